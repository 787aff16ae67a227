"""``seisblock risk``: annual frequency at a site from fragility and hazard."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from seisblock.cli import shell_completion
from seisblock.cli.command import Command, option
from seisblock.cli.console import info
from seisblock.cli.options import check_callback, output_options
from seisblock.cli.output import OutputOptions
from seisblock.cli.write_results import figure_of, write_results
from seisblock.core import checks
from seisblock.core.i18n import gettext

if TYPE_CHECKING:
    from seisblock.studies.fragility.io import FragilityCurve
    from seisblock.studies.hazard.curve import Hazard

_check_years = check_callback(partial(checks.positive, unit="years"))


@click.command(
    cls=Command,
    examples=(
        "seisblock risk --median 60cm/s --beta 0.4 --hazard synthetic_hazard.csv",
        "seisblock risk --median 60cm/s --beta 0.4 --hazard synthetic_hazard.csv --stood 1000 --plot risk.png",
    ),
)
@option(
    "--hazard",
    required=True,
    metavar="FILE",
    type=click.Path(path_type=Path),
    shell_complete=shell_completion.complete_bundled("hazard"),
    section="Site",
    help="CSV of the hazard: levels with unit (pgv_m_s, pga_g, sa(0.5)_gal), annual_rate (or annual_poe, poe_50_years); branch and "
    "weight for several curves. Bundled: synthetic_hazard.csv.",
)
@option(
    "--fragility",
    metavar="FILE",
    type=click.Path(path_type=Path),
    section="Body",
    help="Curves from seisblock fragility --json.",
)
@option(
    "--median",
    metavar="X",
    section="Body",
    help="Median of the fragility, with its unit (0.4g, 60cm/s). The unit may be omitted where the hazard is in SI units.",
)
@option(
    "--beta", type=float, metavar="B", section="Body", help="Dispersion beta of the fragility: standard deviation of the natural logarithm."
)
@option(
    "--im",
    metavar="pga|pgv|pgd|sa:T|rotd50:T|rotd100:T|arias|cav|p*pgv",
    section="Body",
    help="Intensity measure of the fragility (T in s). [default: that of the hazard]",
)
@option(
    "--years",
    type=float,
    default=50.0,
    show_default=True,
    callback=_check_years,
    help="Period for the probability, years.",
)
@option(
    "--stood",
    type=float,
    callback=_check_years,
    metavar="YEARS",
    help="Years without an event: likelihood of each branch of the hazard, years. [default: not computed]",
)
@output_options(histories=False, film=False)
def risk(output: OutputOptions, hazard: Path, years: float, stood: float | None, **params: Any) -> None:
    """Frequency and probability of overturning, sliding or rocking of an object at a site, per year and over a period.

    The annual frequency is the integral of the fragility over the hazard curve, a power law between the levels of its table. Beyond
    the table the curve continues with its end slopes; their contribution is reported.
    """
    from seisblock.report.json.risk import document
    from seisblock.report.text import risk as text_output
    from seisblock.studies.hazard.risk import find_risk

    forms = [params["fragility"] is not None, params["median"] is not None or params["beta"] is not None]
    if sum(forms) != 1 or (params["median"] is None) != (params["beta"] is None):
        raise click.UsageError(gettext("exactly one form is required: --fragility FILE, or --median and --beta"))
    site, curves = _load_inputs(hazard, params)
    risks = [(fragility, find_risk(fragility.curve, site, years=years, stood_years=stood)) for fragility in curves]

    write_results(
        document(risks, site, hazard.name),
        output,
        tables=lambda: text_output.tables(risks, site, gal=output.gal),
        csv=lambda: text_output.csv_columns(risks, site),
        figure=figure_of("risk:figure", risks, site, gal=output.gal),
    )


def _load_inputs(path: Path, params: dict[str, Any]) -> tuple[Hazard, tuple[FragilityCurve, ...]]:
    """Return the hazard and the fragility curves of its intensity measure."""
    from seisblock.core.units import is_unitless
    from seisblock.studies.fragility.io import check_measure, fragility_from_median, read_fragility
    from seisblock.studies.hazard.table import read_hazard

    if params["fragility"] is None:
        site = read_hazard(path, im=params["im"])
        fragility = fragility_from_median(site, params["median"], params["beta"])
        if is_unitless(params["median"]) and fragility.unit != "1":
            info("median {median} has no unit: read as {unit}", median=params["median"].strip(), unit=fragility.unit)
        return site, (fragility,)
    curves = read_fragility(params["fragility"])
    site = read_hazard(path, im=params["im"] or curves[0].im)
    return site, check_measure(curves, site)

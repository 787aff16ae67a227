"""``seisblock risk``: how often it happens at a site, from a fragility and the hazard there."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from seisblock import checks
from seisblock.cli import offered
from seisblock.cli.command import Command, option
from seisblock.cli.emit import emit
from seisblock.cli.options import checked, output_options
from seisblock.cli.output import Output
from seisblock.cli.talk import say
from seisblock.words import tell

if TYPE_CHECKING:
    from seisblock.studies.hazard.curve import Hazard
    from seisblock.studies.hazard.given import GivenFragility

_YEARS = checked(partial(checks.positive, unit="years"))


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
    shell_complete=offered.hazards,
    section="Site",
    help="CSV of the hazard: levels with their unit (pgv_m_s, pga_g, sa(0.5)_gal), annual_rate (or annual_poe, poe_50_years), and branch "
    "and weight where there are several curves. Bundled: synthetic_hazard.csv.",
)
@option(
    "--fragility",
    metavar="FILE",
    type=click.Path(path_type=Path),
    section="Body",
    help="Curves that seisblock fragility --json printed.",
)
@option(
    "--median",
    metavar="X",
    section="Body",
    help="Or its median, with a unit such as 0.4g, 60cm/s; a bare number is in SI, where the levels of the hazard are, too.",
)
@option("--beta", type=float, metavar="B", section="Body", help="And its dispersion, the standard deviation of the logarithm, 1.")
@option(
    "--im",
    metavar="pga|pgv|pgd|sa=T|arias|p*pgv",
    section="Body",
    help="And its measure of intensity (T in s). [default: that of the hazard]",
)
@option(
    "--years",
    type=float,
    default=50.0,
    show_default=True,
    callback=_YEARS,
    help="Time for which the probability is told, years.",
)
@option(
    "--stood",
    type=float,
    callback=_YEARS,
    metavar="YEARS",
    help="How long it did not happen, years: the likelihood of each branch of the hazard. [default: not asked]",
)
@output_options(histories=False, film=False)
def risk(output: Output, hazard: Path, years: float, stood: float | None, **asked: Any) -> None:
    """Tell how often an object falls, slides or rocks at a site, in a year and in many.

    The frequency is the integral of the fragility over the hazard, a power law between the levels of its table; beyond them it goes on
    with its slope, and it is said how much comes from there.
    """
    from seisblock.present.documents.risk import document
    from seisblock.studies.hazard.risk import find_risk

    ways = [asked["fragility"] is not None, asked["median"] is not None or asked["beta"] is not None]
    if sum(ways) != 1 or (asked["median"] is None) != (asked["beta"] is None):
        raise click.UsageError(tell("give --fragility FILE, or --median and --beta"))
    site, curves = _given(hazard, asked)
    found = [(each, find_risk(each.curve, site, years=years, stood_years=stood)) for each in curves]

    def tables() -> Any:
        from seisblock.present.text.risk import tables as shown

        return shown(found, site, gal=output.gal)

    def figure() -> Any:
        from seisblock.present.figures.risk import figure as drawn

        return drawn(found, site, gal=output.gal)

    def csv(path: Path) -> None:
        from seisblock.present.files import write_table
        from seisblock.present.text.risk import columns

        write_table(path, *columns(found, site))

    emit(document(found, site, hazard.name), output, tables=tables, figure=figure, csv=csv)


def _given(path: Path, asked: dict[str, Any]) -> tuple[Hazard, tuple[GivenFragility, ...]]:
    """Return the hazard, and the curves that belong to it."""
    from seisblock.studies.hazard.given import fragility_in, matching, read_fragility
    from seisblock.studies.hazard.table import read_hazard
    from seisblock.units import is_bare

    if asked["fragility"] is None:
        site = read_hazard(path, im=asked["im"])
        given = fragility_in(site, asked["median"], asked["beta"])
        if is_bare(asked["median"]) and given.unit != "1":
            say("the median, {median}, has no unit: it is taken in {unit}", median=asked["median"].strip(), unit=given.unit)
        return site, (given,)
    curves = read_fragility(asked["fragility"])
    site = read_hazard(path, im=asked["im"] or curves[0].im)
    return site, matching(curves, site)

"""``seisblock overturn-rate``: overturning rate of the gravestones of a cemetery."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from seisblock.bodies.edge_wear import DEFAULT_WEAR, MAX_SHARE, EdgeWear
from seisblock.cli import shell_completion
from seisblock.cli.build import gravity_option, solver_options
from seisblock.cli.command import Command, option
from seisblock.cli.console import info
from seisblock.cli.option_checks import RECORD_OPTIONS, reject_with, reject_without
from seisblock.cli.options import Source, check_callback, curve_record_options, output_options
from seisblock.cli.output import OutputOptions
from seisblock.cli.progress import progress
from seisblock.cli.suggest import SuggestingChoice
from seisblock.cli.types import FLOATS, INSET, LENGTH, Count
from seisblock.cli.write_results import write_results
from seisblock.core import checks
from seisblock.core.i18n import N_, gettext, lazy_gettext
from seisblock.core.limits import MAX_CELLS, MAX_STONES, check_limit
from seisblock.models.rock.options import RockOptions

if TYPE_CHECKING:
    from seisblock.studies.survey.shaking import FrequencyKind

FREQUENCY_KINDS: dict[str, FrequencyKind] = {"pga-pgv": "pga_pgv", "fourier": "fourier", "pulse-width": "pulse_width"}
"""Definitions of the equivalent frequency: option value and library name."""

FITTED_EDGES = lazy_gettext(
    "--inset has no effect on criteria (9), (10), which were fitted to gravestones with worn edges; it acts with --criterion rigid "
    "and simulate"
)


def _parse_fit(ctx: click.Context, param: click.Parameter, value: str | None) -> tuple[float, float, float] | None:
    """Parse P,Q,R in gal, Hz and 1."""
    if value is None:
        return None
    try:
        p, q, r = (float(part) for part in value.split(","))
    except ValueError as error:
        raise click.BadParameter(
            gettext("{value!r} is not P,Q,R (P in gal, Q in Hz), for example 826.8,1.92,4.6", value=value), ctx, param
        ) from error
    return p, q, r


@click.command(
    "overturn-rate",
    cls=Command,
    essential=("--cemetery", "--reinforced", "--pga", "--frequency", "--criterion", "--inset"),
    examples=(
        "seisblock overturn-rate --cemetery aoyama.csv",
        "seisblock overturn-rate --cemetery aoyama.csv record.csv --both --plot rate.png",
    ),
)
@curve_record_options
@option(
    "--cemetery",
    required=True,
    metavar="FILE|NAME",
    shell_complete=shell_completion.complete_cemeteries,
    section="Body",
    help="CSV of gravestones: height_over_width, or height and width; optional reinforced, fallen, azimuth_deg, count. "
    "Bundled: aoyama.csv.",
)
@option("--reinforced", is_flag=True, section="Body", help="Assess all stones as reinforced (dowels).")
@option("--both", is_flag=True, section="Body", help="Compare with all stones reinforced: number of stones saved.")
@option(
    "--most-fragile",
    type=Count(N_("gravestones"), MAX_STONES),
    metavar="K",
    section="Body",
    help="Compare with the K most slender stones reinforced. [default: none]",
)
@option(
    "--stone-width",
    type=LENGTH,
    callback=check_callback(checks.positive),
    section="Body",
    help="Width of stones without a width in the file, m or with a unit. [default: 8sun]",
)
@option("--pga", type=FLOATS, metavar="GAL", help="Without RECORD: peak ground acceleration, gal; number, list or range.")
@option(
    "--frequency",
    type=FLOATS,
    metavar="HZ",
    help="Frequency, Hz; number, list or range. With RECORD: instead of its equivalent frequency.",
)
@option(
    "--equivalent",
    type=SuggestingChoice(FREQUENCY_KINDS),
    default="pga-pgv",
    show_default=True,
    help="Equivalent frequency of RECORD: PGA/(2 pi PGV), dominant Fourier frequency, or from the width of the pulse of the PGA.",
)
@option(
    "--criterion",
    type=SuggestingChoice(["furukawa", "rigid", "simulate"]),
    default="furukawa",
    show_default=True,
    help="Fitted criteria (9), (10) for whole gravestones; one rigid block under a half sine; or simulated rocking of each stone "
    "under RECORD or a 20 s sine.",
)
@option(
    "--inset",
    type=INSET,
    metavar="SHARE|M",
    help="rigid, simulate: inset of worn edges from each side, share of the width (0.1, 10%), or m with a unit (1cm). [default: 0.05]",
)
@option(
    "--fit",
    callback=_parse_fit,
    metavar="P,Q,R",
    help="furukawa: parameters P,Q,R without a dowel; P in gal, Q in Hz. [default: 826.8,1.92,4.6]",
)
@option(
    "--fit-reinforced",
    callback=_parse_fit,
    metavar="P,Q,R",
    help="furukawa: parameters P,Q,R with a dowel; P in gal, Q in Hz. [default: 1162.9,1.84,4.5]",
)
@option(
    "--confidence",
    type=float,
    default=0.95,
    show_default=True,
    callback=check_callback(partial(checks.in_interval, interval="(0, 1)")),
    help="Confidence level of the interval of the rate, 0 to 1.",
)
@solver_options(RockOptions, "vertical")
@gravity_option
@output_options(histories=False, film=False)
def overturn_rate(
    source: Source, output: OutputOptions, cemetery: str, reinforced: bool, both: bool, most_fragile: int | None, **params: Any
) -> None:
    """Overturning rate of the gravestones of a cemetery (Furukawa et al. 2009).

    A stone overturns when its height over width exceeds a(f)/PGA. Without RECORD: curve of the rate against PGA, or the rate at --pga and
    --frequency. With RECORD: rate for each horizontal component and for the larger of them. --csv writes the printed table, --json also the
    curve.
    """
    from seisblock.bodies.cemetery.table import read_cemetery
    from seisblock.report.json.overturn_rate import document, parameters_of
    from seisblock.studies.survey import assessment as study
    from seisblock.studies.survey.overturning_rate import FREQUENCIES

    if reinforced + both + (most_fragile is not None) > 1:
        raise click.UsageError(gettext("--reinforced, --both and --most-fragile exclude each other: give only one of them"))
    _check_options(source, params)
    stones = read_cemetery(cemetery)
    for note in stones.notes[:1]:
        info("{cemetery}: {note}", cemetery=cemetery, note=lazy_gettext(note))
    stones = stones.with_dowels() if reinforced else stones
    dowelled = stones.with_dowels(most_fragile) if both or most_fragile else None
    inset, notes = _resolve_inset(params["inset"], params["criterion"])
    method = _make_method({**params, "inset": inset})
    groups = _shaking_groups(source, params)
    with progress("overturning rates") as advance:
        rate_groups = [
            (
                record,
                [study.assess_cemetery(stones, shaking, method, reinforced_cemetery=dowelled, progress=advance) for shaking in shakings],
            )
            for record, shakings in groups
        ]
        frequencies = params["frequency"] or FREQUENCIES
        simulated = (
            [point for _, rates in rate_groups for shaking in rates for point in shaking.curve] if method.criterion == "simulate" else []
        )
        curve = simulated or study.overturning_curve(stones, method, frequencies=frequencies, progress=advance)
    results = [
        (record, [*rates, study.larger_component(rates)] if record is not None and len(rates) > 1 else rates)
        for record, rates in rate_groups
    ]
    warnings = notes + study.cemetery_warnings(
        stones, [shaking for _, shakings in groups for shaking in shakings], method, reinforced_cemetery=dowelled
    )
    frequency_kind = "given" if params["frequency"] else FREQUENCY_KINDS[params["equivalent"]]
    motions = [shaking.motion for _, shakings in groups for shaking in shakings if shaking.motion is not None]
    parameters = parameters_of(stones, dowelled, method, motions=motions, frequency_kind=frequency_kind)
    answer = document(results, curve, parameters, citations=method.citations, warnings=warnings)

    def tables() -> Any:
        from seisblock.report.text.overturn_rate import tables as text_output

        return text_output(stones, results, curve, gal=output.gal, confidence=method.confidence)

    def figure() -> Any:
        from seisblock.report.figures.cemetery import overturn_rate_figure

        return overturn_rate_figure(stones, results, curve, gal=output.gal)

    def csv(path: Path) -> None:
        from seisblock.report.io.atomic import write_table
        from seisblock.report.text.overturn_rate import curve_csv, rate_csv

        if results:
            write_table(path, *rate_csv(results))
            return
        write_table(path, *curve_csv(curve, study.overturning_curve(dowelled, method, frequencies=frequencies) if dowelled else None))

    write_results(answer, output, tables=tables, figure=figure, csv=csv)


def _check_options(source: Source, params: dict[str, Any]) -> None:
    """Raise an error for options without effect on this motion or criterion."""
    if not source.record:
        reject_without("RECORD", [*RECORD_OPTIONS, "equivalent", "vertical"])
    elif params["frequency"]:
        reject_with("--frequency", ["equivalent"])
    if params["criterion"] != "furukawa":
        reject_with(f"--criterion {params['criterion']}", ["fit", "fit_reinforced"])
    elif not (source.record or params["pga"]):
        reject_without(lazy_gettext("RECORD, --pga or --criterion rigid"), ["stone_width", "gravity"])


def _make_method(params: dict[str, Any]) -> Any:
    from seisblock.bodies.cemetery.cemetery import PAPER_WIDTH
    from seisblock.criteria.gravestones import DOWELLED, PLAIN, GravestoneFit
    from seisblock.studies.survey.assessment import AssessmentMethod

    undowelled, dowelled = (
        preset if custom is None else GravestoneFit(custom[0] / 100.0, custom[1], custom[2])
        for custom, preset in ((params["fit"], PLAIN), (params["fit_reinforced"], DOWELLED))
    )
    width = PAPER_WIDTH if params["stone_width"] is None else params["stone_width"]
    return AssessmentMethod(
        params["criterion"], (undowelled, dowelled), params["inset"], width, params["gravity"], params["confidence"], params["vertical"]
    )


def _resolve_inset(inset: EdgeWear | None, criterion: str) -> tuple[EdgeWear, list[str]]:
    """Return the inset and the warnings about its interpretation."""
    if inset is None:
        if criterion != "furukawa":
            info(
                "stones have edges worn by {share:g} of their width per side (default); --inset 0 for sharp edges", share=DEFAULT_WEAR.share
            )
        return DEFAULT_WEAR, []
    if criterion == "furukawa":
        return inset, [FITTED_EDGES]
    if inset.length_m == 0.0 and MAX_SHARE < inset.share <= 1.0:
        converted = EdgeWear(share=round((1.0 - inset.share) / 2, 12))
        return converted, [
            lazy_gettext(
                "--inset {given:g} was read as in version 0.1.0 (pivot distance over half width): {share:g} of the width per side",
                given=inset.share,
                share=converted.share,
            )
        ]
    return inset, []


def _shaking_groups(source: Source, params: dict[str, Any]) -> list[tuple[Any, list[Any]]]:
    """Return the ground motions, grouped by record; None without record."""
    from seisblock.studies.survey.overturning_rate import FREQUENCIES
    from seisblock.studies.survey.shaking import Shaking, component_shakings

    pga, frequency = params["pga"], params["frequency"]
    if not source.record:
        check_limit(N_("ground motions"), len(pga or ()) * len(frequency or FREQUENCIES), MAX_CELLS)
        return [(None, [Shaking(a / 100.0, f) for a in pga for f in frequency or FREQUENCIES])] if pga else []
    if pga:
        raise click.UsageError(gettext("RECORD and --pga exclude each other: give only one of them; --target-pga scales a record"))
    if frequency and len(frequency) > 1:
        raise click.UsageError(gettext("--frequency accepts one value with RECORD, found {count}", count=len(frequency)))
    from seisblock.cli.load_records import load_records, selected_components

    record_frequency = frequency[0] if frequency else None
    return [
        (
            record,
            component_shakings(
                record, selected_components(record, source), kind=FREQUENCY_KINDS[params["equivalent"]], frequency=record_frequency
            ),
        )
        for record in load_records(source)
    ]

"""``seisblock overturn-rate``: overturning rate of the gravestones of a cemetery."""

from __future__ import annotations

import math
from functools import partial
from itertools import product
from typing import TYPE_CHECKING, Any

import click

from seisblock.bodies.edge_wear import DEFAULT_WEAR, MAX_SHARE, EdgeWear
from seisblock.cli.bodies.options import cemetery_option, inset_option, stones_option
from seisblock.cli.build import gravity_option, solver_options
from seisblock.cli.command import Command, option
from seisblock.cli.console import info
from seisblock.cli.option_checks import RECORD_OPTIONS, given_flags, reject_with, reject_without
from seisblock.cli.options import Source, check_callback, curve_record_options, output_options
from seisblock.cli.output import OutputOptions
from seisblock.cli.progress import progress
from seisblock.cli.suggest import SuggestingChoice
from seisblock.cli.types import LENGTH, PEAK_UNITS, Count, Quantities
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
    essential=("--cemetery", "--reinforced", "--pga", "--pgv", "--frequency", "--criterion", "--inset"),
    examples=(
        "seisblock overturn-rate --cemetery aoyama.csv",
        "seisblock overturn-rate --cemetery aoyama.csv record.csv --both --plot rate.png",
    ),
)
@curve_record_options
@cemetery_option(
    "Table of gravestones (.csv, .xlsx): height_over_width, or height and width; optional name, reinforced, fallen, azimuth_deg, "
    "count, inset. Bundled: aoyama.csv.",
    required=True,
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
@option(
    "--pga", type=Quantities(PEAK_UNITS["GAL"]), metavar="GAL", help="Without RECORD: peak ground acceleration, gal; number, list or range."
)
@option(
    "--frequency",
    type=Quantities(PEAK_UNITS["HZ"]),
    metavar="HZ",
    help="Frequency, Hz; number, list or range. With RECORD: instead of its equivalent frequency.",
)
@option(
    "--pgv",
    type=Quantities(PEAK_UNITS["KINE"]),
    metavar="KINE",
    help="Without RECORD: PGV, kine, with --pga instead of --frequency; number, list or range.",
)
@option("--paired", is_flag=True, help="Take --pga and --frequency (or --pgv) in pairs instead of all combinations; lists of equal length.")
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
    help="Fitted criteria (9), (10) for whole gravestones; one rigid block under a half sine; or simulated rocking of each stone "
    "under RECORD or a 20 s sine. [default: simulate with RECORD; furukawa without, for reinforced stones and with --frequency, "
    "--equivalent or --fit]",
)
@inset_option(
    "rigid, simulate: inset of worn edges from each side, share of the width (0.1, 10%), or m with a unit (1cm). [default: "
    "0 to 0.1, median 0.05]",
    section="Solver",
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
@stones_option
@solver_options(RockOptions, "vertical")
@gravity_option
@output_options(histories=False, film=False)
def overturn_rate(
    source: Source, output: OutputOptions, cemetery: str, reinforced: bool, both: bool, most_fragile: int | None, **params: Any
) -> None:
    """Overturning rate of the gravestones of a cemetery (Furukawa et al. 2009).

    With RECORD each stone rocks under each horizontal component and counts if either overturns it; observed falls of the table are
    compared. Without RECORD a stone overturns when its height over width exceeds a(f)/PGA: curve of the rate against PGA, or the rate at
    --pga and --frequency. --csv writes the printed table, --json also the curve and each stone.
    """
    from seisblock.bodies.cemetery.table import read_cemetery
    from seisblock.report.json.overturn_rate import document, parameters_of
    from seisblock.report.text import overturn_rate as text_output
    from seisblock.report.text.stones import RATE_COLUMNS as STONE_COLUMNS
    from seisblock.report.text.stones import rate_groups, write_stones
    from seisblock.studies.survey import assessment as study
    from seisblock.studies.survey.overturning_rate import FREQUENCIES

    if reinforced + both + (most_fragile is not None) > 1:
        raise click.UsageError(gettext("--reinforced, --both and --most-fragile exclude each other: give only one of them"))
    if params["stones"] is not None and not (source.record or params["pga"]):
        raise click.UsageError(gettext("--stones requires RECORD, or --pga: the outcome of a stone depends on the shaking"))
    stones = read_cemetery(cemetery)
    for note in stones.notes[:1]:
        info("{cemetery}: {note}", cemetery=cemetery, note=lazy_gettext(note))
    stones = stones.with_dowels() if reinforced else stones
    dowelled = stones.with_dowels(most_fragile) if both or most_fragile else None
    params["criterion"] = params["criterion"] or _default_criterion(
        source, params, has_dowels=dowelled is not None or bool(stones.reinforced.any())
    )
    _check_options(source, params)
    inset, notes = _resolve_inset(params["inset"], params["criterion"])
    method = _make_method({**params, "inset": inset})
    groups = _shaking_groups(source, params)
    with progress("overturning rates") as advance:
        results = [
            (record, study.assess_record(stones, shakings, method, reinforced_cemetery=dowelled, progress=advance))
            if record is not None
            else (
                record,
                [study.assess_cemetery(stones, shaking, method, reinforced_cemetery=dowelled, progress=advance) for shaking in shakings],
            )
            for record, shakings in groups
        ]
        frequencies = params["frequency"] or FREQUENCIES
        simulated = [point for _, rates in results for rate in rates[-1:] for point in rate.curve] if method.criterion == "simulate" else []
        curve = simulated or study.overturning_curve(stones, method, frequencies=frequencies, progress=advance)
    warnings = notes + study.cemetery_warnings(
        stones, [shaking for _, shakings in groups for shaking in shakings], method, reinforced_cemetery=dowelled
    )
    frequency_kind = "given" if params["frequency"] else FREQUENCY_KINDS[params["equivalent"]]
    motions = [shaking.motion for _, shakings in groups for shaking in shakings if shaking.motion is not None]
    parameters = parameters_of(stones, dowelled, method, motions=motions, frequency_kind=frequency_kind)
    answer = document(results, curve, parameters, citations=method.citations, warnings=warnings)

    def reinforced_curve() -> Any:
        """Return the curve with dowels, empty with results or where none are compared."""
        return study.overturning_curve(dowelled, method, frequencies=frequencies) if dowelled and not results else ()

    def figure() -> Any:
        from seisblock.report.figures.cemetery import overturn_rate_figure

        return overturn_rate_figure(stones, results, curve, reinforced_curve(), gal=output.gal)

    if params["stones"] is not None:
        write_stones(params["stones"], STONE_COLUMNS, rate_groups(results))
        info("wrote {file}", file=str(params["stones"]))
    write_results(
        answer,
        output,
        tables=lambda: text_output.tables(stones, results, curve, gal=output.gal, confidence=method.confidence),
        figure=figure,
        csv=lambda: text_output.rate_csv(results) if results else text_output.curve_csv(curve, reinforced_curve() or None),
    )


def _default_criterion(source: Source, params: dict[str, Any], *, has_dowels: bool) -> str:
    """Return the criterion of a call that names none: each stone is simulated where there is a motion."""
    uses_fit = bool(params["frequency"] or params["fit"] or params["fit_reinforced"] or given_flags(["equivalent"]))
    return "simulate" if source.record and not uses_fit and not has_dowels else "furukawa"


def _check_options(source: Source, params: dict[str, Any]) -> None:
    """Raise an error for options without effect on this motion or criterion."""
    if params["pgv"] and params["frequency"]:
        raise click.UsageError(gettext("--pgv and --frequency exclude each other: give only one of them"))
    if source.record:
        reject_with("RECORD", ["paired", "pgv"])
        if params["frequency"]:
            reject_with("--frequency", ["equivalent"])
    else:
        if not params["pga"]:
            reject_without("--pga", ["pgv"])
        reject_without("RECORD", [*RECORD_OPTIONS, "equivalent", "vertical"])
    if params["criterion"] != "furukawa":
        reject_with(f"--criterion {params['criterion']}", ["fit", "fit_reinforced"])
    elif not (source.record or params["pga"]):
        reject_without(lazy_gettext("RECORD, --pga or --criterion rigid"), ["stone_width", "gravity"])


def _make_method(params: dict[str, Any]) -> Any:
    from seisblock.bodies.table import PAPER_WIDTH
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


def _resolve_inset(inset: EdgeWear | None, criterion: str) -> tuple[EdgeWear | None, list[str]]:
    """Return the inset and the warnings about its interpretation."""
    if inset is None:
        if criterion != "furukawa":
            info(
                "stones have edges worn by {share:g} of their width per side (default); --inset 0 for sharp edges", share=DEFAULT_WEAR.share
            )
        return None, []
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


def _peaks(params: dict[str, Any]) -> list[tuple[float, float]]:
    """Return PGA, m/s^2, and frequency, Hz, of the ground motions without a record: all combinations, or pairs."""
    from seisblock.studies.survey.overturning_rate import FREQUENCIES

    pga, pgv = params["pga"] or (), params["pgv"] or ()
    second_values = pgv or params["frequency"] or (() if params["paired"] else FREQUENCIES)
    if params["paired"] and not len(pga) == len(second_values) > 0:
        text = N_("--paired requires as many values of --pga as of --frequency, found {first} and {second}")
        if pgv:
            text = N_("--paired requires as many values of --pga as of --pgv, found {first} and {second}")
        raise click.UsageError(gettext(text, first=len(pga), second=len(second_values)))
    check_limit(N_("ground motions"), len(pga) * (1 if params["paired"] else len(second_values)), MAX_CELLS)
    pairs = zip(pga, second_values, strict=True) if params["paired"] else product(pga, second_values)
    if not pgv:
        return [(a / 100.0, f) for a, f in pairs]
    for value in pgv:
        checks.positive("PGV", value, "kine")
    # the equivalent frequency of both peaks
    return [(a / 100.0, a / (2.0 * math.pi * v)) for a, v in pairs]


def _shaking_groups(source: Source, params: dict[str, Any]) -> list[tuple[Any, list[Any]]]:
    """Return the ground motions, grouped by record; None without record."""
    from seisblock.studies.survey.shaking import Shaking, component_shakings

    pga, frequency = params["pga"], params["frequency"]
    if not source.record:
        return [(None, [Shaking(a, f) for a, f in _peaks(params)])] if pga or params["paired"] else []
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

"""``seisblock overturn-rate``: which share of a cemetery falls."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from seisblock import checks
from seisblock.bodies.inset import HALF, WORN, Inset
from seisblock.cli import offered
from seisblock.cli.command import Command, option
from seisblock.cli.emit import emit
from seisblock.cli.idle import RECORD_OPTIONS, refuse_beside, refuse_without
from seisblock.cli.meant import OneOf
from seisblock.cli.options import Source, checked, gravity_option, output_options, record_options
from seisblock.cli.output import Output
from seisblock.cli.progress import progress
from seisblock.cli.talk import say
from seisblock.cli.types import FLOATS, INSET, LENGTH, Count
from seisblock.limits import check_budget
from seisblock.words import noted, said, tell

if TYPE_CHECKING:
    from seisblock.studies.cemetery.shaking import FrequencyKind

KINDS: dict[str, FrequencyKind] = {"pga-pgv": "pga_pgv", "fourier": "fourier", "pulse-width": "pulse_width"}
"""Definitions of the equivalent frequency, as they are spelled here and in the library."""

FITTED_EDGES = said(
    "--inset changes nothing here: (9), (10) were fitted to stones whose edges are not sharp; --criterion rigid, simulate use it"
)


def _fit(ctx: click.Context, param: click.Parameter, value: str | None) -> tuple[float, float, float] | None:
    """Accept P,Q,R in gal, Hz and 1."""
    if value is None:
        return None
    try:
        p, q, r = (float(part) for part in value.split(","))
    except ValueError as error:
        raise click.BadParameter(
            tell("{value!r} is not P,Q,R in gal, Hz and 1, for example 826.8,1.92,4.6", value=value), ctx, param
        ) from error
    return p, q, r


@click.command(
    "overturn-rate",
    cls=Command,
    examples=(
        "seisblock overturn-rate --cemetery aoyama.csv",
        "seisblock overturn-rate --cemetery aoyama.csv record.csv --both --plot rate.png",
    ),
)
@record_options
@option(
    "--cemetery",
    required=True,
    metavar="FILE|NAME",
    shell_complete=offered.cemeteries,
    section="Body",
    help="CSV of gravestones: height_over_width, or height and width; optional reinforced, fallen, azimuth_deg, count. "
    "Bundled: aoyama.csv.",
)
@option("--reinforced", is_flag=True, section="Body", help="Judge as if every stone were reinforced.")
@option("--both", is_flag=True, section="Body", help="Compare with every stone reinforced, and say how many that saves.")
@option(
    "--most-fragile",
    type=Count(noted("gravestones"), "SEISBLOCK_STONES"),
    metavar="K",
    section="Body",
    help="Compare with the K most slender stones reinforced. [default: none]",
)
@option(
    "--stone-width",
    type=LENGTH,
    callback=checked(checks.positive),
    section="Body",
    help="Width of stones whose width is not in the file, m or with a unit. [default: 8sun]",
)
@option("--pga", type=FLOATS, metavar="GAL", help="Without RECORD: peak ground acceleration, gal; a list or range is answered one by one.")
@option(
    "--frequency",
    type=FLOATS,
    metavar="HZ",
    help="Without RECORD: frequency, Hz, or a list or range (also of the curves). With RECORD: instead of its equivalent frequency.",
)
@option(
    "--equivalent",
    type=OneOf(KINDS),
    default="pga-pgv",
    show_default=True,
    help="Equivalent frequency of RECORD: PGA/(2 pi PGV), dominant Fourier frequency, or from the width of the pulse of the PGA.",
)
@option(
    "--criterion",
    type=OneOf(["furukawa", "rigid", "simulate"]),
    default="furukawa",
    show_default=True,
    help="Fit to whole stones (9), (10); one rigid block under a half sine; or each stone rocking under RECORD or a 20 s sine.",
)
@option(
    "--inset",
    type=INSET,
    metavar="SHARE|M",
    help="rigid, simulate: how far in from each side a stone's worn edges lie, a share of its width (0.1, 10%), or m with a unit "
    "(1cm). [default: 0.05]",
)
@option("--fit", callback=_fit, metavar="P,Q,R", help="furukawa: own parameters without a dowel, gal, Hz, 1. [default: 826.8,1.92,4.6]")
@option(
    "--fit-reinforced", callback=_fit, metavar="P,Q,R", help="furukawa: own parameters with a dowel, gal, Hz, 1. [default: 1162.9,1.84,4.5]"
)
@option(
    "--confidence",
    type=float,
    default=0.95,
    show_default=True,
    callback=checked(partial(checks.within, interval="(0, 1)")),
    help="Level of the interval of a rate, 0 to 1.",
)
@gravity_option
@output_options(histories=False, film=False)
def overturn_rate(
    source: Source, output: Output, cemetery: str, reinforced: bool, both: bool, most_fragile: int | None, **asked: Any
) -> None:
    """Tell which share of a cemetery's gravestones falls (Furukawa et al. 2009).

    A stone falls when its height over width exceeds a(f)/PGA. Without RECORD the curve of rates against PGA is printed, or the rate
    at --pga and --frequency; with one the rate for each horizontal component and for the larger of them. --csv holds what is printed,
    --json the curve, too.
    """
    from seisblock.bodies.cemetery.table import read_cemetery
    from seisblock.present.documents.overturn_rate import document, parameters_of
    from seisblock.studies.cemetery import judgement as study
    from seisblock.studies.cemetery.rate import FREQUENCIES

    if reinforced + both + (most_fragile is not None) > 1:
        raise click.UsageError(tell("give one of --reinforced, --both and --most-fragile"))
    _refuse_idle(source, asked)
    stones = read_cemetery(cemetery)
    for note in stones.notes[:1]:
        say("{cemetery}: {note}", cemetery=cemetery, note=said(note))
    stones = stones.dowelled() if reinforced else stones
    after = stones.dowelled(most_fragile) if both or most_fragile else None
    inset, notes = _edges(asked["inset"], asked["criterion"])
    method = _method({**asked, "inset": inset})
    groups = _groups(source, asked)
    with progress("rates against PGA") as advance:
        judged = [
            (record, [study.judge_cemetery(stones, each, method, after=after, progress=advance) for each in shakings])
            for record, shakings in groups
        ]
        frequencies = asked["frequency"] or FREQUENCIES
        simulated = [point for _, rates in judged for each in rates for point in each.curve] if method.criterion == "simulate" else []
        curve = simulated or study.curve_of(stones, method, frequencies=frequencies, progress=advance)
    found = [(record, [*rates, study.larger_of(rates)] if record is not None and len(rates) > 1 else rates) for record, rates in judged]
    warnings = notes + study.warnings_of(stones, [each for _, shakings in groups for each in shakings], method, after=after)
    frequency_kind = "given" if asked["frequency"] else KINDS[asked["equivalent"]]
    parameters = parameters_of(stones, after, method, frequency_kind=frequency_kind)
    answer = document(found, curve, parameters, citations=method.citations, warnings=warnings)

    def tables() -> Any:
        from seisblock.present.text.overturn_rate import tables as shown

        return shown(stones, found, curve, gal=output.gal, confidence=method.confidence)

    def figure() -> Any:
        from seisblock.present.figures.cemetery import overturn_rate_figure

        return overturn_rate_figure(stones, found, curve, gal=output.gal)

    def csv(path: Path) -> None:
        from seisblock.present.files import write_table
        from seisblock.present.text.overturn_rate import curve_columns, rate_columns

        if found:
            write_table(path, *rate_columns(found))
            return
        write_table(path, *curve_columns(curve, study.curve_of(after, method, frequencies=frequencies) if after else None))

    emit(answer, output, tables=tables, figure=figure, csv=csv)


def _refuse_idle(source: Source, asked: dict[str, Any]) -> None:
    """Refuse what says nothing of this kind of shaking, or by this criterion."""
    if not source.record:
        refuse_without("RECORD", [*RECORD_OPTIONS, "equivalent"])
    elif asked["frequency"]:
        refuse_beside("--frequency", ["equivalent"])
    if asked["criterion"] != "furukawa":
        refuse_beside(f"--criterion {asked['criterion']}", ["fit", "fit_reinforced"])
    elif not (source.record or asked["pga"]):
        refuse_without(said("RECORD, --pga or --criterion rigid"), ["stone_width", "gravity"])


def _method(asked: dict[str, Any]) -> Any:
    """Return how stones are judged."""
    from seisblock.bodies.cemetery.cemetery import PAPER_WIDTH
    from seisblock.criteria.gravestones import DOWELLED, PLAIN, GravestoneFit
    from seisblock.studies.cemetery.judgement import Method

    plain, dowelled = (
        preset if own is None else GravestoneFit(own[0] / 100.0, own[1], own[2])
        for own, preset in ((asked["fit"], PLAIN), (asked["fit_reinforced"], DOWELLED))
    )
    width = PAPER_WIDTH if asked["stone_width"] is None else asked["stone_width"]
    return Method(asked["criterion"], (plain, dowelled), asked["inset"], width, asked["gravity"], asked["confidence"])


def _edges(inset: Inset | None, criterion: str) -> tuple[Inset, list[str]]:
    """Return the inset that is meant, and what must be said of how it was understood."""
    if inset is None:
        if criterion != "furukawa":
            say("stones turn about edges worn by {share:g} of their width per side; --inset 0 for sharp ones", share=WORN.share)
        return WORN, []
    if criterion == "furukawa":
        return inset, [FITTED_EDGES]
    if inset.length_m == 0.0 and HALF < inset.share <= 1.0:
        told = Inset(share=round((1.0 - inset.share) / 2, 12))
        return told, [
            said(
                "--inset {given:g} is understood as in 0.1.0, pivots over half width: {share:g} of the width per side",
                given=inset.share,
                share=told.share,
            )
        ]
    return inset, []


def _groups(source: Source, asked: dict[str, Any]) -> list[tuple[Any, list[Any]]]:
    """Return the shakings to judge, under the record they belong to, or None."""
    from seisblock.studies.cemetery.rate import FREQUENCIES
    from seisblock.studies.cemetery.shaking import Shaking, shakings_of

    pga, frequency = asked["pga"], asked["frequency"]
    if not source.record:
        check_budget(noted("shakings"), len(pga or ()) * len(frequency or FREQUENCIES), "SEISBLOCK_CELLS")
        return [(None, [Shaking(a / 100.0, f) for a in pga for f in frequency or FREQUENCIES])] if pga else []
    if pga:
        raise click.UsageError(tell("give either RECORD or --pga; --target-pga scales a record"))
    if frequency and len(frequency) > 1:
        raise click.UsageError(tell("with RECORD --frequency takes one value, found {count}", count=len(frequency)))
    from seisblock.cli.inputs import components, load

    own = frequency[0] if frequency else None
    return [
        (record, shakings_of(record, components(record, source), kind=KINDS[asked["equivalent"]], frequency=own)) for record in load(source)
    ]

"""How fragilities are told: where half of the motions do it, how wide the scatter is, and how far that is to be trusted."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

from seisblock.present.scales import length_unit
from seisblock.present.text.tables import NOTHING, line, number, table
from seisblock.studies.fragility.answer import Fragility, FragilityStudy, Interval
from seisblock.studies.fragility.estimate import CLOUD, IDA, STRIPES
from seisblock.studies.fragility.limits import SLIP, said_limit
from seisblock.studies.fragility.lognormal import Lognormal
from seisblock.words import noted, tell

MOST_VERDICTS = 4
"""Curves each of which has a sentence of its own."""

_METHODS = {
    STRIPES: noted("every record at every level, maximum likelihood"),
    IDA: noted("the level at which each record does it first"),
    CLOUD: noted("records as they are, probit regression"),
}


def limit_name(name: str, *, gal: bool = True) -> str:
    """Return a limit as it is told: ``overturn`` as overturns, ``slip=0.05m`` as moved 5 cm, or 0.05 m."""
    kind, _, threshold = name.partition("=")
    if kind != SLIP:
        return tell(said_limit(name))
    far = float(threshold.removesuffix("m"))
    size, unit = length_unit([far], gal=gal)
    return tell("moved {length}", length=f"{round(far / size, 6):g} {unit}")


def tables(study: FragilityStudy, *, gal: bool, compare: Lognormal | None = None) -> Iterator[Any]:
    """Yield what is printed: the median of each curve, the table of all, what the scatter comes from, and the measures side by side.

    Parameters
    ----------
    study : FragilityStudy
    gal : bool
        Whether intensities are told in gal, kine and cm, else in SI.
    compare : Lognormal or None
        A curve to tell them beside.
    """
    fitted = [curve for curve in study.curves if curve.median is not None]
    yield from (line(told, "bold") for told in _verdicts(study, fitted, gal=gal))
    yield _curves(study, gal=gal)
    yield line(_what(study), "dim")
    if any(curve.beta_alone is not None for curve in study.curves):
        yield line(tell("The limits share one beta, so that their curves do not cross; a run past a limit is past those before it."), "dim")
    yield from (line(text) for curve in fitted if (text := _scatter(curve, several=len(fitted) > 1, gal=gal)))
    if compare is not None:
        yield from (line(_beside(study, curve, compare, gal=gal)) for curve in fitted)
    compared = [curve for curve in fitted if curve.measures]
    yield from (_measures(curve, several=len(fitted) > 1, gal=gal) for curve in compared)
    if compared:
        text = noted("beta: the smaller, the better it tells; slopes of what it leaves unexplained: none is best, p: that it is chance")
        yield line(tell(text), "dim")


def _verdicts(study: FragilityStudy, fitted: Sequence[Fragility], *, gal: bool) -> Iterator[str]:
    """Yield what each curve says; of many, the one that does it first and the one that does it last."""
    if len(fitted) <= MOST_VERDICTS:
        yield from (verdict(study, curve, gal=gal) for curve in fitted)
        return
    by_median = sorted(fitted, key=lambda curve: curve.median or 0.0)
    yield tell("first of {count}: {verdict}", count=len(fitted), verdict=verdict(study, by_median[0], gal=gal))
    yield tell("last of {count}: {verdict}", count=len(fitted), verdict=verdict(study, by_median[-1], gal=gal))


def verdict(study: FragilityStudy, curve: Fragility, *, gal: bool) -> str:
    """Return what one curve says."""
    size, unit = study.measure.shown(gal=gal)
    return tell(
        "{body}, {limit}: median {im} {median}, beta {beta:.2f}",
        body=tell(curve.body),
        limit=limit_name(curve.limit, gal=gal),
        im=study.measure.label,
        median=f"{number((curve.median or 0.0) / size, 3)} {unit}".strip(),
        beta=curve.beta or 0.0,
    )


def _curves(study: FragilityStudy, *, gal: bool) -> Any:
    """Return the table of all curves."""
    size, unit = study.measure.shown(gal=gal)
    bodies = list(dict.fromkeys(curve.body for curve in study.curves))
    several = len(bodies) > 1
    name = f"{study.measure.label} ({unit})" if unit else study.measure.label
    heads = [*([tell("body")] if several else []), tell("limit"), name, tell("beta"), tell("not monotone"), tell("fits")]
    rows = [
        [
            *([tell(curve.body)] if several else []),
            limit_name(curve.limit, gal=gal),
            _with_range(curve.median, curve.median_interval, lambda value: number(value / size, 3)),
            _with_range(curve.beta, curve.beta_interval, lambda value: f"{value:.2f}"),
            NOTHING if curve.method == CLOUD else f"{curve.non_monotone_motions}/{curve.motions}",
            None if curve.goodness is None else curve.goodness.fits,
        ]
        for curve in study.curves
    ]
    caption = tell(
        "median and beta with {level:g%} intervals over records; not monotone: motions that do it, and at a higher level do not",
        level=study.confidence,
    )
    return table("" if several else tell(bodies[0]), heads, rows, caption=caption)


def _with_range(value: float | None, interval: Interval | None, told: Callable[[float], str]) -> str:
    """Return a value with its interval, as far as they are known."""
    if value is None:
        return NOTHING
    return told(value) if interval is None else f"{told(value)} ({told(interval[0])}-{told(interval[1])})"


def _what(study: FragilityStudy) -> str:
    """Return what the curves rest on."""
    first = study.curves[0]
    low, high = study.factors
    return tell(
        "{records} records, {motions} motions; {method}; levels: {levels}, factors on the records {low:.2g} to {high:.3g}",
        records=first.records,
        motions=first.motions,
        method=tell(_METHODS[study.method]),
        levels=len(first.levels) if study.method != CLOUD else tell("none"),
        low=low,
        high=high,
    )


def _scatter(curve: Fragility, *, several: bool, gal: bool) -> str:
    """Return where the scatter of a curve comes from, empty where nobody asked."""
    found = curve.dispersion
    if found is None:
        return ""
    return tell(
        "{curve}: beta {records:.2f} from record to record, {parameter:.2f} from what is not known of the body, {total:.2f} together",
        curve=_named(curve, several=several, gal=gal),
        records=found.beta_record_to_record,
        parameter=found.beta_parameter,
        total=found.beta_sum,
    )


def _beside(study: FragilityStudy, curve: Fragility, compare: Lognormal, *, gal: bool) -> str:
    """Return a curve beside the one that it is compared with."""
    size, unit = study.measure.shown(gal=gal)
    return tell(
        "{curve}: {ratio:.3f} times the median compared with, {median}; beta {beta:.2f} against {other:.2f}",
        curve=_named(curve, several=True, gal=gal),
        ratio=(curve.median or 0.0) / compare.median,
        median=f"{number(compare.median / size, 3)} {unit}".strip(),
        beta=curve.beta or 0.0,
        other=compare.beta,
    )


def _named(curve: Fragility, *, several: bool, gal: bool) -> str:
    """Return how a curve is called."""
    limit = limit_name(curve.limit, gal=gal)
    return tell("{body}, {limit}", body=tell(curve.body), limit=limit) if several else limit


def _measures(curve: Fragility, *, several: bool, gal: bool) -> Any:
    """Return the table of the measures that were compared."""
    from seisblock.studies.fragility.intensity import intensity_measure

    rows = []
    for each in sorted(curve.measures, key=lambda each: each.beta):
        measure = intensity_measure(each.im)
        size, unit = measure.shown(gal=gal)
        left = {found.against: f"{found.slope_ratio:+.2f} (p {found.probability:.2g})" for found in each.sufficiency}
        label = f"{measure.label} ({unit})" if unit else measure.label
        rows.append(
            [label, number(each.median / size, 3), f"{each.beta:.2f}", *(left.get(key, NOTHING) for key in ("ln(pgv/pga)", "magnitude"))]
        )
    title = tell("{curve}: measures of intensity", curve=_named(curve, several=several, gal=gal))
    return table(title, [tell("measure"), tell("median"), tell("beta"), "ln(PGV/PGA)", tell("magnitude")], rows)


def columns(study: FragilityStudy) -> tuple[list[str], list[Sequence[Any]]]:
    """Return the header and the rows of ``--csv``: the counts at each level, and the curve there."""
    header = ["body", "limit", "im", "unit", "level", "runs", "exceeding", "share", "probability", "median", "beta"]
    rows: list[Sequence[Any]] = [
        [
            curve.body,
            curve.limit,
            curve.im,
            curve.unit,
            each.im,
            each.runs,
            each.exceeding,
            each.exceeding / each.runs,
            None if curve.curve is None else float(curve.curve.probability(each.im)),
            curve.median,
            curve.beta,
        ]
        for curve in study.curves
        for each in curve.levels
    ]
    return header, rows

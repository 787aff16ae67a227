"""How fragilities are told: where half of the motions do it, how wide the scatter is, and how far that is to be trusted."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

from seisblock.core.i18n import N_, gettext
from seisblock.report.text.tables import DASH, format_number, styled_line, table
from seisblock.report.units_display import length_unit
from seisblock.studies.fragility.damage_states import SLIP, describe_limit
from seisblock.studies.fragility.estimate import CLOUD, IDA, STRIPES
from seisblock.studies.fragility.lognormal import Lognormal
from seisblock.studies.fragility.results import Fragility, FragilityStudy, Interval

MAX_VERDICTS = 4
"""Curves each of which has a sentence of its own."""

_METHODS = {
    STRIPES: N_("every record at every level, maximum likelihood"),
    IDA: N_("the level at which each record does it first"),
    CLOUD: N_("records as they are, probit regression"),
}


def limit_label(name: str, *, gal: bool = True) -> str:
    """Return a limit as it is told: ``overturn`` as overturns, ``slip=0.05m`` as moved 5 cm, or 0.05 m."""
    kind, _, threshold = name.partition("=")
    if kind != SLIP:
        return gettext(describe_limit(name))
    threshold_m = float(threshold.removesuffix("m"))
    size, unit = length_unit([threshold_m], gal=gal)
    return gettext("moved {length}", length=f"{round(threshold_m / size, 6):g} {unit}")


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
    with_median = [curve for curve in study.curves if curve.median is not None]
    yield from (styled_line(verdict_text, "bold") for verdict_text in _verdicts(study, with_median, gal=gal))
    yield _curve_table(study, gal=gal)
    yield styled_line(_basis_text(study), "dim")
    if any(curve.beta_alone is not None for curve in study.curves):
        yield styled_line(
            gettext("The limits share one beta, so that their curves do not cross; a run past a limit is past those before it."), "dim"
        )
    yield from (styled_line(text) for curve in with_median if (text := _dispersion_text(curve, is_labelled=len(with_median) > 1, gal=gal)))
    if compare is not None:
        yield from (styled_line(_comparison_text(study, curve, compare, gal=gal)) for curve in with_median)
    with_measures = [curve for curve in with_median if curve.measures]
    yield from (_measure_table(curve, is_labelled=len(with_median) > 1, gal=gal) for curve in with_measures)
    if with_measures:
        text = N_("beta: the smaller, the better it tells; slopes of what it leaves unexplained: none is best, p: that it is chance")
        yield styled_line(gettext(text), "dim")


def _verdicts(study: FragilityStudy, with_median: Sequence[Fragility], *, gal: bool) -> Iterator[str]:
    """Yield what each curve says; of many, the one that does it first and the one that does it last."""
    if len(with_median) <= MAX_VERDICTS:
        yield from (verdict(study, curve, gal=gal) for curve in with_median)
        return
    by_median = sorted(with_median, key=lambda curve: curve.median or 0.0)
    yield gettext("first of {count}: {verdict}", count=len(with_median), verdict=verdict(study, by_median[0], gal=gal))
    yield gettext("last of {count}: {verdict}", count=len(with_median), verdict=verdict(study, by_median[-1], gal=gal))


def verdict(study: FragilityStudy, curve: Fragility, *, gal: bool) -> str:
    """Return what one curve says."""
    size, unit = study.measure.display_unit(gal=gal)
    return gettext(
        "{body}, {limit}: median {im} {median}, beta {beta:.2f}",
        body=gettext(curve.body),
        limit=limit_label(curve.limit, gal=gal),
        im=study.measure.label,
        median=f"{format_number((curve.median or 0.0) / size, 3)} {unit}".strip(),
        beta=curve.beta or 0.0,
    )


def _curve_table(study: FragilityStudy, *, gal: bool) -> Any:
    """Return the table of all curves."""
    size, unit = study.measure.display_unit(gal=gal)
    bodies = list(dict.fromkeys(curve.body for curve in study.curves))
    has_bodies = len(bodies) > 1
    name = f"{study.measure.label} ({unit})" if unit else study.measure.label
    header = [*([gettext("body")] if has_bodies else []), gettext("limit"), name, gettext("beta"), gettext("not monotone"), gettext("fits")]
    rows = [
        [
            *([gettext(curve.body)] if has_bodies else []),
            limit_label(curve.limit, gal=gal),
            _format_interval(curve.median, curve.median_interval, lambda value: format_number(value / size, 3)),
            _format_interval(curve.beta, curve.beta_interval, lambda value: f"{value:.2f}"),
            DASH if curve.method == CLOUD else f"{curve.non_monotone_motions}/{curve.motions}",
            None if curve.goodness is None else curve.goodness.fits,
        ]
        for curve in study.curves
    ]
    caption = gettext(
        "median and beta with {level:g%} intervals over records; not monotone: motions that do it, and at a higher level do not",
        level=study.confidence,
    )
    return table("" if has_bodies else gettext(bodies[0]), header, rows, caption=caption)


def _format_interval(value: float | None, interval: Interval | None, formatter: Callable[[float], str]) -> str:
    """Return a value with its interval, as far as they are known."""
    if value is None:
        return DASH
    return formatter(value) if interval is None else f"{formatter(value)} ({formatter(interval[0])}-{formatter(interval[1])})"


def _basis_text(study: FragilityStudy) -> str:
    """Return what the curves rest on."""
    first = study.curves[0]
    low, high = study.factors
    return gettext(
        "{records} records, {motions} motions; {method}; levels: {levels}, factors on the records {low:.2g} to {high:.3g}",
        records=first.records,
        motions=first.motions,
        method=gettext(_METHODS[study.method]),
        levels=len(first.levels) if study.method != CLOUD else gettext("none"),
        low=low,
        high=high,
    )


def _dispersion_text(curve: Fragility, *, is_labelled: bool, gal: bool) -> str:
    """Return where the scatter of a curve comes from, empty where nobody asked."""
    dispersion = curve.dispersion
    if dispersion is None:
        return ""
    return gettext(
        "{curve}: beta {records:.2f} from record to record, {parameter:.2f} from what is not known of the body, {total:.2f} together",
        curve=_curve_label(curve, is_labelled=is_labelled, gal=gal),
        records=dispersion.beta_record_to_record,
        parameter=dispersion.beta_parameter,
        total=dispersion.beta_sum,
    )


def _comparison_text(study: FragilityStudy, curve: Fragility, compare: Lognormal, *, gal: bool) -> str:
    """Return a curve beside the one that it is compared with."""
    size, unit = study.measure.display_unit(gal=gal)
    return gettext(
        "{curve}: {ratio:.3f} times the median compared with, {median}; beta {beta:.2f} against {other:.2f}",
        curve=_curve_label(curve, is_labelled=True, gal=gal),
        ratio=(curve.median or 0.0) / compare.median,
        median=f"{format_number(compare.median / size, 3)} {unit}".strip(),
        beta=curve.beta or 0.0,
        other=compare.beta,
    )


def _curve_label(curve: Fragility, *, is_labelled: bool, gal: bool) -> str:
    """Return how a curve is called."""
    limit = limit_label(curve.limit, gal=gal)
    return gettext("{body}, {limit}", body=gettext(curve.body), limit=limit) if is_labelled else limit


def _measure_table(curve: Fragility, *, is_labelled: bool, gal: bool) -> Any:
    """Return the table of the measures that were compared."""
    from seisblock.studies.fragility.intensity import intensity_measure

    rows = []
    for row_measure in sorted(curve.measures, key=lambda row_measure: row_measure.beta):
        measure = intensity_measure(row_measure.im)
        size, unit = measure.display_unit(gal=gal)
        sufficiency = {test.against: f"{test.slope_ratio:+.2f} (p {test.probability:.2g})" for test in row_measure.sufficiency}
        label = f"{measure.label} ({unit})" if unit else measure.label
        rows.append(
            [
                label,
                format_number(row_measure.median / size, 3),
                f"{row_measure.beta:.2f}",
                *(sufficiency.get(key, DASH) for key in ("ln(pgv/pga)", "magnitude")),
            ]
        )
    title = gettext("{curve}: measures of intensity", curve=_curve_label(curve, is_labelled=is_labelled, gal=gal))
    return table(title, [gettext("measure"), gettext("median"), gettext("beta"), "ln(PGV/PGA)", gettext("magnitude")], rows)


def csv_columns(study: FragilityStudy) -> tuple[list[str], list[Sequence[Any]]]:
    """Return the header and the rows of ``--csv``: the counts at each level, and the curve there."""
    header = ["body", "limit", "im", "unit", "level", "runs", "exceeding", "share", "probability", "median", "beta"]
    rows: list[Sequence[Any]] = [
        [
            curve.body,
            curve.limit,
            curve.im,
            curve.unit,
            level.im,
            level.runs,
            level.exceeding,
            level.exceeding / level.runs,
            None if curve.curve is None else float(curve.curve.probability(level.im)),
            curve.median,
            curve.beta,
        ]
        for curve in study.curves
        for level in curve.levels
    ]
    return header, rows

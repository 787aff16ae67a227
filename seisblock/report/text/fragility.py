"""Text report of fragility curves: median, dispersion and diagnostics."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

from seisblock.core.i18n import N_, gettext
from seisblock.output.text.tables import DASH, details, format_number, format_range, styled_line, table
from seisblock.output.units_display import length_unit
from seisblock.studies.fragility.damage_states import SLIP, describe_limit
from seisblock.studies.fragility.estimate import CLOUD, IDA, STRIPES
from seisblock.studies.fragility.intensity import IntensityMeasure, intensity_measure
from seisblock.studies.fragility.lognormal import Lognormal
from seisblock.studies.fragility.results import Fragility, FragilityStudy, Interval

MAX_VERDICTS = 4
"""Most curves with a sentence each."""

_METHODS = {
    STRIPES: N_("all records at all levels, maximum likelihood"),
    IDA: N_("first level of each record at which the limit state is reached"),
    CLOUD: N_("unscaled records, probit regression"),
}


def limit_label(name: str, *, gal: bool = True) -> str:
    """Return the label of a limit state: ``overturn`` as overturns, ``slip=0.05m`` with the length in cm or m."""
    kind, _, threshold = name.partition("=")
    if kind != SLIP:
        return gettext(describe_limit(name))
    threshold_m = float(threshold.removesuffix("m"))
    size, unit = length_unit([threshold_m], gal=gal)
    return gettext("displacement > {length}", length=f"{round(threshold_m / size, 6):g} {unit}")


def tables(study: FragilityStudy, *, gal: bool, compare: Lognormal | None = None) -> Iterator[Any]:
    """Yield the median of each curve, the table of all curves, the components of beta and the comparison of intensity measures.

    Parameters
    ----------
    study : FragilityStudy
    gal : bool
        Intensities in gal, kine and cm; otherwise SI.
    compare : Lognormal or None
        Reference curve to compare with.
    """
    with_median = [curve for curve in study.curves if curve.median is not None]
    yield from (styled_line(verdict_text, "bold") for verdict_text in _verdicts(study, with_median, gal=gal))
    yield _curve_table(study, gal=gal)
    yield styled_line(_basis_text(study), "dim")
    if any(curve.beta_alone is not None for curve in study.curves):
        yield styled_line(
            gettext(
                "The limit states share one beta so that their curves do not cross; a run that exceeds a limit has exceeded all lower ones."
            ),
            "dim",
        )
    yield from (styled_line(text) for curve in with_median if (text := _dispersion_text(curve, is_labelled=len(with_median) > 1, gal=gal)))
    if compare is not None:
        yield from (styled_line(_comparison_text(study, curve, compare, gal=gal)) for curve in with_median)
    with_measures = [curve for curve in with_median if curve.measures]
    measure_tables = [_measure_table(curve, is_labelled=len(with_median) > 1, gal=gal) for curve in with_measures]
    yield from measure_tables if len(measure_tables) == 1 else map(details, measure_tables)
    if with_measures:
        text = N_(
            "beta: efficiency, the smaller the better; slopes: sufficiency, trend of the residuals with magnitude and "
            "distance; p: its p-value"
        )
        if with_measures[0].method == STRIPES:
            text = N_(
                "median and beta: of the lowest levels at which motions reach the limit, where the curve counts all levels; "
                "beta: efficiency, the smaller the better; slopes: sufficiency, trend of the residuals with magnitude and "
                "distance; p: its p-value"
            )
        caption = styled_line(gettext(text), "dim")
        yield caption if len(measure_tables) == 1 else details(caption)


def _verdicts(study: FragilityStudy, with_median: Sequence[Fragility], *, gal: bool) -> Iterator[str]:
    """Yield a sentence for each curve, or for the lowest and highest median of many curves."""
    if len(with_median) <= MAX_VERDICTS:
        yield from (verdict(study, curve, gal=gal) for curve in with_median)
        return
    by_median = sorted(with_median, key=lambda curve: curve.median or 0.0)
    yield gettext("lowest of {count}: {verdict}", count=len(with_median), verdict=verdict(study, by_median[0], gal=gal))
    yield gettext("highest of {count}: {verdict}", count=len(with_median), verdict=verdict(study, by_median[-1], gal=gal))


def verdict(study: FragilityStudy, curve: Fragility, *, gal: bool) -> str:
    """Return the sentence of one curve."""
    size, unit = study.measure.display_unit(gal=gal)
    return gettext(
        "{body}, {limit}: median {im} {median}, beta {beta:.2f}",
        body=gettext(curve.body),
        limit=limit_label(curve.limit, gal=gal),
        im=gettext(study.measure.label),
        median=f"{format_number((curve.median or 0.0) / size, 3)} {unit}".strip(),
        beta=curve.beta or 0.0,
    )


def measure_label(measure: IntensityMeasure, *, gal: bool) -> str:
    """Return the name of an intensity measure with its displayed unit."""
    unit = measure.display_unit(gal=gal)[1]
    return f"{gettext(measure.label)} ({unit})" if unit else gettext(measure.label)


def _curve_table(study: FragilityStudy, *, gal: bool) -> Any:
    size, name = study.measure.display_unit(gal=gal)[0], measure_label(study.measure, gal=gal)
    bodies = list(dict.fromkeys(curve.body for curve in study.curves))
    has_bodies = len(bodies) > 1
    header = [*([gettext("body")] if has_bodies else []), gettext("limit"), name, gettext("beta"), gettext("not monotone"), gettext("fit")]
    rows = [
        [
            *([gettext(curve.body)] if has_bodies else []),
            limit_label(curve.limit, gal=gal),
            _format_interval(curve.median, curve.median_interval, lambda value: format_number(value / size, 3)),
            _format_interval(curve.beta, curve.beta_interval, lambda value: f"{value:.2f}"),
            DASH if curve.method == CLOUD else f"{curve.non_monotone_motions}/{curve.motions}",
            DASH if curve.goodness is None else gettext("good") if curve.goodness.fits else gettext("poor"),
        ]
        for curve in study.curves
    ]
    caption = gettext(
        "median and beta with {level:g%} confidence intervals over the records; not monotone: motions that reach the "
        "limit but not at a higher level; fit: of the lognormal curve (poor: rejected at the 5 % level)",
        level=study.confidence,
    )
    return table("" if has_bodies else gettext(bodies[0]), header, rows, caption=caption)


def _format_interval(value: float | None, interval: Interval | None, formatter: Callable[[float], str]) -> str:
    if value is None:
        return DASH
    return formatter(value) if interval is None else f"{formatter(value)} ({format_range(formatter(interval[0]), formatter(interval[1]))})"


def _basis_text(study: FragilityStudy) -> str:
    """Return the description of records, method and levels."""
    first = study.curves[0]
    low, high = study.factors
    return gettext(
        "{records} records, {motions} motions; {method}; levels: {levels}, scale factors {low:.2g} to {high:.3g}",
        records=first.records,
        motions=first.motions,
        method=gettext(_METHODS[study.method]),
        levels=len(first.levels) if study.method != CLOUD else gettext("none"),
        low=low,
        high=high,
    )


def _dispersion_text(curve: Fragility, *, is_labelled: bool, gal: bool) -> str:
    """Return the components of beta of a curve; empty without perturbed samples."""
    dispersion = curve.dispersion
    if dispersion is None:
        return ""
    return gettext(
        "{curve}: beta {records:.2f} between records, {parameter:.2f} from body parameters, {total:.2f} in total",
        curve=_curve_label(curve, is_labelled=is_labelled, gal=gal),
        records=dispersion.beta_record_to_record,
        parameter=dispersion.beta_parameter,
        total=dispersion.beta_sum,
    )


def _comparison_text(study: FragilityStudy, curve: Fragility, compare: Lognormal, *, gal: bool) -> str:
    size, unit = study.measure.display_unit(gal=gal)
    return gettext(
        "{curve}: median {ratio:.3f} times that of the comparison curve ({median}); beta {beta:.2f}, comparison {other:.2f}",
        curve=_curve_label(curve, is_labelled=True, gal=gal),
        ratio=(curve.median or 0.0) / compare.median,
        median=f"{format_number(compare.median / size, 3)} {unit}".strip(),
        beta=curve.beta or 0.0,
        other=compare.beta,
    )


def _curve_label(curve: Fragility, *, is_labelled: bool, gal: bool) -> str:
    limit = limit_label(curve.limit, gal=gal)
    return gettext("{body}, {limit}", body=gettext(curve.body), limit=limit) if is_labelled else limit


def _measure_table(curve: Fragility, *, is_labelled: bool, gal: bool) -> Any:
    """Return the table of efficiency and sufficiency by intensity measure."""
    rows = []
    for row_measure in sorted(curve.measures, key=lambda row_measure: row_measure.beta):
        measure = intensity_measure(row_measure.im)
        size = measure.display_unit(gal=gal)[0]
        sufficiency = {test.against: f"{test.slope_ratio:+.2f} (p {test.probability:.2g})" for test in row_measure.sufficiency}
        rows.append(
            [
                measure_label(measure, gal=gal),
                format_number(row_measure.median / size, 3),
                f"{row_measure.beta:.2f}",
                *(sufficiency.get(key, DASH) for key in ("ln(pgv/pga)", "magnitude")),
            ]
        )
    title = gettext("{curve}: intensity measures", curve=_curve_label(curve, is_labelled=is_labelled, gal=gal))
    return table(title, [gettext("measure"), gettext("median"), gettext("beta"), "ln(PGV/PGA)", gettext("magnitude")], rows)


def csv_columns(study: FragilityStudy) -> tuple[list[str], list[Sequence[Any]]]:
    """Return header and rows of ``--csv``: counts and curve values at each level."""
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

"""Text report of inferred ground motion: estimates from stones and scale factors of records."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from seisblock.core.i18n import N_, format_share, gettext
from seisblock.measures.intensity import reported_intensity
from seisblock.output.text.tables import (
    DASH,
    acceleration_cell,
    format_acceleration,
    format_number,
    format_range,
    group_answers,
    styled_line,
    table,
    with_notes,
)
from seisblock.output.units_display import acceleration_unit, format_length, length_cell, length_unit, velocity_unit
from seisblock.records import Record
from seisblock.studies.survey.assumptions import Assumptions
from seisblock.studies.survey.estimate import Interval, ShakingEstimate, split_stone_label
from seisblock.studies.survey.joint import JointEstimate

if TYPE_CHECKING:
    from seisblock.studies.survey.scale_search import ScaleFactors
from seisblock.studies.survey.twist import FactorInterval, TwistEstimate


def estimate_tables(
    name: str, estimates: Sequence[ShakingEstimate], joint: Sequence[JointEstimate], assumptions: Assumptions, *, gal: bool
) -> Iterator[Any]:
    """Yield the joint estimates, one table per group of stones (PGA, PGV, threshold H/B, JMA intensity) and the notes."""
    level = assumptions.level
    for estimate in joint[:1]:
        pga, low, high = _accelerations(estimate, gal=gal)
        text = "{names} combined: PGA {pga} {unit} ({low} to {high})."
        yield styled_line(gettext(text, names=list(estimate.names), pga=pga, unit=acceleration_unit(gal=gal).name, low=low, high=high))
    if not joint:
        yield from (styled_line(sentence) for sentence in verdicts(name, estimates, gal=gal, level=level))
    speed, unit = velocity_unit(gal=gal)
    header = ("f (Hz)", f"PGA ({acceleration_unit(gal=gal).name})", f"PGV ({unit})", "H/B", gettext("JMA intensity"))
    caption = gettext("median and {level:g%} interval; H/B: stones more slender than this overturned", level=level)
    for stones in dict.fromkeys(estimate.stones for estimate in estimates):
        group = [estimate for estimate in estimates if estimate.stones == stones]
        site, kind = split_stone_label(stones)
        title = gettext(
            "{cemetery}, stones {stones}: {fallen} of {all} overturned",
            cemetery=site or name,
            stones=gettext(kind),
            fallen=group[0].fallen,
            all=group[0].fallen + group[0].standing,
        )
        rows = [
            (
                gettext("0.5-3") if estimate.frequency_hz is None else f"{estimate.frequency_hz:.3g}",
                _with_interval(estimate.pga_m_s2, estimate.pga_interval_m_s2, acceleration_unit(gal=gal).size),
                _with_interval(estimate.pgv_m_s, estimate.pgv_interval_m_s, speed),
                DASH if estimate.threshold_ratio is None else f"{estimate.threshold_ratio:.2f}",
                _intensity(estimate),
            )
            for estimate in group
        ]
        yield table(title, header, rows, caption=caption)
    if assumptions.bias:
        yield styled_line(
            gettext(
                "The criterion was fitted to sine motions; records need {factor:.2f} times its PGA (rigid-block "
                "simulations). The estimates include this factor (--bias 0 omits it).",
                factor=math.exp(assumptions.bias),
            ),
            "dim",
        )


def verdicts(name: str, estimates: Sequence[ShakingEstimate], *, gal: bool, level: float) -> Iterator[str]:
    """Yield a sentence for each group of stones: over all frequencies, or at the first requested one."""
    first_estimates = {estimate.stones: estimate for estimate in reversed(estimates)}
    for stones in dict.fromkeys(estimate.stones for estimate in estimates):
        estimate = first_estimates[stones]
        site, kind = split_stone_label(stones)
        label = (
            (site or name)
            if len(first_estimates) == 1
            else gettext("{cemetery}, stones {stones}", cemetery=site or name, stones=gettext(kind))
        )
        at = gettext("0.5-3 Hz") if estimate.frequency_hz is None else f"{estimate.frequency_hz:.3g} Hz"
        pga, low, high = _accelerations(estimate, gal=gal)
        if estimate.bound is not None:
            pga = _format_interval(estimate.pga_interval_m_s2, acceleration_unit(gal=gal).size)
        values = {"who": label, "pga": f"{pga} {acceleration_unit(gal=gal).name}", "at": at, "intensity": _intensity(estimate)}
        if estimate.bound is not None:
            text = gettext("{who}: PGA {pga} at {at}; JMA intensity {intensity}.", **values)
        else:
            template = N_("{who}: PGA {pga} ({low} to {high}, {level:g%} interval) at {at}; JMA intensity {intensity}.")
            text = gettext(template, low=low, high=high, level=level, **values)
        by_rule = estimate.jma_class_by_rule
        notes = [] if by_rule is None else [gettext("By the surveyors' rule: class {name}.", name=gettext(by_rule))]
        yield with_notes(text, notes)


def _accelerations(estimate: ShakingEstimate | JointEstimate, *, gal: bool) -> list[str]:
    """Return the median PGA and the ends of its interval to three significant digits."""
    unit = acceleration_unit(gal=gal).size
    values = (estimate.pga_m_s2, *estimate.pga_interval_m_s2)
    return [format_number(None if value is None else value / unit, 3) for value in values]


def _format_interval(interval: Interval, unit: float) -> str:
    low, high = interval
    if low is None:
        return DASH if high is None else f"< {format_number(high / unit, 3)}"
    return (
        f"> {format_number(low / unit, 3)}" if high is None else format_range(format_number(low / unit, 3), format_number(high / unit, 3))
    )


def _with_interval(value: float | None, interval: Interval, unit: float) -> str:
    """Return a median with its interval, or the bound where there is no median."""
    text = _format_interval(interval, unit)
    return text if value is None else f"{format_number(value / unit, 3)} ({text})"


def _intensity(estimate: ShakingEstimate) -> str:
    """Return the JMA classes of the interval, with the intensity of the median."""
    low, high = estimate.jma_classes
    if low is None or high is None:
        return gettext("at most {name}", name=gettext(high)) if high else gettext("at least {name}", name=gettext(low or ""))
    classes = gettext(low) if low == high else gettext("{low} to {high}", low=gettext(low), high=gettext(high))
    return classes if estimate.jma_intensity is None else f"{classes} ({reported_intensity(estimate.jma_intensity):.1f})"


def estimate_csv(line: Sequence[ShakingEstimate]) -> tuple[list[str], list[list[Any]]]:
    """Return header and rows of ``--csv``: the contour, SI."""
    header = ["frequency_hz", "pga_low_m_s2", "pga_m_s2", "pga_high_m_s2", "pgv_low_m_s", "pgv_m_s", "pgv_high_m_s"]
    rows = [
        [e.frequency_hz, *_interval_cells(e.pga_m_s2, e.pga_interval_m_s2), *_interval_cells(e.pgv_m_s, e.pgv_interval_m_s)] for e in line
    ]
    return header, rows


def _interval_cells(middle: float | None, interval: Interval) -> tuple[float | None, float | None, float | None]:
    return interval[0], middle, interval[1]


def factor_tables(results: Sequence[tuple[Record, ScaleFactors]], *, gal: bool, displacement_kind: str) -> Iterator[Any]:
    """Yield a sentence and the table of scale factors for each component; `displacement_kind` names the observed quantity."""
    for heading, part in group_answers(
        results, lambda result: result[0], lambda result: [styled_line(_factor_sentence(result[1], displacement_kind, gal=gal))]
    ):
        yield from heading
        for _, result in part:
            unit = length_unit((f.displacement_m for f in result.scale_factors), gal=gal)
            rows = [
                (
                    f"{f.scale:.4f}",
                    acceleration_cell(f.pga_m_s2, gal=gal),
                    length_cell(f.displacement_m, unit),
                    gettext("discontinuity") if f.leaps else "",
                )
                for f in result.scale_factors
            ]
            if rows:
                headings = (
                    gettext("factor"),
                    f"PGA ({acceleration_unit(gal=gal).name})",
                    gettext("displacement ({unit})", unit=unit.name),
                    "",
                )
                yield table(result.component if len(part) > 1 else "", headings, rows)


def _factor_sentence(result: ScaleFactors, displacement_kind: str, *, gal: bool) -> str:
    """Return a sentence on the scale factors that reproduce the observed displacement."""
    factor_texts = [
        gettext("{factor:.3f} ({pga})", factor=item.scale, pga=format_acceleration(item.pga_m_s2, gal=gal)) for item in result.scale_factors
    ]
    size, as_recorded, largest = (
        format_length(length, gal=gal) for length in (result.observed_m, result.displacement_at_1_m, result.largest_displacement_m)
    )
    values = {"name": result.component, "size": size, "moved": gettext(displacement_kind), "alone": as_recorded}
    if not factor_texts:
        text = N_(
            "{name}: {moved} of {size} not reached by scale factors up to {limit:g} (largest {most} at {at:g}); unscaled record: {alone}."
        )
        return gettext(text, **values, limit=result.limit, most=largest, at=result.largest_at_scale)
    if len(factor_texts) == 1:
        text = N_("{name}: {moved} of {size} at a scale factor of {factor:.3f} ({pga}); unscaled record: {alone}.")
        pga = format_acceleration(result.scale_factors[0].pga_m_s2, gal=gal)
        return gettext(text, **values, factor=result.scale_factors[0].scale, pga=pga)
    text = N_("{name}: {moved} of {size} at scale factors {factors}; unscaled record: {alone}.")
    return gettext(text, **values, factors=factor_texts)


def factor_csv(results: Sequence[tuple[Record, ScaleFactors]]) -> tuple[list[str], list[list[Any]]]:
    """Return header and rows of ``--csv``: displacement against scale factor, by record and component."""
    header = ["record", "component", "scale", "pga_m_s2", "displacement_m"]
    rows = [
        [record.station or record.source, result.component, scale, scale * result.pga_m_s2, value]
        for record, result in results
        for scale, value in zip(*result.curve, strict=True)
    ]
    return header, rows


def twist_tables(
    results: Sequence[tuple[Record, TwistEstimate]], station: FactorInterval | None, *, level: float, limit: float, gal: bool
) -> Iterator[Any]:
    """Yield a sentence per record, and the PGA at the station of several candidate records."""
    for heading, _ in group_answers(
        results, lambda result: result[0], lambda result: [styled_line(_twist_sentence(result[1], level, limit, gal=gal), "bold")]
    ):
        yield from heading
    if station is not None:
        yield styled_line(
            gettext(
                "Station, all records: PGA {pga} ({level} interval {low} to {high}).",
                pga=format_acceleration(station.median, gal=gal),
                level=format_share(level),
                low=format_acceleration(station.low, gal=gal),
                high=format_acceleration(station.high, gal=gal),
            )
        )


def _twist_sentence(estimate: TwistEstimate, level: float, limit: float, *, gal: bool) -> str:
    """Return the factor and PGA that explain the observed twist, with their intervals."""
    subject = gettext("twist of {twist:g}°", twist=estimate.twist_deg)
    if estimate.displacement_m is not None:
        length = format_length(estimate.displacement_m, gal=gal)
        subject = gettext("{twist} and displacement of {length}", twist=subject, length=length)
    if estimate.scale is None and estimate.largest_twist_deg >= estimate.twist_deg:
        return gettext(
            "{name}: {what}: too few of {runs} runs agree for an interval (effectively {effective:.1f}); give more --runs.",
            name=estimate.component,
            what=subject,
            runs=estimate.runs,
            effective=estimate.effective_runs,
        )
    if estimate.scale is None or estimate.pga_m_s2 is None:
        return gettext(
            "{name}: {what} not explained by scale factors up to {limit:g}; largest twist without overturning {largest:.2g}°.",
            name=estimate.component,
            what=subject,
            limit=limit,
            largest=estimate.largest_twist_deg,
        )
    return gettext(
        "{name}: {what} at a scale factor of {factor:.2f} ({level} interval {low:.2f} to {high:.2f}), PGA {pga} ({pga_low} to {pga_high}); "
        "{runs} runs, effectively {effective:.0f}.",
        name=estimate.component,
        what=subject,
        factor=estimate.scale.median,
        level=format_share(level),
        low=estimate.scale.low,
        high=estimate.scale.high,
        pga=format_acceleration(estimate.pga_m_s2.median, gal=gal),
        pga_low=format_acceleration(estimate.pga_m_s2.low, gal=gal),
        pga_high=format_acceleration(estimate.pga_m_s2.high, gal=gal),
        runs=estimate.runs,
        effective=estimate.effective_runs,
    )


def twist_csv(results: Sequence[tuple[Record, TwistEstimate]]) -> tuple[list[str], list[list[Any]]]:
    """Return header and rows of ``--csv``: the runs behind the interval."""
    header = ["record", "component", "scale", "twist_deg", "displacement_m", "overturned", "weight"]
    rows = [
        [record.station or record.source, estimate.component, *(getattr(run, name) for name in header[2:])]
        for record, estimate in results
        for run in estimate.sample
    ]
    return header, rows

"""How an overturning rate is told: a table per record, a sentence on dowels, and the curve as columns of frequencies; and as CSV."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

from seisblock.bodies.cemetery.cemetery import Cemetery
from seisblock.present.histories import of_records
from seisblock.present.scales import acceleration_unit
from seisblock.present.text.agreement import rates_line
from seisblock.present.text.measure import usual_filters
from seisblock.present.text.tables import NOTHING, acceleration, answered, line, number, table, told_acceleration
from seisblock.records import Record
from seisblock.studies.cemetery.judgement import CemeteryRate
from seisblock.studies.cemetery.rate import CurvePoint
from seisblock.words import noted, percent, tell

CAPTION = noted(
    "least H/B: of a stone that falls; %: what so few stones leave open of the rate (Clopper-Pearson), not what shaking and criterion do"
)

MOST_VERDICTS = 4
"""Shakings each of which has a sentence of its own."""

USUAL_HZ = 1.0
"""Frequency of the shaking that a curve is told at, about that of strong motion."""

OF_RATE = (
    "component",
    "of",
    "pga_m_s2",
    "equivalent_frequency_hz",
    "threshold_ratio",
    "least_overturned_ratio",
    "fallen",
    "stones",
    "rate",
)
"""What ``--csv`` says of one shaking, before the limits of the interval."""

SHOWN_EVERY = 1.0
"""Step of the curve's rows in the table, m/s^2; the whole curve is in --json and --csv."""


def tables(
    cemetery: Cemetery,
    groups: Sequence[tuple[Record | None, Sequence[CemeteryRate]]],
    curve: Sequence[CurvePoint],
    *,
    gal: bool,
    confidence: float,
) -> Iterator[Any]:
    """Yield what is printed: the results of each record or of bare numbers, else the curve.

    Parameters
    ----------
    cemetery : Cemetery
    groups : sequence of (Record or None, results)
    curve : sequence of CurvePoint
        Shown where there are no results.
    gal : bool
    confidence : float
        Level of the intervals.
    """
    dowelled = int(cemetery.reinforced.sum())
    title = tell("{name}: {stones} stones", name=cemetery.name, stones=cemetery.size)
    title += tell(", {stones} reinforced", stones=dowelled) if dowelled else ""
    for opening, ((_, results),) in answered(
        groups, lambda group: group[0], lambda group: map(line, verdicts(cemetery.name, group[1], gal=gal))
    ):
        yield from opening
        yield _rates(title, results, gal=gal, confidence=confidence)
        yield from (line(sentence) for sentence in (*_filters(results, gal=gal), *_models(results), *_dowels(results)))
    if not groups:
        yield line(half_falls(cemetery.name, curve, gal=gal))
        yield _curve(title, curve, gal=gal)


def verdicts(cemetery: str, results: Sequence[CemeteryRate], *, gal: bool) -> Iterator[str]:
    """Yield how many stones fall, a sentence per shaking, or one for many."""
    own = [each for each in results if not each.of]
    if len(own) > MOST_VERDICTS:
        low, high = (f(each.fallen for each in own) for f in (min, max))
        text = noted("{cemetery}: {low} to {high} of {stones} stones fall, by the shaking.")
        yield tell(text, cemetery=cemetery, low=low, high=high, stones=own[0].stones)
        return
    for each in own:
        shaking = f"{told_acceleration(each.pga_m_s2, gal=gal)}, {number(each.equivalent_frequency_hz, 3)} Hz"
        text = noted("{name}: {fallen} of {stones} stones fall ({share:.0%}).")
        yield tell(text, name=each.component or shaking, fallen=each.fallen, stones=each.stones, share=each.rate)


def half_falls(cemetery: str, curve: Sequence[CurvePoint], *, gal: bool) -> str:
    """Return at which PGA half of the stones fall, at the frequency nearest to 1 Hz."""
    frequency = min((point.frequency_hz for point in curve), key=lambda f: abs(math.log(f / USUAL_HZ)))
    at = sorted((point for point in curve if point.frequency_hz == frequency), key=lambda point: point.pga_m_s2)
    half = next((point.pga_m_s2 for point in at if point.rate >= 0.5), None)
    pga = told_acceleration(at[-1].pga_m_s2 if half is None else half, gal=gal)
    values = {"cemetery": cemetery, "pga": pga, "f": frequency}
    if half is None:
        return tell("{cemetery}: less than half of the stones fall up to {pga} of {f:g} Hz.", **values)
    return tell("{cemetery}: half of the stones fall at {pga} of {f:g} Hz.", **values)


def _rates(title: str, results: Sequence[CemeteryRate], *, gal: bool, confidence: float) -> Any:
    """Return the table of rates, one row per shaking."""
    unit = acceleration_unit(gal=gal).name
    head = ("", f"PGA ({unit})", "f (Hz)", tell("least H/B"), tell("fallen"), tell("rate"), percent(confidence, "g"))
    rows = [
        (
            _name(each),
            acceleration(each.pga_m_s2, gal=gal),
            number(each.equivalent_frequency_hz, 3),
            _ratio(each),
            tell("{fallen} of {stones}", fallen=each.fallen, stones=each.stones),
            f"{each.rate:.2f}",
            "{:.2f}-{:.2f}".format(*each.rate_interval),
        )
        for each in results
    ]
    return table(title, head, rows, caption=tell(CAPTION))


def _name(each: CemeteryRate) -> str:
    """Return what a row is called."""
    return f"{tell(each.component or '')} ({each.of})" if each.of else each.component or ""


def _ratio(each: CemeteryRate) -> str:
    """Return the least H/B that falls: that of the criterion, else that of the stoutest stone that fell."""
    value = each.least_overturned_ratio if each.threshold_ratio is None else each.threshold_ratio
    return NOTHING if value is None else f"{value:.2f}"


def _filters(results: Sequence[CemeteryRate], *, gal: bool) -> Iterator[str]:
    """Yield how far frequency and rate move with the usual filters, a sentence per component."""
    for each in results:
        if each.usual_highpass is not None and each.rate_range is not None and not each.of:
            low, high = each.rate_range
            rate = tell("rate {low:.2f}", low=low) if low == high else tell("rate {low:.2f} to {high:.2f}", low=low, high=high)
            yield tell("{name}: {what}; {rate}", name=each.component, what=usual_filters(each.usual_highpass, gal=gal), rate=rate)


def _models(results: Sequence[CemeteryRate]) -> Iterator[str]:
    """Yield how far the models of the stones are apart, a sentence per shaking."""
    for each in results:
        if not each.of and (told := rates_line(each.component or "", each.models)):
            yield told


def _dowels(results: Sequence[CemeteryRate]) -> Iterator[str]:
    """Yield what dowels would save, a sentence per shaking."""
    for each in results:
        after = each.reinforced
        if after is None or each.of:
            continue
        where = each.component or f"{number(each.equivalent_frequency_hz, 3)} Hz"
        low, high = after.rate_interval
        yield tell(
            "{where}: with {reinforced} stones reinforced {fallen} of {stones} fall, {saved} fewer; rate {rate:.2f} ({low:.2f}-{high:.2f})",
            where=where,
            reinforced=after.reinforced_stones,
            fallen=after.fallen,
            stones=each.stones,
            saved=after.stones_saved,
            rate=after.rate,
            low=low,
            high=high,
        )


def _curve(title: str, curve: Sequence[CurvePoint], *, gal: bool) -> Any:
    """Return the rate against PGA, a column per frequency."""
    frequencies = list(dict.fromkeys(point.frequency_hz for point in curve))
    rate = {(point.pga_m_s2, point.frequency_hz): point.rate for point in curve}
    levels = [pga for pga in dict.fromkeys(point.pga_m_s2 for point in curve) if abs(pga / SHOWN_EVERY - round(pga / SHOWN_EVERY)) < 1e-9]
    rows = [(acceleration(pga, gal=gal), *(f"{rate[pga, f]:.2f}" for f in frequencies)) for pga in levels]
    return table(
        title, (f"PGA ({acceleration_unit(gal=gal).name})", *(f"{f:g} Hz" for f in frequencies)), rows, caption=tell("overturning rate")
    )


def curve_columns(curve: Sequence[CurvePoint], reinforced: Sequence[CurvePoint] | None) -> tuple[list[str], list[list[float]]]:
    """Return the header and the rows of ``--csv`` without shaking: PGA (m/s^2), frequency (Hz), rates without and with more dowels."""
    header = ["pga_m_s2", "frequency_hz", "rate"] + (["rate_reinforced"] if reinforced else [])
    rows = [[p.pga_m_s2, p.frequency_hz, p.rate] for p in curve]
    if reinforced:
        rows = [[*row, point.rate] for row, point in zip(rows, reinforced, strict=True)]
    return header, rows


def rate_columns(groups: Sequence[tuple[Record | None, Sequence[CemeteryRate]]]) -> tuple[list[str], Iterator[list[Any]]]:
    """Return the header and the rows of ``--csv`` where shakings were named: one each, SI, with what more dowels change."""
    header = [*OF_RATE, "rate_low", "rate_high"]
    compared = any(each.reinforced is not None for _, results in groups for each in results)
    header += [f"{name}_reinforced" for name in ("fallen", "rate", "rate_low", "rate_high")] if compared else []
    return of_records(header, [map(_written, results) for _, results in groups])


def _written(each: CemeteryRate) -> list[Any]:
    """Return the row of one shaking."""
    after = each.reinforced
    row = [getattr(each, name) for name in OF_RATE] + [*each.rate_interval]
    return row if after is None else [*row, after.fallen, after.rate, *after.rate_interval]

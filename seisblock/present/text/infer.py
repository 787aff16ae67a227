"""How inferred shaking is told: a table of estimates and their contour as columns, or the factors on records."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from seisblock.present.scales import acceleration_unit, length_cell, length_unit, told_length, velocity_unit
from seisblock.present.text.tables import NOTHING, acceleration, answered, line, number, table, told_acceleration
from seisblock.records import Record
from seisblock.studies.inverse.assumptions import Assumptions
from seisblock.studies.inverse.estimate import Interval, ShakingEstimate, place_and_kind
from seisblock.studies.inverse.joint import JointEstimate
from seisblock.words import noted, tell

if TYPE_CHECKING:
    from seisblock.studies.inverse.factors import ScaleFactors


def estimate_tables(
    name: str, estimates: Sequence[ShakingEstimate], joint: Sequence[JointEstimate], assumptions: Assumptions, *, gal: bool
) -> Iterator[Any]:
    """Yield what all cemeteries say together, one table per group of stones (PGA, PGV, threshold H/B, JMA intensity), and the notes."""
    level = assumptions.level
    for each in joint[:1]:
        low, high = (acceleration(end, gal=gal) for end in each.pga_interval_m_s2)
        yield line(
            tell(
                "{names} together: PGA {pga} {unit} ({low} to {high}).",
                names=list(each.names),
                pga=acceleration(each.pga_m_s2, gal=gal),
                unit=acceleration_unit(gal=gal).name,
                low=low,
                high=high,
            )
        )
    if not joint:
        yield from (line(sentence) for sentence in verdicts(name, estimates, gal=gal, level=level))
    speed, unit = velocity_unit(gal=gal)
    head = ("f (Hz)", f"PGA ({acceleration_unit(gal=gal).name})", "", f"PGV ({unit})", "", "H/B", tell("JMA intensity"))
    caption = tell("median and {level:g%} interval; H/B: stones more slender than this fell", level=level)
    for stones in dict.fromkeys(each.stones for each in estimates):
        group = [each for each in estimates if each.stones == stones]
        place, kind = place_and_kind(stones)
        title = tell(
            "{cemetery}, stones {stones}: {fallen} of {all} fell",
            cemetery=place or name,
            stones=tell(kind),
            fallen=group[0].fallen,
            all=group[0].fallen + group[0].standing,
        )
        rows = [
            (
                "0.5-3" if each.frequency_hz is None else f"{each.frequency_hz:.3g}",
                acceleration(each.pga_m_s2, gal=gal),
                _range(each.pga_interval_m_s2, acceleration_unit(gal=gal).size),
                NOTHING if each.pgv_m_s is None else number(each.pgv_m_s / speed, 3),
                _range(each.pgv_interval_m_s, speed),
                NOTHING if each.threshold_ratio is None else f"{each.threshold_ratio:.2f}",
                _intensity(each),
            )
            for each in group
        ]
        yield table(title, head, rows, caption=caption)
    if assumptions.bias:
        yield line(
            tell(
                "Records need {factor:.2f} times the PGA that the criterion, fitted to sines, says: measured with rigid blocks, and taken "
                "into account here (--bias 0 leaves it out).",
                factor=math.exp(assumptions.bias),
            ),
            "dim",
        )


def verdicts(name: str, estimates: Sequence[ShakingEstimate], *, gal: bool, level: float) -> Iterator[str]:
    """Yield the shaking that each group of stones speaks of: over all frequencies, or at the first that was asked for."""
    firsts = {each.stones: each for each in reversed(estimates)}
    for stones in dict.fromkeys(each.stones for each in estimates):
        each = firsts[stones]
        place, kind = place_and_kind(stones)
        who = (place or name) if len(firsts) == 1 else tell("{cemetery}, stones {stones}", cemetery=place or name, stones=tell(kind))
        at = tell("0.5 to 3 Hz") if each.frequency_hz is None else f"{each.frequency_hz:.3g} Hz"
        pga = (
            acceleration(each.pga_m_s2, gal=gal) if each.bound is None else _range(each.pga_interval_m_s2, acceleration_unit(gal=gal).size)
        )
        values = {"who": who, "pga": f"{pga} {acceleration_unit(gal=gal).name}", "at": at, "intensity": _intensity(each)}
        if each.bound is not None:
            yield tell("{who}: PGA {pga} at {at}; JMA intensity {intensity}.", **values)
            continue
        low, high = (acceleration(end, gal=gal) for end in each.pga_interval_m_s2)
        text = noted("{who}: PGA {pga} ({low} to {high}, {level:g%}) at {at}; JMA intensity {intensity}.")
        yield tell(text, low=low, high=high, level=level, **values)


def _range(interval: Interval, unit: float) -> str:
    """Return an interval, or a bound."""
    low, high = interval
    if low is None:
        return NOTHING if high is None else f"< {number(high / unit, 3)}"
    return f"> {number(low / unit, 3)}" if high is None else f"{number(low / unit, 3)}-{number(high / unit, 3)}"


def _intensity(each: ShakingEstimate) -> str:
    """Return the classes of the JMA intensity's interval and its middle."""
    low, high = each.jma_classes
    if low is None or high is None:
        return tell("at most {name}", name=tell(high)) if high else tell("at least {name}", name=tell(low or ""))
    classes = tell(low) if low == high else tell("{low} to {high}", low=tell(low), high=tell(high))
    return f"{classes} ({each.jma_intensity:.1f})"


def estimate_columns(line: Sequence[ShakingEstimate]) -> tuple[list[str], list[list[Any]]]:
    """Return the header and the rows of ``--csv``: the contour, SI."""
    header = ["frequency_hz", "pga_low_m_s2", "pga_m_s2", "pga_high_m_s2", "pgv_low_m_s", "pgv_m_s", "pgv_high_m_s"]
    rows = [[e.frequency_hz, *_around(e.pga_m_s2, e.pga_interval_m_s2), *_around(e.pgv_m_s, e.pgv_interval_m_s)] for e in line]
    return header, rows


def _around(middle: float | None, interval: Interval) -> tuple[float | None, float | None, float | None]:
    """Return lower end, middle and upper end."""
    return interval[0], middle, interval[1]


def factor_tables(found: Sequence[tuple[Record, ScaleFactors]], *, gal: bool, moved: str) -> Iterator[Any]:
    """Yield what each component needs in a sentence, and its factors as a table; `moved` says what was observed."""
    for opening, part in answered(found, lambda each: each[0], lambda each: [line(_needs(each[1], moved, gal=gal))]):
        yield from opening
        for _, each in part:
            unit = length_unit((f.displacement_m for f in each.scale_factors), gal=gal)
            rows = [
                (
                    f"{f.scale:.4f}",
                    acceleration(f.pga_m_s2, gal=gal),
                    length_cell(f.displacement_m, unit),
                    tell("leaps across") if f.leaps else "",
                )
                for f in each.scale_factors
            ]
            if rows:
                headings = (tell("factor"), f"PGA ({acceleration_unit(gal=gal).name})", tell("moved ({unit})", unit=unit.name), "")
                yield table(each.component if len(part) > 1 else "", headings, rows)


def _needs(each: ScaleFactors, moved: str, *, gal: bool) -> str:
    """Return what the observed displacement needs, in words; `moved` is a word for it."""
    told = [f"{factor.scale:.3g} ({told_acceleration(factor.pga_m_s2, gal=gal)})" for factor in each.scale_factors]
    size, alone, most = (told_length(far, gal=gal) for far in (each.observed_m, each.displacement_at_1_m, each.largest_displacement_m))
    values = {"name": each.component, "size": size, "moved": tell(moved), "alone": alone}
    if not told:
        text = noted(
            "{name}: {size} of {moved}: no factor up to {limit:g} moves it so far (at most {most}, at {at:g}); as recorded it is {alone}."
        )
        return tell(text, **values, limit=each.limit, most=most, at=each.largest_at_scale)
    if len(told) == 1:
        text = noted("{name}: {size} of {moved} needs {factor:.3g} times this record ({pga}); as recorded it is {alone}.")
        pga = told_acceleration(each.scale_factors[0].pga_m_s2, gal=gal)
        return tell(text, **values, factor=each.scale_factors[0].scale, pga=pga)
    text = noted("{name}: {size} of {moved} needs this record times one of {factors}; as recorded it is {alone}.")
    return tell(text, **values, factors=told)


def factor_columns(found: Sequence[tuple[Record, ScaleFactors]]) -> tuple[list[str], list[list[Any]]]:
    """Return the header and the rows of ``--csv``: displacement against the factor, per record and component."""
    header = ["record", "component", "scale", "pga_m_s2", "displacement_m"]
    rows = [
        [record.station or record.source, each.component, scale, scale * each.pga_m_s2, value]
        for record, each in found
        for scale, value in zip(*each.curve, strict=True)
    ]
    return header, rows

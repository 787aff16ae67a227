"""What the samples of a record say against it: offset, size, flat peaks, held values, spikes, jumps, dead and copied rows, directions."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations

import numpy as np

from seisblock.records.doubts import Doubt
from seisblock.records.jumps import spikes_and_jumps
from seisblock.records.record import Component, Record
from seisblock.records.whereabouts import doubts_of_header
from seisblock.typing import FloatArray, IntArray
from seisblock.units import GAL
from seisblock.words import said

IMPLAUSIBLE_PGA = 50.0
"""A peak beyond this (m/s^2, about 5 g) has hardly been recorded on the ground: the unit is probably wrong."""

OFFSET_SHARE = 0.1
"""A mean beyond this share of the peak is an offset."""

FLAT_SAMPLES = 4
"""Least samples of one value at the peak that make it flat."""

HELD_S = 0.1
"""Shortest stretch of one value in the midst of shaking that is told, s; eight samples at least."""

EDGE_SHARE = 0.03
"""A step into or out of a flat stretch beyond this share of the peak is a break, not the resolution of the instrument."""

SMOOTH = 0.15
"""Third differences below this share of the first are those of a pulse by a formula (of a sine of twenty samples a tenth). Bundled shaking,
cut anywhere, is so smooth and about to cross zero 1 time in 150 at most, El Centro, which is straight lines, 1 time in 13."""

SKEW_DEG = 1.0
"""How far from perpendicular two horizontals may be before it is said, degrees."""

_AROUND = 20
_PULSE = 8
_NAMED = 5


def examined(record: Record) -> Record:
    """Return a record with the doubts that its samples and its header raise, after those it has.

    Parameters
    ----------
    record : Record
        As read, before anything is done to it.
    """
    found = [doubt for component in record.components for doubt in _of_component(component, record.dt)]
    found += [*_of_rows(record), *_of_directions(record), *doubts_of_header(record)]
    return replace(record, doubts=tuple(dict.fromkeys((*record.doubts, *found))))


def _of_component(component: Component, dt: float) -> Iterator[Doubt]:
    """Yield the doubts that one row of samples raises."""
    a, code = component.acceleration, component.code
    peak = max(float(a.max()), -float(a.min()))
    if peak == 0.0:
        return
    mean = float(a.mean())
    if abs(mean) > OFFSET_SHARE * peak:
        yield Doubt("offset", _offset(code, mean, peak), code)
    if peak > IMPLAUSIBLE_PGA:
        text = said("{component}: a PGA of {pga:.4g} m/s^2 is more than 5 g; is the unit right?", component=code, pga=peak)
        yield Doubt("size", text, code)
    starts, ends = _flat_stretches(a)
    if starts.size:
        yield from _of_flat_stretches(code, a, dt, peak, starts, ends)
    spikes, jumps = spikes_and_jumps(a)
    if spikes.size:
        text = said(
            "{component}: {count} lone spike(s), samples far from their neighbours (at {times} s); they are kept as they are",
            component=code,
            count=spikes.size,
            times=_times(spikes, dt),
        )
        yield Doubt("spike", text, code)
    if jumps.size:
        text = said(
            "{component}: {count} isolated jump(s) (at {times} s), as where pieces of a record were overwritten or left out "
            "(JMA announced such on 2015-12-04); the samples are kept as they are",
            component=code,
            count=jumps.size,
            times=_times(jumps, dt),
        )
        yield Doubt("jump", text, code)


def _offset(code: str, mean: float, peak: float) -> str:
    """Return what is said of an offset."""
    return said(
        "{component}: the mean, {mean:.4g} gal, is {share:.0%} of the peak: an offset, which moves whatever stands there; "
        "remove the mean, or high-pass the record",
        component=code,
        mean=mean / GAL,
        share=abs(mean) / peak,
    )


def _flat_stretches(a: FloatArray) -> tuple[IntArray, IntArray]:
    """Return first and last sample of each stretch of equal samples that is long enough to be looked at."""
    same = np.concatenate(([False], a[1:] == a[:-1], [False]))
    edges = np.flatnonzero(same[1:] != same[:-1])
    starts, ends = edges[::2], edges[1::2]
    long = ends - starts + 1 >= FLAT_SAMPLES
    return starts[long], ends[long]


def _of_flat_stretches(code: str, a: FloatArray, dt: float, peak: float, starts: IntArray, ends: IntArray) -> Iterator[Doubt]:
    """Yield the doubts that stretches of equal samples raise: flat peaks, and values held in the midst of shaking."""
    into = np.where(starts > 0, np.abs(a[starts] - a[np.maximum(starts - 1, 0)]), 0.0)
    out = np.where(ends < a.size - 1, np.abs(a[ends] - a[np.minimum(ends + 1, a.size - 1)]), 0.0)
    at_peak = np.isin(a[starts], (a.max(), a.min())) & (np.abs(a[starts]) > 0.5 * peak)
    clipped = at_peak & (np.minimum(into, out) > EDGE_SHARE * peak)
    if clipped.any():
        text = said(
            "{component}: {count} flat peak(s) of {longest} equal samples at most (at {times} s): the instrument or the file is clipped",
            component=code,
            count=int(clipped.sum()),
            longest=int((ends - starts)[clipped].max()) + 1,
            times=_times(starts[clipped], dt),
        )
        yield Doubt("clipped", text, code)
    long = (ends - starts) * dt >= max(HELD_S, 7.5 * dt)
    held = [
        i
        for i in np.flatnonzero(long & ~clipped & (np.maximum(into, out) > EDGE_SHARE * peak))
        if _shaken(a[max(starts[i] - _AROUND, 0) : starts[i]], peak)
        and (
            not _comes_to_rest(a[max(starts[i] - _AROUND, 0) : starts[i]], a[starts[i]])
            if ends[i] == a.size - 1
            else _shaken(a[ends[i] + 1 : ends[i] + 1 + _AROUND], peak)
        )
    ]
    if held:
        text = said(
            "{component}: {count} stretch(es) of one value in the midst of shaking (from {times} s, {longest:.3g} s at most): "
            "a gap that was filled, or samples that were lost",
            component=code,
            count=len(held),
            times=_times(starts[held], dt),
            longest=float((ends - starts)[held].max()) * dt,
        )
        yield Doubt("held", text, code)


def _shaken(around: FloatArray, peak: float) -> bool:
    """Return whether some samples beside a stretch are those of shaking."""
    return around.size >= _AROUND // 2 and float(np.median(np.abs(np.diff(around)))) > 0.002 * peak


def _comes_to_rest(before: FloatArray, held: float) -> bool:
    """Return whether a smooth pulse, and no recorded shaking, ends in zeros: its last samples, gone on with, arrive there."""
    rest = np.flatnonzero(before == 0.0)
    pulse = before[rest[-1] :] if rest.size else before
    if held != 0.0 or pulse.size < _PULSE:
        return False
    smooth = np.median(np.abs(np.diff(pulse, 3))) < SMOOTH * np.median(np.abs(np.diff(pulse)))
    following = 3.0 * (pulse[-1] - pulse[-2]) + pulse[-3]
    near = EDGE_SHARE * float(np.abs(pulse).max())
    return bool(smooth and min(pulse[-1], following) - near <= 0.0 <= max(pulse[-1], following) + near)


def _of_rows(record: Record) -> Iterator[Doubt]:
    """Yield the doubts about rows beside each other: all that are still, one that is while others shake, one that is a copy of another."""
    shaken = [c for c in record.components if c.acceleration.any()]
    if not shaken:
        yield Doubt("held", said("every sample of every component is 0: nothing moves on such ground"))
    for still in (c.code for c in record.components if shaken and c not in shaken):
        yield Doubt("held", said("{component}: every sample is 0 while others shake: a channel that was dead", component=still), still)
    for one, other in combinations(shaken, 2):
        if np.array_equal(one.acceleration, other.acceleration):
            text = said("{one} and {other} hold the same samples: one is a copy of the other", one=one.code, other=other.code)
            yield Doubt("directions", text)


def _of_directions(record: Record) -> Iterator[Doubt]:
    """Yield the doubts about the directions of a record: azimuths that are no right angle apart, or without a vertical component."""
    if record.vertical is None and len(record.horizontals) > 2:
        text = said("none of the components {codes} is known to be vertical: all are taken as horizontal", codes=record.codes)
        yield Doubt("directions", text)
    known = [c for c in record.horizontals if c.azimuth_deg is not None]
    if len(known) != 2:
        return
    one, other = known
    apart = abs((one.azimuth_deg or 0.0) - (other.azimuth_deg or 0.0)) % 180.0
    if abs(apart - 90.0) > SKEW_DEG:
        text = said(
            "the horizontals {one} and {other} are not perpendicular, {apart:g} degrees apart", one=one.code, other=other.code, apart=apart
        )
        yield Doubt("directions", text)
    if record.vertical is None and {one.code, other.code} != {"NS", "EW"}:
        text = said("the horizontals {one} and {other} come without a vertical component", one=one.code, other=other.code)
        yield Doubt("directions", text)


def _times(indices: IntArray, dt: float) -> str:
    """Return some times in words, s, the first few."""
    return ", ".join(f"{i * dt:.2f}" for i in indices[:_NAMED]) + (", ..." if len(indices) > _NAMED else "")

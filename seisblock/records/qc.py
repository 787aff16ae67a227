"""What the samples of a record say against it: offset, size, flat peaks, held values, spikes, jumps, dead and copied rows, directions."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations

import numpy as np

from seisblock.core.i18n import lazy_gettext
from seisblock.core.typing import FloatArray, IntArray
from seisblock.core.units import GAL
from seisblock.records.qc_flags import QCFlag
from seisblock.records.qc_metadata import check_metadata
from seisblock.records.qc_spikes import find_spikes_and_jumps
from seisblock.records.record import Component, Record

IMPLAUSIBLE_PGA = 50.0
"""A peak beyond this (m/s^2, about 5 g) has hardly been recorded on the ground: the unit is probably wrong."""

OFFSET_RATIO = 0.1
"""A mean beyond this share of the peak is an offset."""

MIN_FLAT_SAMPLES = 4
"""Least samples of one value at the peak that make it flat."""

MIN_HOLD_S = 0.1
"""Shortest stretch of one value in the midst of shaking that is told, s; eight samples at least."""

EDGE_RATIO = 0.03
"""A step into or out of a flat stretch beyond this share of the peak is a break, not the resolution of the instrument."""

SMOOTHNESS_RATIO = 0.15
"""Third differences below this share of the first are those of a pulse by a formula (of a sine of twenty samples a tenth). Bundled shaking,
cut anywhere, is so smooth and about to cross zero 1 time in 150 at most, El Centro, which is straight lines, 1 time in 13."""

MAX_SKEW_DEG = 1.0
"""How far from perpendicular two horizontals may be before it is said, degrees."""

_NEIGHBOURHOOD = 20
_MIN_PULSE_SAMPLES = 8
_MAX_LISTED = 5


def run_qc(record: Record) -> Record:
    """Return a record with the doubts that its samples and its header raise, after those it has.

    Parameters
    ----------
    record : Record
        As read, before anything is done to it.
    """
    flags = [flag for component in record.components for flag in _check_component(component, record.dt)]
    flags += [*_check_duplicates(record), *_check_directions(record), *check_metadata(record)]
    return replace(record, doubts=tuple(dict.fromkeys((*record.doubts, *flags))))


def _check_component(component: Component, dt: float) -> Iterator[QCFlag]:
    """Yield the doubts that one row of samples raises."""
    a, code = component.acceleration, component.code
    peak = max(float(a.max()), -float(a.min()))
    if peak == 0.0:
        return
    mean = float(a.mean())
    if abs(mean) > OFFSET_RATIO * peak:
        yield QCFlag("offset", _offset_message(code, mean, peak), code)
    if peak > IMPLAUSIBLE_PGA:
        text = lazy_gettext("{component}: a PGA of {pga:.4g} m/s^2 is more than 5 g; is the unit right?", component=code, pga=peak)
        yield QCFlag("size", text, code)
    starts, ends = _find_flat_runs(a)
    if starts.size:
        yield from _check_flat_runs(code, a, dt, peak, starts, ends)
    spikes, jumps = find_spikes_and_jumps(a)
    if spikes.size:
        text = lazy_gettext(
            "{component}: {count} lone spike(s), samples far from their neighbours (at {times} s); they are kept as they are",
            component=code,
            count=spikes.size,
            times=_format_times(spikes, dt),
        )
        yield QCFlag("spike", text, code)
    if jumps.size:
        text = lazy_gettext(
            "{component}: {count} isolated jump(s) (at {times} s), as where pieces of a record were overwritten or left out "
            "(JMA announced such on 2015-12-04); the samples are kept as they are",
            component=code,
            count=jumps.size,
            times=_format_times(jumps, dt),
        )
        yield QCFlag("jump", text, code)


def _offset_message(code: str, mean: float, peak: float) -> str:
    """Return what is said of an offset."""
    return lazy_gettext(
        "{component}: the mean, {mean:.4g} gal, is {share:.0%} of the peak: an offset, which moves whatever stands there; "
        "remove the mean, or high-pass the record",
        component=code,
        mean=mean / GAL,
        share=abs(mean) / peak,
    )


def _find_flat_runs(a: FloatArray) -> tuple[IntArray, IntArray]:
    """Return first and last sample of each stretch of equal samples that is long enough to be looked at."""
    is_repeat = np.concatenate(([False], a[1:] == a[:-1], [False]))
    edges = np.flatnonzero(is_repeat[1:] != is_repeat[:-1])
    starts, ends = edges[::2], edges[1::2]
    is_long = ends - starts + 1 >= MIN_FLAT_SAMPLES
    return starts[is_long], ends[is_long]


def _check_flat_runs(code: str, a: FloatArray, dt: float, peak: float, starts: IntArray, ends: IntArray) -> Iterator[QCFlag]:
    """Yield the doubts that stretches of equal samples raise: flat peaks, and values held in the midst of shaking."""
    step_in = np.where(starts > 0, np.abs(a[starts] - a[np.maximum(starts - 1, 0)]), 0.0)
    step_out = np.where(ends < a.size - 1, np.abs(a[ends] - a[np.minimum(ends + 1, a.size - 1)]), 0.0)
    at_peak = np.isin(a[starts], (a.max(), a.min())) & (np.abs(a[starts]) > 0.5 * peak)
    is_clipped = at_peak & (np.minimum(step_in, step_out) > EDGE_RATIO * peak)
    if is_clipped.any():
        text = lazy_gettext(
            "{component}: {count} flat peak(s) of {longest} equal samples at most (at {times} s): the instrument or the file is clipped",
            component=code,
            count=int(is_clipped.sum()),
            longest=int((ends - starts)[is_clipped].max()) + 1,
            times=_format_times(starts[is_clipped], dt),
        )
        yield QCFlag("clipped", text, code)
    is_long = (ends - starts) * dt >= max(MIN_HOLD_S, 7.5 * dt)
    holds = [
        i
        for i in np.flatnonzero(is_long & ~is_clipped & (np.maximum(step_in, step_out) > EDGE_RATIO * peak))
        if _is_shaking(a[max(starts[i] - _NEIGHBOURHOOD, 0) : starts[i]], peak)
        and (
            not _ends_at_rest(a[max(starts[i] - _NEIGHBOURHOOD, 0) : starts[i]], a[starts[i]])
            if ends[i] == a.size - 1
            else _is_shaking(a[ends[i] + 1 : ends[i] + 1 + _NEIGHBOURHOOD], peak)
        )
    ]
    if holds:
        text = lazy_gettext(
            "{component}: {count} stretch(es) of one value in the midst of shaking (from {times} s, {longest:.3g} s at most): "
            "a gap that was filled, or samples that were lost",
            component=code,
            count=len(holds),
            times=_format_times(starts[holds], dt),
            longest=float((ends - starts)[holds].max()) * dt,
        )
        yield QCFlag("held", text, code)


def _is_shaking(samples: FloatArray, peak: float) -> bool:
    """Return whether some samples beside a stretch are those of shaking."""
    return samples.size >= _NEIGHBOURHOOD // 2 and float(np.median(np.abs(np.diff(samples)))) > 0.002 * peak


def _ends_at_rest(samples: FloatArray, value: float) -> bool:
    """Return whether a smooth pulse, and no recorded shaking, ends in zeros: its last samples, gone on with, arrive there."""
    zeros = np.flatnonzero(samples == 0.0)
    pulse = samples[zeros[-1] :] if zeros.size else samples
    if value != 0.0 or pulse.size < _MIN_PULSE_SAMPLES:
        return False
    is_smooth = np.median(np.abs(np.diff(pulse, 3))) < SMOOTHNESS_RATIO * np.median(np.abs(np.diff(pulse)))
    extrapolated = 3.0 * (pulse[-1] - pulse[-2]) + pulse[-3]
    tolerance = EDGE_RATIO * float(np.abs(pulse).max())
    return bool(is_smooth and min(pulse[-1], extrapolated) - tolerance <= 0.0 <= max(pulse[-1], extrapolated) + tolerance)


def _check_duplicates(record: Record) -> Iterator[QCFlag]:
    """Yield the doubts about rows beside each other: all that are still, one that is while others shake, one that is a copy of another."""
    active = [c for c in record.components if c.acceleration.any()]
    if not active:
        yield QCFlag("held", lazy_gettext("every sample of every component is 0: nothing moves on such ground"))
    for code in (c.code for c in record.components if active and c not in active):
        yield QCFlag(
            "held", lazy_gettext("{component}: every sample is 0 while others shake: a channel that was dead", component=code), code
        )
    for first, second in combinations(active, 2):
        if np.array_equal(first.acceleration, second.acceleration):
            text = lazy_gettext("{one} and {other} hold the same samples: one is a copy of the other", one=first.code, other=second.code)
            yield QCFlag("directions", text)


def _check_directions(record: Record) -> Iterator[QCFlag]:
    """Yield the doubts about the directions of a record: azimuths that are no right angle apart, or without a vertical component."""
    if record.vertical is None and len(record.horizontals) > 2:
        text = lazy_gettext("none of the components {codes} is known to be vertical: all are taken as horizontal", codes=record.codes)
        yield QCFlag("directions", text)
    oriented = [c for c in record.horizontals if c.azimuth_deg is not None]
    if len(oriented) != 2:
        return
    first, second = oriented
    angle = abs((first.azimuth_deg or 0.0) - (second.azimuth_deg or 0.0)) % 180.0
    if abs(angle - 90.0) > MAX_SKEW_DEG:
        text = lazy_gettext(
            "the horizontals {one} and {other} are not perpendicular, {apart:g} degrees apart",
            one=first.code,
            other=second.code,
            apart=angle,
        )
        yield QCFlag("directions", text)
    if record.vertical is None and {first.code, second.code} != {"NS", "EW"}:
        text = lazy_gettext("the horizontals {one} and {other} come without a vertical component", one=first.code, other=second.code)
        yield QCFlag("directions", text)


def _format_times(indices: IntArray, dt: float) -> str:
    """Return some times in words, s, the first few."""
    return ", ".join(f"{i * dt:.2f}" for i in indices[:_MAX_LISTED]) + (", ..." if len(indices) > _MAX_LISTED else "")

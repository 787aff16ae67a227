"""Quality control of samples: offset, size, clipping, constant runs, spikes, jumps, duplicates, directions."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from datetime import timedelta
from itertools import combinations

import numpy as np

from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.typing import FloatArray, IntArray
from seisblock.core.units import GAL
from seisblock.records.qc_flags import QCFlag
from seisblock.records.qc_repetition import find_repetitions
from seisblock.records.qc_spikes import find_flipped_samples, find_rectified_samples, find_spikes_and_jumps
from seisblock.records.record import Component, Record
from seisblock.records.site import MAX_LATITUDE, MAX_LONGITUDE, format_local_time, get_earthquake, get_site

ORIGIN_TIME_TOLERANCE = timedelta(seconds=60)
"""Old headers give the origin time to the minute."""

MAX_TRAVEL_TIME = timedelta(hours=1)
"""Longest plausible travel time of strong shaking."""


def check_metadata(record: Record) -> Iterator[QCFlag]:
    """Yield flags for coordinates out of range and for a record start that does not match the origin time."""
    site, earthquake = get_site(record), get_earthquake(record)
    locations = {lazy_gettext("station"): site} | ({lazy_gettext("epicentre"): earthquake} if earthquake else {})
    for label, location in locations.items():
        for degrees, limit in ((location.latitude_deg, MAX_LATITUDE), (location.longitude_deg, MAX_LONGITUDE)):
            if degrees is not None and abs(degrees) > limit:
                yield QCFlag(
                    "header",
                    lazy_gettext(
                        "{what} coordinate {degrees:g} degrees out of range (limit {most:g})", what=label, degrees=degrees, most=limit
                    ),
                )
    origin = earthquake.origin_time if earthquake else None
    if origin is None or record.start is None:
        return
    end = record.start + timedelta(seconds=record.samples * record.dt)
    # a recorder with memory starts before the origin time, but no record of the earthquake ends before it
    if end < origin - ORIGIN_TIME_TOLERANCE or record.start > origin + MAX_TRAVEL_TIME:
        text = lazy_gettext(
            "record start {start} and origin time {origin} do not match: one of them is wrong",
            start=format_local_time(record, record.start),
            origin=format_local_time(record, origin),
        )
        yield QCFlag("header", text)


IMPLAUSIBLE_PGA = 50.0
"""Peak, m/s^2 (about 5 g), hardly ever recorded on the ground; larger values suggest a wrong unit."""

OFFSET_RATIO = 0.1
"""Ratio of mean to peak beyond which an offset is flagged."""

MIN_FLAT_SAMPLES = 4
"""Minimum number of equal samples at the peak that count as clipped."""

MIN_HOLD_S = 0.1
"""Shortest run of one value during shaking that is flagged, s; at least eight samples."""

EDGE_RATIO = 0.03
"""Step at the edge of a flat run, as a ratio of the peak, beyond which the run is not due to instrument resolution."""

EDGE_UNITS = 4.5
"""Step at the edge of a flat run, as a multiple of the resolution, beyond which the run is not due to a coarse resolution."""

FREQUENT_SHARE = 0.1
"""Share of the nonzero steps between samples at which a step is one of the resolution."""

USUAL_RUNS = 10
"""Number of flat runs of at least half the length or at the same value, the run included, and at a peak of those of at least its length
elsewhere, beyond which a flat run is due to a coarse resolution."""

LONG_FLAT_SAMPLES = 8
"""Minimum number of equal samples at the peak of either side that count as clipped where their edges only exceed EDGE_UNITS: a smooth
maximum with as many samples within one unit of the resolution has edges of one or two."""

QUIET_SHARE, INTERRUPTION_RATIO, MAX_INTERRUPTION_S = 0.5, 12.0, 10.0
"""Interruption of weak motion: flat run of at least LONG_HOLD_SAMPLES intervals, between two windows of its length in which at least this
share of the steps is not zero, and this many times as long as the longest flat run there; at most 10 s, as rests between two motions of a
sequence are longer."""

LONG_HOLD_SAMPLES = 25
"""Intervals of a flat run beyond which it is not due to a coarse resolution, if the unit of that is below EDGE_RATIO times the peak."""

MIN_INTERVAL_S, MAX_INTERVAL_S = 5e-4, 0.1
"""Sampling intervals of strong-motion records, s; others are probably in another unit."""

MIN_ZERO_MINIMA, ZERO_RATIO = 10, 0.02
"""Number of minima below this ratio of the peak at which samples without a negative value have lost their signs."""

SMOOTHNESS_RATIO = 0.15
"""Ratio of third to first differences below which samples are those of an analytic pulse (a tenth for a sine of 20 samples).

Of the bundled records, cut at any sample, at most 1 in 150 is so smooth and about to cross zero; of El Centro, which is piecewise
linear, 1 in 13."""

MAX_SKEW_DEG = 1.0
"""Largest deviation of two horizontals from perpendicular without a flag, degrees."""

_MILLISECONDS = N_("times in milliseconds?")
_SAMPLE_NUMBERS = N_("sample numbers instead of times?")
_DAYS = N_("times in days, as of a spreadsheet?")
_OTHER_INTERVAL = N_("check the unit of time")

_HIDDEN_BY_INTERPOLATION = {"clipped", "held", "spike"}
_RESOLUTION_SAMPLES = 2**15
_NEIGHBOURHOOD = 20
_MIN_PULSE_SAMPLES = 8
_MAX_LISTED = 5


def run_qc(record: Record) -> Record:
    """Return the record with quality flags from samples and header appended to its existing flags.

    Parameters
    ----------
    record : Record
        Record as read, before processing.
    """
    is_interpolated = bool(record.metadata.get("interpolated"))
    flags = [flag for component in record.components for flag in _check_component(component, record.dt, is_interpolated=is_interpolated)]
    if record.carries_offset:
        # of the instrument, removed by default and named in the history
        flags = [flag for flag in flags if flag.kind != "offset"]
    flags += [*_check_interval(record), *_check_duplicates(record), *_check_directions(record), *check_metadata(record)]
    return replace(record, doubts=tuple(dict.fromkeys((*record.doubts, *flags))))


def check_recorded(component: Component, dt: float) -> tuple[QCFlag, ...]:
    """Return flags of flat peaks, gaps and spikes of uneven samples as recorded, at a mean interval `dt`, s: interpolation hides them."""
    return tuple(flag for flag in _check_component(component, dt, is_interpolated=False) if flag.kind in _HIDDEN_BY_INTERPOLATION)


def _check_component(component: Component, dt: float, *, is_interpolated: bool) -> Iterator[QCFlag]:
    """Yield the flags of one component; interpolated samples are straight between those of the file."""
    a, code = component.acceleration, component.code
    peak = max(float(a.max()), -float(a.min()))
    if peak == 0.0:
        return
    mean = float(a.mean())
    # an offset acts on a body as a constant force and may overturn it, where the record has none
    if abs(mean) > OFFSET_RATIO * peak:
        yield QCFlag("offset", _offset_message(code, mean, peak), code)
    if peak > IMPLAUSIBLE_PGA:
        text = lazy_gettext("{component}: PGA {pga:.4g} m/s^2 exceeds 5 g; check the unit", component=code, pga=peak)
        yield QCFlag("size", text, code)
    starts, ends = _find_flat_runs(a)
    # interpolated samples are straight between those of the file, which looks like a coarse resolution
    if starts.size and not is_interpolated:
        yield from _check_flat_runs(code, a, dt, peak, starts, ends)
    yield from _check_repetition(code, a, dt)
    yield from _check_signs(code, a, dt, peak)
    spikes, jumps = find_spikes_and_jumps(a)
    if spikes.size:
        text = lazy_gettext(
            "{component}: {count} isolated spike(s) (at {times} s); samples not corrected",
            component=code,
            count=spikes.size,
            times=_format_times(spikes, dt),
        )
        yield QCFlag("spike", text, code)
    if jumps.size:
        text = lazy_gettext(
            "{component}: {count} isolated step(s) (at {times} s), possibly overwritten or missing samples (JMA notice of "
            "2015-12-04); samples not corrected",
            component=code,
            count=jumps.size,
            times=_format_times(jumps, dt),
        )
        yield QCFlag("jump", text, code)


def _check_repetition(code: str, a: FloatArray, dt: float) -> Iterator[QCFlag]:
    """Yield a flag for pieces that repeat earlier ones exactly."""
    pieces = find_repetitions(a)
    if pieces:
        text = lazy_gettext(
            "{component}: {count} interval(s) repeat earlier samples exactly (from {times} s, up to {longest:.3g} s, as those "
            "{lag:.3g} s before): overwritten samples (JMA notice of 2015-12-04) or duplicate data; samples not corrected",
            component=code,
            count=len(pieces),
            times=_format_times(np.array([piece.second for piece in pieces]), dt),
            longest=max(piece.samples for piece in pieces) * dt,
            lag=(pieces[0].second - pieces[0].first) * dt,
        )
        yield QCFlag("repetition", text, code)


def _check_signs(code: str, a: FloatArray, dt: float, peak: float) -> Iterator[QCFlag]:
    """Yield a flag for minus signs that are lost, in the whole component or in single samples."""
    if a.size < _MIN_PULSE_SAMPLES:
        return
    # a horizontal component of one sign is impossible for shaking, unless it is a short pulse
    if a.min() >= 0.0 or a.max() <= 0.0:
        size = np.abs(a)
        is_minimum = (size[1:-1] < size[:-2]) & (size[1:-1] <= size[2:]) & (size[1:-1] < ZERO_RATIO * peak)
        if np.count_nonzero(is_minimum) >= MIN_ZERO_MINIMA:
            text = lazy_gettext(
                "{component}: all samples have one sign, though they often come near zero: minus signs lost", component=code
            )
            yield QCFlag("sign", text, code)
        return
    for first, last, count in find_rectified_samples(a):
        text = lazy_gettext(
            "{component}: samples touch zero {count} times between {first:.2f} and {last:.2f} s without crossing it: minus signs lost",
            component=code,
            count=count,
            first=first * dt,
            last=last * dt,
        )
        yield QCFlag("sign", text, code)
    flips = find_flipped_samples(a)
    if flips.size:
        text = lazy_gettext(
            "{component}: {count} sample(s) fit their neighbours with the opposite sign only (at {times} s): minus signs lost",
            component=code,
            count=flips.size,
            times=_format_times(flips, dt),
        )
        yield QCFlag("sign", text, code)


def _offset_message(code: str, mean: float, peak: float) -> str:
    return lazy_gettext(
        "{component}: mean {mean:.4g} gal is {share:.0%} of the peak (offset); remove the mean or high-pass the record",
        component=code,
        mean=mean / GAL,
        share=abs(mean) / peak,
    )


def _find_flat_runs(a: FloatArray) -> tuple[IntArray, IntArray]:
    """Return first and last index of each run of at least MIN_FLAT_SAMPLES equal samples."""
    # entry i: sample i equals the one before; its changes mark the first and the last sample of each run
    is_repeat = np.concatenate(([False], a[1:] == a[:-1], [False]))
    edges = np.flatnonzero(is_repeat[1:] != is_repeat[:-1])
    starts, ends = edges[::2], edges[1::2]
    is_long = ends - starts + 1 >= MIN_FLAT_SAMPLES
    return starts[is_long], ends[is_long]


def _check_flat_runs(code: str, a: FloatArray, dt: float, peak: float, starts: IntArray, ends: IntArray) -> Iterator[QCFlag]:
    """Yield flags for clipped peaks and for constant values during shaking."""
    # steps into and out of each run; none at the ends of the record
    step_in = np.where(starts > 0, np.abs(a[starts] - a[np.maximum(starts - 1, 0)]), 0.0)
    step_out = np.where(ends < a.size - 1, np.abs(a[ends] - a[np.minimum(ends + 1, a.size - 1)]), 0.0)
    # clipped: at an extreme of the record, entered and left by steep steps
    at_extreme = np.isin(a[starts], (a.max(), a.min()))
    lengths = ends - starts
    edge, edges = np.minimum(step_in, step_out), np.maximum(step_in, step_out)
    # the resolution matters at steep edges and at long peaks only
    unit = _resolution(a) if (edges > EDGE_RATIO * peak).any() or (at_extreme & (lengths >= LONG_FLAT_SAMPLES - 1)).any() else 0.0
    is_steep = edge > max(EDGE_RATIO * peak, EDGE_UNITS * unit)
    is_long = (lengths >= LONG_FLAT_SAMPLES - 1) & (edge > EDGE_UNITS * unit)
    is_clipped = at_extreme & ((is_steep & (np.abs(a[starts]) > 0.5 * peak)) | (is_long & (np.abs(a[starts]) > OFFSET_RATIO * peak)))
    # an instrument that rests at other values as long, between steps as steep, has a coarse resolution
    is_clipped &= _count_at_least(lengths[(is_steep | is_long) & ~at_extreme], lengths) <= USUAL_RUNS
    if is_clipped.any():
        text = lazy_gettext(
            "{component}: {count} flat peak(s) of up to {longest} equal samples (at {times} s): instrument or file clipped",
            component=code,
            count=int(is_clipped.sum()),
            longest=int(lengths[is_clipped].max()) + 1,
            times=_format_times(starts[is_clipped], dt),
        )
        yield QCFlag("clipped", text, code)
    # coarse samples stay constant for a while by themselves: steps of few units of the resolution are no edge, unless the run is long
    is_long_hold = (lengths >= LONG_HOLD_SAMPLES) & (unit < EDGE_RATIO * peak)
    is_edge = (edges > EDGE_RATIO * peak) & ((edges > EDGE_UNITS * unit) | is_long_hold)
    # runs of half the length are usual in such samples, too, or runs at the same value between steps as steep: a gap is filled with any
    # value, not with one at which the instrument often rests
    _, levels = np.unique(a[starts], return_inverse=True)
    is_steep = edges > max(EDGE_RATIO * peak, EDGE_UNITS * unit)
    rests = np.bincount(levels, is_steep)[levels]
    is_usual = (_count_at_least(lengths, (lengths + 1) // 2) > USUAL_RUNS) | (rests > USUAL_RUNS)
    is_edge &= ~is_usual | is_long_hold
    # 7.5 intervals: eight equal samples, with a margin for rounding
    is_long = lengths * dt >= max(MIN_HOLD_S, 7.5 * dt)
    holds = [
        i for i in np.flatnonzero(~is_clipped & (lengths >= LONG_HOLD_SAMPLES)) if _is_interruption(a, int(starts[i]), int(ends[i]), dt)
    ]
    holds += [
        i
        for i in np.flatnonzero(is_long & ~is_clipped & is_edge)
        if _is_shaking(a[max(starts[i] - _NEIGHBOURHOOD, 0) : starts[i]], peak)
        and (
            not _ends_at_rest(a[max(starts[i] - _NEIGHBOURHOOD, 0) : starts[i]], a[starts[i]])
            if ends[i] == a.size - 1
            else _is_shaking(a[ends[i] + 1 : ends[i] + 1 + _NEIGHBOURHOOD], peak)
        )
    ]
    holds = sorted(set(holds))
    if holds:
        text = lazy_gettext(
            "{component}: {count} interval(s) of constant value during shaking (from {times} s, up to {longest:.3g} s): filled gap "
            "or lost samples",
            component=code,
            count=len(holds),
            times=_format_times(starts[holds], dt),
            longest=float(lengths[holds].max()) * dt,
        )
        yield QCFlag("held", text, code)


def _is_interruption(a: FloatArray, start: int, end: int, dt: float) -> bool:
    """Return whether a flat run between two samples interrupts motion that goes on changing on both sides, however weak."""
    length = end - start
    before, after = a[max(start - length, 0) : start + 1], a[end : end + length + 1]
    if length * dt > MAX_INTERRUPTION_S or min(before.size, after.size) <= length:
        return False
    for window in (before, after):
        changes = np.flatnonzero(np.diff(window))
        if changes.size < QUIET_SHARE * length:
            return False
        longest = int(np.diff(changes, prepend=-1, append=length).max()) - 1
        if length < INTERRUPTION_RATIO * max(longest, 1):
            return False
    return not _ends_at_rest(before[-_NEIGHBOURHOOD - 1 : -1], float(a[start]))


def _count_at_least(values: IntArray, limits: IntArray) -> IntArray:
    """Return the number of values, (n,), that are not below each limit, (m,)."""
    return values.size - np.searchsorted(np.sort(values), limits)


def _resolution(a: FloatArray) -> float:
    """Return the smallest difference of two values among the samples around the peak."""
    # around the peak, where all digits of the resolution are in use
    # not argmax, which copies read-only arrays
    middle = int(np.flatnonzero(a == a.max())[0])
    around = a[max(middle - _RESOLUTION_SAMPLES, 0) : middle + _RESOLUTION_SAMPLES]
    smallest = float(np.diff(np.unique(around)).min(initial=np.inf))
    # digits may be printed below the resolution of the instrument: its steps are the most frequent ones
    multiples = np.diff(around)
    # in place, for these are as many as the samples of a usual record
    np.abs(multiples, out=multiples)
    np.divide(multiples, smallest, out=multiples)
    np.round(multiples, out=multiples)
    multiples.sort()
    starts = np.append(0, 1 + np.flatnonzero(multiples[1:] != multiples[:-1]))
    steps, counts = multiples[starts], np.diff(starts, append=multiples.size)
    frequent = steps[(steps > 0.0) & (counts >= FREQUENT_SHARE * max(counts[steps > 0.0].sum(), 1))]
    return smallest * float(frequent.max(initial=1.0))


def _is_shaking(samples: FloatArray, peak: float) -> bool:
    """Return whether samples next to a flat run are those of shaking."""
    return samples.size >= _NEIGHBOURHOOD // 2 and float(np.median(np.abs(np.diff(samples)))) > 0.002 * peak


def _ends_at_rest(samples: FloatArray, value: float) -> bool:
    """Return whether samples end like an analytic pulse that reaches zero, not like recorded shaking."""
    zeros = np.flatnonzero(samples == 0.0)
    pulse = samples[zeros[-1] :] if zeros.size else samples
    if value != 0.0 or pulse.size < _MIN_PULSE_SAMPLES:
        return False
    # analytic pulses have small third differences; recorded shaking does not
    is_smooth = np.median(np.abs(np.diff(pulse, 3))) < SMOOTHNESS_RATIO * np.median(np.abs(np.diff(pulse)))
    # quadratic extrapolation to the first sample of the run
    extrapolated = 3.0 * (pulse[-1] - pulse[-2]) + pulse[-3]
    tolerance = EDGE_RATIO * float(np.abs(pulse).max())
    return bool(is_smooth and min(pulse[-1], extrapolated) - tolerance <= 0.0 <= max(pulse[-1], extrapolated) + tolerance)


def _check_interval(record: Record) -> Iterator[QCFlag]:
    """Yield a flag for a sampling interval that no strong-motion recorder has, with its probable reason."""
    dt = record.dt
    # half a unit of the ninth digit: 1/2000 s and 1/10 s are inside
    if MIN_INTERVAL_S * (1.0 - 1e-9) <= dt <= MAX_INTERVAL_S * (1.0 + 1e-9):
        return
    # recorders with a network code state their rate themselves
    if record.network and dt > MAX_INTERVAL_S:
        text = lazy_gettext(
            "sampling interval {dt:.4g} s: motion above {limit:.3g} Hz is not in the file; unusable as a strong-motion record",
            dt=dt,
            limit=0.5 / dt,
        )
        yield QCFlag("clock", text)
        return
    reasons = {0.001 * dt: _MILLISECONDS, 86400.0 * dt: _DAYS, 0.01 * dt: _SAMPLE_NUMBERS if dt == 1.0 else _OTHER_INTERVAL}
    plausible = [reason for interval, reason in reasons.items() if MIN_INTERVAL_S <= interval <= MAX_INTERVAL_S]
    reason = plausible[-1 if dt == 1.0 else 0] if plausible and not record.network else _OTHER_INTERVAL
    text = lazy_gettext("sampling interval {dt:.4g} s, expected 0.0005 to 0.1 s: {reason}", dt=dt, reason=lazy_gettext(reason))
    yield QCFlag("clock", text)


def _check_duplicates(record: Record) -> Iterator[QCFlag]:
    """Yield flags for all-zero records, dead channels and identical components."""
    active = [c for c in record.components if c.acceleration.any()]
    if not active:
        yield QCFlag("held", lazy_gettext("all samples of all components are 0: no ground motion"))
    for code in (c.code for c in record.components if active and c not in active):
        yield QCFlag(
            "held", lazy_gettext("{component}: all samples are 0 while other components are not: dead channel", component=code), code
        )
    for first, second in combinations(active, 2):
        if np.array_equal(first.acceleration, second.acceleration):
            text = lazy_gettext("{one} and {other} are identical: one is a copy of the other", one=first.code, other=second.code)
            yield QCFlag("directions", text)


def _check_directions(record: Record) -> Iterator[QCFlag]:
    """Yield flags for horizontals that are not perpendicular and for a missing vertical component."""
    if record.vertical is None and len(record.horizontals) > 2:
        text = lazy_gettext("no vertical component identified among {codes}; all treated as horizontal", codes=record.codes)
        yield QCFlag("directions", text)
    oriented = [c for c in record.horizontals if c.azimuth_deg is not None]
    if len(oriented) != 2:
        return
    first, second = oriented
    # modulo 180: opposite directions are the same axis
    angle = abs((first.azimuth_deg or 0.0) - (second.azimuth_deg or 0.0)) % 180.0
    if abs(angle - 90.0) > MAX_SKEW_DEG:
        text = lazy_gettext(
            "horizontals {one} and {other} are not perpendicular ({apart:g} degrees apart)",
            one=first.code,
            other=second.code,
            apart=angle,
        )
        yield QCFlag("directions", text)


def _format_times(indices: IntArray, dt: float) -> str:
    """Return the first few times, s, as text."""
    return ", ".join(f"{i * dt:.2f}" for i in indices[:_MAX_LISTED]) + (", ..." if len(indices) > _MAX_LISTED else "")

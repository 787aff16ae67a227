"""Quality control of samples: offset, size, clipping, constant runs, spikes, jumps, duplicates, directions."""

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
"""Peak, m/s^2 (about 5 g), hardly ever recorded on the ground; larger values suggest a wrong unit."""

OFFSET_RATIO = 0.1
"""Ratio of mean to peak beyond which an offset is flagged."""

MIN_FLAT_SAMPLES = 4
"""Minimum number of equal samples at the peak that count as clipped."""

MIN_HOLD_S = 0.1
"""Shortest run of one value during shaking that is flagged, s; at least eight samples."""

EDGE_RATIO = 0.03
"""Step at the edge of a flat run, as a ratio of the peak, beyond which the run is not due to instrument resolution."""

SMOOTHNESS_RATIO = 0.15
"""Ratio of third to first differences below which samples are those of an analytic pulse (a tenth for a sine of 20 samples).

Of the bundled records, cut at any sample, at most 1 in 150 is so smooth and about to cross zero; of El Centro, which is piecewise
linear, 1 in 13."""

MAX_SKEW_DEG = 1.0
"""Largest deviation of two horizontals from perpendicular without a flag, degrees."""

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
    flags = [flag for component in record.components for flag in _check_component(component, record.dt)]
    flags += [*_check_duplicates(record), *_check_directions(record), *check_metadata(record)]
    return replace(record, doubts=tuple(dict.fromkeys((*record.doubts, *flags))))


def _check_component(component: Component, dt: float) -> Iterator[QCFlag]:
    """Yield the flags of one component."""
    a, code = component.acceleration, component.code
    peak = max(float(a.max()), -float(a.min()))
    if peak == 0.0:
        return
    mean = float(a.mean())
    if abs(mean) > OFFSET_RATIO * peak:
        yield QCFlag("offset", _offset_message(code, mean, peak), code)
    if peak > IMPLAUSIBLE_PGA:
        text = lazy_gettext("{component}: PGA {pga:.4g} m/s^2 exceeds 5 g; check the unit", component=code, pga=peak)
        yield QCFlag("size", text, code)
    starts, ends = _find_flat_runs(a)
    if starts.size:
        yield from _check_flat_runs(code, a, dt, peak, starts, ends)
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
    at_peak = np.isin(a[starts], (a.max(), a.min())) & (np.abs(a[starts]) > 0.5 * peak)
    is_clipped = at_peak & (np.minimum(step_in, step_out) > EDGE_RATIO * peak)
    if is_clipped.any():
        text = lazy_gettext(
            "{component}: {count} flat peak(s) of up to {longest} equal samples (at {times} s): instrument or file clipped",
            component=code,
            count=int(is_clipped.sum()),
            longest=int((ends - starts)[is_clipped].max()) + 1,
            times=_format_times(starts[is_clipped], dt),
        )
        yield QCFlag("clipped", text, code)
    # 7.5 intervals: eight equal samples, with a margin for rounding
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
            "{component}: {count} interval(s) of constant value during shaking (from {times} s, up to {longest:.3g} s): filled gap "
            "or lost samples",
            component=code,
            count=len(holds),
            times=_format_times(starts[holds], dt),
            longest=float((ends - starts)[holds].max()) * dt,
        )
        yield QCFlag("held", text, code)


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
    if record.vertical is None and {first.code, second.code} != {"NS", "EW"}:
        text = lazy_gettext("horizontals {one} and {other} without a vertical component", one=first.code, other=second.code)
        yield QCFlag("directions", text)


def _format_times(indices: IntArray, dt: float) -> str:
    """Return the first few times, s, as text."""
    return ", ".join(f"{i * dt:.2f}" for i in indices[:_MAX_LISTED]) + (", ..." if len(indices) > _MAX_LISTED else "")

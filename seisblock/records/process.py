"""Processing of records: pure functions that add an entry to ``history``."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from seisblock.core import checks
from seisblock.core.arrays import readonly
from seisblock.core.errors import ComponentError, ParameterError, RecordError
from seisblock.core.i18n import Message, lazy_gettext
from seisblock.core.jma_scale import parse_jma_intensity
from seisblock.core.typing import FloatArray
from seisblock.core.units import GAL
from seisblock.records.crop_history import CROP_HISTORY
from seisblock.records.filters import HIGHPASS_ORDER, highpass_samples
from seisblock.records.qc_flags import drop_resolved
from seisblock.records.record import Component, Record
from seisblock.records.rotation import acceleration_at_azimuth, oriented_pair
from seisblock.records.seismic_intensity import jma_intensity, missing_intensity_reason


def demean(record: Record) -> Record:
    """Subtract the mean of each component over the whole record.

    K-NET and KiK-net counts carry an offset of up to tens of gal, which would act as a constant force on a body. NIED defines the header
    maximum on the record minus this mean.

    Parameters
    ----------
    record : Record
        Record; demean before cropping to remove the offset of the whole record.

    Returns
    -------
    Record

    Examples
    --------
    >>> from seisblock.records import demean
    >>> from seisblock.readers import read
    >>> demean(read("synthetic_knet.EW")).history
    ('mean of the whole record removed (NS -13.87, EW 9.134, UD 22.27 gal)',)
    """
    checks.instance(record, Record)
    means = {c.code: float(c.acceleration.mean()) for c in record.components}
    entry = lazy_gettext(
        "mean of the whole record removed ({means} gal)", means=[f"{code} {mean / GAL:.4g}" for code, mean in means.items()]
    )
    return _apply(record, lambda c: readonly(c.acceleration - means[c.code]), entry, doubts=drop_resolved(record.doubts))


def crop(record: Record, start_s: float | None, end_s: float | None) -> Record:
    """Return the samples in a time window; sample times do not change.

    Parameters
    ----------
    record : Record
        Record; ``offset_s`` of the result keeps times relative to the first sample as read.
    start_s, end_s : float or None, s
        Start and end, counted from the record's first sample as read, both included. None keeps the end of the record.

    Returns
    -------
    Record

    Raises
    ------
    RecordError
        If the window lies outside the record or contains fewer than two samples.

    Examples
    --------
    >>> from seisblock.records import crop
    >>> from seisblock.readers import read
    >>> part = crop(read("synthetic_jma.csv"), 20.0, 30.0)
    >>> part.samples, part.offset_s
    (1001, 20.0)
    """
    checks.instance(record, Record)
    record_start, record_end = record.offset_s, record.offset_s + record.duration_s
    start = record_start if start_s is None else checks.finite("the start of the window", start_s, "s", error=RecordError)
    end = record_end if end_s is None else checks.finite("the end of the window", end_s, "s", error=RecordError)
    window = lazy_gettext("window {start:g}:{end:g} s", start=start, end=end)
    if not start < end:
        raise RecordError("{window}: start must be before end (s from the first sample)", window=window)
    # tolerance for window ends on a sample, whose time is rounded
    slack = 1e-6 * record.dt
    if start < record_start - slack or end > record_end + slack:
        source = record.source or lazy_gettext("record")
        raise RecordError(
            "{where}: {window} lies outside the record ({first:g} to {last:g} s)",
            where=source,
            window=window,
            first=record_start,
            last=record_end,
        )
    # 1e-6 of a sample: a window end on a sample includes it in spite of rounding
    begin = int(np.ceil((start - record_start) / record.dt - 1e-6))
    stop = int(np.floor((end - record_start) / record.dt + 1e-6)) + 1
    if stop - begin < 2:
        raise RecordError("{window}: fewer than 2 samples at an interval of {dt:g} s; lengthen the window", window=window, dt=record.dt)
    return _apply(
        record,
        lambda c: c.acceleration[begin:stop],
        lazy_gettext(CROP_HISTORY, window=window),
        offset_s=record.offset_s + begin * record.dt,
    )


def scale(record: Record, factor: float) -> Record:
    """Multiply all components by one factor.

    Parameters
    ----------
    record : Record
    factor : float
        Finite; 1 returns the record unchanged, without a history entry.

    Returns
    -------
    Record

    Raises
    ------
    ParameterError
        If the factor is not a finite number.

    Examples
    --------
    >>> from seisblock.records import scale
    >>> from seisblock.readers import read
    >>> scale(read("synthetic_jma.csv"), 0.5).history
    ('scaled by 0.5',)
    """
    checks.instance(record, Record)
    checks.finite("the scale factor", factor)
    entry = lazy_gettext("scaled by {factor:.10g}", factor=factor)
    return record if factor == 1.0 else _apply(record, lambda c: readonly(c.acceleration * factor), entry)


def scale_to_pga(record: Record, target: float, component: str | Sequence[str] | None = None) -> Record:
    """Scale all components by the factor that gives the largest of the selected components the target peak.

    Parameters
    ----------
    record : Record
        Record; the ratios between components are preserved.
    target : float, m/s^2
        Target peak absolute acceleration, positive.
    component : str or sequence of str, optional
        Codes or azimuths (degrees) that define the peak; by default all horizontals.

    Returns
    -------
    Record

    Raises
    ------
    ParameterError
        If the target is not positive, or the components are zero throughout.
    ComponentError
        If there is no such component.

    Examples
    --------
    >>> from seisblock.records import scale_to_pga
    >>> from seisblock.readers import read
    >>> east = scale_to_pga(read("synthetic_jma.csv"), 4.0, "EW").component("EW")
    >>> round(float(abs(east.acceleration).max()), 12)
    4.0
    """
    checks.instance(record, Record)
    checks.positive("the target PGA", target, "m/s^2")
    candidates: Message | None = lazy_gettext("largest horizontal")
    if component is None:
        selected = largest_horizontal(record)
    else:
        names = (component,) if isinstance(component, str) else tuple(component)
        selected = max((select_component(record, name) for name in names), key=_peak)
        candidates = lazy_gettext("largest of {names}", names=names) if len(names) > 1 else None
    peak = _peak(selected)
    if peak == 0.0:
        raise ParameterError(
            "component {code} is zero throughout and cannot be scaled to {target:g} m/s^2", code=selected.code, target=target
        )
    factor = target / peak
    values = {"factor": factor, "code": selected.code, "peak": peak / GAL, "target": target / GAL}
    if candidates is None:
        entry = lazy_gettext("scaled by {factor:.10g}: PGA of {code} {peak:.5g} -> {target:.5g} gal", **values)
    else:
        entry = lazy_gettext("scaled by {factor:.10g}: PGA of {code} ({among}) {peak:.5g} -> {target:.5g} gal", **values, among=candidates)
    return _apply(record, lambda c: readonly(c.acceleration * factor), entry)


def scale_to_jma(record: Record, target: float) -> Record:
    """Scale all components by the factor that gives the whole record the target JMA intensity.

    The filter of the intensity is linear, so that a factor s adds 2 log10 s to the intensity ([JMA1996]_): the factor is exact.

    Parameters
    ----------
    record : Record
        Record with two horizontals and the vertical.
    target : float, 1
        Instrumental intensity, see :func:`~seisblock.core.jma_scale.parse_jma_intensity`.

    Returns
    -------
    Record

    Raises
    ------
    ParameterError
        If the target is not between 0 and 8, or the record has no intensity: a component is missing, or the motion is too weak.

    Examples
    --------
    >>> from seisblock.records import scale_to_jma
    >>> from seisblock.readers import read
    >>> from seisblock.measures import jma_intensity
    >>> round(jma_intensity(scale_to_jma(read("synthetic_jma.csv"), 5.75)), 9)
    5.75
    """
    checks.instance(record, Record)
    target = parse_jma_intensity(target)
    intensity = jma_intensity(record)
    if intensity is None:
        raise ParameterError(
            "{source}: no JMA intensity to scale to: {reason}",
            source=record.source or lazy_gettext("record"),
            reason=missing_intensity_reason(record),
        )
    factor = 10.0 ** ((target - intensity) / 2.0)
    entry = lazy_gettext("scaled by {factor:.10g}: JMA intensity {own:.3g} -> {target:.3g}", factor=factor, own=intensity, target=target)
    return _apply(record, lambda c: readonly(c.acceleration * factor), entry)


def select_component(record: Record, name: str) -> Component:
    """Return a component by code, or the horizontal component at an azimuth.

    Parameters
    ----------
    record : Record
        Record; a component with the code ``90`` takes precedence over the azimuth 90.
    name : str
        Code in any case, or degrees clockwise from north such as ``37``.

    Raises
    ------
    ComponentError
        If there is no such component; the message lists the available codes.
    """
    if name.upper() in (code.upper() for code in record.codes):
        return record.component(name)
    try:
        azimuth = float(name)
    except ValueError:
        return record.component(name)  # raises with the list of codes
    return component_at_azimuth(record, checks.azimuth(azimuth, error=ComponentError))


def require_horizontals(record: Record) -> tuple[Component, ...]:
    """Return the horizontal components; raise ComponentError if there is none."""
    if not record.horizontals:
        raise ComponentError("{source}: no horizontal component; available: {codes}", source=record.source, codes=record.codes)
    return record.horizontals


def largest_horizontal(record: Record) -> Component:
    """Return the horizontal component with the largest peak acceleration; the first of equals.

    Raises
    ------
    ComponentError
        If the record has no horizontal component.
    """
    return max(require_horizontals(record), key=_peak)


def highpass(record: Record, hz: float) -> Record:
    """High-pass all components with zero phase.

    The line through the ends of the record is removed, which eliminates offset and drift; then a Butterworth filter of order 4 runs
    forwards and backwards (half amplitude at the corner) over mirrored ends, see :func:`seisblock.records.filters.highpass_samples`.

    Parameters
    ----------
    record : Record
    hz : float, Hz
        Corner frequency, between 0 and half the sampling rate.

    Returns
    -------
    Record

    Raises
    ------
    ParameterError
        If the corner lies outside that range, or the padding exceeds its limit.

    Examples
    --------
    >>> from seisblock.records import highpass
    >>> from seisblock.readers import read
    >>> low = highpass(read("synthetic_jma.csv"), 0.1)
    >>> bool(abs(low.component("EW").acceleration.mean()) < 1e-4)
    True
    """
    checks.instance(record, Record)
    text = "high-pass {hz:g} Hz (Butterworth order {order} forwards and backwards, line through the ends removed, mirrored ends)"
    entry = lazy_gettext(text, hz=hz, order=HIGHPASS_ORDER)
    return _apply(record, lambda c: highpass_samples(c.acceleration, record.dt, hz), entry, doubts=drop_resolved(record.doubts))


def component_at_azimuth(record: Record, azimuth_deg: float) -> Component:
    """Return the ground acceleration towards an azimuth as a component named by the azimuth.

    Parameters
    ----------
    record : Record
        Record with two horizontals of known azimuth, not necessarily orthogonal.
    azimuth_deg : float, degrees
        Clockwise from north.

    Returns
    -------
    Component

    Raises
    ------
    ComponentError
        If the record has fewer than two horizontals of known azimuth.

    Examples
    --------
    >>> from seisblock.records import component_at_azimuth
    >>> from seisblock.readers import read
    >>> component_at_azimuth(read("synthetic_jma.csv"), 45.0).azimuth_deg
    45.0
    """
    checks.instance(record, Record)
    if isinstance(azimuth_deg, str) or not np.isfinite(azimuth_deg):
        raise ComponentError("azimuth must be a finite number of degrees, found {found}", found=azimuth_deg)
    return Component(f"{azimuth_deg:g}", acceleration_at_azimuth(oriented_pair(record), azimuth_deg), azimuth_deg % 360.0)


def rotate(record: Record, azimuth_deg: float) -> Record:
    """Rotate the two horizontals to an azimuth and to 90 degrees clockwise of it; the vertical is unchanged.

    Parameters
    ----------
    record : Record
        Record with two horizontals of known azimuth.
    azimuth_deg : float, degrees
        Azimuth of the first new component, clockwise from north; the codes are the azimuths.

    Returns
    -------
    Record

    Raises
    ------
    ComponentError
        If the record has fewer than two horizontals of known azimuth.

    Examples
    --------
    >>> from seisblock.records import rotate
    >>> from seisblock.readers import read
    >>> rotate(read("synthetic_jma.csv"), 30.0).codes
    ('30', '120', 'UD')
    """
    pair = [component_at_azimuth(record, azimuth_deg), component_at_azimuth(record, azimuth_deg + 90.0)]
    vertical = [] if record.vertical is None else [record.vertical]
    return record.with_components(
        [*pair, *vertical], lazy_gettext("horizontals rotated to {one} and {other} degrees", one=pair[0].code, other=pair[1].code)
    )


def _peak(component: Component) -> float:
    return float(np.abs(component.acceleration).max())


def _apply(record: Record, transform: Callable[[Component], FloatArray], entry: str, **changes: object) -> Record:
    """Return the record with transformed samples of each component and a new history entry."""
    return record.with_components([replace(c, acceleration=transform(c)) for c in record.components], entry, **changes)

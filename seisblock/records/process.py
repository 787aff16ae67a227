"""What may be done to a record between reading and solving: pure functions, each of which logs itself in ``history``."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from seisblock.core import checks
from seisblock.core.errors import ComponentError, ParameterError, RecordError
from seisblock.core.i18n import lazy_gettext
from seisblock.core.typing import FloatArray
from seisblock.core.units import GAL
from seisblock.records.crop_history import CROP_HISTORY
from seisblock.records.filters import HIGHPASS_ORDER, highpass_samples
from seisblock.records.qc_flags import drop_resolved
from seisblock.records.record import Component, Record, readonly
from seisblock.records.rotation import acceleration_at_azimuth, oriented_pair


def demean(record: Record) -> Record:
    """Subtract from each component its mean over the whole record held here.

    K-NET and KiK-net counts carry an offset of up to tens of gal, which would push a block for ever; NIED defines its own
    header maximum on the record less this mean.

    Parameters
    ----------
    record : Record
        Any record; cut a window after this, not before, if the offset of the whole is meant.

    Examples
    --------
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
    """Keep the samples of a window; their times do not change.

    Parameters
    ----------
    record : Record
        Its ``offset_s`` moves, so that times go on counting from the first sample as read.
    start_s, end_s : float or None, s
        First and last instant kept, counted from the record's first sample as read; samples on them are kept. None is the
        record's own end.

    Raises
    ------
    RecordError
        If the window lies outside the record or holds fewer than two samples.

    Examples
    --------
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
        raise RecordError("{window}: its start must come before its end, both in s from the first sample", window=window)
    slack = 1e-6 * record.dt
    if start < record_start - slack or end > record_end + slack:
        source = record.source or lazy_gettext("record")
        raise RecordError(
            "{where}: the {window} lies outside the record, which runs from {first:g} to {last:g} s",
            where=source,
            window=window,
            first=record_start,
            last=record_end,
        )
    begin = int(np.ceil((start - record_start) / record.dt - 1e-6))
    stop = int(np.floor((end - record_start) / record.dt + 1e-6)) + 1
    if stop - begin < 2:
        raise RecordError("{window} holds fewer than 2 samples at {dt:g} s: make it longer", window=window, dt=record.dt)
    return _apply(
        record,
        lambda c: c.acceleration[begin:stop],
        lazy_gettext(CROP_HISTORY, window=window),
        offset_s=record.offset_s + begin * record.dt,
    )


def scale(record: Record, factor: float) -> Record:
    """Multiply every component by one factor.

    Parameters
    ----------
    record : Record
    factor : float
        Finite; by 1 nothing is done, and nothing is said to be.

    Raises
    ------
    ParameterError
        If the factor is not a finite number.

    Examples
    --------
    >>> from seisblock.readers import read
    >>> scale(read("synthetic_jma.csv"), 0.5).history
    ('scaled by 0.5',)
    """
    checks.instance(record, Record)
    checks.finite("the scale factor", factor)
    entry = lazy_gettext("scaled by {factor:.10g}", factor=factor)
    return record if factor == 1.0 else _apply(record, lambda c: readonly(c.acceleration * factor), entry)


def scale_to_pga(record: Record, target: float, component: str | Sequence[str] | None = None) -> Record:
    """Multiply every component by the one factor that gives the largest of some components the asked peak.

    Parameters
    ----------
    record : Record
        All components are scaled alike, so that their ratios are kept.
    target : float, m/s^2
        Peak absolute acceleration to reach, positive.
    component : str or sequence of str, optional
        Codes or azimuths (degrees) among which the largest peak shall have it; by default all horizontals.

    Raises
    ------
    ParameterError
        If the target is not positive, or the components are zero throughout.
    ComponentError
        If there is no such component.

    Examples
    --------
    >>> from seisblock.readers import read
    >>> east = scale_to_pga(read("synthetic_jma.csv"), 4.0, "EW").component("EW")
    >>> round(float(abs(east.acceleration).max()), 12)
    4.0
    """
    checks.instance(record, Record)
    checks.positive("the target PGA", target, "m/s^2")
    if component is None:
        selected, candidates = largest_horizontal(record), lazy_gettext("the largest horizontal")
    else:
        names = (component,) if isinstance(component, str) else tuple(component)
        selected, candidates = (
            max((select_component(record, name) for name in names), key=_peak),
            lazy_gettext("the largest of {names}", names=names),
        )
    peak = _peak(selected)
    if peak == 0.0:
        raise ParameterError(
            "component {code} is zero throughout: no factor gives it a peak of {target:g} m/s^2", code=selected.code, target=target
        )
    factor = target / peak
    entry = lazy_gettext(
        "scaled by {factor:.10g}: PGA of {code} ({among}) {peak:.5g} -> {target:.5g} gal",
        factor=factor,
        code=selected.code,
        among=candidates,
        peak=peak / GAL,
        target=target / GAL,
    )
    return _apply(record, lambda c: readonly(c.acceleration * factor), entry)


def select_component(record: Record, name: str) -> Component:
    """Return a component by its code, or the horizontal towards an azimuth.

    Parameters
    ----------
    record : Record
        Codes come first: a record whose component is called ``90`` gives that one.
    name : str
        Code in any case, or degrees clockwise from north such as ``37``.

    Raises
    ------
    ComponentError
        If there is no such component; the message lists those there are.
    """
    if name.upper() in (code.upper() for code in record.codes):
        return record.component(name)
    try:
        azimuth = float(name)
    except ValueError:
        return record.component(name)  # raises, and lists the codes
    return component_at_azimuth(record, checks.azimuth(azimuth, error=ComponentError))


def largest_horizontal(record: Record) -> Component:
    """Return the horizontal component with the largest absolute acceleration; the first when they tie.

    Raises
    ------
    ComponentError
        If the record has no horizontal component.
    """
    if not record.horizontals:
        raise ComponentError(
            "{source}: no horizontal component; it has {codes}", source=record.source or lazy_gettext("record"), codes=record.codes
        )
    return max(record.horizontals, key=_peak)


def highpass(record: Record, hz: float) -> Record:
    """Remove what is slower than a corner frequency, without delay.

    An offset and a drift leave nothing (:func:`seisblock.records.filters.highpass_samples`): the line through the ends of the record is
    taken off, then a Butterworth filter of order 4 is run forwards and backwards (half the amplitude at the corner), with mirrored ends.

    Parameters
    ----------
    record : Record
        Any record.
    hz : float, Hz
        Corner frequency, between 0 and half the sampling rate.

    Raises
    ------
    ParameterError
        If the corner lies outside that range, or so low that it needs more padding than is allowed.

    Examples
    --------
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
    """Return the ground acceleration towards an azimuth as a component named after it.

    Parameters
    ----------
    record : Record
        Needs two horizontals of known azimuth, which need not be orthogonal.
    azimuth_deg : float, degrees
        Clockwise from north.

    Raises
    ------
    ComponentError
        If the record lacks those two.

    Examples
    --------
    >>> from seisblock.readers import read
    >>> component_at_azimuth(read("synthetic_jma.csv"), 45.0).azimuth_deg
    45.0
    """
    checks.instance(record, Record)
    if isinstance(azimuth_deg, str) or not np.isfinite(azimuth_deg):
        raise ComponentError("the azimuth must be a finite number of degrees, found {found}", found=azimuth_deg)
    return Component(f"{azimuth_deg:g}", acceleration_at_azimuth(oriented_pair(record), azimuth_deg), azimuth_deg % 360.0)


def rotate(record: Record, azimuth_deg: float) -> Record:
    """Turn the two horizontals to an azimuth and to 90 degrees clockwise of it; the vertical stays.

    Parameters
    ----------
    record : Record
        Needs two horizontals of known azimuth.
    azimuth_deg : float, degrees
        Azimuth of the first new component, clockwise from north; the codes are the azimuths.

    Raises
    ------
    ComponentError
        If the record lacks those two.

    Examples
    --------
    >>> from seisblock.readers import read
    >>> rotate(read("synthetic_jma.csv"), 30.0).codes
    ('30', '120', 'UD')
    """
    pair = [component_at_azimuth(record, azimuth_deg), component_at_azimuth(record, azimuth_deg + 90.0)]
    vertical = [] if record.vertical is None else [record.vertical]
    return record.with_components(
        [*pair, *vertical], lazy_gettext("horizontals turned to {one} and {other} degrees", one=pair[0].code, other=pair[1].code)
    )


def _peak(component: Component) -> float:
    """Return the peak absolute acceleration of a component, m/s^2."""
    return float(np.abs(component.acceleration).max())


def _apply(record: Record, transform: Callable[[Component], FloatArray], entry: str, **changes: object) -> Record:
    """Return the record with new samples for each component, and what was done in its history."""
    return record.with_components([replace(c, acceleration=transform(c)) for c in record.components], entry, **changes)

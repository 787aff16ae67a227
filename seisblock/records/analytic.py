"""Analytic motions: sine, one full sine, half sine and rectangle of acceleration, exact at the samples.

A name such as ``sine:300gal@1.5Hz,10s`` stands for a record wherever a file does.
"""

from __future__ import annotations

import hashlib
import math
import re
from collections.abc import Callable

import numpy as np

from seisblock.core import checks
from seisblock.core.arrays import readonly
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_
from seisblock.core.limits import MAX_ANALYTIC_SAMPLES, check_limit
from seisblock.core.typing import FloatArray
from seisblock.core.units import ACCELERATION_UNITS, LENGTH_UNITS, VELOCITY_UNITS, parse_quantity, to_halfwidth
from seisblock.records.record import Component, Record

ANALYTIC = "analytic"
"""Format of the record of an analytic motion."""

COMPONENT = "X"
"""Code of its only component."""

SAMPLES_PER_PERIOD = 400
"""Fewest samples per period by default; a multiple of four, so that the peaks of a sine lie on samples."""

MIN_SAMPLES_PER_PERIOD = 20
"""Fewest samples per period that may be requested."""

MAX_INTERVAL_S = 0.01
"""Longest sampling interval by default, s."""


def sine_motion(amplitude: float, frequency: float, duration: float, *, dt: float | None = None, name: str = "") -> Record:
    """Return the record of a sinusoidal acceleration A sin(2 pi f t) that starts at t = 0.

    Parameters
    ----------
    amplitude : float, m/s^2
        Peak acceleration A.
    frequency : float, Hz
    duration : float, s
        Rounded to a multiple of the sampling interval.
    dt : float, optional, s
        Sampling interval; default: a 400th of the period or an integer fraction of it, at most 0.01 s.
    name : str
        Source of the record.

    Returns
    -------
    Record
        With the component X.

    Raises
    ------
    ParameterError
        If a number is not positive, the interval exceeds a 20th of the period, or the record would have too many samples.

    Examples
    --------
    >>> record = sine_motion(3.0, 1.5, 10.0)
    >>> record.samples, round(float(record.components[0].acceleration.max()), 12), record.format
    (6001, 3.0, 'analytic')
    """
    checks.positive("the duration of the motion", duration, "s")
    return _sine(amplitude, frequency, duration, dt, name)


def pulse_motion(amplitude: float, frequency: float, *, dt: float | None = None, name: str = "") -> Record:
    """Return the record of one full sine of acceleration.

    Parameters
    ----------
    amplitude : float, m/s^2
        Peak acceleration.
    frequency : float, Hz
    dt : float, optional, s
        Sampling interval; default: as in :func:`sine_motion`.
    name : str
        Source of the record.

    Returns
    -------
    Record
        With the component X.

    Raises
    ------
    ParameterError
        If a number is not positive, the interval is too long, or the record would have too many samples.

    Examples
    --------
    >>> round(pulse_motion(3.0, 1.5).duration_s, 12)
    0.666666666667
    """
    return _sine(amplitude, frequency, None, dt, name, periods=1.0)


def half_sine_motion(amplitude: float, frequency: float, *, dt: float | None = None, name: str = "") -> Record:
    """Return the record of half a sine of acceleration of the given frequency.

    Parameters
    ----------
    amplitude : float, m/s^2
        Peak acceleration.
    frequency : float, Hz
    dt : float, optional, s
        Sampling interval; default: as in :func:`sine_motion`.
    name : str
        Source of the record.

    Returns
    -------
    Record
        With the component X.

    Raises
    ------
    ParameterError
        If a number is not positive, the interval is too long, or the record would have too many samples.

    Examples
    --------
    >>> round(half_sine_motion(3.0, 1.5).duration_s, 12)
    0.333333333333
    """
    return _sine(amplitude, frequency, None, dt, name, periods=0.5)


def rectangle_motion(amplitude: float, duration: float, *, dt: float | None = None, name: str = "") -> Record:
    """Return the record of a constant acceleration.

    Parameters
    ----------
    amplitude : float, m/s^2
        Peak acceleration.
    duration : float, s
    dt : float, optional, s
        Sampling interval; default: as in :func:`sine_motion`.
    name : str
        Source of the record.

    Returns
    -------
    Record
        With the component X.

    Raises
    ------
    ParameterError
        If a number is not positive, the interval is too long, or the record would have too many samples.

    Examples
    --------
    >>> record = rectangle_motion(3.0, 0.5)
    >>> record.samples, record.components[0].acceleration[[0, -1]].tolist()
    (401, [3.0, 3.0])
    """
    checks.positive("the amplitude of the motion", amplitude)
    checks.positive("the duration of the motion", duration, "s")
    intervals = _intervals(duration, duration, dt)
    return _record(np.full(intervals + 1, float(amplitude)), duration / intervals if dt is None else dt, name)


def _sine(amplitude: float, frequency: float, duration: float | None, dt: float | None, name: str, *, periods: float = 0.0) -> Record:
    """Return the record of a sine of a duration, s, or of a number of periods."""
    checks.positive("the amplitude of the motion", amplitude)
    checks.positive("the frequency of the motion", frequency, "Hz")
    period = 1.0 / frequency
    length = periods * period if duration is None else duration
    intervals = _intervals(length, period, dt)
    interval = period / _samples_per_period(period) if dt is None else dt
    # the phase of a default sample is a multiple of a fraction of the period: no round-off grows with time
    phase = 2.0 * math.pi * frequency * interval * np.arange(intervals + 1)
    return _record(amplitude * np.sin(phase), interval, name)


def _samples_per_period(period: float) -> int:
    """Return the default number of samples per period."""
    return SAMPLES_PER_PERIOD * max(1, math.ceil(period / (SAMPLES_PER_PERIOD * MAX_INTERVAL_S)))


def _intervals(duration: float, period: float, dt: float | None) -> int:
    """Return the number of sampling intervals, at least one."""
    if dt is not None:
        checks.positive("the sampling interval", dt, "s")
        if dt * MIN_SAMPLES_PER_PERIOD > period * (1.0 + 1e-9):
            raise ParameterError(
                "a sampling interval of {dt:g} s is too long for an analytic motion of {period:g} s per period: give at most {most:g} s",
                dt=dt,
                period=period,
                most=period / MIN_SAMPLES_PER_PERIOD,
            )
    count = duration / (period / _samples_per_period(period) if dt is None else dt)
    check_limit(N_("samples of an analytic motion"), int(min(count, 1e15)) + 1, MAX_ANALYTIC_SAMPLES)
    return max(1, round(count))


def _record(acceleration: FloatArray, dt: float, name: str) -> Record:
    """Return the record of an acceleration."""
    digest = hashlib.sha256(name.encode() if name else acceleration.tobytes()).hexdigest()
    return Record((Component(COMPONENT, readonly(acceleration)),), dt, source=name, sha256=digest, format=ANALYTIC)


FORMS = {
    "sine": "sine:300gal@1.5Hz,10s",
    "pulse": "pulse:300gal@1.5Hz",
    "halfsine": "halfsine:300gal@1.5Hz",
    "rectangle": "rectangle:300gal@0.5s",
}
"""Example of each shape."""


def is_analytic(name: object) -> bool:
    """Return whether a name is that of an analytic motion.

    Examples
    --------
    >>> is_analytic("sine:300gal@1.5Hz,10s"), is_analytic("sine.csv"), is_analytic("c:sine")
    (True, False, False)
    """
    return isinstance(name, str) and ":" in name and to_halfwidth(name).partition(":")[0].strip().lower() in FORMS


def analytic_record(name: str) -> Record:
    """Return the record of an analytic motion given by its name.

    The amplitude has a unit: an acceleration, a velocity or a displacement; the latter two are amplitudes of the sine, divided by the
    circular frequency once and twice.

    Parameters
    ----------
    name : str
        ``sine:AMPLITUDE@FREQUENCY,DURATION``, ``pulse:`` or ``halfsine:AMPLITUDE@FREQUENCY``, ``rectangle:AMPLITUDE@DURATION``; after
        these an optional ``dt=INTERVAL``.

    Raises
    ------
    ParameterError, UnitError
        If the name is incomplete, or a number has no unit, is not positive, or asks for too many samples.

    Examples
    --------
    >>> record = analytic_record("sine:60cm@0.318Hz,20s")
    >>> round(float(record.components[0].acceleration.max()), 4), record.source
    (2.3953, 'sine:60cm@0.318Hz,20s')
    """
    text = to_halfwidth(name)
    shape, _, rest = text.partition(":")
    shape = shape.strip().lower()
    amplitude_text, at, arguments = rest.partition("@")
    terms = [term.strip() for term in arguments.split(",")]
    options = [term for term in terms if "=" in term]
    values = [term for term in terms if "=" not in term]
    if not at or len(values) != (2 if shape == "sine" else 1) or len(options) > 1:
        raise ParameterError("incomplete analytic motion {name!r}: write, for example, {example}", name=name, example=FORMS[shape])
    dt = _interval(name, options[0]) if options else None
    if shape == "rectangle":
        return rectangle_motion(
            _quantity(name, amplitude_text, ACCELERATION_UNITS, "gal"), _quantity(name, values[0], {"s": 1.0}, "s"), dt=dt, name=name
        )
    frequency = _quantity(name, re.sub("hz$", "Hz", values[0], flags=re.IGNORECASE), {"Hz": 1.0}, "Hz")
    omega = 2.0 * math.pi * frequency
    units = {
        **ACCELERATION_UNITS,
        **{unit: omega * size for unit, size in VELOCITY_UNITS.items()},
        **{unit: omega * omega * size for unit, size in LENGTH_UNITS.items()},
    }
    amplitude = _quantity(name, amplitude_text, units, "gal")
    if shape == "sine":
        return sine_motion(amplitude, frequency, _quantity(name, values[1], {"s": 1.0}, "s"), dt=dt, name=name)
    make: Callable[..., Record] = pulse_motion if shape == "pulse" else half_sine_motion
    return make(amplitude, frequency, dt=dt, name=name)


def _interval(name: str, text: str) -> float:
    """Return the value of ``dt=``."""
    key, _, value = text.partition("=")
    if key.strip().lower() != "dt":
        raise ParameterError("{name}: unknown key {key!r} of an analytic motion; the only key is dt=", name=name, key=key.strip())
    return _quantity(name, value, {"s": 1.0, "ms": 1e-3}, "s", required=False)


def _quantity(name: str, text: str, units: dict[str, float], example: str, *, required: bool = True) -> float:
    """Return a number with its unit in SI."""
    if not re.match(r"\s*[-+]?[\d.]", text):
        shape = name.partition(":")[0].strip().lower()
        raise ParameterError("incomplete analytic motion {name!r}: write, for example, {example}", name=name, example=FORMS[shape])
    value, has_unit = parse_quantity(text, units, quantity=name)
    if required and not has_unit:
        raise ParameterError("{name}: {text!r} has no unit: write, for example, {text}{unit}", name=name, text=text.strip(), unit=example)
    return value


__all__ = ["analytic_record", "half_sine_motion", "is_analytic", "pulse_motion", "rectangle_motion", "sine_motion"]

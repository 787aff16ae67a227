"""Floor motion of a building modelled as one linear oscillator."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_, Message, lazy_gettext
from seisblock.core.limits import check_memory
from seisblock.core.typing import FloatArray
from seisblock.records.oscillator import oscillator_path
from seisblock.records.record import Component, Record

DAMPING = 0.05
"""Default damping ratio of a building."""

PARTICIPATION_FACTOR = 1.5
"""Participation factor of the fundamental mode at roof level for uniform mass and a linear mode shape."""

RINGDOWN_RATIO = 1e-3
"""The free vibration after the record is computed until its acceleration falls to this ratio of the oscillator's peak."""

POINTS_PER_PERIOD = 20
"""Minimum number of samples per floor period: the error of linear interpolation is then (2 pi/20)^2/8, 1.2 % of the amplitude."""

EXAMPLE = "T=0.6,zeta=0.05,height=0.8"
_PARAMETERS = {"t": "period_s", "zeta": "damping", "height": "height"}


@dataclass(frozen=True, repr=False)
class Storey(DisplayMixin):
    """Floor of a building modelled as one linear oscillator on the ground.

    Parameters
    ----------
    period_s : float, s
        Undamped natural period of the building's fundamental mode.
    damping : float, 1
        Damping ratio, between 0 and 1.
    height : float or None, 1
        Height of the floor as a ratio of the building height, above 0 up to 1; None for the mass of the oscillator, which corresponds to
        two thirds of the height for uniform mass and a linear mode shape.

    Raises
    ------
    ParameterError
        If a number lies outside its range.

    Notes
    -----
    u'' + 2 zeta w u' + w^2 u = -a_g from rest gives the absolute acceleration a = -(2 zeta w u' + w^2 u) of the oscillator, exact for a
    piecewise linear ground acceleration ([NigamJennings1969]_ eq. (2.7)). For a linear fundamental mode phi = z/H and uniform mass m the
    participation factor is Gamma = int m phi dz / int m phi^2 dz = 3/2 ([Chopra2012]_ section 13.1), and the absolute acceleration of a
    floor at height z is

        a_g + (3/2) (z/H) (a - a_g) .

    Higher modes and yielding are neglected: real floors near the ground respond more at short periods, and a yielding building transmits
    less.

    Examples
    --------
    >>> Storey(0.6).share, Storey(0.6, height=1.0).share
    (1.0, 1.5)
    """

    period_s: float
    damping: float = DAMPING
    height: float | None = None

    def __post_init__(self) -> None:
        checks.positive("the period of the building", self.period_s, "s")
        checks.in_interval("the damping ratio of the building", self.damping, "(0, 1)")
        if self.height is not None:
            checks.in_interval("the height ratio of the floor", self.height, "(0, 1]")

    @property
    def share(self) -> float:
        """Ratio of the floor's to the oscillator's motion relative to the ground ([Chopra2012]_ section 13.1)."""
        return 1.0 if self.height is None else PARTICIPATION_FACTOR * self.height

    @property
    def spec(self) -> str:
        """Text form accepted by :func:`parse_storey`: ``T=0.6,zeta=0.05``."""
        return f"T={self.period_s:g},zeta={self.damping:g}" + ("" if self.height is None else f",height={self.height:g}")

    @property
    def omega(self) -> float:
        """Undamped natural frequency, rad/s."""
        return 2.0 * math.pi / self.period_s


def parse_storey(text: str) -> Storey:
    """Return the storey described by text such as ``T=0.6,zeta=0.05,height=0.8``.

    Raises
    ------
    ParameterError
        If the text has another form, or a number lies outside its range.

    Examples
    --------
    >>> parse_storey("T=0.6,height=1")
    Storey(period_s=0.6, damping=0.05, height=1.0)
    """
    parameters: dict[str, float] = {}
    for part in text.split(","):
        name, _, value = part.partition("=")
        key = _PARAMETERS.get(name.strip().lower())
        try:
            if key is None or key in parameters:
                raise ValueError(name)
            parameters[key] = float(value)
        except ValueError:
            raise _parse_error(text) from None
    if "period_s" not in parameters:
        raise _parse_error(text)
    return Storey(**parameters)


def _parse_error(text: str) -> ParameterError:
    return ParameterError(
        "invalid floor {text!r}: expected the period T in s and optionally the damping ratio zeta and the height ratio, for "
        "example {example}",
        text=text[:60],
        example=EXAMPLE,
    )


def floor_motion(record: Record, storey: Storey) -> Record:
    """Return the absolute acceleration of a floor for a ground-motion record.

    Each horizontal component drives its own oscillator with the same properties, so that rotation to an azimuth commutes with the
    response. The vertical component is unchanged. The ground is at rest before and after the record; free vibration is appended until the
    acceleration has decayed to a thousandth of its peak. Where the record is coarse for the period, samples are inserted by linear
    interpolation, at least 20 per period.

    Parameters
    ----------
    record : Record
        Ground motion.
    storey : Storey

    Returns
    -------
    Record
        With free vibration appended and, where needed, a shorter sampling interval.

    Raises
    ------
    ParameterError
        If free vibration and inserted samples exceed the limit on the number of samples.

    Examples
    --------
    >>> from seisblock.records import Storey, floor_motion
    >>> from seisblock.readers import read
    >>> floor = floor_motion(read("elcentro_1940_ns.csv"), Storey(0.6))
    >>> floor.dt, round(float(abs(floor.horizontals[0].acceleration).max()), 2)
    (0.02, 7.52)
    """
    checks.instance(record, Record)
    checks.instance(storey, Storey)
    # 1e-9: a ratio that is whole up to rounding needs no further subdivision
    subdivisions = max(1, math.ceil(POINTS_PER_PERIOD * record.dt / storey.period_s - 1e-9))
    dt = record.dt / subdivisions
    items = N_("samples of floor motion")
    # checked before allocation, and again with the free vibration
    check_memory(items, (record.samples - 1) * subdivisions * len(record.components), 8)
    rows = [_interpolate(component.acceleration, subdivisions) for component in record.components]
    n_ringdown = max(
        (_ringdown_samples(row, dt, storey) for row, c in zip(rows, record.components, strict=True) if not c.is_vertical), default=0
    )
    check_memory(items, (rows[0].size + n_ringdown) * len(rows), 8)
    components = [
        replace(component, acceleration=_floor_acceleration(component, np.concatenate((row, np.zeros(n_ringdown))), dt, storey))
        for component, row in zip(record.components, rows, strict=True)
    ]
    return record.with_components(components, _history_entry(storey, subdivisions, n_ringdown * dt), dt=dt)


def _interpolate(row: FloatArray, subdivisions: int) -> FloatArray:
    """Return samples with each interval linearly subdivided into `subdivisions` parts."""
    if subdivisions == 1:
        return row
    return np.interp(np.arange((row.size - 1) * subdivisions + 1) / subdivisions, np.arange(row.size), row)


def _floor_acceleration(component: Component, ground: FloatArray, dt: float, storey: Storey) -> FloatArray:
    """Return the absolute floor acceleration along a component, (n,), m/s^2."""
    if component.is_vertical:
        return ground
    absolute = _absolute_acceleration(oscillator_path(ground, dt, storey.omega, storey.damping), storey)
    # share 1: return the oscillator's own acceleration without the rounding of the sum below
    # relative motion of the floor over that of the oscillator, added to the motion of the ground
    return absolute if storey.share == 1.0 else ground + storey.share * (absolute - ground)


def _absolute_acceleration(path: Sequence[FloatArray], storey: Storey) -> FloatArray:
    """Return the absolute acceleration of an oscillator from its displacement and velocity, m/s^2."""
    u, v = path
    return -(2.0 * storey.damping * storey.omega * v + storey.omega**2 * u)


def _ringdown_samples(ground: FloatArray, dt: float, storey: Storey) -> int:
    """Return the number of samples of free vibration until its acceleration is RINGDOWN_RATIO of the peak."""
    u, v = path = oscillator_path(ground, dt, storey.omega, storey.damping)
    largest = float(np.abs(_absolute_acceleration(path, storey)).max())
    decay = storey.damping * storey.omega
    # free vibration Re(C exp(s t)) has the acceleration Re(s^2 C exp(s t)), and |s| is the natural frequency
    damped_omega = storey.omega * math.sqrt(1.0 - storey.damping**2)
    final = storey.omega**2 * math.hypot(float(u[-1]), (float(v[-1]) + decay * float(u[-1])) / damped_omega)
    if final <= RINGDOWN_RATIO * largest or final == 0.0:
        return 0
    # exponential decay with rate zeta*omega from the state at the end of the record
    return math.ceil(math.log(final / (RINGDOWN_RATIO * max(largest, final))) / (decay * dt))


FLOOR_MOTION_HISTORY = N_(
    "floor motion T {period:g} s, damping {damping:g}{height} (absolute acceleration of a linear oscillator from rest{model}; {kept})"
)
"""Template of the history entry written by :func:`floor_motion`."""


def is_floor_motion(record: Record) -> bool:
    """Return whether a record is a floor motion.

    Examples
    --------
    >>> from seisblock.readers import read
    >>> record = read("synthetic_jma.csv")
    >>> is_floor_motion(record), is_floor_motion(floor_motion(record, Storey(0.6)))
    (False, True)
    """
    return any(isinstance(entry, Message) and entry.template == FLOOR_MOTION_HISTORY for entry in record.history)


def _history_entry(storey: Storey, subdivisions: int, ringdown_s: float) -> str:
    if subdivisions > 1:
        details = lazy_gettext(
            "vertical unchanged; {count} sub-intervals per sample, {after:.4g} s of free vibration appended",
            count=subdivisions,
            after=ringdown_s,
        )
    else:
        details = lazy_gettext("vertical unchanged; {after:.4g} s of free vibration appended", after=ringdown_s)
    has_height = storey.height is not None
    return lazy_gettext(
        FLOOR_MOTION_HISTORY,
        period=storey.period_s,
        damping=storey.damping,
        height=lazy_gettext(", height ratio {height:g}", height=storey.height) if has_height else "",
        model=lazy_gettext(", linear mode shape, uniform mass: {share:g} times the relative acceleration", share=storey.share)
        if has_height
        else "",
        kept=details,
    )

"""A storey of a building that swings as one linear oscillator: what stands on it feels the storey's motion, not the ground's."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from seisblock.core import checks
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_, Message, lazy_gettext
from seisblock.core.limits import check_limit
from seisblock.core.typing import FloatArray
from seisblock.records.oscillator import oscillator_path
from seisblock.records.record import Component, Record

DAMPING = 0.05
"""Of a building, a ratio to critical, unless another is given."""

PARTICIPATION_FACTOR = 1.5
"""How much of the ground's motion the fundamental mode takes up at the top: of even mass, in a straight line."""

RINGDOWN_RATIO = 1e-3
"""The swing after the record is followed until it is this share of the largest acceleration of the oscillator."""

POINTS_PER_PERIOD = 20
"""Least samples per period of the storey: straight lines between them are then right to (2 pi/20)^2/8, 1.2 % of a swing."""

EXAMPLE = "T=0.6,zeta=0.05,height=0.8"
_PARAMETERS = {"t": "period_s", "zeta": "damping", "height": "height"}


@dataclass(frozen=True)
class Storey:
    """A storey, as one linear oscillator under the building's ground.

    Parameters
    ----------
    period_s : float, s
        Undamped natural period of the building's fundamental mode.
    damping : float, 1
        Ratio to critical, between 0 and 1.
    height : float or None, 1
        Where the storey lies, a share of the building's height, above 0 up to 1; None for the oscillator's own mass, which is where a
        building of even mass and of a mode in a straight line has it, at two thirds.

    Raises
    ------
    ParameterError
        If a number lies outside its range.

    Notes
    -----
    u'' + 2 zeta w u' + w^2 u = -a_g from rest gives the oscillator the absolute acceleration a = -(2 zeta w u' + w^2 u), exactly for a
    ground that is a straight line from sample to sample ([NigamJennings1969]_ eq. (2.7)). A building whose fundamental mode is a straight
    line phi = z/H and whose mass m is even takes up Gamma = int m phi dz / int m phi^2 dz = 3/2 of the ground's motion in it
    ([Chopra2012]_ section 13.1: the participation factor), so that a storey at z feels

        a_g + (3/2) (z/H) (a - a_g) .

    Higher modes and yielding are left out: real storeys near the ground feel more of the ground's short periods, and a building that yields
    passes on less.

    Examples
    --------
    >>> Storey(0.6).share, Storey(0.6, height=1.0).share
    (1.0, 1.5)
    """

    period_s: float
    damping: float = DAMPING
    height: float | None = None

    def __post_init__(self) -> None:
        checks.positive("the period of the storey", self.period_s, "s")
        checks.in_interval("the damping of the storey", self.damping, "(0, 1)")
        if self.height is not None:
            checks.in_interval("the height of the storey, a share of the building's,", self.height, "(0, 1]")

    @property
    def share(self) -> float:
        """How much of the oscillator's motion relative to the ground the storey has ([Chopra2012]_ section 13.1)."""
        return 1.0 if self.height is None else PARTICIPATION_FACTOR * self.height

    @property
    def spec(self) -> str:
        """As :func:`parse_storey` reads it: ``T=0.6,zeta=0.05``."""
        return f"T={self.period_s:g},zeta={self.damping:g}" + ("" if self.height is None else f",height={self.height:g}")

    @property
    def omega(self) -> float:
        """Undamped natural frequency, rad/s."""
        return 2.0 * math.pi / self.period_s


def parse_storey(text: str) -> Storey:
    """Return the storey that a text such as ``T=0.6,zeta=0.05,height=0.8`` describes: period in s, damping and height as shares.

    Raises
    ------
    ParameterError
        If it says something else, or a number lies outside its range.

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
    """Return the refusal of a text that describes no storey."""
    return ParameterError(
        "{text!r} is no storey: expected its period T in s and, if need be, its damping zeta and its height, such as {example}",
        text=text[:60],
        example=EXAMPLE,
    )


def floor_motion(record: Record, storey: Storey) -> Record:
    """Return what a storey does while the ground moves as a record says: absolute accelerations of its horizontal components.

    Each horizontal component drives an oscillator of its own, alike in all directions, so that turning to an azimuth afterwards or
    before is the same. The vertical component passes as it is. The ground is still before and after the record, and the storey swings on:
    samples are added until its swing is a thousandth of its peak. Where the record is coarse against the period, samples are put in
    between, on the straight lines of the ground, 20 to a period.

    Parameters
    ----------
    record : Record
        Of the ground.
    storey : Storey

    Raises
    ------
    ParameterError
        If the swing lasts so long, or asks for so many samples in between, that there would be more than may be kept.

    Examples
    --------
    >>> from seisblock.readers import read
    >>> floor = floor_motion(read("elcentro_1940_ns.csv"), Storey(0.6))
    >>> floor.dt, round(float(abs(floor.horizontals[0].acceleration).max()), 2)
    (0.02, 7.52)
    """
    checks.instance(record, Record)
    checks.instance(storey, Storey)
    subdivisions = max(1, math.ceil(POINTS_PER_PERIOD * record.dt / storey.period_s - 1e-9))
    dt = record.dt / subdivisions
    items = N_("samples of a storey's motion")
    check_limit(items, (record.samples - 1) * subdivisions * len(record.components), "SEISBLOCK_READ_SAMPLES")
    rows = [_interpolate(component.acceleration, subdivisions) for component in record.components]
    n_ringdown = max(
        (_ringdown_samples(row, dt, storey) for row, c in zip(rows, record.components, strict=True) if not c.is_vertical), default=0
    )
    check_limit(items, (rows[0].size + n_ringdown) * len(rows), "SEISBLOCK_READ_SAMPLES")
    components = [
        replace(component, acceleration=_floor_acceleration(component, np.concatenate((row, np.zeros(n_ringdown))), dt, storey))
        for component, row in zip(record.components, rows, strict=True)
    ]
    return record.with_components(components, _history_entry(storey, subdivisions, n_ringdown * dt), dt=dt)


def _interpolate(row: FloatArray, subdivisions: int) -> FloatArray:
    """Return samples with others on the straight lines between them, so that each interval has so many parts."""
    if subdivisions == 1:
        return row
    return np.interp(np.arange((row.size - 1) * subdivisions + 1) / subdivisions, np.arange(row.size), row)


def _floor_acceleration(component: Component, ground: FloatArray, dt: float, storey: Storey) -> FloatArray:
    """Return the absolute acceleration of the storey along a component, (n,), m/s^2."""
    if component.is_vertical:
        return ground
    absolute = _absolute_acceleration(oscillator_path(ground, dt, storey.omega, storey.damping), storey)
    # of the oscillator itself as it is, bit by bit
    return absolute if storey.share == 1.0 else ground + storey.share * (absolute - ground)


def _absolute_acceleration(path: Sequence[FloatArray], storey: Storey) -> FloatArray:
    """Return the absolute acceleration of an oscillator from its displacement and velocity, m/s^2."""
    u, v = path
    return -(2.0 * storey.damping * storey.omega * v + storey.omega**2 * u)


def _ringdown_samples(ground: FloatArray, dt: float, storey: Storey) -> int:
    """Return how many samples the oscillator swings on until its acceleration is a thousandth of its peak."""
    u, v = path = oscillator_path(ground, dt, storey.omega, storey.damping)
    largest = float(np.abs(_absolute_acceleration(path, storey)).max())
    decay = storey.damping * storey.omega
    # the free swing is Re(C exp(s t)); its acceleration s^2 C exp(s t), and |s| is the natural frequency
    damped_omega = storey.omega * math.sqrt(1.0 - storey.damping**2)
    final = storey.omega**2 * math.hypot(float(u[-1]), (float(v[-1]) + decay * float(u[-1])) / damped_omega)
    if final <= RINGDOWN_RATIO * largest or final == 0.0:
        return 0
    return math.ceil(math.log(final / (RINGDOWN_RATIO * max(largest, final))) / (decay * dt))


FLOOR_MOTION_HISTORY = N_(
    "floor motion T {period:g} s, damping {damping:g}{height} (absolute acceleration of a linear oscillator from rest{model}; {kept})"
)
"""What is said of a record that is the motion of a storey."""


def is_floor_motion(record: Record) -> bool:
    """Return whether a record is the motion of a storey, not of the ground.

    Examples
    --------
    >>> from seisblock.readers import read
    >>> record = read("synthetic_jma.csv")
    >>> is_floor_motion(record), is_floor_motion(floor_motion(record, Storey(0.6)))
    (False, True)
    """
    return any(isinstance(entry, Message) and entry.template == FLOOR_MOTION_HISTORY for entry in record.history)


def _history_entry(storey: Storey, subdivisions: int, ringdown_s: float) -> str:
    """Return the line of the history."""
    if subdivisions > 1:
        details = lazy_gettext(
            "vertical as it was; {count} samples for each, and {after:.4g} s more of free swing", count=subdivisions, after=ringdown_s
        )
    else:
        details = lazy_gettext("vertical as it was; {after:.4g} s more of free swing", after=ringdown_s)
    has_height = storey.height is not None
    return lazy_gettext(
        FLOOR_MOTION_HISTORY,
        period=storey.period_s,
        damping=storey.damping,
        height=lazy_gettext(", height {height:g}", height=storey.height) if has_height else "",
        model=lazy_gettext(", mode in a straight line, even mass: {share:g} of it relative to the ground", share=storey.share)
        if has_height
        else "",
        kept=details,
    )

"""A storey of a building that swings as one linear oscillator: what stands on it feels the storey's motion, not the ground's."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from seisblock import checks
from seisblock.errors import ParameterError
from seisblock.limits import check_budget
from seisblock.records.oscillator import oscillator_path
from seisblock.records.record import Component, Record
from seisblock.typing import FloatArray
from seisblock.words import Said, noted, said

DAMPING = 0.05
"""Of a building, a ratio to critical, unless another is given."""

PARTICIPATION = 1.5
"""How much of the ground's motion the fundamental mode takes up at the top: of even mass, in a straight line."""

DIED = 1e-3
"""The swing after the record is followed until it is this share of the largest acceleration of the oscillator."""

POINTS_PER_PERIOD = 20
"""Least samples per period of the storey: straight lines between them are then right to (2 pi/20)^2/8, 1.2 % of a swing."""

EXAMPLE = "T=0.6,zeta=0.05,height=0.8"
_NAMES = {"t": "period_s", "zeta": "damping", "height": "height"}


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
        checks.within("the damping of the storey", self.damping, "(0, 1)")
        if self.height is not None:
            checks.within("the height of the storey, a share of the building's,", self.height, "(0, 1]")

    @property
    def share(self) -> float:
        """How much of the oscillator's motion relative to the ground the storey has ([Chopra2012]_ section 13.1)."""
        return 1.0 if self.height is None else PARTICIPATION * self.height

    @property
    def written(self) -> str:
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
    told: dict[str, float] = {}
    for part in text.split(","):
        name, _, value = part.partition("=")
        key = _NAMES.get(name.strip().lower())
        try:
            if key is None or key in told:
                raise ValueError(name)
            told[key] = float(value)
        except ValueError:
            raise _misread(text) from None
    if "period_s" not in told:
        raise _misread(text)
    return Storey(**told)


def _misread(text: str) -> ParameterError:
    """Return the refusal of a text that describes no storey."""
    return ParameterError(
        "{text!r} is no storey: expected its period T in s and, if need be, its damping zeta and its height, such as {example}",
        text=text[:60],
        example=EXAMPLE,
    )


def on_storey(record: Record, storey: Storey) -> Record:
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
    >>> floor = on_storey(read("elcentro_1940_ns.csv"), Storey(0.6))
    >>> floor.dt, round(float(abs(floor.horizontals[0].acceleration).max()), 2)
    (0.02, 7.52)
    """
    checks.instance(record, Record)
    checks.instance(storey, Storey)
    parts = max(1, math.ceil(POINTS_PER_PERIOD * record.dt / storey.period_s - 1e-9))
    dt = record.dt / parts
    many = noted("samples of a storey's motion")
    check_budget(many, (record.samples - 1) * parts * len(record.components), "SEISBLOCK_READ_SAMPLES")
    between = [_between(component.acceleration, parts) for component in record.components]
    after = max((_swing(row, dt, storey) for row, c in zip(between, record.components, strict=True) if not c.is_vertical), default=0)
    check_budget(many, (between[0].size + after) * len(between), "SEISBLOCK_READ_SAMPLES")
    moved = [
        replace(component, acceleration=_felt(component, np.concatenate((row, np.zeros(after))), dt, storey))
        for component, row in zip(record.components, between, strict=True)
    ]
    return record.with_components(moved, _did(storey, parts, after * dt), dt=dt)


def _between(row: FloatArray, parts: int) -> FloatArray:
    """Return samples with others on the straight lines between them, so that each interval has so many parts."""
    if parts == 1:
        return row
    return np.interp(np.arange((row.size - 1) * parts + 1) / parts, np.arange(row.size), row)


def _felt(component: Component, ground: FloatArray, dt: float, storey: Storey) -> FloatArray:
    """Return the absolute acceleration of the storey along a component, (n,), m/s^2."""
    if component.is_vertical:
        return ground
    absolute = _absolute(oscillator_path(ground, dt, storey.omega, storey.damping), storey)
    # of the oscillator itself as it is, bit by bit
    return absolute if storey.share == 1.0 else ground + storey.share * (absolute - ground)


def _absolute(path: Sequence[FloatArray], storey: Storey) -> FloatArray:
    """Return the absolute acceleration of an oscillator from its displacement and velocity, m/s^2."""
    u, v = path
    return -(2.0 * storey.damping * storey.omega * v + storey.omega**2 * u)


def _swing(ground: FloatArray, dt: float, storey: Storey) -> int:
    """Return how many samples the oscillator swings on until its acceleration is a thousandth of its peak."""
    u, v = path = oscillator_path(ground, dt, storey.omega, storey.damping)
    largest = float(np.abs(_absolute(path, storey)).max())
    decay = storey.damping * storey.omega
    # the free swing is Re(C exp(s t)); its acceleration s^2 C exp(s t), and |s| is the natural frequency
    swing = storey.omega * math.sqrt(1.0 - storey.damping**2)
    left = storey.omega**2 * math.hypot(float(u[-1]), (float(v[-1]) + decay * float(u[-1])) / swing)
    if left <= DIED * largest or left == 0.0:
        return 0
    return math.ceil(math.log(left / (DIED * max(largest, left))) / (decay * dt))


DID = noted(
    "floor motion T {period:g} s, damping {damping:g}{height} (absolute acceleration of a linear oscillator from rest{model}; {kept})"
)
"""What is said of a record that is the motion of a storey."""


def was_upstairs(record: Record) -> bool:
    """Return whether a record is the motion of a storey, not of the ground.

    Examples
    --------
    >>> from seisblock.readers import read
    >>> record = read("synthetic_jma.csv")
    >>> was_upstairs(record), was_upstairs(on_storey(record, Storey(0.6)))
    (False, True)
    """
    return any(isinstance(did, Said) and did.template == DID for did in record.history)


def _did(storey: Storey, parts: int, after: float) -> str:
    """Return the line of the history."""
    if parts > 1:
        kept = said("vertical as it was; {count} samples for each, and {after:.4g} s more of free swing", count=parts, after=after)
    else:
        kept = said("vertical as it was; {after:.4g} s more of free swing", after=after)
    high = storey.height is not None
    return said(
        DID,
        period=storey.period_s,
        damping=storey.damping,
        height=said(", height {height:g}", height=storey.height) if high else "",
        model=said(", mode in a straight line, even mass: {share:g} of it relative to the ground", share=storey.share) if high else "",
        kept=kept,
    )

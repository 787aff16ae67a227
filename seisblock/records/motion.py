"""The input of a solver: ground acceleration along, across and up, on one clock."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seisblock import checks
from seisblock.errors import ComponentError, ParameterError
from seisblock.records.record import Component, Record, frozen
from seisblock.showing import Drawn
from seisblock.typing import ArrayLike, FloatArray
from seisblock.words import said

ALONG, ACROSS, UP = range(3)


@dataclass(frozen=True, eq=False)
class Motion(Drawn):
    """Ground acceleration that a body feels, piecewise linear between samples.

    Parameters
    ----------
    acceleration : (3, n) array, m/s^2
        Rows: along +x, across (+y, 90 degrees counter-clockwise of x seen from above), up (+z). Kept read-only.
    dt : float, s
        Sampling interval.
    name : str
        Which direction of the record +x is (``EW``, ``37`` for an azimuth...).
    start_s : float, s
        Time of the first sample, counted from the record's first sample as read.
    record : Record or None
        Where it comes from.
    """

    acceleration: FloatArray
    dt: float
    name: str = ""
    start_s: float = 0.0
    record: Record | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "acceleration", frozen(self.acceleration))
        if self.acceleration.ndim != 2 or self.acceleration.shape[0] != 3:
            raise ParameterError("a motion has three rows (along, across, up), found shape {shape}", shape=str(self.acceleration.shape))
        if self.acceleration.shape[1] < 2:
            raise ParameterError("a motion needs at least 2 samples, found {count}", count=self.acceleration.shape[1])
        checks.positive("the sampling interval", self.dt, "s")
        if not np.isfinite(self.acceleration).all():
            raise ParameterError("a motion must hold finite numbers only")

    @classmethod
    def from_arrays(
        cls, horizontal: ArrayLike, dt: float, *, vertical: ArrayLike | None = None, name: str = "", start_s: float = 0.0
    ) -> Motion:
        """Return a motion from a horizontal and an optional vertical acceleration, (n,), m/s^2."""
        along = np.asarray(horizontal, dtype=np.float64)
        rows = np.zeros((3, along.size))
        rows[ALONG] = along
        if vertical is not None:
            up = np.asarray(vertical, dtype=np.float64)
            if up.shape != along.shape:
                raise ParameterError("horizontal and vertical differ in length: {along} and {up} samples", along=along.size, up=up.size)
            rows[UP] = up
        return cls(rows, dt, name=name, start_s=start_s)

    @property
    def horizontal(self) -> FloatArray:
        """Ground acceleration along +x, (n,), m/s^2."""
        return self.acceleration[ALONG]

    @property
    def transverse(self) -> FloatArray:
        """Ground acceleration across +x, (n,), m/s^2."""
        return self.acceleration[ACROSS]

    @property
    def vertical(self) -> FloatArray:
        """Ground acceleration upwards, (n,), m/s^2."""
        return self.acceleration[UP]

    @property
    def samples(self) -> int:
        """Number of samples."""
        return int(self.acceleration.shape[1])

    @property
    def time(self) -> FloatArray:
        """Times of the samples, (n,), s after the record's first sample."""
        return self.start_s + self.dt * np.arange(self.samples, dtype=np.float64)


def motion_of(record: Record, component: str) -> Motion:
    """Return the motion whose +x is a component's positive direction, or an azimuth.

    Parameters
    ----------
    record : Record
        Its vertical component, when there is one, becomes the third row; when there is none that row is zero.
    component : str
        Code of a horizontal component, or an azimuth in degrees clockwise from north, for example ``37``.

    Raises
    ------
    ComponentError
        If there is no such component, or an azimuth is asked of a record without two oriented horizontals.
    """
    along, across = _along_and_across(record, component)
    rows = np.zeros((3, record.samples))
    rows[ALONG] = along
    if across is not None:
        rows[ACROSS] = across
    if record.vertical is not None:
        rows[UP] = record.vertical.acceleration
    return Motion(rows, record.dt, name=component, start_s=record.offset_s, record=record)


def _along_and_across(record: Record, component: str) -> tuple[FloatArray, FloatArray | None]:
    """Return the acceleration along a direction and, when known, 90 degrees counter-clockwise of it."""
    azimuth = _as_azimuth(component)
    if azimuth is None:
        chosen = record.component(component)
        if chosen.is_vertical:
            raise ComponentError(
                "{component} is vertical; choose a horizontal direction: {codes}",
                component=component,
                codes=[c.code for c in record.horizontals],
            )
        azimuth = chosen.azimuth_deg
        others = [c for c in record.horizontals if c is not chosen]
        if azimuth is None or not others or any(c.azimuth_deg is None for c in others):
            return chosen.acceleration, None
        return chosen.acceleration, _resolve(_oriented_pair(record), azimuth - 90.0)
    pair = _oriented_pair(record)
    return _resolve(pair, azimuth), _resolve(pair, azimuth - 90.0)


def _as_azimuth(component: str) -> float | None:
    """Return an azimuth in degrees when the text is a number."""
    try:
        azimuth = float(component)
    except ValueError:
        return None
    if not np.isfinite(azimuth):
        raise ComponentError("the azimuth must be a finite number of degrees, found {component!r}", component=component)
    return azimuth


def _oriented_pair(record: Record) -> tuple[Component, Component]:
    """Return two horizontals of known and different azimuth."""
    oriented = [c for c in record.horizontals if c.azimuth_deg is not None]
    if len(oriented) < 2:
        raise ComponentError(
            "{source}: turning to an azimuth needs two horizontal components of known direction; it has {codes}",
            source=record.source or said("record"),
            codes=record.codes,
        )
    return oriented[0], oriented[1]


def _resolve(pair: tuple[Component, Component], azimuth_deg: float) -> FloatArray:
    """Return the acceleration towards an azimuth from two horizontals, which need not be orthogonal."""
    first, second = pair
    # for exact axes keep the samples bit by bit: "numbers round-trip"
    for component in pair:
        if component.azimuth_deg == azimuth_deg % 360.0:
            return component.acceleration
    a, b, t = (math.radians(angle or 0.0) for angle in (first.azimuth_deg, second.azimuth_deg, azimuth_deg))
    span = math.sin(b - a)
    if abs(span) < 1e-6:
        raise ComponentError("the two horizontal components are parallel: no other direction follows from them")
    # north/east of the ground from its two projections, then projected on the azimuth
    return first.acceleration * (math.sin(b - t) / span) + second.acceleration * (math.sin(t - a) / span)

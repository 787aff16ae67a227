"""A record as it was read: station, start, components, and what was done to it since."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from datetime import datetime

import numpy as np

from seisblock.core import checks
from seisblock.core._display import PlotMixin
from seisblock.core.errors import ComponentError, RecordError
from seisblock.core.i18n import lazy_gettext
from seisblock.core.typing import ArrayLike, FloatArray
from seisblock.records.azimuth import parse_bearing
from seisblock.records.qc_flags import QCFlag

HORIZONTAL_AZIMUTHS = {"NS": 0.0, "EW": 90.0}
"""Azimuth, in degrees clockwise from north, of the positive direction of the two standard horizontals."""

VERTICAL = "UD"
"""Code of the vertical component, positive up."""

MAX_ACCELERATION = 1e9
"""No number beyond this, m/s^2, is an acceleration of the ground: squares of it would leave the range of numbers."""


def as_readonly(values: ArrayLike) -> FloatArray:
    """Return `values` as a read-only, C-contiguous float64 array, copied only when it must be."""
    array = np.ascontiguousarray(values, dtype=np.float64)
    if array.flags.writeable:
        array = array.view() if array is not values else array.copy()
        array.flags.writeable = False
    return array


def readonly(array: FloatArray) -> FloatArray:
    """Return an array that nobody else holds, read-only from now on: :func:`as_readonly` does not copy it."""
    array.flags.writeable = False
    return array


@dataclass(frozen=True, eq=False)
class Component:
    """One component of ground acceleration.

    Parameters
    ----------
    code : str
        ``NS``, ``EW`` or ``UD`` (positive north, east, up), else the name the file gives.
    acceleration : (n,) array, m/s^2
        Ground acceleration; kept read-only.
    azimuth_deg : float or None
        Azimuth of the positive direction, degrees clockwise from north; None when vertical or unknown.
    """

    code: str
    acceleration: FloatArray
    azimuth_deg: float | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "acceleration", as_readonly(self.acceleration))
        if self.acceleration.ndim != 1:
            raise RecordError(
                "component {code}: expected one row of samples, found {count} dimensions", code=self.code, count=self.acceleration.ndim
            )
        if self.azimuth_deg is None and self.code in HORIZONTAL_AZIMUTHS:
            object.__setattr__(self, "azimuth_deg", HORIZONTAL_AZIMUTHS[self.code])

    @property
    def is_vertical(self) -> bool:
        """Whether this is the vertical component."""
        return self.code == VERTICAL


@dataclass(frozen=True, eq=False)
class Record(PlotMixin):
    """A strong-motion record of one station.

    Parameters
    ----------
    components : sequence of Component
        All of one length; codes are unique.
    dt : float, s
        Sampling interval.
    station : str
        Code or name of the station, empty when unknown.
    start : datetime or None
        Time of the first sample as read, UTC.
    offset_s : float, s
        Time of the first sample held here after the first sample as read (cutting a window moves it).
    source, sha256, format : str
        File, digest of its bytes, and name of the format it was read as.
    history : tuple of str
        What was done to the samples since they were read, oldest first.
    metadata : mapping
        What else the header said (epicentre, magnitude, header's own maximum...).
    doubts : tuple of Doubt
        What a careful reader notices before he believes it, by the file and by the samples as read.
    """

    components: tuple[Component, ...]
    dt: float
    station: str = ""
    start: datetime | None = None
    offset_s: float = 0.0
    source: str = ""
    sha256: str = ""
    format: str = ""
    history: tuple[str, ...] = ()
    metadata: dict[str, object] = field(default_factory=dict)
    doubts: tuple[QCFlag, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "components", tuple(self.components))
        source = self.source or lazy_gettext("record")
        if not self.components:
            raise RecordError("{where}: there is no component in it", where=source)
        checks.positive("{source}: the sampling interval", self.dt, "s", error=RecordError, source=self.source or lazy_gettext("record"))
        lengths = {c.code: c.acceleration.size for c in self.components}
        if len(lengths) != len(self.components):
            raise RecordError("{where}: component codes repeat: {codes}", where=source, codes=self.codes)
        if len(set(lengths.values())) != 1:
            counts = [f"{code} {n}" for code, n in lengths.items()]
            raise RecordError(
                "{where}: components differ in length ({found} samples): give files of one recording", where=source, found=counts
            )
        if self.samples < 2:
            raise RecordError("{where}: needs at least 2 samples, found {found}", where=source, found=self.samples)
        for component in self.components:
            invalid = np.flatnonzero(~np.isfinite(component.acceleration))
            if invalid.size:
                raise RecordError(
                    "{where}: component {code} holds {count} samples that are not numbers, the first at index {first}",
                    where=source,
                    code=component.code,
                    count=invalid.size,
                    first=invalid[0],
                )
            size = max(float(component.acceleration.max()), -float(component.acceleration.min()))
            if size > MAX_ACCELERATION:
                text = "{where}: component {code} reaches {size:.3g} m/s^2, which is no acceleration of the ground"
                raise RecordError(text, where=source, code=component.code, size=size)

    @property
    def carries_offset(self) -> bool:
        """Whether its format's counts carry an offset, so that a mean is no motion of the ground."""
        return bool(self.metadata.get("carries_offset"))

    @property
    def samples(self) -> int:
        """Number of samples of each component."""
        return int(self.components[0].acceleration.size)

    @property
    def duration_s(self) -> float:
        """Time from the first to the last sample, s."""
        return (self.samples - 1) * self.dt

    @property
    def time(self) -> FloatArray:
        """Times of the samples, (n,), s after the first sample as read."""
        return self.offset_s + self.dt * np.arange(self.samples, dtype=np.float64)

    @property
    def codes(self) -> tuple[str, ...]:
        """Codes of the components, in the order of the file."""
        return tuple(c.code for c in self.components)

    @property
    def horizontals(self) -> tuple[Component, ...]:
        """The components that are not vertical."""
        return tuple(c for c in self.components if not c.is_vertical)

    @property
    def vertical(self) -> Component | None:
        """The vertical component, or None."""
        return next((c for c in self.components if c.is_vertical), None)

    def component(self, code: str) -> Component:
        """Return the component of that code.

        Raises
        ------
        ComponentError
            If there is none; the message lists those there are.
        """
        for candidate in self.components:
            if candidate.code.upper() == code.upper():
                return candidate
        source, azimuth = self.source or lazy_gettext("record"), parse_bearing(code)
        if azimuth is not None:
            text = "{source}: no component {code!r}; it has {codes}; an azimuth is in degrees clockwise from north: write {azimuth:g}"
            raise ComponentError(text, source=source, code=code, codes=self.codes, azimuth=azimuth)
        raise ComponentError("{source}: no component {code!r}; it has {codes}", source=source, code=code, codes=self.codes)

    def with_components(self, components: Sequence[Component], entry: str, **changes: object) -> Record:
        """Return a record with other samples, and `entry` added to its history."""
        return replace(self, components=tuple(components), history=(*self.history, entry), **changes)  # type: ignore[arg-type]

"""Strong-motion record: station, start, components, processing history and quality flags."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import UTC, datetime
from typing import Any

import numpy as np

from seisblock.core import checks
from seisblock.core._display import DisplayMixin, PlotMixin
from seisblock.core.arrays import as_readonly, readonly
from seisblock.core.backends import backend
from seisblock.core.errors import ComponentError, KindError, RecordError
from seisblock.core.i18n import lazy_gettext
from seisblock.core.typing import ArrayLike, FloatArray
from seisblock.records.azimuth import parse_bearing
from seisblock.records.qc_flags import QCFlag

HORIZONTAL_AZIMUTHS = {"NS": 0.0, "EW": 90.0}
"""Azimuth of the positive direction of the two standard horizontals, degrees clockwise from north."""

VERTICAL = "UD"
"""Code of the vertical component, positive up."""

MAX_ACCELERATION = 1e9
"""Largest accepted acceleration, m/s^2; keeps squares of samples within the range of floating-point numbers."""


@dataclass(frozen=True, eq=False, repr=False)
class Component(DisplayMixin):
    """One component of ground acceleration.

    Parameters
    ----------
    code : str
        ``NS``, ``EW`` or ``UD`` (positive north, east, up), else the name in the file.
    acceleration : (n,) array, m/s^2
        Ground acceleration, read-only.
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
                "component {code}: expected a 1-D array of samples, found {count} dimensions", code=self.code, count=self.acceleration.ndim
            )
        if self.azimuth_deg is None and self.code in HORIZONTAL_AZIMUTHS:
            object.__setattr__(self, "azimuth_deg", HORIZONTAL_AZIMUTHS[self.code])

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Restore a pickled or copied component; the samples stay read-only."""
        self.__dict__.update(state)
        readonly(self.acceleration)

    @property
    def is_vertical(self) -> bool:
        """True for the vertical component."""
        return self.code == VERTICAL


@dataclass(frozen=True, eq=False, repr=False)
class Record(PlotMixin):
    """A strong-motion record of one station.

    Parameters
    ----------
    components : sequence of Component
        Components of equal length with unique codes.
    dt : float, s
        Sampling interval.
    station : str
        Code or name of the station, empty when unknown.
    start : datetime or None
        Time of the first sample as read, UTC.
    offset_s : float, s
        Time of the first sample relative to the first sample as read (nonzero after cropping).
    source, sha256, format : str
        File, digest of its bytes, and name of the format.
    history : tuple of str
        Processing of the samples since reading, oldest first.
    metadata : mapping
        Further header entries (epicentre, magnitude, header maximum...).
    doubts : tuple of QCFlag
        Quality flags of the file and of the samples as read.
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
            raise RecordError("{where}: no components", where=source)
        checks.positive("{source}: the sampling interval", self.dt, "s", error=RecordError, source=self.source or lazy_gettext("record"))
        lengths = {c.code: c.acceleration.size for c in self.components}
        # equal codes fall on one key
        if len(lengths) != len(self.components):
            raise RecordError("{where}: duplicate component codes: {codes}", where=source, codes=self.codes)
        if len(set(lengths.values())) != 1:
            counts = [f"{code} {n}" for code, n in lengths.items()]
            raise RecordError(
                "{where}: components differ in length ({found} samples); give the files of one recording", where=source, found=counts
            )
        if self.samples < 2:
            raise RecordError("{where}: at least 2 samples required, found {found}", where=source, found=self.samples)
        for component in self.components:
            invalid = np.flatnonzero(~np.isfinite(component.acceleration))
            if invalid.size:
                raise RecordError(
                    "{where}: component {code} is not finite at {count} of its samples, the first at index {first}",
                    where=source,
                    code=component.code,
                    count=invalid.size,
                    first=invalid[0],
                )
            # without the temporary array of an absolute value
            size = max(float(component.acceleration.max()), -float(component.acceleration.min()))
            if size > MAX_ACCELERATION:
                text = "{where}: component {code} reaches {size:.3g} m/s^2, beyond any ground acceleration"
                raise RecordError(text, where=source, code=component.code, size=size)

    @classmethod
    def from_arrays(cls, components: Mapping[str, ArrayLike], dt: float, *, station: str = "", start: datetime | None = None) -> Record:
        """Return a record of accelerations in memory.

        Parameters
        ----------
        components : mapping of str to (n,) array, m/s^2
            Ground acceleration by code: ``NS``, ``EW``, ``UD`` (positive north, east, up), or an azimuth in degrees such as ``37``.
            Other codes have no azimuth.
        dt : float, s
            Sampling interval.
        station : str
            Code or name of the station.
        start : datetime or None
            Time of the first sample; UTC if it has no time zone.

        Returns
        -------
        Record

        Raises
        ------
        RecordError
            If there are no components, their lengths differ, or a sample is not finite.
        ParameterError
            If an array is not 1-D and numeric.
        KindError
            If the components have no codes.

        Examples
        --------
        >>> import numpy as np
        >>> sine = 3.0 * np.sin(2.0 * np.pi * np.arange(1001) * 0.01)
        >>> record = Record.from_arrays({"EW": sine, "UD": 0.3 * sine}, dt=0.01, station="shaking table")
        >>> record.codes, record.duration_s, record.horizontals[0].azimuth_deg
        (('EW', 'UD'), 10.0, 90.0)
        """
        if not hasattr(components, "items"):
            raise KindError('expected components by code, {{"NS": array}}, found {found}', found=checks.type_name(components))
        columns = []
        for code, values in components.items():
            array = checks.float_vector("the accelerations", values)
            columns.append(Component(str(code), array.copy() if array is values else array, _azimuth_of_code(str(code))))
        if start is not None and start.tzinfo is None:
            start = start.replace(tzinfo=UTC)
        return cls(tuple(columns), dt, station=station, start=start)

    @classmethod
    def from_obspy(cls, stream: Any, inventory: Any = None, event: Any = None, **options: Any) -> Record:
        """Return the record of an ObsPy Stream or Trace.

        Parameters
        ----------
        stream : obspy.Stream or obspy.Trace
            Traces of one station and sensor; not modified. Counts require `inventory` or a response attached to the traces. Floating-point
            samples of an accelerometer without a response, and samples after ``remove_response(output="ACC")``, are taken in m/s^2.
        inventory : obspy.Inventory or None
            Responses; these are removed, and azimuths, dips and coordinates taken.
        event : ObsPy Event, Catalog, path or None
            Earthquake of the record.
        **options
            ``units``, ``station``, ``location``, ``differentiate`` and ``response``, as for :func:`~seisblock.readers.read`.

        Returns
        -------
        Record

        Raises
        ------
        UnitError
            If samples are counts without a response, or velocities.
        ComponentError
            If the stream has several stations or sensors, and none is selected.
        RecordFormatError
            If a trace has gaps.

        Examples
        --------
        >>> import numpy as np, obspy
        >>> header = {"network": "XX", "station": "ABC", "location": "00", "channel": "HNE", "delta": 0.01}
        >>> record = Record.from_obspy(obspy.Trace(np.sin(np.arange(500.0)), header))
        >>> record.network, record.station, record.location, record.channels
        ('XX', 'ABC', '00', {'EW': 'HNE'})
        """
        return backend("obspy").record_from_obspy(stream, inventory, event, **options)  # type: ignore[no-any-return]

    def to_obspy(self) -> Any:
        """Return the record as an ObsPy Stream: m/s^2, full channel names, azimuths in ``stats.seisblock``.

        Examples
        --------
        >>> from seisblock.readers import read
        >>> stream = read("synthetic_jma.csv").to_obspy()
        >>> [(trace.id, trace.stats.seisblock.azimuth_deg) for trace in stream]
        [('.SYN..NS', 0.0), ('.SYN..EW', 90.0), ('.SYN..UD', None)]
        """
        return backend("obspy").record_to_obspy(self)

    @property
    def network(self) -> str:
        """Code of the network, empty when unknown."""
        return str(self.metadata.get("network", ""))

    @property
    def location(self) -> str:
        """SEED location code of the sensor, empty when unknown."""
        return str(self.metadata.get("location", ""))

    @property
    def channels(self) -> dict[str, str]:
        """Name of the channel by component code, as far as the file states it."""
        channels = self.metadata.get("channels")
        return {code: str(name) for code, name in channels.items()} if isinstance(channels, dict) else {}

    @property
    def seed_id(self) -> str:
        """Network, station, location and channels, such as ``CI.MIKB..HN?``; empty without network and channels."""
        names = list(dict.fromkeys(self.channels.values()))
        if not self.network or not names:
            return ""
        sensors = {name[:-1] for name in names}
        channel = names[0] if len(names) == 1 else f"{sensors.pop()}?" if len(sensors) == 1 else ",".join(names)
        return f"{self.network}.{self.station}.{self.location}.{channel}"

    @property
    def carries_offset(self) -> bool:
        """True if the counts of the format carry an instrument offset."""
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
        """Return the component with a code, in any case.

        Raises
        ------
        ComponentError
            If there is no such component; the message lists the available codes.
        """
        for candidate in self.components:
            if candidate.code.upper() == code.upper():
                return candidate
        source, azimuth = self.source or lazy_gettext("record"), parse_bearing(code)
        if azimuth is not None:
            text = "{source}: no component {code!r}; available: {codes}; for an azimuth in degrees clockwise from north, write {azimuth:g}"
            raise ComponentError(text, source=source, code=code, codes=self.codes, azimuth=azimuth)
        raise ComponentError("{source}: no component {code!r}; available: {codes}", source=source, code=code, codes=self.codes)

    def with_components(self, components: Sequence[Component], entry: str, **changes: object) -> Record:
        """Return a record with other components and `entry` appended to its history."""
        return replace(self, components=tuple(components), history=(*self.history, entry), **changes)  # type: ignore[arg-type]


def _azimuth_of_code(code: str) -> float | None:
    """Return the azimuth that a code states as a number from 0 to 360, None for other codes."""
    try:
        azimuth = float(code)
    except ValueError:
        return None
    return azimuth if 0.0 <= azimuth <= 360.0 else None

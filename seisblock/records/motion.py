"""Input motion of a solver: ground acceleration along, across and up at common times."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Final, NamedTuple, TypeAlias

import numpy as np

from seisblock.core import checks
from seisblock.core._display import PlotMixin
from seisblock.core._warnings import called_externally, warn_external
from seisblock.core.arrays import as_readonly, readonly
from seisblock.core.errors import ComponentError, ParameterError
from seisblock.core.i18n import lazy_gettext
from seisblock.core.typing import ArrayLike, FloatArray
from seisblock.records.qc import IMPLAUSIBLE_PGA
from seisblock.records.record import Component, Record
from seisblock.records.rotation import acceleration_at_azimuth, azimuth_projection, oriented_pair

ALONG: Final = 0
ACROSS: Final = 1
UP: Final = 2

ALL_AZIMUTHS = "all-azimuths"
"""Component name that requests all directions."""

MAX_SAMPLING_INTERVAL = 0.1
"""Longest plausible sampling interval of ground motion, s; beyond it a rate or another unit was probably given."""

LONG_MOTION_SAMPLES = 2**20
"""Number of samples (three hours at 100 Hz) beyond which motions and trajectories are processed in segments."""

SEGMENT_SAMPLES = 2**18
"""Samples per segment of a long motion."""


MotionRows: TypeAlias = FloatArray | tuple[FloatArray, FloatArray | Callable[[slice], FloatArray], FloatArray]
"""Accelerations along, across and up: one (3, n) array or a tuple; the row across may be a function of a slice."""


class MotionSegment(NamedTuple):
    """Consecutive samples of a motion: index of the first, accelerations (3, k), m/s^2, and number of later samples."""

    first: int
    acceleration: FloatArray
    samples_after: int


@dataclass(frozen=True, eq=False, repr=False)
class Motion(PlotMixin):
    """Ground acceleration acting on a body, piecewise linear between samples.

    Parameters
    ----------
    rows : (3, n) array or three (n,) arrays, m/s^2
        Along +x, across (+y, 90 degrees counter-clockwise of x seen from above), up (+z). Stored read-only; contiguous float64 arrays are
        not copied. The row across may be a function that returns the samples of a slice.
    dt : float, s
        Sampling interval.
    name : str
        Direction of +x in the record (component code such as ``EW``, or azimuth such as ``37``).
    start_s : float, s
        Time of the first sample, counted from the record's first sample as read.
    record : Record or None
        Source record.
    """

    rows: MotionRows
    dt: float
    name: str = ""
    start_s: float = 0.0
    record: Record | None = None

    def __post_init__(self) -> None:
        rows = (
            tuple(row if callable(row) else as_readonly(row) for row in self.rows)
            if isinstance(self.rows, tuple)
            else as_readonly(self.rows)
        )
        object.__setattr__(self, "rows", rows)
        arrays = [row for row in rows if not callable(row)]
        shape = rows.shape if isinstance(rows, np.ndarray) else (len(rows), *arrays[0].shape)
        if len(shape) != 2 or shape[0] != 3 or any(row.shape != shape[1:] for row in arrays):
            raise ParameterError("expected three rows (along, across, up), found shape {shape}", shape=str(shape))
        if shape[1] < 2:
            raise ParameterError("a motion needs at least 2 samples, found {count}", count=shape[1])
        checks.positive("the sampling interval", self.dt, "s")
        if not all(np.isfinite(row).all() for row in arrays):
            raise ParameterError("accelerations of a motion must be finite")

    def __reduce__(self) -> tuple[Any, ...]:
        """Copy and pickle by the constructor: arrays that a copy restores are writable, which no kernel accepts."""
        return Motion, (self.rows, self.dt, self.name, self.start_s, self.record)

    @classmethod
    def from_arrays(
        cls, horizontal: ArrayLike, dt: float, *, vertical: ArrayLike | None = None, name: str = "", start_s: float = 0.0
    ) -> Motion:
        """Return a motion from a horizontal and an optional vertical acceleration, (n,), m/s^2.

        Parameters
        ----------
        horizontal, vertical : (n,) array, m/s^2
            Ground acceleration along +x and, optionally, upwards.
        dt, name, start_s
            As for the class.

        Returns
        -------
        Motion

        Raises
        ------
        ParameterError
            If an array is not 1-D and finite, the lengths differ, or the interval is not positive.

        Warns
        -----
        UserWarning
            If the peak exceeds 5 g or the interval exceeds 0.1 s, which suggests another unit.
        """
        along = checks.float_vector("the horizontal acceleration", horizontal)
        rows = np.zeros((3, along.size))
        rows[ALONG] = along
        if vertical is not None:
            up = checks.float_vector("the vertical acceleration", vertical)
            if up.shape != along.shape:
                raise ParameterError(
                    "horizontal and vertical accelerations differ in length: {along} and {up} samples", along=along.size, up=up.size
                )
            rows[UP] = up
        motion = cls(rows, dt, name=name, start_s=start_s)
        if called_externally(1):
            _warn_units(motion, 2)
        return motion

    @property
    def horizontal(self) -> FloatArray:
        """Ground acceleration along +x, (n,), m/s^2."""
        along: FloatArray = self.rows[ALONG]
        return along

    @property
    def transverse(self) -> FloatArray:
        """Ground acceleration across +x, (n,), m/s^2; recomputed on each access for long motions."""
        return _slice_row(self.rows[ACROSS], slice(None))

    @property
    def vertical(self) -> FloatArray:
        """Ground acceleration upwards, (n,), m/s^2."""
        up: FloatArray = self.rows[UP]
        return up

    @property
    def acceleration(self) -> FloatArray:
        """Accelerations along, across and up, (3, n), m/s^2, read-only; recomputed on each access for long motions."""
        return self.rows if isinstance(self.rows, np.ndarray) else readonly(np.stack([self.horizontal, self.transverse, self.vertical]))

    @property
    def azimuth_deg(self) -> float | None:
        """Azimuth of +x, degrees clockwise from north; None if unknown."""
        for component in () if self.record is None else self.record.components:
            if component.code == self.name and component.azimuth_deg is not None:
                return component.azimuth_deg
        try:
            return float(self.name)
        except ValueError:
            return None

    @property
    def samples(self) -> int:
        """Number of samples."""
        return int(self.horizontal.size)

    @property
    def is_long(self) -> bool:
        """True if the motion should be processed in segments rather than copied."""
        return self.samples > LONG_MOTION_SAMPLES

    def segments(self, active: Sequence[bool], first_sample: int = 0) -> Iterator[MotionSegment]:
        """Yield the motion in time order: in one segment, or in several if it is long.

        Parameters
        ----------
        active : three bool
            Rows to compute; the other rows of a long motion are zero.
        first_sample : int
            Start of the first segment of a long motion, at the latest its last interval.

        Yields
        ------
        MotionSegment
        """
        if not self.is_long:
            yield MotionSegment(0, self.acceleration, 0)
            return
        # segments share their end samples: the last of one is the first of the next
        last = self.samples - 1
        for begin in range(min(first_sample, last - 1), last, SEGMENT_SAMPLES):
            end = min(begin + SEGMENT_SAMPLES, last)
            piece = np.zeros((3, end + 1 - begin))
            for index, row in enumerate(self.rows):
                if active[index]:
                    piece[index] = _slice_row(row, slice(begin, end + 1))
            yield MotionSegment(begin, readonly(piece), last - end)

    @property
    def time(self) -> FloatArray:
        """Times of the samples, (n,), s after the record's first sample."""
        return self.start_s + self.dt * np.arange(self.samples, dtype=np.float64)


def _slice_row(row: FloatArray | Callable[[slice], FloatArray], part: slice) -> FloatArray:
    """Return samples of a row given as an array or as a function of a slice."""
    return row(part) if callable(row) else row[part]


def motion_of(record: Record, component: str) -> Motion:
    """Return the motion whose +x axis is a component's positive direction or an azimuth.

    Parameters
    ----------
    record : Record
        Source; a missing vertical component gives a row of zeros.
    component : str
        Code of a horizontal component, or an azimuth in degrees clockwise from north, for example ``37``. A number that is the code of a
        component names that component; ``37.0`` is then the azimuth.

    Returns
    -------
    Motion

    Raises
    ------
    ComponentError
        If there is no such component, or an azimuth is requested from a record without two oriented horizontals.

    Warns
    -----
    UserWarning
        If called from outside the package and the interval exceeds 0.1 s, or the peak exceeds 5 g without a quality flag of the record.

    Examples
    --------
    >>> from seisblock.readers import read
    >>> motion = motion_of(read("synthetic_jma.csv"), "EW")
    >>> motion.name, motion.samples, motion.dt
    ('EW', 6000, 0.01)
    """
    checks.instance(record, Record)
    component = str(component)
    along, across = _horizontal_rows(record, component)
    zeros = np.zeros(record.samples)
    up = zeros if record.vertical is None else record.vertical.acceleration
    if record.samples > LONG_MOTION_SAMPLES:
        # a long motion keeps the row across as a function, which saves a third of its memory
        rows: MotionRows = (along, across or zeros, up)
    else:
        rows = readonly(np.stack([along, zeros if across is None else across(slice(None)), up]))
    motion = Motion(rows, record.dt, name=component, start_s=record.offset_s, record=record)
    if called_externally(1):
        _warn_units(motion, 2)
    return motion


def azimuth_name(record: Record, azimuth_deg: float) -> str:
    """Return the name of an azimuth for :func:`motion_of`, also where a component towards another azimuth has that number as its code.

    Examples
    --------
    >>> record = Record([Component("90", np.zeros(2), 100.0), Component("0", np.zeros(2), 10.0)], 0.01)
    >>> azimuth_name(record, 90.0), azimuth_name(record, 45.0), motion_of(record, "90").azimuth_deg
    ('90.0', '45', 100.0)
    """
    name = f"{azimuth_deg:g}"
    is_other = any(component.code == name and component.azimuth_deg != azimuth_deg % 360.0 for component in record.components)
    return f"{name}.0" if is_other and "." not in name else name


def motion_toward(record: Record, azimuth_deg: float) -> Motion:
    """Return the motion of a record towards an azimuth, degrees clockwise from north."""
    return motion_of(record, azimuth_name(record, azimuth_deg))


def requested_azimuth(motion: Motion) -> float | None:
    """Return the azimuth of a motion of a record that was requested by its degrees, None for a recorded component."""
    record = motion.record
    if record is None or any(component.code == motion.name for component in record.components):
        return None
    return _parse_azimuth(motion.name)


def _warn_units(motion: Motion, depth: int) -> None:
    """Warn if peak or sampling interval suggest another unit."""
    is_flagged = motion.record is not None and any(flag.kind == "size" for flag in motion.record.doubts)
    # max and -min instead of abs: no temporary array
    peak = max(max(float(row.max()), -float(row.min())) for row in (motion.horizontal, motion.vertical))
    if peak > IMPLAUSIBLE_PGA and not is_flagged:
        warn_external(
            lazy_gettext("peak acceleration {peak:.4g} m/s^2 exceeds 5 g; check the unit (expected m/s^2; 1 gal = 0.01 m/s^2)", peak=peak),
            depth,
        )
    if motion.dt > MAX_SAMPLING_INTERVAL:
        text = "sampling interval {dt:g} s exceeds 0.1 s; check the unit (interval in s, not rate in Hz)"
        warn_external(lazy_gettext(text, dt=motion.dt), depth)


def _horizontal_rows(record: Record, component: str) -> tuple[FloatArray, Callable[[slice], FloatArray] | None]:
    """Return the acceleration along a direction, and a function for slices of the row 90 degrees counter-clockwise."""
    # a code that is a number names its component, whatever the azimuth of that
    component_match = next((c for c in record.horizontals if c.code == component), None)
    azimuth = None if component_match is not None else _parse_azimuth(component)
    if azimuth is not None:
        checks.azimuth(azimuth, error=ComponentError)
        component_match = _component_toward(record, azimuth)
    if azimuth is None or component_match is not None:
        selected = record.component(component) if component_match is None else component_match
        if selected.is_vertical:
            raise ComponentError(
                "component {component} is vertical; choose a horizontal component: {codes}",
                component=component,
                codes=[c.code for c in record.horizontals],
            )
        azimuth = selected.azimuth_deg
        remaining = [c for c in record.horizontals if c is not selected]
        if azimuth is None or not remaining or any(c.azimuth_deg is None for c in remaining):
            return selected.acceleration, None
        pair = oriented_pair(record)
        along = selected.acceleration
    else:
        # a single oriented horizontal still gives its opposite direction, without the transverse row
        opposite = _component_toward(record, azimuth + 180.0)
        if opposite is not None and sum(c.azimuth_deg is not None for c in record.horizontals) < 2:
            return readonly(-opposite.acceleration), None
        pair = oriented_pair(record)
        # the row across lies 90 degrees counter-clockwise of the row along
        along = acceleration_at_azimuth(pair, azimuth)
    return along, azimuth_projection(pair, azimuth - 90.0)


def _parse_azimuth(component: str) -> float | None:
    """Return an azimuth in degrees if the text is a number, else None."""
    try:
        azimuth = float(component)
    except ValueError:
        return None
    if not np.isfinite(azimuth):
        raise ComponentError("azimuth must be a finite number of degrees, found {component!r}", component=component)
    return azimuth


def _component_toward(record: Record, azimuth: float) -> Component | None:
    """Return the horizontal recorded towards an azimuth."""
    return next((candidate for candidate in record.horizontals if candidate.azimuth_deg == azimuth % 360.0), None)

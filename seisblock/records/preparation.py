"""Preparation of records before analysis: demean, high-pass, scaling, floor motion, window."""

from __future__ import annotations

from dataclasses import dataclass

from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import ParameterError
from seisblock.core.jma_scale import parse_jma_intensity
from seisblock.core.typing import TimeWindow
from seisblock.records import process
from seisblock.records.floor import Storey, floor_motion
from seisblock.records.record import Record


@dataclass(frozen=True, repr=False)
class Preparation(DisplayMixin):
    """Processing steps applied to records: mean, high-pass, scale, floor motion and window, in this order.

    Parameters
    ----------
    demean : bool or None
        Remove the mean of each component; None removes it for formats whose counts carry an offset (K-NET, KiK-net).
    highpass_hz : float or None, Hz
        Corner of :func:`~seisblock.records.process.highpass`.
    scale : float
        Factor on all components.
    target_pga : float or None, m/s^2
        Target peak of the largest of `components` after these steps; all components are scaled by the same factor.
    target_jma : float or None, 1
        Target JMA intensity of the whole record after these steps, instead of `target_pga`.
    components : tuple of str
        Codes or azimuths that define the peak; all horizontals when empty.
    window : (float or None, float or None) or None, s
        Start and end, counted from the record's first sample as read; None keeps the end of the record.
    floor : Storey or None
        Replace the ground motion by :func:`~seisblock.records.floor.floor_motion`. Scale and targets refer to the ground; the
        window is extracted from the floor motion and includes the response to earlier shaking.

    Raises
    ------
    ParameterError
        If a number lies outside its range, or two targets are given.

    Examples
    --------
    >>> from seisblock.readers import read
    >>> strong = Preparation(highpass_hz=0.1, target_pga=8.0, components=("EW",), window=(20.0, None))
    >>> prepared = strong.apply(read("synthetic_jma.csv"))
    >>> len(prepared.history), prepared.offset_s
    (3, 20.0)
    """

    demean: bool | None = None
    highpass_hz: float | None = None
    scale: float = 1.0
    target_pga: float | None = None
    components: tuple[str, ...] = ()
    window: TimeWindow | None = None
    floor: Storey | None = None
    target_jma: float | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "components", (self.components,) if isinstance(self.components, str) else tuple(self.components))
        checks.nonzero("the scale factor", self.scale)
        if self.highpass_hz is not None:
            checks.positive("the high-pass corner", self.highpass_hz, "Hz")
        if self.target_pga is not None:
            checks.positive("the target PGA", self.target_pga, "m/s^2")
        if self.target_jma is not None:
            object.__setattr__(self, "target_jma", parse_jma_intensity(self.target_jma))
            if self.target_pga is not None:
                raise ParameterError("a record cannot be scaled to a PGA and to a JMA intensity: give only one of them")
        if self.floor is not None:
            checks.instance(self.floor, Storey)

    def apply(self, record: Record) -> Record:
        """Return the processed record; each step adds an entry to ``history``.

        Parameters
        ----------
        record : Record
            Record as read; not modified.

        Returns
        -------
        Record

        Raises
        ------
        ParameterError
            If the corner exceeds half the sampling rate, the components are zero, or the floor motion exceeds the limit on samples.
        ComponentError
            If there is no such component.
        RecordError
            If the window lies outside the record.
        """
        checks.instance(record, Record)
        if record.carries_offset if self.demean is None else self.demean:
            record = process.demean(record)
        if self.highpass_hz is not None:
            record = process.highpass(record, self.highpass_hz)
        if self.scale != 1.0:
            record = process.scale(record, self.scale)
        if self.target_pga is not None:
            # after the filters, which change the peak
            record = process.scale_to_pga(record, self.target_pga, self.components or None)
        if self.target_jma is not None:
            record = process.scale_to_jma(record, self.target_jma)
        if self.floor is not None:
            # scale and target PGA are those of the ground
            record = floor_motion(record, self.floor)
        # last: filter and floor motion need the record before the window
        return record if self.window is None else process.crop(record, *self.window)

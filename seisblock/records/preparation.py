"""What is done to records before they are used: one frozen list of steps that any number of records can go through."""

from __future__ import annotations

from dataclasses import dataclass

from seisblock.core import checks
from seisblock.core.typing import TimeWindow
from seisblock.records import process
from seisblock.records.floor_motion import Storey, floor_motion
from seisblock.records.record import Record


@dataclass(frozen=True)
class Preparation:
    """Mean, high-pass, scale, floor and window, in this order.

    Parameters
    ----------
    demean : bool or None
        Whether the mean of each component is removed; None removes it where the format's counts carry an offset (K-NET, KiK-net).
    highpass_hz : float or None, Hz
        Corner of :func:`~seisblock.records.process.highpass`.
    scale : float
        Factor on all components.
    target_pga : float or None, m/s^2
        Peak that the largest of `components` shall have after that; all components are scaled alike.
    components : tuple of str
        Codes or azimuths among which that peak is looked for; all horizontals when empty.
    window : (float or None, float or None) or None, s
        First and last instant kept, counted from the record's first sample as read; None is the record's own end.
    floor : Storey or None
        What stands on a storey of a building feels :func:`~seisblock.records.floor_motion.floor_motion` of that. The scale is that of
        the ground, a target PGA too; the window is cut out of the storey's motion, which knows what came before it.

    Raises
    ------
    ParameterError
        If a number lies outside its range.

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

    def __post_init__(self) -> None:
        object.__setattr__(self, "components", (self.components,) if isinstance(self.components, str) else tuple(self.components))
        checks.nonzero("the scale factor", self.scale)
        if self.highpass_hz is not None:
            checks.positive("the corner of the high-pass", self.highpass_hz, "Hz")
        if self.target_pga is not None:
            checks.positive("the target PGA", self.target_pga, "m/s^2")
        if self.floor is not None:
            checks.instance(self.floor, Storey)

    def apply(self, record: Record) -> Record:
        """Return a record that went through the steps, each of which is told in its ``history``.

        Parameters
        ----------
        record : Record
            As it was read; it stays as it is.

        Raises
        ------
        ParameterError
            If the corner lies above half the sampling rate, nothing can be scaled, or the floor swings for ever.
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
            record = process.scale_to_pga(record, self.target_pga, self.components or None)
        if self.floor is not None:
            record = floor_motion(record, self.floor)
        return record if self.window is None else process.crop(record, *self.window)

"""History entry of a cropped record, and the test for it."""

from __future__ import annotations

from seisblock.core.i18n import N_, Message
from seisblock.records.record import Record

CROP_HISTORY = N_("{window} extracted")
"""Template of the history entry written by :func:`seisblock.records.process.crop`."""


def is_cropped(record: Record) -> bool:
    """Return whether a record is a window of a longer one.

    Examples
    --------
    >>> from seisblock.readers import read
    >>> from seisblock.records.process import crop
    >>> record = read("synthetic_jma.csv")
    >>> is_cropped(record), is_cropped(crop(record, 20.0, 30.0))
    (False, True)
    """
    return any(isinstance(entry, Message) and entry.template == CROP_HISTORY for entry in record.history)

"""Whether a record is all that was recorded."""

from __future__ import annotations

from seisblock.core.i18n import N_, Message
from seisblock.records.record import Record

CROP_HISTORY = N_("{window} cut out")
"""What is said of a record of which a part was taken."""


def is_cropped(record: Record) -> bool:
    """Return whether a record is a part of one that was longer.

    Examples
    --------
    >>> from seisblock.readers import read
    >>> from seisblock.records.process import crop
    >>> record = read("synthetic_jma.csv")
    >>> is_cropped(record), is_cropped(crop(record, 20.0, 30.0))
    (False, True)
    """
    return any(isinstance(entry, Message) and entry.template == CROP_HISTORY for entry in record.history)

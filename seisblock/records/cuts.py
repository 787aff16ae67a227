"""Whether a record is all that was recorded."""

from __future__ import annotations

from seisblock.records.record import Record
from seisblock.words import Said, noted

CUT = noted("{window} cut out")
"""What is said of a record of which a part was taken."""


def was_cut(record: Record) -> bool:
    """Return whether a record is a part of one that was longer.

    Examples
    --------
    >>> from seisblock.readers import read
    >>> from seisblock.records.process import crop
    >>> record = read("synthetic_jma.csv")
    >>> was_cut(record), was_cut(crop(record, 20.0, 30.0))
    (False, True)
    """
    return any(isinstance(did, Said) and did.template == CUT for did in record.history)

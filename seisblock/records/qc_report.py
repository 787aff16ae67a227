"""Quality flags of records as sentences or as an error."""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce

from seisblock.core.errors import RecordError
from seisblock.core.i18n import lazy_gettext
from seisblock.records.record import Record


def qc_summary(records: Sequence[Record]) -> list[str]:
    """Return the messages of the flags of records, prefixed by the station where there are several records.

    Parameters
    ----------
    records : sequence of Record
    """
    if len(records) == 1:
        return list(dict.fromkeys(flag.message for flag in records[0].doubts))
    messages = (lazy_gettext("{record}: {doubt}", record=r.station or r.source, doubt=flag.message) for r in records for flag in r.doubts)
    return list(dict.fromkeys(messages))


def require_clean(record: Record) -> None:
    """Raise `RecordError` if a record has quality flags.

    Raises
    ------
    RecordError
        If the record has quality flags; the message lists them all.
    """
    if record.doubts:
        raise RecordError(
            "{record}: quality flags raised, and flagged records are excluded: {doubts}",
            record=record.source or record.station or "record",
            doubts=reduce(_join_messages, (flag.message for flag in record.doubts)),
        )


def _join_messages(first: str, second: str) -> str:
    """Return two messages as one, separated as the language requires when displayed."""
    return lazy_gettext("{first}; {second}", first=first, second=second)

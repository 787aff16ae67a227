"""Records that a careful reader doubts: the doubts as sentences, or as a refusal."""

from __future__ import annotations

from collections.abc import Sequence

from seisblock.core.errors import RecordError
from seisblock.core.i18n import lazy_gettext
from seisblock.records.record import Record


def qc_summary(records: Sequence[Record]) -> list[str]:
    """Return the doubts about some records, a sentence each, with the record's name where there are several.

    Parameters
    ----------
    records : sequence of Record
    """
    if len(records) == 1:
        return list(dict.fromkeys(flag.message for flag in records[0].doubts))
    messages = (lazy_gettext("{record}: {doubt}", record=r.station or r.source, doubt=flag.message) for r in records for flag in r.doubts)
    return list(dict.fromkeys(messages))


def require_clean(record: Record) -> None:
    """Raise where a careful reader would doubt.

    Raises
    ------
    RecordError
        If there are doubts about the record; the message holds them all.
    """
    if record.doubts:
        raise RecordError(
            "{record} is doubtful, and doubtful records are refused: {doubts}",
            record=record.source or record.station or "record",
            doubts=[flag.message for flag in record.doubts],
        )

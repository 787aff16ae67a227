"""Records that a careful reader doubts: the doubts as sentences, or as a refusal."""

from __future__ import annotations

from collections.abc import Sequence

from seisblock.errors import RecordError
from seisblock.records.record import Record
from seisblock.words import said


def sentences(records: Sequence[Record]) -> list[str]:
    """Return the doubts about some records, a sentence each, with the record's name where there are several.

    Parameters
    ----------
    records : sequence of Record
    """
    if len(records) == 1:
        return list(dict.fromkeys(doubt.message for doubt in records[0].doubts))
    named = (said("{record}: {doubt}", record=r.station or r.source, doubt=doubt.message) for r in records for doubt in r.doubts)
    return list(dict.fromkeys(named))


def refuse_doubtful(record: Record) -> None:
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
            doubts=[doubt.message for doubt in record.doubts],
        )

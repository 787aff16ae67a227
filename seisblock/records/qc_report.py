"""Quality flags of records as sentences or as an error."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import reduce

from seisblock.core.errors import RecordError
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.records.record import Record
from seisblock.records.site import get_earthquake

CHECK_WORDS = (
    "count",
    N_("peak"),
    N_("clock"),
    N_("unit"),
    N_("sign"),
    N_("instrument"),
    N_("repetition"),
    N_("earthquake"),
)
"""Properties of a record that are proved or assumed: number and size of its samples, sampling interval, unit, positive direction, sensor
that measures accelerations, no repeated samples, record of the earthquake in the header."""

_WORDS_BY_KIND = {
    "count": ("count",),
    "cut": ("count",),
    "line": ("count",),
    "header": ("peak", "earthquake"),
    "clock": ("clock",),
    "size": ("unit",),
    "calibration": ("unit",),
    "sign": ("sign",),
    "directions": ("sign",),
    "repetition": ("repetition",),
}
"""Words that a flag contradicts."""


@dataclass(frozen=True)
class RecordChecks:
    """Proofs and assumptions of a record.

    Parameters
    ----------
    proved : tuple of str
        Stated by the file and confirmed by its samples or by a second statement, or fixed by its format.
    assumed : tuple of str
        Neither proved nor contradicted; contradictions are quality flags.
    """

    proved: tuple[str, ...]
    assumed: tuple[str, ...]


def record_checks(record: Record) -> RecordChecks:
    """Return what was proved of a record and what was assumed; nothing of an analytic motion.

    Examples
    --------
    >>> from seisblock.readers import read
    >>> checks = record_checks(read("synthetic_knet.NS"))
    >>> checks.proved
    ('count', 'peak', 'unit', 'sign', 'instrument', 'repetition')
    >>> checks.assumed
    ('clock',)
    """
    stated = record.metadata.get("proved")
    if not isinstance(stated, tuple):
        return RecordChecks((), ())
    earthquake = get_earthquake(record)
    words = [word for word in CHECK_WORDS if word != "earthquake" or earthquake is not None]
    proved = {*stated, "repetition"}
    if earthquake is not None and earthquake.origin_time is not None and record.start is not None:
        proved.add("earthquake")
    contradicted = {word for flag in record.doubts for word in _WORDS_BY_KIND.get(flag.kind, ())}
    return RecordChecks(
        tuple(word for word in words if word in proved - contradicted),
        tuple(word for word in words if word not in proved | contradicted),
    )


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

"""JSON document of ``seisblock paper``."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from msgspec import Struct

from seisblock.output.json.schema import Document, DocumentSchema, Result, fill
from seisblock.paper import Answer, Inputs, Item, Paper
from seisblock.records import Record
from seisblock.validation.case import Case


class PaperParameters(Struct, frozen=True, kw_only=True):
    """Parameters of the command.

    Parameters
    ----------
    body, stations : str or None
        User's body and table of stations; null: those of the paper.
    """

    body: str | None
    stations: str | None


class DifferenceEntry(Struct, frozen=True, kw_only=True):
    """Statement of the paper that differs.

    Parameters
    ----------
    key : str
        Identifier of the validation case.
    quantity, unit : str
    expected, computed : float or None
        Printed or expected value, and the value computed here.
    cause : str
        As shown, or "cause unknown".
    """

    key: str
    quantity: str
    unit: str
    expected: float | None
    computed: float | None
    cause: str


class ItemEntry(Result, frozen=True, kw_only=True):
    """Figure or table of a paper.

    Parameters
    ----------
    paper, item, title : str
        Citation key, name such as ``fig7``, and contents.
    verdict : str
        ``holds`` or ``differs``, by the validation cases on this item; ``drawn`` where the paper
        prints no value to compare, or the data are the user's.
    case_count : int
        Number of validation cases on this item.
    source : str
        Data behind the rows.
    rows : list of dict
        Table; the unit is part of the key. Empty in the list of items.
    differs : list of DifferenceEntry
        Differences from the paper on its own data, with causes.
    """

    paper: str
    item: str
    title: str
    verdict: str
    case_count: int
    source: str
    rows: list[dict[str, Any]]
    differs: list[DifferenceEntry]


PAPER = DocumentSchema("paper", PaperParameters, ItemEntry)


def verdict(cases: Sequence[Case]) -> str:
    """Return the verdict on an item from the claims of its cases."""
    if not cases:
        return "drawn"
    return "differs" if any(case.status == "differs" for case in cases) else "holds"


def document(pairs: Iterable[tuple[Paper, Item, Answer | None]], inputs: Inputs, *, records: Sequence[Record] = ()) -> Document:
    """Return the document of a computed item, or of the list of items, without answers."""
    is_own = bool(inputs.records or inputs.body or inputs.stations)
    entries = [_entry(paper, item, answer, own=is_own) for paper, item, answer in pairs]
    return PAPER.document(
        PaperParameters(body=inputs.body, stations=inputs.stations),
        ((None, entry) for entry in entries),
        records=records,
        citations=tuple(dict.fromkeys(entry.paper for entry in entries)),
    )


def _entry(paper: Paper, item: Item, answer: Answer | None, *, own: bool) -> ItemEntry:
    # the statements of the paper are about its own data
    cases = [] if own else paper.cases(item)
    rows = [] if answer is None else [dict(zip((c.key for c in answer.columns), row, strict=True)) for row in answer.rows]
    differing = [case for case in cases if case.status == "differs"]
    return fill(
        ItemEntry,
        item,
        paper=paper.key,
        item=item.name,
        verdict=verdict(cases),
        case_count=len(cases),
        source="" if answer is None else answer.source,
        rows=rows,
        differs=[] if answer is None else [difference(case) for case in differing],
    )


def difference(case: Case) -> DifferenceEntry:
    """Return the entry of a differing case; values that take long are those held by the case."""
    return fill(
        DifferenceEntry,
        case,
        expected=None if callable(case.expected) else case.expected,
        computed=None if case.today is None else case.today[0],
        cause=case.note,
    )

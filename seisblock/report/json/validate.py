"""JSON document of ``seisblock validate``."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated

from msgspec import Meta, Struct

from seisblock.output.json.schema import Document, DocumentSchema, Result, fill
from seisblock.validation.case import CaseResult, count_verdicts, count_verdicts_by_kind, sort_by_verdict


class ValidateParameters(Struct, frozen=True, kw_only=True):
    """Parameters of the command.

    Parameters
    ----------
    papers : list of str
    quick : bool
        Whether the cases that take more than a moment were left out.
    """

    papers: tuple[str, ...]
    quick: bool


class CaseEntry(Result, frozen=True, kw_only=True):
    """One statement of a paper.

    Parameters
    ----------
    key, paper, where : str
        Identifier, paper, and equation, table or figure.
    quantity, unit : str
        Compared quantity, and the unit of the four numbers.
    expected, computed, error, tolerance : float
        Published and computed value, difference and tolerance; null if not computed.
    status, verdict : str
        Claimed (``holds``, ``differs``) and actual verdict (``fails`` in addition).
    kind : str
        What it is worth: ``computed`` by the program against what the paper states; from an input ``rebuilt`` or replaced; against what was
        ``derived`` here; or the ``print`` checked against itself.
    today : float or None
        Computed value at the time of the explanation of a difference; null for ``holds``.
    note : str
    """

    key: str
    paper: str
    where: str
    quantity: str
    unit: str
    expected: float
    computed: float | None
    error: float | None
    tolerance: float
    status: str
    verdict: str
    kind: str
    today: float | None
    note: str


COUNT_KEYS = {
    "counts": Annotated[dict[str, int], Meta(description="Number of cases of each verdict.")],
    "counts_by_kind": Annotated[dict[str, dict[str, int]], Meta(description="The same by kind of evidence.")],
}
VALIDATE = DocumentSchema("validate", ValidateParameters, CaseEntry, COUNT_KEYS)


def document(results: Sequence[CaseResult], *, quick: bool) -> Document:
    """Return the document of the evidence: failures first, then differences."""
    papers = tuple(dict.fromkeys(result.case.paper for result in results))
    entries = (
        (
            None,
            fill(
                CaseEntry,
                result,
                result.case,
                where=result.case.place,
                today=None if result.case.today is None else result.case.today[0],
            ),
        )
        for result in sort_by_verdict(results)
    )
    return VALIDATE.document(
        ValidateParameters(papers=papers, quick=quick),
        entries,
        citations=papers,
        counts=count_verdicts(results),
        counts_by_kind=count_verdicts_by_kind(results),
    )

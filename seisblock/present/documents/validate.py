"""What ``seisblock validate`` answers."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated

from msgspec import Meta, Struct

from seisblock.present.documents.kind import Document, Kind, Result
from seisblock.validation.case import CaseResult, counts, ranked


class ValidateParameters(Struct, frozen=True, kw_only=True):
    """What was chosen.

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
        What is compared, and the unit of the four numbers.
    expected, computed, error, tolerance : float
        The paper's value and this machine's, their difference, and what is allowed; null where nothing could be computed.
    status, verdict : str
        What is claimed (``holds``, ``differs``), and what this machine found (``fails`` too).
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
    note: str


VALIDATE = Kind(
    "validate", ValidateParameters, CaseEntry, {"counts": Annotated[dict[str, int], Meta(description="How many cases of each verdict.")]}
)


def document(results: Sequence[CaseResult], *, quick: bool) -> Document:
    """Return the document of the evidence: what fails first, then what differs."""
    papers = tuple(dict.fromkeys(result.case.paper for result in results))
    found = (
        (
            None,
            CaseEntry(
                key=result.case.key,
                paper=result.case.paper,
                where=result.case.place,
                quantity=result.case.quantity,
                unit=result.case.unit,
                expected=result.case.expected,
                computed=result.computed,
                error=result.error,
                tolerance=result.case.tolerance,
                status=result.case.status,
                verdict=result.verdict,
                note=result.case.note,
            ),
        )
        for result in ranked(results)
    )
    return VALIDATE.document(ValidateParameters(papers=papers, quick=quick), found, citations=papers, counts=counts(results))

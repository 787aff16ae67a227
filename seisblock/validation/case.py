"""Validation case: a value from a paper, the program's value, tolerance, kind of evidence and verdict."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal

from seisblock.core.errors import ParameterError, SeisblockError
from seisblock.core.i18n import N_
from seisblock.references import find_citations

EXACT = 1e-12
"""Relative tolerance between two closed forms: round-off only."""

CONVERGED = 1e-8
"""Relative tolerance if one side is integrated numerically: the error of the reference integration."""

REPRODUCIBLE = 1e-6
"""Relative tolerance of a difference that is reproducible on every machine."""

UNKNOWN = "cause unknown"
"""Note of a difference without a shown cause."""

Verdict = Literal["holds", "differs", "fails"]

VERDICTS: tuple[Verdict, ...] = ("fails", "differs", "holds")
"""Verdicts, the most important first."""

EvidenceKind = Literal["computed", "print", "rebuilt", "derived"]

EVIDENCE_KINDS: dict[EvidenceKind, str] = {
    "computed": N_("program against the paper"),
    "rebuilt": N_("program with reconstructed or substitute input"),
    "derived": N_("program against an independent derivation"),
    "print": N_("consistency of printed values"),
}
"""Kinds of evidence, the strongest first, with their description."""


def expected_difference(value: float, tolerance: float = 0.0) -> tuple[float, float]:
    """Return today's value of a difference and its tolerance, by default :data:`REPRODUCIBLE` relative.

    Parameters
    ----------
    value : float
    tolerance : float
        Absolute, in the case's unit.
    """
    return value, tolerance or REPRODUCIBLE * abs(value)


@dataclass(frozen=True)
class Case:
    """One checkable statement of a paper.

    Parameters
    ----------
    key : str
        Unique identifier, for example ``sugimoto-1b``.
    where : str
        Paper and locator in the citation grammar: ``[Sugimoto2017]_ eq. (1b)``.
    quantity, unit : str
        Compared quantity and its SI unit (``1`` for none).
    expected : float, or a callable that returns one
        The paper's value, or that of an independent derivation; a callable if it takes time.
    tolerance : float
        Largest admissible absolute difference, in `unit`: half the last printed digit, round-off of a closed form, or a reading error.
    compute : callable
        Returns the program's value, a float in `unit`.
    status : "holds" or "differs"
        Claim. "differs" cases lie outside `tolerance`: the note states the cause, and `today` the value. A case that starts to agree, or
        to differ by another amount, fails, so that its explanation is reviewed.
    note : str
        Source of the expected value, and for "differs" the cause.
    kind : "computed", "rebuilt", "derived" or "print"
        Kind of evidence: program with the paper's input against the paper's value; with a reconstructed or substitute input; against a
        value derived independently; or consistency of printed values.
    today : (float, float) or None
        For "differs": the program's value at the time of the explanation, and its tolerance, see :func:`expected_difference`.
    quick : bool
        Whether the case belongs to ``validate --quick``.
    """

    key: str
    where: str
    quantity: str
    unit: str
    expected: float | Callable[[], float]
    tolerance: float
    compute: Callable[[], float]
    status: Literal["holds", "differs"] = "holds"
    note: str = ""
    kind: EvidenceKind = "computed"
    today: tuple[float, float] | None = None
    quick: bool = True

    def __post_init__(self) -> None:
        if self.status == "differs" and not self.note:
            raise ParameterError("case {key}: `note` required: the cause of the difference", key=self.key)

    @property
    def paper(self) -> str:
        """Citation key of the paper."""
        return find_citations([self.where])[0]

    @property
    def place(self) -> str:
        """Equation, table or figure."""
        return re.sub(r"^\[\w+\]_\s*", "", self.where)

    def run(self) -> CaseResult:
        """Compute the value and its verdict; a case that raises an error of this package fails."""
        expected = float(self.expected() if callable(self.expected) else self.expected)
        try:
            value = float(self.compute())
        except SeisblockError:
            value = math.nan
        inside = abs(value - expected) <= self.tolerance
        verdict: Verdict = "fails"
        if self.status == "holds" and inside:
            verdict = "holds"
        elif self.status == "differs" and not inside and self._matches_explanation(value):
            verdict = "differs"
        return CaseResult(self, expected, value, verdict)

    def _matches_explanation(self, value: float) -> bool:
        """Return whether a differing value equals the explained one within its tolerance."""
        return math.isfinite(value) if self.today is None else abs(value - self.today[0]) <= self.today[1]


@dataclass(frozen=True)
class CaseResult:
    """A case with the program's value and the verdict on this machine."""

    case: Case
    expected: float
    computed: float
    verdict: Verdict

    @property
    def error(self) -> float:
        """Computed minus expected value, in the case's unit."""
        return self.computed - self.expected


def sort_by_verdict(results: Sequence[CaseResult]) -> list[CaseResult]:
    """Return the results sorted by verdict: failed, differing, holding; stable within a verdict."""
    return sorted(results, key=lambda result: VERDICTS.index(result.verdict))


def count_verdicts(results: Sequence[CaseResult]) -> dict[Verdict, int]:
    """Return the number of cases per verdict."""
    counter = Counter(result.verdict for result in results)
    return {verdict: counter[verdict] for verdict in VERDICTS}


def count_verdicts_by_kind(results: Sequence[CaseResult]) -> dict[EvidenceKind, dict[Verdict, int]]:
    """Return the number of cases per kind of evidence and verdict."""
    return {kind: count_verdicts([result for result in results if result.case.kind == kind]) for kind in EVIDENCE_KINDS}

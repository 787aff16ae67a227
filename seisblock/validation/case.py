"""A validation case: one number of a paper, what the program makes of it, what that is worth, and the verdict."""

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
"""Relative tolerance where both sides are closed forms: round-off and nothing else."""

CONVERGED = 1e-8
"""Relative tolerance where one side is integrated: the error of the reference integration."""

REPRODUCIBLE = 1e-6
"""Relative tolerance of a difference that comes out alike on every machine."""

Verdict = Literal["holds", "differs", "fails"]

VERDICTS: tuple[Verdict, ...] = ("fails", "differs", "holds")
"""What matters most first."""

EvidenceKind = Literal["computed", "print", "rebuilt", "derived"]

EVIDENCE_KINDS: dict[EvidenceKind, str] = {
    "computed": N_("computed by the program, against what the paper states"),
    "rebuilt": N_("computed from an input that was rebuilt, or stands in for the paper's own"),
    "derived": N_("computed by the program, against what was derived here"),
    "print": N_("the print checked against itself"),
}
"""What a case is worth as evidence, the most first, in words."""


def expected_difference(value: float, tolerance: float = 0.0) -> tuple[float, float]:
    """Return today's value of a difference, and how near it must stay: by default within :data:`REPRODUCIBLE` of itself.

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
        What is compared, in words, and its SI unit (``1`` for none).
    expected : float, or a callable that returns one
        The paper's value, or that of the independent derivation; one that takes time to derive is a callable.
    tolerance : float
        Largest admissible absolute difference, in `unit`: half the last digit printed, a closed form's round-off, or a
        stated reading error.
    compute : callable
        Returns the program's value, a float in `unit`.
    status : "holds" or "differs"
        What is claimed. "differs" cases lie outside `tolerance`: the note says why, and `today` by how much. One that starts to
        agree, or to differ by another amount, fails, so that the explanation is looked at again.
    note : str
        Provenance of the expected value, and for "differs" the explanation.
    kind : "computed", "rebuilt", "derived" or "print"
        What it is worth: whether the program runs from the paper's own input against the paper's own statement; from an input that had
        to be rebuilt or replaced; against a value that the paper does not state but that follows from it; or whether the print is only
        checked against itself.
    today : (float, float) or None
        For "differs": the program's value when the difference was explained, and how near it must stay, see :func:`expected_difference`.
    quick : bool
        Whether it belongs to ``validate --quick``.
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
            raise ParameterError("case {key}: a difference needs its explanation in the note", key=self.key)

    @property
    def paper(self) -> str:
        """Key of the paper."""
        return find_citations([self.where])[0]

    @property
    def place(self) -> str:
        """Equation, table or figure."""
        return re.sub(r"^\[\w+\]_\s*", "", self.where)

    def run(self) -> CaseResult:
        """Compute the value and judge it; what cannot be computed fails."""
        expected = float(self.expected() if callable(self.expected) else self.expected)
        try:
            computed = float(self.compute())
        except SeisblockError:
            computed = math.nan
        inside = abs(computed - expected) <= self.tolerance
        verdict: Verdict = "fails"
        if self.status == "holds" and inside:
            verdict = "holds"
        elif self.status == "differs" and not inside and self._matches_explanation(computed):
            verdict = "differs"
        return CaseResult(self, expected, computed, verdict)

    def _matches_explanation(self, computed: float) -> bool:
        """Whether a value that differs is the one that was explained."""
        return math.isfinite(computed) if self.today is None else abs(computed - self.today[0]) <= self.today[1]


@dataclass(frozen=True)
class CaseResult:
    """A case with the program's value and the verdict on this machine."""

    case: Case
    expected: float
    computed: float
    verdict: Verdict

    @property
    def error(self) -> float:
        """Computed less expected, in the case's unit."""
        return self.computed - self.expected


def sort_by_verdict(results: Sequence[CaseResult]) -> list[CaseResult]:
    """Return the results with what fails first, then what differs; otherwise in their order."""
    return sorted(results, key=lambda result: VERDICTS.index(result.verdict))


def count_verdicts(results: Sequence[CaseResult]) -> dict[Verdict, int]:
    """Return how many cases got each verdict."""
    counter = Counter(result.verdict for result in results)
    return {verdict: counter[verdict] for verdict in VERDICTS}


def count_verdicts_by_kind(results: Sequence[CaseResult]) -> dict[EvidenceKind, dict[Verdict, int]]:
    """Return how many cases of each kind got each verdict."""
    return {kind: count_verdicts([result for result in results if result.case.kind == kind]) for kind in EVIDENCE_KINDS}

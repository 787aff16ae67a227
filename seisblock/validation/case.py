"""A validation case: one number of a paper, what the program makes of it, and the verdict."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal

from seisblock.errors import ParameterError, SeisblockError

EXACT = 1e-12
"""Relative tolerance where both sides are closed forms: round-off and nothing else."""

CONVERGED = 1e-8
"""Relative tolerance where one side is integrated: the error of the reference integration."""

Verdict = Literal["holds", "differs", "fails"]

VERDICTS: tuple[Verdict, ...] = ("fails", "differs", "holds")
"""What matters most first."""


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
    expected : float
        The paper's value, or that of the independent derivation.
    tolerance : float
        Largest admissible absolute difference, in `unit`: half the last digit printed, a closed form's round-off, or a
        stated reading error.
    compute : callable
        Returns the program's value, a float in `unit`.
    status : "holds" or "differs"
        What is claimed. "differs" cases are expected to lie outside `tolerance`: the note says why, and a "differs" that
        starts to agree fails, so that the explanation is looked at again.
    note : str
        Provenance of the expected value, and for "differs" the explanation.
    quick : bool
        Whether it belongs to ``validate --quick``.
    """

    key: str
    where: str
    quantity: str
    unit: str
    expected: float
    tolerance: float
    compute: Callable[[], float]
    status: Literal["holds", "differs"] = "holds"
    note: str = ""
    quick: bool = True

    def __post_init__(self) -> None:
        if self.status == "differs" and not self.note:
            raise ParameterError(f"case {self.key}: a difference needs its explanation in the note")

    @property
    def paper(self) -> str:
        """Key of the paper."""
        found = re.match(r"\[(\w+)\]_", self.where)
        return found.group(1) if found else self.key.split("-")[0]

    @property
    def place(self) -> str:
        """Equation, table or figure."""
        return re.sub(r"^\[\w+\]_\s*", "", self.where)

    def run(self) -> CaseResult:
        """Compute the value and judge it; what cannot be computed fails."""
        try:
            computed = float(self.compute())
        except SeisblockError:
            computed = math.nan
        inside = abs(computed - self.expected) <= self.tolerance
        verdict: Verdict = "fails"
        if self.status == "holds" and inside:
            verdict = "holds"
        elif self.status == "differs" and not inside and math.isfinite(computed):
            verdict = "differs"
        return CaseResult(self, computed, verdict)


@dataclass(frozen=True)
class CaseResult:
    """A case with the program's value and the verdict on this machine."""

    case: Case
    computed: float
    verdict: Verdict

    @property
    def error(self) -> float:
        """Computed less expected, in the case's unit."""
        return self.computed - self.case.expected


def ranked(results: Sequence[CaseResult]) -> list[CaseResult]:
    """Return the results with what fails first, then what differs; otherwise in their order."""
    return sorted(results, key=lambda result: VERDICTS.index(result.verdict))


def counts(results: Sequence[CaseResult]) -> dict[str, int]:
    """Return how many cases got each verdict."""
    counted = Counter(result.verdict for result in results)
    return {verdict: counted[verdict] for verdict in VERDICTS}

"""Validation cases: one module per paper, each with a tuple `CASES`."""

from __future__ import annotations

import importlib
from collections.abc import Sequence

from seisblock.core.errors import ParameterError
from seisblock.validation.case import CONVERGED, EXACT, Case, CaseResult

PAPERS: tuple[str, ...] = (
    "fujino",
    "sugimoto",
    "okumura",
    "tsutsui",
    "housner",
    "furukawa_rocking",
    "furukawa",
    "furukawa_field",
    "edge_wear",
    "furukawa_pile",
    "furukawa_dowel",
    "stack_steps",
    "stack_round",
    "fema_p58",
    "jma_furniture",
    "cube_tosses",
)
"""Modules of this package that export CASES."""


def cases(paper: str | None = None) -> list[Case]:
    """Return the cases of one module, or of all."""
    names = PAPERS if paper is None else (paper,)
    return [case for name in names for case in importlib.import_module(f"seisblock.validation.{name}").CASES]


def cases_of(papers: Sequence[str] = ()) -> list[Case]:
    """Return the cases whose citation key starts with any of the given names, case-insensitive; all cases without a name.

    Raises
    ------
    ParameterError
        If no case cites such a paper.
    """
    all_cases = cases()
    paper_keys = tuple(dict.fromkeys(case.paper for case in all_cases))
    for name in papers:
        if not name or not any(paper.lower().startswith(name.lower()) for paper in paper_keys):
            available = list(paper_keys)
            raise ParameterError("no validation case for {name!r}; available papers: {there_are}", name=name, there_are=available)
    return [case for case in all_cases if not papers or any(case.paper.lower().startswith(name.lower()) for name in papers)]


__all__ = ["CONVERGED", "EXACT", "PAPERS", "Case", "CaseResult", "cases", "cases_of"]

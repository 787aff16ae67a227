"""The evidence: one module per paper, each exporting CASES."""

from __future__ import annotations

import importlib

from seisblock.validation.case import CONVERGED, EXACT, Case, CaseResult

PAPERS: tuple[str, ...] = (
    "sugimoto",
    "okumura",
)
"""Modules of this package that export CASES."""


def cases(paper: str | None = None) -> list[Case]:
    """Return the cases of one paper's module, or of all."""
    names = PAPERS if paper is None else (paper,)
    return [case for name in names for case in importlib.import_module(f"seisblock.validation.{name}").CASES]


__all__ = ["CONVERGED", "EXACT", "PAPERS", "Case", "CaseResult", "cases"]

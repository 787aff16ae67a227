"""Vectorised solution of the bodies of a batch under one motion."""

from __future__ import annotations

from collections.abc import Sequence

from seisblock.core._display import exact_repr
from seisblock.core.errors import SeisblockError
from seisblock.core.registry import RowResult, Solver, SolverBody
from seisblock.records import Motion


def solve_vectorized(solver: Solver, bodies: Sequence[SolverBody], motion: Motion) -> dict[str, RowResult]:
    """Return results by body name for the bodies that a solver can vectorise; the others are solved one by one."""
    if solver.solve_rows is None:
        return {}
    groups: dict[str, list[SolverBody]] = {}
    for body in bodies:
        shared = {key: value for key, value in body.options.keywords().items() if key not in solver.row_options}
        groups.setdefault(exact_repr(shared), []).append(body)
    results: dict[str, RowResult] = {}
    for group in groups.values():
        try:
            results |= solver.solve_rows(group, motion)
        except SeisblockError:
            # solved one by one, the failing body is identified with its reason
            continue
    return results

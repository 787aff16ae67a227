"""Vectorised solution of the bodies of a batch under one motion."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias

from seisblock.core.errors import SeisblockError
from seisblock.models.jump.batch import jump_many
from seisblock.models.jump.describe import chain_warnings
from seisblock.models.uplift.batch import uplift_many
from seisblock.models.uplift.outcome import warnings as uplift_warnings
from seisblock.records import Motion
from seisblock.records._validation import vertical_gain

if TYPE_CHECKING:
    from seisblock.studies.batch.models import SolverBody

RowResult: TypeAlias = "tuple[Mapping[str, Any], Sequence[str]]"
"""Scalar outcome fields and warnings."""


def solve_vectorized(solver: str, bodies: Sequence[SolverBody], motion: Motion) -> dict[str, RowResult]:
    """Return results by body name for the bodies that a solver can vectorise; the others are solved one by one.

    Parameters
    ----------
    solver : str
    bodies : sequence of SolverBody
    motion : Motion
    """
    if solver not in VECTORIZED_SOLVERS:
        return {}
    solve, row_options = VECTORIZED_SOLVERS[solver]
    groups: dict[str, list[SolverBody]] = {}
    for body in bodies:
        groups.setdefault(repr({key: value for key, value in body.options.items() if key not in row_options}), []).append(body)
    results: dict[str, RowResult] = {}
    for group in groups.values():
        shared_options = {key: value for key, value in group[0].options.items() if key not in row_options}
        try:
            results |= solve(group, motion, **shared_options)
        except (SeisblockError, TypeError):
            # solved one by one, the failing body is identified with its reason
            continue
    return results


def _solve_uplifts(bodies: Sequence[SolverBody], motion: Motion, **shared: Any) -> dict[str, RowResult]:
    """Solve blocks on springs; stopped runs are repeated one by one for their reason."""
    gains = [(1.0, 1.0, vertical_gain(motion, body.options.get("vertical"))) for body in bodies]
    result = uplift_many([body.body for body in bodies], motion, gains=gains, **shared)
    return {
        body.name: (result.row_dict(row, motion.start_s), uplift_warnings(motion, result, row))
        for row, body in enumerate(bodies)
        if not result.gave_up[row]
    }


def _solve_jumps(bodies: Sequence[SolverBody], motion: Motion, **shared: Any) -> dict[str, RowResult]:
    """Solve two-layer blocks; jammed feet and stopped runs have no result."""
    contacts, drop = [body.options["contact"] for body in bodies], [body.options.get("drop", 0.0) for body in bodies]
    result = jump_many([body.body for body in bodies], motion, contacts=contacts, drop=drop, **shared)
    return {
        body.name: (
            {**result.row_dict(row), "landing": shared.get("landing", "paper")},
            chain_warnings(motion, result.row_chains(row, motion.start_s), contact.mu),
        )
        for row, (body, contact) in enumerate(zip(bodies, contacts, strict=True))
        if not (result.jammed[row] or result.gave_up[row])
    }


VECTORIZED_SOLVERS: dict[str, tuple[Callable[..., dict[str, RowResult]], tuple[str, ...]]] = {
    "uplift": (_solve_uplifts, ("vertical",)),
    "jump": (_solve_jumps, ("contact", "drop")),
}
"""Vectorised solver and the options that may differ between rows."""

"""Probability columns of a batch: share of samples of body and motion in which the body overturns or moves."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from seisblock.core.registry import SolverBody
from seisblock.records import Motion
from seisblock.studies.parallel import left_out_versions
from seisblock.studies.respond.probability import respond_probability
from seisblock.studies.rocking.perturb import perturb

Row = dict[str, Any]

LEFT_OUT = "left_out"
"""Key of the warning on samples without a result; not a column."""

PROBABILITY_COLUMNS: Mapping[str, type] = {
    "runs": int,
    "probability_overturned": float,
    "probability_low": float,
    "probability_high": float,
}
MOVED_COLUMNS: Mapping[str, type] = {**PROBABILITY_COLUMNS, "probability_moved": float}


def respond_probability_columns(solver_body: SolverBody, motion: Motion, runs: int, seed: int) -> Row:
    """Return the probability columns of a free-standing body."""
    result = respond_probability(solver_body.body, motion, solver_body.options, runs=runs, seed=seed)
    low, high = result.interval
    return _probability_columns(result.runs, result.overturned, low, high, result.no_answer) | {"probability_moved": result.moved}


def rock_probability_columns(solver_body: SolverBody, motion: Motion, runs: int, seed: int) -> Row:
    """Return the probability columns of a rocking block."""
    result = perturb(solver_body.body, motion, runs, seed=seed, options=solver_body.options)
    return _probability_columns(result.runs, result.probability, *result.probability_interval, result.no_answer)


def _probability_columns(runs: int, overturned: float, low: float, high: float, no_answer: tuple[int, ...]) -> Row:
    """Return an overturning probability as columns, with a warning for samples without a result."""
    row: Row = {"runs": runs, "probability_overturned": overturned, "probability_low": low, "probability_high": high}
    warning = left_out_versions(no_answer, runs)
    return row if warning is None else {**row, LEFT_OUT: warning}

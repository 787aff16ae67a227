"""Probability columns of a batch: share of samples of body and motion in which the body overturns or moves, and its class."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from seisblock.core.registry import SolverBody
from seisblock.records import Motion
from seisblock.studies.assessment import classify
from seisblock.studies.parallel import left_out_versions
from seisblock.studies.sampling import sample

Row = dict[str, Any]

LEFT_OUT = "left_out"
"""Key of the warning on samples without a result; not a column."""

PROBABILITY_COLUMNS: Mapping[str, type] = {
    "runs": int,
    "probability_overturned": float,
    "probability_low": float,
    "probability_high": float,
    "probability_moved": float,
    "overturning_probability": float,
    "moved_probability": float,
    "class": str,
}
"""Columns and their types; `probability_overturned` and `probability_moved` are the older names of two of them."""


def probability_columns(solver: str, solver_body: SolverBody, motion: Motion, runs: int, seed: int) -> Row:
    """Return the probability columns of a body, with a warning for samples without a result."""
    samples = sample(solver, solver_body.body, motion, solver_body.options, runs, seed=seed)
    overturned, moved, (low, high) = samples.probability, samples.moved_probability(), samples.interval
    row: Row = {
        "runs": samples.completed,
        "probability_overturned": overturned,
        "probability_low": low,
        "probability_high": high,
        "probability_moved": moved,
        "overturning_probability": overturned,
        "moved_probability": moved,
        "class": classify(overturned, moved),
    }
    warning = left_out_versions(samples.stopped, samples.completed)
    return row if warning is None else {**row, LEFT_OUT: warning}

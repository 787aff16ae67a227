"""Worst azimuth of a body under a record, as in the single commands."""

from __future__ import annotations

from typing import TypeAlias

from seisblock.core.registry import SolverBody
from seisblock.records import Record
from seisblock.records.motion import azimuth_name
from seisblock.studies.azimuth_probability import solve_azimuths
from seisblock.studies.respond.azimuths import left_out_directions

DIRECTIONS, FALLEN_DIRECTIONS = "directions", "directions_overturned"
"""Columns of azimuth sweeps: number of directions, and number of those with overturning."""

Worst: TypeAlias = tuple[str, dict[str, int], list[str]]
"""Worst direction, counts of directions, and warnings."""


def worst_direction(solver: str, body: SolverBody, record: Record, runs: int, seed: int) -> Worst:
    """Return the worst direction of a body: with samples the most probable one, else that of the single runs."""
    results = solve_azimuths(solver, body.body, record, body.options, runs, seed=seed)
    fall_count, solved_count = sum(result.overturned for result in results), sum(not result.gave_up for result in results)
    counts = {DIRECTIONS: solved_count, FALLEN_DIRECTIONS: fall_count}
    return azimuth_name(record, results[0].azimuth_deg), counts, left_out_directions(results)

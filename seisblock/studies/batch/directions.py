"""Worst azimuth of a body under a record, as in the single commands."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

from seisblock.bodies.sliding_base import SlidingBase
from seisblock.core.registry import SolverBody
from seisblock.records import Record, motion_of
from seisblock.records._validation import vertical_gain
from seisblock.studies.azimuths import sweep_azimuths
from seisblock.studies.respond.azimuths import RespondAzimuth, left_out_directions, respond_directions
from seisblock.studies.rocking.azimuths import RockAzimuth, rock_directions
from seisblock.studies.sliding import slide_study, worst_directions

DIRECTIONS, FALLEN_DIRECTIONS = "directions", "directions_overturned"
"""Columns of azimuth sweeps: number of directions, and number of those with overturning."""

Worst: TypeAlias = tuple[str, dict[str, int], list[str]]
"""Worst direction, counts of directions, and warnings."""


def worst_rock(solver_body: SolverBody, record: Record) -> Worst:
    """Return the worst direction of a rocking block."""
    return _worst_result(rock_directions(solver_body.body, record, options=solver_body.options))


def worst_respond(solver_body: SolverBody, record: Record) -> Worst:
    """Return the worst direction of a free-standing body."""
    return _worst_result(respond_directions(solver_body.body, record, solver_body.options))


def _worst_result(results: Sequence[RespondAzimuth] | Sequence[RockAzimuth]) -> Worst:
    """Return the first (worst) direction with the number of directions solved and of those with overturning."""
    fall_count, solved_count = sum(result.overturned for result in results), sum(not result.gave_up for result in results)
    return f"{results[0].azimuth_deg:g}", {DIRECTIONS: solved_count, FALLEN_DIRECTIONS: fall_count}, left_out_directions(results)


def worst_slide(solver_body: SolverBody, record: Record) -> Worst:
    """Return the worst direction of a sliding object."""
    base = solver_body.body if isinstance(solver_body.body, SlidingBase) else SlidingBase(solver_body.body)
    motions = [motion_of(record, f"{azimuth:g}") for azimuth in sweep_azimuths(base)]
    points = slide_study(
        base.mu,
        motions=motions,
        mu_kinetic=base.kinetic,
        slope_deg=base.slope_deg,
        slope_length=base.slope_length,
        one_way=base.one_way,
        vertical=vertical_gain(motions[0], solver_body.options.vertical),
        gravity=solver_body.options.gravity,
        workers=1,
    )
    return worst_directions(points)[0].component, {DIRECTIONS: len(points)}, []

"""Worst azimuth of a body under a record, as in the single commands."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

from seisblock.bodies.sliding_base import SlidingBase
from seisblock.core.registry import SolverBody
from seisblock.records import Record, motion_of
from seisblock.records._validation import vertical_gain
from seisblock.records.motion import azimuth_name
from seisblock.studies.azimuth_probability import Azimuth, rank_by_probability
from seisblock.studies.azimuths import sweep_azimuths
from seisblock.studies.respond.azimuths import RespondAzimuth, left_out_directions, respond_directions
from seisblock.studies.rocking.azimuths import RockAzimuth, rock_directions
from seisblock.studies.sampling import ParameterVariation
from seisblock.studies.sliding import slide_study, worst_directions

DIRECTIONS, FALLEN_DIRECTIONS = "directions", "directions_overturned"
"""Columns of azimuth sweeps: number of directions, and number of those with overturning."""

Worst: TypeAlias = tuple[str, dict[str, int], list[str]]
"""Worst direction, counts of directions, and warnings."""


def worst_rock(solver_body: SolverBody, record: Record, runs: int, seed: int) -> Worst:
    """Return the worst direction of a rocking block: with samples the most probable one, else that of the single runs."""
    results = rock_directions(solver_body.body, record, options=solver_body.options)
    return _worst_result(record, _ranked("rock", solver_body, record, results, runs, seed))


def worst_respond(solver_body: SolverBody, record: Record, runs: int, seed: int) -> Worst:
    """Return the worst direction of a free-standing body: with samples the most probable one, else that of the single runs."""
    results = respond_directions(solver_body.body, record, solver_body.options)
    return _worst_result(record, _ranked("respond", solver_body, record, results, runs, seed))


def _ranked(solver: str, body: SolverBody, record: Record, results: list[Azimuth], runs: int, seed: int) -> list[Azimuth]:
    """Return the directions in the order of their probability; without samples as they are."""
    if not runs or not any(result.moves for result in results):
        return results
    return rank_by_probability(solver, body.body, record, results, body.options, runs, ParameterVariation(), seed=seed)


def _worst_result(record: Record, results: Sequence[RespondAzimuth] | Sequence[RockAzimuth]) -> Worst:
    """Return the first (worst) direction with the number of directions solved and of those with overturning."""
    fall_count, solved_count = sum(result.overturned for result in results), sum(not result.gave_up for result in results)
    counts = {DIRECTIONS: solved_count, FALLEN_DIRECTIONS: fall_count}
    return azimuth_name(record, results[0].azimuth_deg), counts, left_out_directions(results)


def worst_slide(solver_body: SolverBody, record: Record, runs: int, seed: int) -> Worst:
    """Return the worst direction of a sliding object."""
    base = solver_body.body if isinstance(solver_body.body, SlidingBase) else SlidingBase(solver_body.body)
    motions = [motion_of(record, azimuth_name(record, azimuth)) for azimuth in sweep_azimuths(base)]
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

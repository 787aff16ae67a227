"""``all-azimuths`` in a batch: worst azimuth of each body and record, as in the single commands."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeAlias

from seisblock.bodies.sliding_base import SlidingBase
from seisblock.core.errors import ParameterError
from seisblock.records import Record, motion_of
from seisblock.records._validation import vertical_gain
from seisblock.records.motion import ALL_AZIMUTHS
from seisblock.studies.azimuths import sweep_azimuths
from seisblock.studies.batch.models import SolverBody
from seisblock.studies.batch.table import DIRECTIONS, FALLEN_DIRECTIONS
from seisblock.studies.respond.azimuths import RespondAzimuth, left_out_directions, respond_directions
from seisblock.studies.rocking.azimuths import RockAzimuth, rock_directions
from seisblock.studies.sliding import slide_study, worst_directions


def is_all_azimuths(components: Sequence[str]) -> bool:
    """Return whether all azimuths are requested."""
    return any(name.lower() == ALL_AZIMUTHS for name in components)


def check_all_azimuths(solver: str, components: Sequence[str], options: Mapping[str, Any]) -> None:
    """Raise for components and options incompatible with all azimuths.

    Raises
    ------
    ParameterError
        If other components are given, or the solver or an option does not support all azimuths.
    """
    if not is_all_azimuths(components):
        return
    if len(components) > 1:
        raise ParameterError("{name} covers all azimuths: give no other component", name=ALL_AZIMUTHS)
    if solver not in DIRECTIONAL_SOLVERS:
        raise ParameterError("{solver} does not support all azimuths; available: {known}", solver=solver, known=list(DIRECTIONAL_SOLVERS))
    allowed = DIRECTIONAL_SOLVERS[solver][1]
    unknown = [f"`{name}`" for name in options if name not in allowed]
    if unknown:
        raise ParameterError("{solver} in all azimuths has no option {names}: omit it", solver=solver, names=unknown)


Worst: TypeAlias = tuple[str, dict[str, int], list[str]]
"""Worst direction, counts of directions, and warnings."""


def worst_azimuth(solver: str, solver_body: SolverBody, record: Record) -> Worst:
    """Return the worst direction of a record for a body, and the number of directions.

    Parameters
    ----------
    solver : str
    solver_body : SolverBody
    record : Record
        With two horizontal components of known azimuths.
    """
    return DIRECTIONAL_SOLVERS[solver][0](solver_body, record)


def _worst_rock(solver_body: SolverBody, record: Record) -> Worst:
    return _worst_result(rock_directions(solver_body.body, record, **solver_body.options))


def _worst_respond(solver_body: SolverBody, record: Record) -> Worst:
    return _worst_result(respond_directions(solver_body.body, record, **solver_body.options))


def _worst_result(results: Sequence[RespondAzimuth] | Sequence[RockAzimuth]) -> Worst:
    """Return the first (worst) direction with the number of directions solved and of those with overturning."""
    fall_count, solved_count = sum(result.overturned for result in results), sum(not result.gave_up for result in results)
    return f"{results[0].azimuth_deg:g}", {DIRECTIONS: solved_count, FALLEN_DIRECTIONS: fall_count}, left_out_directions(results)


def _worst_slide(solver_body: SolverBody, record: Record) -> Worst:
    base = solver_body.body if isinstance(solver_body.body, SlidingBase) else SlidingBase(solver_body.body)
    motions = [motion_of(record, f"{azimuth:g}") for azimuth in sweep_azimuths(base)]
    points = slide_study(
        base.mu,
        motions=motions,
        mu_kinetic=base.kinetic,
        slope_deg=base.slope_deg,
        slope_length=base.slope_length,
        one_way=base.one_way,
        vertical=vertical_gain(motions[0], solver_body.options.get("vertical", False)),
        **{key: value for key, value in solver_body.options.items() if key != "vertical"},
        workers=1,
    )
    return worst_directions(points)[0].component, {DIRECTIONS: len(points)}, []


DIRECTIONAL_SOLVERS: dict[str, tuple[Callable[[SolverBody, Record], Worst], tuple[str, ...]]] = {
    "respond": (_worst_respond, ("mu", "mu_kinetic", "restitution", "rocking_restitution", "gravity", "tenon", "settle_s", "vertical")),
    "rock": (_worst_rock, ("restitution", "linear", "vertical", "gravity")),
    "slide": (_worst_slide, ("mu", "mu_kinetic", "vertical", "gravity")),
}
"""Worst-azimuth function of each solver, and the options that it accepts."""

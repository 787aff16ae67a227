"""``all-azimuths`` in a batch: each body in every direction of each record, and the answer for the worst, as single commands have it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeAlias

from seisblock.bodies.sliding_base import SlidingBase
from seisblock.errors import ParameterError
from seisblock.records import Record, motion_of
from seisblock.records.given import vertical_gain
from seisblock.records.motion import ALL_AZIMUTHS
from seisblock.studies.azimuths import azimuths_of
from seisblock.studies.batch.models import Placed
from seisblock.studies.batch.table import DIRECTIONS, FALLEN
from seisblock.studies.rocking.azimuths import RockAzimuth, rock_directions
from seisblock.studies.sliding import slide_study, worst_directions
from seisblock.studies.standing.azimuths import AzimuthFate, left_out_directions, respond_directions


def around(components: Sequence[str]) -> bool:
    """Return whether every direction is asked for."""
    return any(name.lower() == ALL_AZIMUTHS for name in components)


def check_around(solver: str, components: Sequence[str], options: Mapping[str, Any]) -> None:
    """Refuse what does not go with every direction.

    Raises
    ------
    ParameterError
        If components are named beside it, the solver looks in none, or has options that act in one direction only.
    """
    if not around(components):
        return
    if len(components) > 1:
        raise ParameterError("{name} stands for every direction: name no component beside it", name=ALL_AZIMUTHS)
    if solver not in WORST:
        raise ParameterError("{solver} does not look in every direction; {known} do", solver=solver, known=list(WORST))
    known = WORST[solver][1]
    unknown = [f"`{name}`" for name in options if name not in known]
    if unknown:
        raise ParameterError("{solver} in every direction has no option {names}: leave it out", solver=solver, names=unknown)


Worst: TypeAlias = tuple[str, dict[str, int], list[str]]
"""A direction, in how many it was looked for, and what is to be known of them."""


def worst_azimuth(solver: str, placed: Placed, record: Record) -> Worst:
    """Return the direction in which a record is worst for a body, and in how many it was looked for.

    Parameters
    ----------
    solver : str
    placed : Placed
    record : Record
        With two horizontal components of known azimuths.
    """
    return WORST[solver][0](placed, record)


def _rocking(placed: Placed, record: Record) -> Worst:
    """Look at a block that rocks."""
    return _counted(rock_directions(placed.body, record, **placed.options))


def _standing(placed: Placed, record: Record) -> Worst:
    """Look at a free-standing body."""
    return _counted(respond_directions(placed.body, record, **placed.options))


def _counted(found: Sequence[AzimuthFate] | Sequence[RockAzimuth]) -> Worst:
    """Count the directions that have an answer, the worst of which comes first, and those in which the body falls."""
    fallen, answered = sum(each.overturned for each in found), sum(not each.gave_up for each in found)
    return f"{found[0].azimuth_deg:g}", {DIRECTIONS: answered, FALLEN: fallen}, left_out_directions(found)


def _sliding(placed: Placed, record: Record) -> Worst:
    """Look at an object that slides."""
    base = placed.body if isinstance(placed.body, SlidingBase) else SlidingBase(placed.body)
    motions = [motion_of(record, f"{azimuth:g}") for azimuth in azimuths_of(base)]
    points = slide_study(
        base.mu,
        motions=motions,
        mu_kinetic=base.kinetic,
        slope_deg=base.slope_deg,
        slope_length=base.slope_length,
        one_way=base.one_way,
        vertical=vertical_gain(motions[0], placed.options.get("vertical", False)),
        **{key: value for key, value in placed.options.items() if key != "vertical"},
        workers=1,
    )
    return worst_directions(points)[0].component, {DIRECTIONS: len(points)}, []


WORST: dict[str, tuple[Callable[[Placed, Record], Worst], tuple[str, ...]]] = {
    "respond": (_standing, ("mu", "mu_kinetic", "restitution", "rocking_restitution", "gravity", "tenon", "settle_s", "vertical")),
    "rock": (_rocking, ("restitution", "linear", "vertical", "gravity")),
    "slide": (_sliding, ("mu", "mu_kinetic", "vertical", "gravity")),
}
"""What looks in every direction, and the options that act in each."""

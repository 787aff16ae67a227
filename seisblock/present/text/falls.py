"""How the falls of a pile's stones are told: one by itself, some together, or one after the other."""

from __future__ import annotations

import math
from collections.abc import Sequence

from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import GROUND
from seisblock.present.directions import pointed
from seisblock.records import Motion
from seisblock.results import Response
from seisblock.solvers.stack.outcome import StackOutcome, StoneFate
from seisblock.words import listed, noted, tell

TOGETHER = 0.5
"""Stones of which the last falls so soon after the first fall together, s: so long a stone takes from 1.2 m to the ground."""

ABOUT = 45.0
"""To about one side fall those that fall within so many degrees of their mean direction."""

NAMED = 6
"""How many stones a sentence names."""


def fallen(response: Response[StackOutcome]) -> list[StoneFate]:
    """Return the stones that fell, in the order of time."""
    return sorted((stone for stone in response.outcome.stones if stone.fell_at_s is not None), key=_at)


def told_falls(response: Response[StackOutcome]) -> str:
    """Return in a sentence what fell, when and to which side; nothing where all stand."""
    falls, motion = fallen(response), response.motion
    if len(falls) < 2:
        return "".join(_alone(stone, motion) for stone in falls)
    if fell_together(falls):
        where = {"time": _at(falls[0]), "side": pointed(_mean_direction(falls), motion)}
        return tell("{stones} fell together at {time:.2f} s, to about {side}.", stones=_called(falls, response.body), **where)
    first, last = falls[0], falls[-1]
    began = {"stone": tell(first.name), "time": _at(first), "side": pointed(_to(first), motion), "end": _at(last)}
    if len(falls) == 2:
        text = noted("{stone} fell first, at {time:.2f} s to {side}; then {other}, at {end:.2f} s to {there}.")
        return tell(text, **began, other=tell(last.name), there=pointed(_to(last), motion))
    text = noted("{stone} fell first, at {time:.2f} s to {side}; then {others}, the last at {end:.2f} s.")
    return tell(text, **began, others=_names(falls[1:]))


def fell_together(falls: Sequence[StoneFate]) -> bool:
    """Return whether several stones, in the order of time, fell within a short time to about one side."""
    if len(falls) < 2 or _at(falls[-1]) - _at(falls[0]) > TOGETHER:
        return False
    mean = _mean_direction(falls)
    return all(_apart(_to(stone), mean) <= ABOUT for stone in falls)


def _alone(stone: StoneFate, motion: Motion) -> str:
    """Return when a stone fell, to which side, and where it came to lie."""
    where = {"stone": tell(stone.name), "side": pointed(_to(stone), motion), "time": _at(stone)}
    if stone.fell_onto is None:
        return tell("{stone} fell at {time:.2f} s to {side}, and is still in the air.", **where)
    if stone.fell_onto == GROUND:
        return tell("{stone} fell at {time:.2f} s to {side}, onto the ground.", **where)
    return tell("{stone} fell at {time:.2f} s to {side}, onto {other}.", **where, other=tell(stone.fell_onto))


def _called(falls: Sequence[StoneFate], pile: Pile) -> str:
    """Return what stones are together: the whole pile, all that stood on one stone, or their names."""
    names = {stone.name for stone in falls}
    if len(names) == len(pile.stones):
        return tell("All {count} stones", count=len(names))
    foot, *more = {stone.on for stone in pile.stones if stone.name in names and stone.on not in names}
    if not more and foot != GROUND and _above(foot, pile) == names:
        return tell("All above {stone}", stone=tell(foot))
    return _names(falls)


def _above(foot: str, pile: Pile) -> set[str]:
    """Return the stones that stand on a stone, and on those."""
    found = {foot}
    for stone in pile.stones:  # from below upwards
        if stone.on in found:
            found.add(stone.name)
    return found - {foot}


def _names(stones: Sequence[StoneFate]) -> str:
    """Return the names of stones, or how many they are."""
    if len(stones) > NAMED:
        return tell("{count} stones", count=len(stones))
    return listed(tell(stone.name) for stone in stones)


def _at(stone: StoneFate) -> float:
    """Return when a stone fell, s."""
    return stone.fell_at_s or 0.0


def _to(stone: StoneFate) -> float:
    """Return to where it fell, degrees from +x."""
    return stone.fell_towards_deg or 0.0


def _mean_direction(falls: Sequence[StoneFate]) -> float:
    """Return the mean direction of falls, degrees from +x."""
    angles = [math.radians(_to(stone)) for stone in falls]
    return math.degrees(math.atan2(sum(map(math.sin, angles)), sum(map(math.cos, angles))))


def _apart(one: float, other: float) -> float:
    """Return the angle between two directions, degrees."""
    return abs(math.remainder(one - other, 360.0))

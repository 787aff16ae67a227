"""Sentences on falls of stones: single, simultaneous or successive."""

from __future__ import annotations

import math
from collections.abc import Sequence

from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import GROUND
from seisblock.core.i18n import N_, gettext, join_list
from seisblock.core.results import Response
from seisblock.models.stack.outcome import StackOutcome, StoneOutcome
from seisblock.output.directions import direction_with_compass
from seisblock.records import Motion

SIMULTANEOUS_S = 0.5
"""Longest time between the first and last of simultaneous falls, s; the fall time from a height of 1.2 m."""

SAME_SIDE_DEG = 45.0
"""Largest deviation from the mean direction of falls to one side, degrees."""

MAX_NAMES = 6
"""Most stones named in a sentence."""


def fallen_stones(response: Response[StackOutcome]) -> list[StoneOutcome]:
    """Return the fallen stones in order of time."""
    return sorted((stone for stone in response.outcome.stones if stone.fell_at_s is not None), key=_fall_time)


def describe_falls(response: Response[StackOutcome]) -> str:
    """Return a sentence on stones, times and directions of falls; empty without falls."""
    falls, motion = fallen_stones(response), response.motion
    if len(falls) < 2:
        return "".join(_describe_fall(stone, motion) for stone in falls)
    if fell_together(falls):
        values = {"time": _fall_time(falls[0]), "side": direction_with_compass(_mean_direction(falls), motion)}
        return gettext(
            "{stones} fall together at {time:.2f} s, approximately to {side}.", stones=_group_name(falls, response.body), **values
        )
    first, last = falls[0], falls[-1]
    first_values = {
        "stone": gettext(first.name),
        "time": _fall_time(first),
        "side": direction_with_compass(_fall_direction(first), motion),
        "end": _fall_time(last),
    }
    if len(falls) == 2:
        text = N_("{stone} falls first, to {side} at {time:.2f} s; then {other}, to {there} at {end:.2f} s.")
        return gettext(text, **first_values, other=gettext(last.name), there=direction_with_compass(_fall_direction(last), motion))
    text = N_("{stone} falls first, to {side} at {time:.2f} s; then {others}, the last at {end:.2f} s.")
    return gettext(text, **first_values, others=_names(falls[1:]))


def fell_together(falls: Sequence[StoneOutcome]) -> bool:
    """Return whether stones, in order of time, fell simultaneously to one side."""
    if len(falls) < 2 or _fall_time(falls[-1]) - _fall_time(falls[0]) > SIMULTANEOUS_S:
        return False
    mean = _mean_direction(falls)
    return all(abs(math.remainder(_fall_direction(stone) - mean, 360.0)) <= SAME_SIDE_DEG for stone in falls)


def _describe_fall(stone: StoneOutcome, motion: Motion) -> str:
    values = {"stone": gettext(stone.name), "side": direction_with_compass(_fall_direction(stone), motion), "time": _fall_time(stone)}
    if stone.fell_onto is None:
        return gettext("{stone} falls to {side} at {time:.2f} s; still falling at the end of the analysis.", **values)
    if stone.fell_onto == GROUND:
        return gettext("{stone} falls to {side} at {time:.2f} s, onto the ground.", **values)
    return gettext("{stone} falls to {side} at {time:.2f} s, onto {other}.", **values, other=gettext(stone.fell_onto))


def _group_name(falls: Sequence[StoneOutcome], pile: Pile) -> str:
    """Return the whole pile, all stones above one, or the names."""
    names = {stone.name for stone in falls}
    if len(names) == len(pile.stones):
        return gettext("All {count} stones", count=len(names))
    foot, *further_bases = {stone.on for stone in pile.stones if stone.name in names and stone.on not in names}
    if not further_bases and foot != GROUND and _stones_above(foot, pile) == names:
        return gettext("All stones above {stone}", stone=gettext(foot))
    return _names(falls)


def _stones_above(foot: str, pile: Pile) -> set[str]:
    """Return the stones supported by a stone, directly or indirectly."""
    stones = {foot}
    for stone in pile.stones:  # supports come before the stones that they carry
        if stone.on in stones:
            stones.add(stone.name)
    return stones - {foot}


def _names(stones: Sequence[StoneOutcome]) -> str:
    """Return the names of stones, or their number if there are many."""
    if len(stones) > MAX_NAMES:
        return gettext("{count} stones", count=len(stones))
    return join_list(gettext(stone.name) for stone in stones)


def _fall_time(stone: StoneOutcome) -> float:
    return stone.fell_at_s or 0.0


def _fall_direction(stone: StoneOutcome) -> float:
    """Return the direction of fall, degrees from +x."""
    return stone.fell_towards_deg or 0.0


def _mean_direction(falls: Sequence[StoneOutcome]) -> float:
    """Return the circular mean of the fall directions, degrees from +x."""
    angles = [math.radians(_fall_direction(stone)) for stone in falls]
    return math.degrees(math.atan2(sum(map(math.sin, angles)), sum(map(math.cos, angles))))

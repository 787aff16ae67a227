"""Consistency checks of a pile of stones."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import Protocol

from seisblock.bodies.pile.stone import CONTACT_TOLERANCE, GROUND, Joint, PileStone, bearing_rectangle, overlaps_in_plan
from seisblock.core import checks
from seisblock.core.errors import BodyError
from seisblock.core.i18n import N_, lazy_gettext


class PileLike(Protocol):
    """Interface of the checks: a pile, or one under construction."""

    @property
    def name(self) -> str: ...  # noqa: D102
    @property
    def stones(self) -> tuple[PileStone, ...]: ...  # noqa: D102
    @property
    def dowels(self) -> tuple[tuple[str, ...], ...]: ...  # noqa: D102
    @property
    def fixed(self) -> tuple[str, ...]: ...  # noqa: D102
    @property
    def mu(self) -> float: ...  # noqa: D102
    @property
    def names(self) -> tuple[str, ...]: ...  # noqa: D102

    def centres(self) -> list[tuple[float, float, float]]: ...  # noqa: D102
    def joints(self) -> list[Joint]: ...  # noqa: D102
    def friction(self, stone: PileStone | None = None) -> tuple[float, float]: ...  # noqa: D102
    def bodies(self) -> Iterator[tuple[int, ...]]: ...  # noqa: D102


def check_pile(pile: PileLike) -> None:
    """Raise an error for an inconsistent or unstable pile.

    Raises
    ------
    BodyError
        For the first inconsistency.
    """
    _check_names(pile)
    _check_friction(pile)
    _check_overlaps(pile)
    joints = pile.joints()
    _check_floating(pile, joints)
    _check_dowels(pile, joints)
    _check_balance(pile, joints)


def _check_names(pile: PileLike) -> None:
    """Raise an error for duplicate or unknown names."""
    if not pile.stones:
        raise BodyError("the pile {name} has no stones: give at least one", name=pile.name)
    names_below: set[str] = set()
    for stone in pile.stones:
        if stone.name in names_below or stone.name == GROUND:
            raise BodyError("the pile {pile} has two stones named {name}: names must be unique", pile=pile.name, name=stone.name)
        if stone.on != GROUND and stone.on not in names_below:
            raise BodyError(
                "the stone {name} stands on {on!r}, which does not precede it in the list: {known}",
                name=stone.name,
                on=stone.on,
                known=[GROUND, *sorted(names_below)],
            )
        names_below.add(stone.name)
    for role, names in ((N_("dowel"), [n for group in pile.dowels for n in group]), (N_("fixed stone"), list(pile.fixed))):
        for name in names:
            if name not in names_below:
                raise BodyError(
                    "{what}: the pile {pile} has no stone {name!r}; stones: {names}",
                    what=lazy_gettext(role),
                    name=name,
                    pile=pile.name,
                    names=list(pile.names),
                )
    if all(name in pile.fixed for name in pile.names):
        raise BodyError("all stones of the pile {name} are fixed: leave at least one free", name=pile.name)


def _check_friction(pile: PileLike) -> None:
    """Raise an error for negative friction, or kinetic above static friction."""
    if not pile.mu >= 0.0:
        raise BodyError("the friction coefficient of the pile {name} must be zero or more, found {mu}", name=pile.name, mu=pile.mu)
    static, kinetic = pile.friction()
    checks.non_negative("kinetic friction", kinetic, error=BodyError)
    if kinetic > static:
        raise BodyError("kinetic friction {kinetic:g} must not exceed static friction {mu:g}", kinetic=kinetic, mu=static)
    for stone in pile.stones:
        static, kinetic = pile.friction(stone)
        if kinetic > static:
            raise BodyError(
                "kinetic friction under the stone {name}, {kinetic:g}, must not exceed static friction, {mu:g}",
                name=stone.name,
                kinetic=kinetic,
                mu=static,
            )


def _check_overlaps(pile: PileLike) -> None:
    """Raise an error for stones that overlap each other or the ground."""
    centres = pile.centres()
    for i, (centre, stone) in enumerate(zip(centres, pile.stones, strict=True)):
        if centre[2] - 0.5 * stone.height < -CONTACT_TOLERANCE:
            raise BodyError(
                "the stone {name} reaches {depth:.4g} m into the ground: raise its bottom to 0",
                name=stone.name,
                depth=0.5 * stone.height - centre[2],
            )
        for j in range(i):
            other_stone = pile.stones[j]
            penetration = min(0.5 * (stone.size[k] + other_stone.size[k]) - abs(centre[k] - centres[j][k]) for k in range(3))
            if penetration > CONTACT_TOLERANCE and overlaps_in_plan(centre, stone, centres[j], other_stone):
                raise BodyError(
                    "the stones {one} and {other} overlap by {inside:.4g} m: move one of them",
                    one=other_stone.name,
                    other=stone.name,
                    inside=penetration,
                )


def _check_floating(pile: PileLike, joints: list[Joint]) -> None:
    """Raise an error for a stone without support."""
    for i, stone in enumerate(pile.stones):
        if stone.name not in pile.fixed and not any(joint.upper == i for joint in joints):
            raise BodyError("the stone {name} has no support: neither a stone nor the ground touches its base", name=stone.name)


def _check_dowels(pile: PileLike, joints: list[Joint]) -> None:
    """Raise an error for a dowel between stones that do not touch."""
    touching_pairs = {frozenset((joint.upper, joint.lower)) for joint in joints}
    dowelled_names: set[str] = set()
    for group in pile.dowels:
        if len(group) < 2:
            raise BodyError("a dowel connects at least two stones, found {group}", group=list(group) or lazy_gettext("none"))
        for lower, upper in pairwise(group):
            if frozenset((pile.names.index(lower), pile.names.index(upper))) not in touching_pairs:
                raise BodyError("the dowel between {lower} and {upper} has no effect: these stones do not touch", lower=lower, upper=upper)
        repeated_names = dowelled_names & set(group)
        if repeated_names:
            raise BodyError("the stone {name} belongs to two dowels: name all connected stones in one dowel", name=min(repeated_names))
        dowelled_names |= set(group)


def _check_balance(pile: PileLike, joints: list[Joint]) -> None:
    """Raise an error for a pile that is unstable at rest."""
    centres = pile.centres()
    group_of_stone = {i: group for group in pile.bodies() for i in group}
    for body in dict.fromkeys(group_of_stone.values()):
        supports = [joint for joint in joints if joint.upper in body and joint.lower not in body]
        supported_stones = _supported_stones(body, group_of_stone, joints)
        mass = sum(pile.stones[i].mass for i in supported_stones)
        rectangles = [bearing_rectangle(joint, pile.stones, centres) for joint in supports]
        for axis, sides in enumerate(zip(*rectangles, strict=True)):
            centroid = sum(pile.stones[i].mass * centres[i][axis] for i in supported_stones) / mass
            low, high = min(side[0] for side in sides), max(side[1] for side in sides)
            if not low < centroid < high:
                name = pile.stones[min(supports, key=lambda joint: joint.height).upper].name
                raise BodyError(
                    "the pile {pile} is unstable at rest: the centre of gravity of the stone {name} and the stones on it lies "
                    "{depth:.4g} m outside its support along {axis}",
                    pile=pile.name,
                    name=name,
                    depth=max(low - centroid, centroid - high),
                    axis="xy"[axis],
                )


def _supported_stones(body: tuple[int, ...], group_of_stone: dict[int, tuple[int, ...]], joints: list[Joint]) -> set[int]:
    """Return the stones of a body and all stones supported by it alone."""
    supported_stones = set(body)
    changed = True
    while changed:
        changed = False
        for group in set(group_of_stone.values()):
            supports = {joint.lower for joint in joints if joint.upper in group and joint.lower not in group}
            if not set(group) <= supported_stones and supports and supports <= supported_stones:
                supported_stones |= set(group)
                changed = True
    return supported_stones

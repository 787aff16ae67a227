"""Whether a pile can stand: what is wrong with it, in one sentence that names the stone."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import Protocol

from seisblock import checks
from seisblock.bodies.pile.stone import GROUND, TOUCHING, Joint, PileStone, carrying, lies_over
from seisblock.errors import BodyError
from seisblock.words import noted, said


class Standing(Protocol):
    """What the checks look at: a pile, or one about to be."""

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


def check_pile(pile: Standing) -> None:
    """Refuse a pile that cannot be what is meant.

    Raises
    ------
    BodyError
        With the first thing found wrong.
    """
    _check_names(pile)
    _check_friction(pile)
    _check_overlaps(pile)
    joints = pile.joints()
    _check_floating(pile, joints)
    _check_dowels(pile, joints)
    _check_balance(pile, joints)


def _check_names(pile: Standing) -> None:
    """Refuse a pile whose names do not say what stands on what."""
    if not pile.stones:
        raise BodyError("the pile {name} has no stones: give at least one", name=pile.name)
    seen: set[str] = set()
    for stone in pile.stones:
        if stone.name in seen or stone.name == GROUND:
            raise BodyError("two stones of the pile {pile} are called {name}: give each its own name", pile=pile.name, name=stone.name)
        if stone.on != GROUND and stone.on not in seen:
            raise BodyError(
                "the stone {name} stands on {on!r}, which is not before it in the list: {known}",
                name=stone.name,
                on=stone.on,
                known=[GROUND, *sorted(seen)],
            )
        seen.add(stone.name)
    for what, names in ((noted("dowel"), [n for group in pile.dowels for n in group]), (noted("fixed stone"), list(pile.fixed))):
        for name in names:
            if name not in seen:
                raise BodyError(
                    "the {what} names {name!r}, but the pile {pile} has {names}",
                    what=said(what),
                    name=name,
                    pile=pile.name,
                    names=list(pile.names),
                )
    if all(name in pile.fixed for name in pile.names):
        raise BodyError("every stone of the pile {name} is fixed: leave at least one free", name=pile.name)


def _check_friction(pile: Standing) -> None:
    """Refuse friction that is none, or more of it once a stone slides than before."""
    if not pile.mu >= 0.0:
        raise BodyError("friction of the pile {name} must be zero or more, found {mu}", name=pile.name, mu=pile.mu)
    clings, slides = pile.friction()
    checks.not_negative("kinetic friction", slides, error=BodyError)
    if slides > clings:
        raise BodyError("kinetic friction, {kinetic:g}, is more than static friction, {mu:g}", kinetic=slides, mu=clings)
    for stone in pile.stones:
        clings, slides = pile.friction(stone)
        if slides > clings:
            raise BodyError(
                "kinetic friction under the stone {name}, {kinetic:g}, is more than its static friction, {mu:g}",
                name=stone.name,
                kinetic=slides,
                mu=clings,
            )


def _check_overlaps(pile: Standing) -> None:
    """Refuse stones in each other or in the ground."""
    centres = pile.centres()
    for i, (a, stone) in enumerate(zip(centres, pile.stones, strict=True)):
        if a[2] - 0.5 * stone.height < -TOUCHING:
            raise BodyError(
                "the stone {name} reaches {depth:.4g} m into the ground: raise its bottom to 0",
                name=stone.name,
                depth=0.5 * stone.height - a[2],
            )
        for j in range(i):
            other = pile.stones[j]
            inside = min(0.5 * (stone.size[k] + other.size[k]) - abs(a[k] - centres[j][k]) for k in range(3))
            if inside > TOUCHING and lies_over(a, stone, centres[j], other):
                raise BodyError(
                    "the stones {one} and {other} overlap by {inside:.4g} m: move one of them",
                    one=other.name,
                    other=stone.name,
                    inside=inside,
                )


def _check_floating(pile: Standing, joints: list[Joint]) -> None:
    """Refuse a stone under which there is nothing."""
    for i, stone in enumerate(pile.stones):
        if stone.name not in pile.fixed and not any(joint.upper == i for joint in joints):
            raise BodyError("the stone {name} floats: no stone and no ground touches its lower face", name=stone.name)


def _check_dowels(pile: Standing, joints: list[Joint]) -> None:
    """Refuse a dowel between stones that do not touch."""
    touching = {frozenset((joint.upper, joint.lower)) for joint in joints}
    used: set[str] = set()
    for group in pile.dowels:
        if len(group) < 2:
            raise BodyError("a dowel holds at least two stones together, found only {group}", group=list(group) or said("none"))
        for lower, upper in pairwise(group):
            if frozenset((pile.names.index(lower), pile.names.index(upper))) not in touching:
                raise BodyError("the dowel between {lower} and {upper} holds nothing: these stones do not touch", lower=lower, upper=upper)
        twice = used & set(group)
        if twice:
            raise BodyError("the stone {name} is in two dowels: name all stones it is held to in one", name=min(twice))
        used |= set(group)


def _check_balance(pile: Standing, joints: list[Joint]) -> None:
    """Refuse a pile of which some part would tip over at rest."""
    centres = pile.centres()
    whole = {i: group for group in pile.bodies() for i in group}
    for body in dict.fromkeys(whole.values()):
        supports = [joint for joint in joints if joint.upper in body and joint.lower not in body]
        carried = _carried(body, whole, joints)
        mass = sum(pile.stones[i].mass for i in carried)
        worn = [carrying(joint, pile.stones, centres) for joint in supports]
        for axis, sides in enumerate(zip(*worn, strict=True)):
            at = sum(pile.stones[i].mass * centres[i][axis] for i in carried) / mass
            low, high = min(side[0] for side in sides), max(side[1] for side in sides)
            if not low < at < high:
                name = pile.stones[min(supports, key=lambda joint: joint.height).upper].name
                raise BodyError(
                    "the pile {pile} is unstable at rest: the stone {name}, with what it carries, has its centre of gravity "
                    "{depth:.4g} m outside what it stands on, along {axis}",
                    pile=pile.name,
                    name=name,
                    depth=max(low - at, at - high),
                    axis="xy"[axis],
                )


def _carried(body: tuple[int, ...], whole: dict[int, tuple[int, ...]], joints: list[Joint]) -> set[int]:
    """Return the stones of a body and all that stand on it alone."""
    carried = set(body)
    growing = True
    while growing:
        growing = False
        for group in set(whole.values()):
            under = {joint.lower for joint in joints if joint.upper in group and joint.lower not in group}
            if not set(group) <= carried and under and under <= carried:
                carried |= set(group)
                growing = True
    return carried

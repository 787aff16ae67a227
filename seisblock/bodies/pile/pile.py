"""Pile of cuboid and cylindrical stones: gravestones, lanterns, pagodas, columns, crates."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from itertools import pairwise

from seisblock.bodies.block import Block
from seisblock.bodies.edge_wear import EdgeWear
from seisblock.bodies.pile.stone import (
    CONTACT_TOLERANCE,
    GROUND,
    Joint,
    PileStone,
    bearing_rectangle,
    interval_overlap,
    overlaps_in_plan,
    span,
)
from seisblock.bodies.uncertainty import ParameterRanges
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import BodyError, ParameterError
from seisblock.core.i18n import N_, lazy_gettext


def _check_pile(pile: Pile) -> None:
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


def _check_names(pile: Pile) -> None:
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


def _check_friction(pile: Pile) -> None:
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


def _check_overlaps(pile: Pile) -> None:
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


def _check_floating(pile: Pile, joints: list[Joint]) -> None:
    """Raise an error for a stone without support."""
    for i, stone in enumerate(pile.stones):
        if stone.name not in pile.fixed and not any(joint.upper == i for joint in joints):
            raise BodyError("the stone {name} has no support: neither a stone nor the ground touches its base", name=stone.name)


def _check_dowels(pile: Pile, joints: list[Joint]) -> None:
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


def _check_balance(pile: Pile, joints: list[Joint]) -> None:
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


@dataclass(frozen=True, repr=False)
class Pile(DisplayMixin):
    """Ordered pile of stones ([Furukawa2009]_ section 3(2), fig. 3).

    Parameters
    ----------
    name : str
    stones : tuple of PileStone
        From bottom to top.
    dowels : tuple of tuples of str
        Names of stones joined as one body ([Furukawa2009]_ section 3(6)).
    fixed : tuple of str
        Stones that move with the ground.
    mu, mu_kinetic : float, 1
        Static and kinetic friction of joints without their own; 0.438 as in [Furukawa2009]_ table 2. The kinetic value is at most the
        static one; None: equal.
    ranges : ParameterRanges or None
        Ranges of the kind, for the pile as one block.

    Raises
    ------
    BodyError
        If stones overlap, lack support, or do not touch at a dowel; if the pile is unstable at rest; if kinetic exceeds static friction.
    """

    name: str
    stones: tuple[PileStone, ...]
    dowels: tuple[tuple[str, ...], ...] = ()
    fixed: tuple[str, ...] = ()
    mu: float = 0.438
    ranges: ParameterRanges | None = field(default=None, repr=False)
    mu_kinetic: float | None = None

    def __post_init__(self) -> None:
        _check_pile(self)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the stones, from bottom to top."""
        return tuple(stone.name for stone in self.stones)

    def centres(self) -> list[tuple[float, float, float]]:
        """Return the centres of the stones in ground axes, m."""
        centre_by_name: dict[str, tuple[float, float, float]] = {}
        for stone in self.stones:
            x, y, top = 0.0, 0.0, 0.0
            if stone.on != GROUND:
                support = self.stones[self.names.index(stone.on)]
                x, y, middle = centre_by_name[stone.on]
                top = middle + 0.5 * support.height
            bottom = top if stone.bottom is None else stone.bottom
            centre_by_name[stone.name] = (x + stone.offset[0], y + stone.offset[1], bottom + 0.5 * stone.height)
        return [centre_by_name[stone.name] for stone in self.stones]

    def joints(self) -> list[Joint]:
        """Return the joints between stones and with the ground."""
        centres = self.centres()
        result = []
        for upper, stone in enumerate(self.stones):
            floor = centres[upper][2] - 0.5 * stone.height
            if abs(floor) <= CONTACT_TOLERANCE:
                result.append(Joint(upper, -1, span(centres[upper][0], stone.width), span(centres[upper][1], stone.depth), floor))
            for lower, lower_stone in enumerate(self.stones):
                if lower != upper and abs(centres[lower][2] + 0.5 * lower_stone.height - floor) <= CONTACT_TOLERANCE:
                    overlaps = [interval_overlap(centres[upper][k], stone.size[k], centres[lower][k], lower_stone.size[k]) for k in (0, 1)]
                    if overlaps_in_plan(centres[upper], stone, centres[lower], lower_stone):
                        result.append(Joint(upper, lower, overlaps[0], overlaps[1], floor))
        return result

    def bodies(self) -> Iterator[tuple[int, ...]]:
        """Yield the groups of stones that move as one body, without the fixed ones."""
        index = {name: i for i, name in enumerate(self.names)}
        group_of_stone = {name: tuple(sorted(index[member] for member in group)) for group in self.dowels for name in group}
        visited: set[int] = set()
        for i, name in enumerate(self.names):
            members = group_of_stone.get(name, (i,))
            if i not in visited and not any(self.names[m] in self.fixed for m in members):
                visited.update(members)
                yield members

    def friction(self, stone: PileStone | None = None) -> tuple[float, float]:
        """Return static and kinetic friction of the joint under a stone, or of other contacts, 1.

        Examples
        --------
        >>> from seisblock.bodies.pile.stone import PileStone
        >>> pile = Pile("two", (PileStone("low", 1.0, 1.0, 0.5, mu=0.3), PileStone("high", 1.0, 1.0, 0.5, on="low")), mu=0.7)
        >>> pile.friction(), [pile.with_kinetic_friction(0.25).friction(stone) for stone in pile.stones]
        ((0.7, 0.7), [(0.3, 0.25), (0.7, 0.25)])
        """
        static = self.mu if stone is None or stone.mu is None else stone.mu
        kinetic = self.mu_kinetic if stone is None or stone.mu_kinetic is None else stone.mu_kinetic
        return static, static if kinetic is None else kinetic

    @property
    def has_lower_kinetic_friction(self) -> bool:
        """True if any joint has kinetic friction below static friction."""
        return any(kinetic < static for static, kinetic in map(self.friction, (None, *self.stones)))

    def with_kinetic_friction(self, mu_kinetic: float) -> Pile:
        """Return the pile with the same kinetic friction in every joint, 1.

        Raises
        ------
        ParameterError
            If the value exceeds the static friction of a joint.
        """
        stones = tuple(replace(stone, mu_kinetic=None) for stone in self.stones)
        try:
            return replace(self, mu_kinetic=mu_kinetic, stones=stones)
        except BodyError as error:
            raise ParameterError("{why}", why=error.message) from None

    def without(self, *names: str) -> Pile:
        """Return the pile without the named stones, on which no other stone may stand."""
        stones = tuple(stone for stone in self.stones if stone.name not in names)
        dowels = tuple(group for group in self.dowels if not set(group) & set(names))
        return replace(self, stones=stones, dowels=dowels, fixed=tuple(name for name in self.fixed if name not in names))

    def as_block(self) -> Block:
        """Return the pile as one rigid block in the x-z plane: base on the ground, total mass, centre and inertia.

        Height: top of the highest stone; stones wider than the base do not widen it.
        """
        centres = self.centres()
        free_stones = [i for i, name in enumerate(self.names) if name not in self.fixed]
        floor = min(centres[i][2] - 0.5 * self.stones[i].height for i in free_stones)
        base_stones = [i for i in free_stones if centres[i][2] - 0.5 * self.stones[i].height - floor <= CONTACT_TOLERANCE]
        low = min(centres[i][0] - 0.5 * self.stones[i].width for i in base_stones)
        high = max(centres[i][0] + 0.5 * self.stones[i].width for i in base_stones)
        mass = sum(self.stones[i].mass for i in free_stones)
        x, z = (sum(self.stones[i].mass * centres[i][axis] for i in free_stones) / mass for axis in (0, 2))
        inertia = sum(
            self.stones[i].mass * (float(self.stones[i].gyration_squared[1]) + (centres[i][0] - x) ** 2 + (centres[i][2] - z) ** 2)
            for i in free_stones
        )
        top = max(centres[i][2] + 0.5 * self.stones[i].height for i in free_stones)
        return Block(
            high - low,
            top - floor,
            max(self.stones[i].depth for i in base_stones),
            mass,
            centroid_height=z - floor,
            centroid_offset=x - 0.5 * (low + high),
            centroid_inertia=inertia,
            name=self.name,
            inset=max(self.stones[i].insets()[0] for i in base_stones),
            ranges=self.ranges,
            stone_count=len(free_stones),
        )

    def with_wear(self, inset: EdgeWear | float) -> Pile:
        """Return the pile with worn edges: the same share of the width per side, or the same inset, for all stones.

        Examples
        --------
        >>> from seisblock.bodies.pile.toml import load_pile
        >>> [round(stone.insets()[0], 4) for stone in load_pile("lantern").with_wear(0.1).stones]
        [0.06, 0.026, 0.048, 0.034, 0.064, 0.02]
        """
        wear = inset if isinstance(inset, EdgeWear) else EdgeWear(share=inset)
        return replace(self, stones=tuple(replace(stone, inset=wear) for stone in self.stones))

    def with_dowels(self, *names: str) -> Pile:
        """Return the pile with the named stones joined by a dowel."""
        return replace(self, dowels=(*self.dowels, names))

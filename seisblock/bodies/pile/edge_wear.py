"""Edge wear of the samples of a pile."""

from __future__ import annotations

from dataclasses import replace

from seisblock.bodies.block_array import MAX_WEAR_SHARE
from seisblock.bodies.edge_wear import MAX_SHARE
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import PileStone
from seisblock.core.errors import BodyError

BISECTION_TOLERANCE = 1e-3
"""Tolerance of the bisection for the half width."""


def worn_to(body: Pile, tolerance: float, draw: float) -> Pile:
    """Return a sample of a pile whose insets differ by one common share; sharp stones stay sharp.

    Parameters
    ----------
    body : Pile
    tolerance : float, 1
        Half width of the insets, a share of each; reduced where less than a fifth of a base would remain.
    draw : float
        In [-1, 1].

    Examples
    --------
    >>> from seisblock.bodies.pile.toml import load_pile
    >>> pile = load_pile("lantern")
    >>> [round(worn_to(worn, 0.1, draw).stones[0].inset.share, 3) for worn in (pile, pile.with_wear(0.2)) for draw in (-1.0, 1.0)]
    [0.0, 0.0, 0.18, 0.22]
    """
    if tolerance == 0.0:
        return body
    return replace(body, stones=tuple(_vary_wear(stone, tolerance, draw) for stone in body.stones))


def _vary_wear(stone: PileStone, tolerance: float, draw: float) -> PileStone:
    """Return the sample of one stone; an inset given as a length stays a length."""
    share = worn_share(stone)
    if share == 0.0:
        return stone
    factor = 1.0 + min(tolerance, MAX_WEAR_SHARE * (MAX_SHARE - share) / share) * draw
    return replace(stone, inset=replace(stone.inset, length_m=factor * stone.inset.length_m, share=factor * stone.inset.share))


def worn_share(stone: PileStone) -> float:
    """Return the inset of a stone, the larger share of its two sides."""
    along, across = stone.insets()
    return max(along / stone.width, across / stone.depth)


def widest_wear(body: Pile, tolerance: float) -> float:
    """Return the half width of the insets of the samples of a pile, a share of each.

    Smaller than `tolerance` where the most worn sample would be unstable at rest.

    Examples
    --------
    >>> lower, upper = PileStone("lower", 0.6, 0.6, 0.2), PileStone("upper", 0.4, 0.4, 0.9, offset=(0.24, 0.0), on="lower")
    >>> one, two = Pile("one", (lower,)).with_wear(0.1), Pile("two", (lower, upper)).with_wear(0.15)
    >>> widest_wear(one, 0.9), round(widest_wear(two, 0.9), 2)
    (0.9, 0.44)
    """
    if _is_stable(body, tolerance / MAX_WEAR_SHARE):
        return tolerance
    low, high = 0.0, tolerance / MAX_WEAR_SHARE
    while high - low > BISECTION_TOLERANCE:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if _is_stable(body, middle) else (low, middle)
    return min(tolerance, MAX_WEAR_SHARE * low)


def _is_stable(body: Pile, tolerance: float) -> bool:
    """Return whether the most worn sample of a pile is stable at rest."""
    try:
        worn_to(body, tolerance, 1.0)
    except BodyError:
        return False
    return True

"""Versions of a pile with worn edges: how far, and how far at most."""

from __future__ import annotations

from dataclasses import replace

from seisblock.bodies.blocks import MOST_WORN, range_about
from seisblock.bodies.inset import HALF, Inset
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import PileStone
from seisblock.errors import BodyError

CLOSE = 1e-3
"""Shares of the width this near are one."""


def worn_to(body: Pile, deepest: float, draw: float) -> Pile:
    """Return a version of a pile whose edges are worn, all by one share of their widths.

    Parameters
    ----------
    body : Pile
    deepest : float, 1
        Largest inset per side, a share of the width; 0: worn as it is. A stone that is itself worn by more differs from that by half
        of it, and by no more than leaves a fifth of what it stands on.
    draw : float
        In [-1, 1]: from sharp edges, or from its own less half of `deepest`, to the deepest.

    Examples
    --------
    >>> from seisblock.bodies.pile.toml import load_pile
    >>> pile = load_pile("lantern")
    >>> [worn_to(worn, 0.1, draw).stones[0].inset.share for worn in (pile, pile.worn(0.25)) for draw in (-1.0, 1.0)]
    [0.0, 0.1, 0.2, 0.3]
    """
    if deepest == 0.0:
        return body
    return replace(body, stones=tuple(replace(stone, inset=_inset(stone, deepest, draw)) for stone in body.stones))


def _inset(stone: PileStone, deepest: float, draw: float) -> Inset:
    """Return how far in one stone of a version turns: one of its own is scaled, so that a length stays one."""
    own = worn_share(stone)
    low, high = range_about(own, deepest, HALF - own)
    worn = 0.5 * (low + high) + 0.5 * (high - low) * draw
    if low == 0.0:
        return Inset(share=worn)
    factor = worn / own
    return Inset(length_m=factor * stone.inset.length_m, share=factor * stone.inset.share)


def worn_share(stone: PileStone) -> float:
    """Return how far in from the sides of its base a stone turns, a share of the side of which that is more."""
    along, across = stone.insets()
    return max(along / stone.width, across / stone.depth)


def deepest_wear(body: Pile, share: float) -> float:
    """Return how far versions of a pile may be worn, a share of the width per side.

    Less than asked where the pile would not stand at rest, its load being near an edge: what stands is not worn like that.

    Examples
    --------
    >>> lower, upper = PileStone("lower", 0.6, 0.6, 0.2), PileStone("upper", 0.4, 0.4, 0.9, offset=(0.24, 0.0), on="lower")
    >>> deepest_wear(Pile("one", (lower,)), 0.1), round(deepest_wear(Pile("two", (lower, upper)), 0.4), 2)
    (0.1, 0.19)
    """
    if _stands(body, share / MOST_WORN):
        return share
    low, high = 0.0, share / MOST_WORN
    while high - low > CLOSE:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if _stands(body, middle) else (low, middle)
    return min(share, MOST_WORN * low)


def _stands(body: Pile, deepest: float) -> bool:
    """Return whether the most worn version of a pile stands at rest."""
    try:
        worn_to(body, deepest, 1.0)
    except BodyError:
        return False
    return True

"""Worn edges of a body and of its samples, in words."""

from __future__ import annotations

from dataclasses import replace

from seisblock.bodies.block import Block
from seisblock.bodies.blocks import wear_range
from seisblock.bodies.ranges import Ranges
from seisblock.bodies.scan.body import ScannedBody
from seisblock.present.scales import told_length
from seisblock.words import Said, noted, roughly, said


def edges(body: Block | ScannedBody, *, gal: bool = True) -> str:
    """Return where a body's edges lie, empty when they are those of its drawing.

    Parameters
    ----------
    body : Block or ScannedBody
    gal : bool
        Whether lengths are told in cm or mm, else in m.

    Examples
    --------
    >>> from seisblock.bodies.inset import Inset
    >>> stone = Block(0.24, 0.72).worn(Inset(share=0.1))
    >>> print(edges(stone)), print(edges(stone, gal=False))
    turns about edges 2.4 cm in from its sides (0.1 of the width)
    turns about edges 0.024 m in from its sides (0.1 of the width)
    (None, None)
    """
    if isinstance(body, ScannedBody):
        return (
            said("turns about edges {inset} in from the sides of its base", inset=told_length(body.inset_m, gal=gal))
            if body.inset_m
            else ""
        )
    if not body.inset:
        return ""
    text = "turns about edges {inset} in from its sides ({share:.3g} of the width)"
    return said(text, inset=told_length(body.inset, gal=gal), share=body.inset / body.width)


def sampled_edges(block: Block, ranges: Ranges | None, tolerance: float) -> Said:
    """Return the range of the worn edges of the samples of a block.

    Parameters
    ----------
    block : Block
    ranges : Ranges or None
        Priors from which samples were drawn.
    tolerance : float
        Half width of a known inset, a share of itself.

    Examples
    --------
    >>> print(sampled_edges(Block(0.24, 0.72), None, 0.1)), print(sampled_edges(Block(0.24, 0.72).worn(0.1), None, 0.1))
    sharp edges
    edges worn by 9 % to 11 % of the width
    (None, None)
    """
    low, high = wear_range(replace(block, ranges=ranges), tolerance)
    return said(_edges_text(low, high), low=roughly(low), high=roughly(high), share=roughly(high))


def _edges_text(low: float, high: float) -> str:
    """Return the text for a range of worn edges."""
    if high == 0.0:
        return noted("sharp edges")
    if low == high:
        return noted("edges worn by {share} of the width")
    return noted("edges worn by {low} to {high} of the width") if low > 0.0 else noted("edges worn by 0 to {share} of the width")

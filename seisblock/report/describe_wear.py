"""Worn edges of a body and of its samples, in words."""

from __future__ import annotations

from dataclasses import replace

from seisblock.bodies.block import Block
from seisblock.bodies.block_array import wear_range
from seisblock.bodies.scan.body import ScannedBody
from seisblock.bodies.uncertainty import ParameterRanges
from seisblock.core.i18n import N_, Message, format_share, lazy_gettext
from seisblock.report.units_display import format_length


def describe_edges(body: Block | ScannedBody, *, gal: bool = True) -> str:
    """Return where a body's edges lie, empty when they are those of its drawing.

    Parameters
    ----------
    body : Block or ScannedBody
    gal : bool
        Whether lengths are told in cm or mm, else in m.

    Examples
    --------
    >>> from seisblock.bodies.edge_wear import EdgeWear
    >>> stone = Block(0.24, 0.72).with_wear(EdgeWear(share=0.1))
    >>> print(describe_edges(stone)), print(describe_edges(stone, gal=False))
    turns about edges 2.4 cm in from its sides (0.1 of the width)
    turns about edges 0.024 m in from its sides (0.1 of the width)
    (None, None)
    """
    if isinstance(body, ScannedBody):
        return (
            lazy_gettext("turns about edges {inset} in from the sides of its base", inset=format_length(body.inset_m, gal=gal))
            if body.inset_m
            else ""
        )
    if not body.inset:
        return ""
    text = "turns about edges {inset} in from its sides ({share:.3g} of the width)"
    return lazy_gettext(text, inset=format_length(body.inset, gal=gal), share=body.inset / body.width)


def sampled_edges(block: Block, ranges: ParameterRanges | None, tolerance: float) -> Message:
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
    >>> print(sampled_edges(Block(0.24, 0.72), None, 0.1)), print(sampled_edges(Block(0.24, 0.72).with_wear(0.1), None, 0.1))
    sharp edges
    edges worn by 9 % to 11 % of the width
    (None, None)
    """
    low, high = wear_range(replace(block, ranges=ranges), tolerance)
    return lazy_gettext(_edges_text(low, high), low=format_share(low), high=format_share(high), share=format_share(high))


def _edges_text(low: float, high: float) -> str:
    """Return the text for a range of worn edges."""
    if high == 0.0:
        return N_("sharp edges")
    if low == high:
        return N_("edges worn by {share} of the width")
    return N_("edges worn by {low} to {high} of the width") if low > 0.0 else N_("edges worn by 0 to {share} of the width")

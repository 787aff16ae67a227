"""What is to be known of the edges about which a body turns, as it is told."""

from __future__ import annotations

from seisblock.bodies.block import Block
from seisblock.bodies.scan.body import ScannedBody
from seisblock.present.scales import told_length
from seisblock.words import said


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

"""Text for the edge wear of a body and of its samples."""

from __future__ import annotations

from dataclasses import replace

from seisblock.bodies.block import Block
from seisblock.bodies.block_array import wear_range
from seisblock.bodies.scan.body import ScannedBody
from seisblock.bodies.uncertainty import ParameterRanges
from seisblock.core.i18n import N_, Message, format_share, lazy_gettext
from seisblock.output.units_display import format_length


def describe_edges(body: Block | ScannedBody, *, gal: bool = True) -> str:
    """Return the edge wear of a body as text, empty for sharp edges.

    Parameters
    ----------
    body : Block or ScannedBody
    gal : bool
        Lengths in cm or mm if true, else in m.

    Examples
    --------
    >>> from seisblock.bodies.edge_wear import EdgeWear
    >>> stone = Block(0.24, 0.72).with_wear(EdgeWear(share=0.1))
    >>> print(describe_edges(stone)), print(describe_edges(stone, gal=False))
    edge wear 2.4 cm (0.1 of the width)
    edge wear 0.024 m (0.1 of the width)
    (None, None)
    """
    if isinstance(body, ScannedBody):
        return (
            lazy_gettext("edge wear {inset} from the sides of the base", inset=format_length(body.inset_m, gal=gal)) if body.inset_m else ""
        )
    if not body.inset:
        return ""
    text = "edge wear {inset} ({share:.3g} of the width)"
    return lazy_gettext(text, inset=format_length(body.inset, gal=gal), share=body.inset / body.width)


def sampled_edges(block: Block, ranges: ParameterRanges | None, tolerance: float) -> Message:
    """Return the range of edge wear in the samples of a block as text.

    Parameters
    ----------
    block : Block
    ranges : ParameterRanges or None
        Prior distributions of the samples.
    tolerance : float
        Relative half width of the range of a given inset.

    Examples
    --------
    >>> print(sampled_edges(Block(0.24, 0.72), None, 0.1)), print(sampled_edges(Block(0.24, 0.72).with_wear(0.1), None, 0.1))
    sharp edges
    edge wear 9 % to 11 % of the width
    (None, None)
    """
    low, high = wear_range(replace(block, ranges=ranges), tolerance)
    return lazy_gettext(_edges_text(low, high), low=format_share(low), high=format_share(high), share=format_share(high))


def _edges_text(low: float, high: float) -> str:
    if high == 0.0:
        return N_("sharp edges")
    if low == high:
        return N_("edge wear {share} of the width")
    return N_("edge wear {low} to {high} of the width") if low > 0.0 else N_("edge wear 0 to {share} of the width")

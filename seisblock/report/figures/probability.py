"""Colour scale of an overturning probability, the same in maps, figures, pages and notebooks."""

from __future__ import annotations

from matplotlib.colors import LinearSegmentedColormap, to_hex

SHADES = LinearSegmentedColormap.from_list("probability", ["#f3efe6", "#e9b872", "#c0392b", "#3d0c11"])
"""Colour map from no overturning (light) to overturning (dark), monotonic in greyscale."""


def share_colour(share: float) -> str:
    """Return the colour of a probability, or of a fraction of the scale, as a hex string.

    Parameters
    ----------
    share : float, 1

    Examples
    --------
    >>> share_colour(0.0)
    '#f3efe6'
    """
    return to_hex(SHADES(min(max(share, 0.0), 1.0)))

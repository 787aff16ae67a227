"""Many vertical bands as a single artist, for fast drawing."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.patches import PathPatch
from matplotlib.path import Path

CORNERS = 4


def span_patch(stretches: Sequence[tuple[float, float]], low: float = 0.0, high: float = 1.0, **style: Any) -> PathPatch:
    """Return vertical bands as one patch.

    Parameters
    ----------
    stretches : sequence of (float, float)
        Start and end of each band.
    low, high : float
        Lower and upper end of all bands; axes fractions with a suitable ``transform``.
    **style
        Properties of the patch.

    Examples
    --------
    >>> span_patch([(0.0, 1.0), (2.0, 2.5)]).get_extents().extents.tolist()
    [0.0, 0.0, 2.5, 1.0]
    """
    starts, ends = np.array(stretches, dtype=float).reshape(-1, 2).T
    lows, highs = np.full(starts.size, low), np.full(starts.size, high)
    outline = np.stack([[starts, lows], [starts, highs], [ends, highs], [ends, lows], [starts, lows]])
    codes = [Path.MOVETO, *[Path.LINETO] * (CORNERS - 1), Path.CLOSEPOLY] * starts.size
    return PathPatch(Path(outline.transpose(2, 0, 1).reshape(-1, 2), codes), **style)

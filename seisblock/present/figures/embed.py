"""A figure inside a page, as data: sharp on paper, small on a phone."""

from __future__ import annotations

import base64
import io
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

LARGEST_DRAWING = 200_000
"""A drawing of more bytes is put in as a picture."""

MOST_POINTS = 6000
"""A figure whose curves have more points than this would be a larger drawing: it is not tried."""

PICTURE_DPI = 170


class Picture(NamedTuple):
    """A figure as a page holds it: where it is taken from, which is the page itself, and what stands below it and is read aloud."""

    source: str
    caption: str


def picture(figure: Figure, caption: str, *, width: float = 6.0) -> Picture:
    """Return a figure as a page holds it.

    Parameters
    ----------
    figure : Figure
        Narrowed to `width`, so that its letters stay readable where the page is small.
    caption : str
        Plain text.
    width : float, inch
    """
    have, height = figure.get_size_inches()
    if have > width:
        figure.set_size_inches(width, height * (0.75 + 0.25 * width / have))
    for axis in figure.axes:
        _part(axis)
    held = io.BytesIO()
    kind = "svg+xml"
    if sum(np.size(curve.get_xdata()) for axis in figure.axes for curve in axis.lines) <= MOST_POINTS:
        figure.savefig(held, format="svg")
    if not 0 < held.tell() <= LARGEST_DRAWING:
        held, kind = io.BytesIO(), "png"
        figure.savefig(held, format="png", dpi=PICTURE_DPI)
    return Picture(f"data:image/{kind};base64,{base64.b64encode(held.getvalue()).decode('ascii')}", caption)


def _part(axis: Axes) -> None:
    """Lift a panel's title over its legend, which a narrow figure would draw on it."""
    title = axis.get_title(loc="left")
    if title and axis.get_legend() is not None:
        axis.set_title(title, loc="left", fontsize=8, pad=13.0)

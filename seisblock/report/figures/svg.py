"""A figure inside a page, as a drawing: sharp on paper and at any size, small enough for a phone."""

from __future__ import annotations

import base64
import io
import re
from typing import NamedTuple

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from seisblock.report.figures.curves import decimate

MAX_POINTS = 1600
"""What a page shows of a curve: two a dot on a screen of its widest."""

MAX_SVG_BYTES = 600_000
"""A drawing of more bytes, which is one of thousands of marks, is put in as a picture."""

PICTURE_DPI = 170

OVER_KEY = 17.0
"""Height of a panel's title that stands over a key of one row and hides no letter's tail behind it, points."""

CLIP = re.compile(r"\bp[0-9a-f]{10}\b")
"""The name of a clipping path, which matplotlib makes of an address in memory."""

PATH = re.compile(r' d="[^"]*"')
LONG_NUMBER = re.compile(r"(\d\.\d\d)\d+")
"""A coordinate with more decimals than hundredths of a point."""


class Picture(NamedTuple):
    """A figure as a page holds it: where it is taken from, which is the page itself, and what stands below it and is read aloud."""

    source: str
    caption: str


def embed_figure(figure: Figure, caption: str, *, width: float = 6.0) -> Picture:
    """Return a figure as a page holds it: the same figure is the same page, byte by byte.

    Parameters
    ----------
    figure : Figure
        Narrowed to `width`, so that its letters stay readable where the page is small.
    caption : str
        Plain text.
    width : float, inch
    """
    figure_width, height = figure.get_size_inches()
    if figure_width > width:
        figure.set_size_inches(width, height * (0.75 + 0.25 * width / figure_width))
    for axis in figure.axes:
        _lift_title(axis)
        for line in axis.lines:
            _thin_line(line)
    drawing, kind = _to_svg(figure), "svg+xml"
    if len(drawing) > MAX_SVG_BYTES:
        buffer, kind = io.BytesIO(), "png"
        figure.savefig(buffer, format="png", dpi=PICTURE_DPI)
        drawing = buffer.getvalue()
    return Picture(f"data:image/{kind};base64,{base64.b64encode(drawing).decode('ascii')}", caption)


def _to_svg(figure: Figure) -> bytes:
    """Return a figure as .svg, its coordinates to hundredths of a point."""
    buffer = io.StringIO()
    with rc_context({"svg.hashsalt": "seisblock"}):
        # the canvas itself: savefig would draw everything twice, the first time for nothing
        FigureCanvasSVG(figure).print_svg(buffer, metadata={"Date": None})
    clips: dict[str, str] = {}
    svg = CLIP.sub(lambda name: clips.setdefault(name[0], f"clip{len(clips)}"), buffer.getvalue())
    return PATH.sub(lambda path: LONG_NUMBER.sub(r"\1", path[0]), svg).encode()


def _thin_line(line: Line2D) -> None:
    """Thin a curve against something that grows to what a page shows of it."""
    x, y = (np.asarray(values, dtype=float) for values in (line.get_xdata(), line.get_ydata()))
    if x.size > MAX_POINTS and np.all(np.diff(x) >= 0.0):
        line.set_data(*decimate(x, y, MAX_POINTS))


def _lift_title(axis: Axes) -> None:
    """Lift a panel's title over its legend, which a narrow figure would draw on it."""
    title = axis.get_title(loc="left")
    if title and axis.get_legend() is not None:
        axis.set_title(title, loc="left", fontsize=8, pad=OVER_KEY)

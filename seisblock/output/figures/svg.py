"""Embedding of figures in HTML pages as SVG, or as PNG if the SVG is large."""

from __future__ import annotations

import base64
import io
import re
from contextlib import suppress
from typing import NamedTuple

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from seisblock.core.errors import OutputError
from seisblock.output.figures.curves import decimate
from seisblock.output.figures.fit_size import fit_figure_size
from seisblock.output.figures.style import INCH, StyledFigure

MAX_POINTS = 1600
"""Points of an embedded curve, at most: two per pixel of the widest screen."""

MAX_SVG_BYTES = 600_000
"""Size above which a figure is embedded as PNG."""

PICTURE_DPI = 170

PICTURE_WIDTH = 6.0
"""Largest width of an embedded figure, inch."""

NARROWEST = 0.6
"""Share of its width to which a figure is narrowed without stacking its columns."""

OVER_KEY = 17.0
"""Offset of the title of a panel above a legend of one row, points."""

CLIP = re.compile(r"\bp[0-9a-f]{10}\b")
"""Id of a clip path; matplotlib derives it from a memory address, which is not reproducible."""

PATH = re.compile(r' d="[^"]*"')
LONG_NUMBER = re.compile(r"(\d\.\d\d)\d+")
"""A coordinate with more than two decimals, points."""


class Picture(NamedTuple):
    """An embedded figure: data URI, and caption (also the alternative text)."""

    source: str
    caption: str


def embed_figure(figure: Figure, caption: str) -> Picture:
    """Return a figure as data URI, reproducible byte by byte.

    Parameters
    ----------
    figure : Figure
        Narrowed to :data:`PICTURE_WIDTH`, so that text stays readable on small screens.
    caption : str
        Plain text.
    """
    if isinstance(figure, StyledFigure) and figure.narrow_layout is not None and NARROWEST * figure.get_figwidth() > PICTURE_WIDTH:
        figure = figure.build_narrow(figure.narrow_layout, None)
        with suppress(OutputError):
            figure = fit_figure_size(figure, size=(PICTURE_WIDTH * INCH, figure.get_figheight() * INCH), dpi=int(figure.dpi))
    figure_width, height = figure.get_size_inches()
    if figure_width > PICTURE_WIDTH:
        figure.set_size_inches(PICTURE_WIDTH, height * (0.75 + 0.25 * PICTURE_WIDTH / figure_width))
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
    """Return a figure as SVG with coordinates to 0.01 points."""
    buffer = io.StringIO()
    with rc_context({"svg.hashsalt": "seisblock"}):
        # print_svg draws once; savefig would draw twice
        FigureCanvasSVG(figure).print_svg(buffer, metadata={"Date": None})
    # number the clip paths in order of appearance, so that the output is reproducible
    clips: dict[str, str] = {}
    svg = CLIP.sub(lambda name: clips.setdefault(name[0], f"clip{len(clips)}"), buffer.getvalue())
    return PATH.sub(lambda path: LONG_NUMBER.sub(r"\1", path[0]), svg).encode()


def _thin_line(line: Line2D) -> None:
    """Decimate a curve with monotonic x to :data:`MAX_POINTS`."""
    x, y = (np.asarray(values, dtype=float) for values in (line.get_xdata(), line.get_ydata()))
    if x.size > MAX_POINTS and np.all(np.diff(x) >= 0.0):
        line.set_data(*decimate(x, y, MAX_POINTS))


def _lift_title(axis: Axes) -> None:
    """Raise the title of a panel above its legend, which would overlap in a narrow figure."""
    title = axis.get_title(loc="left")
    if title and axis.get_legend() is not None:
        axis.set_title(title, loc="left", fontsize=8, pad=OVER_KEY)

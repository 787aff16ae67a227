"""Fitting of a figure to a given size: smaller text, wrapped labels, moved legends."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.text import Text
from matplotlib.transforms import Bbox

from seisblock.core.errors import OutputError
from seisblock.core.units import LENGTH_UNITS, FigureSize
from seisblock.output.figures.fonts import set_fonts, use_fonts
from seisblock.output.figures.style import (
    DPI,
    INCH,
    LEGEND_Y,
    MAX_PIXELS,
    MIN_FONT_SCALE,
    TICK_LABEL_SIZE,
    StyledFigure,
    add_figure_legend,
    add_legend,
    panel_titles,
)
from seisblock.output.text.wrap import display_width, wrap_text

MAX_SCALE = 3.0
"""Upper limit of the search over the default size."""

RELATIVE_TOLERANCE = 0.04
"""Relative tolerance of the minimum size."""


def min_size(fits: Callable[[float], bool], too_small: float, default_size: float, unit: str) -> float | None:
    """Return the minimum size that fits, inch, by bisection on displayable sizes; None if the largest does not fit.

    A trial lays out the figure (up to 1 s), hence the default size, which mostly fits, is tried before the largest.

    Parameters
    ----------
    fits : callable
        Returns True if a size, inch, fits.
    too_small : float, inch
        A size that does not fit.
    default_size : float, inch
        Default size of the figure.
    unit : str
        Display unit.

    Examples
    --------
    >>> trials = []
    >>> size = min_size(lambda size: trials.append(size) or size > 5.0, 2.0, 8.0, "mm")
    >>> format_inches(size, "mm"), len(trials)
    ('128 mm', 7)
    """
    for size in (round_up(default_size, unit), max_size(too_small, default_size, unit)):
        if size <= too_small:
            continue
        if fits(size):
            break
        too_small = size
    else:
        return None
    # bisection in the logarithm: the tolerance is relative
    while size / too_small > 1.0 + RELATIVE_TOLERANCE:
        middle = round_up(math.sqrt(too_small * size), unit)
        # rounding up may return the upper end
        if middle >= size:
            break
        if fits(middle):
            size = middle
        else:
            too_small = middle
    return size


def max_size(too_small: float, default_size: float, unit: str) -> float:
    """Return the upper limit of the search, inch."""
    return round_up(MAX_SCALE * max(default_size, too_small), unit)


def unit_step(unit: str) -> float:
    """Return the resolution of displayed sizes in a unit, inch.

    Parameters
    ----------
    unit : str

    Examples
    --------
    >>> round(unit_step("mm"), 5)
    0.03937
    """
    return {"mm": 1.0, "cm": 0.1}.get(unit, 0.01) * LENGTH_UNITS[unit] / INCH


def round_up(inches: float, unit: str) -> float:
    """Round a length up to the displayed resolution, inch.

    Parameters
    ----------
    inches : float
    unit : str

    Examples
    --------
    >>> format_inches(round_up(1.0, "mm"), "mm")
    '26 mm'
    """
    return math.ceil(inches / unit_step(unit) - 1e-6) * unit_step(unit)


def format_inches(inches: float, unit: str) -> str:
    """Return a length, inch, as text in a unit.

    Parameters
    ----------
    inches : float
    unit : str

    Examples
    --------
    >>> format_inches(1.0, "cm")
    '2.54 cm'
    """
    return f"{inches * INCH / LENGTH_UNITS[unit]:.4g} {unit}"


MAX_OVERLAP = 0.05
"""Tolerated overlap of two text boxes over the area of the smaller; boxes are slightly larger than their glyphs."""

MIN_PANEL = 0.16
"""Smallest side of a panel, inch (4 mm)."""

MAX_LINES = 3
"""Lines of a label or a title, at most."""

MAX_HIDDEN = 0.25
"""Largest fraction of a panel covered by a legend inside it."""


STACKED_WIDTH = 0.4
"""Fraction of the default width below which columns are mostly stacked: the largest height is tried first (less than the font scale)."""


def fit_figure_size(
    figure: Figure, *, size: tuple[float, float] | FigureSize | None = None, dpi: int = DPI, title: str | None = None
) -> Figure:
    """Return a figure with given size, resolution and title.

    Parameters
    ----------
    figure : Figure
    size : (float, float) or FigureSize, m, optional
        Width and height; errors are in the unit of a :class:`~seisblock.core.units.FigureSize`, else in cm.
    dpi : int, 1/inch
    title : str, optional
        Replaces the title of the figure; empty for none.

    Returns
    -------
    Figure
        `figure`, or its narrow layout with stacked columns if only that fits.

    Raises
    ------
    OutputError
        If the picture has too many pixels, or the text does not fit; the message gives the minimum height or size.
    """
    figure.set_dpi(dpi)
    if title is not None and isinstance(figure, StyledFigure):
        figure.set_title(title)
    if size is not None:
        target_size = size if isinstance(size, FigureSize) else FigureSize(*size)
        _check_pixels(target_size.width / INCH * dpi, target_size.height / INCH * dpi)
        if isinstance(figure, StyledFigure):
            figure = _fit(figure, target_size, title)
        else:
            figure.set_size_inches(target_size.width / INCH, target_size.height / INCH)
    _check_pixels(*(figure.get_size_inches() * dpi))
    return figure


def _check_pixels(wide: float, high: float) -> None:
    """Raise OutputError if a side exceeds :data:`MAX_PIXELS`."""
    if max(wide, high) > MAX_PIXELS:
        raise OutputError(
            "figure of {wide:.0f} x {high:.0f} pixels exceeds the limit of {most} pixels per side: reduce the size or `dpi`",
            wide=wide,
            high=high,
            most=MAX_PIXELS,
        )


def _fit(fig: StyledFigure, target_size: FigureSize, title: str | None) -> StyledFigure:
    """Return a figure fitted to a size; raise OutputError with the minimum height, or the minimum size if no height fits."""
    layout = Layout.of(fig)
    wide, high = target_size.width / INCH, target_size.height / INCH
    min_length = None
    # text has its smallest size at every height of so narrow a figure: if the largest height does not fit, none does
    feasible = fig.narrow_layout is None or wide >= STACKED_WIDTH * layout.width
    if feasible or layout.fits(wide, max_size(high, layout.height, target_size.unit)):
        if layout.fits(wide, high):
            return fig
        min_length = min_size(lambda tall: layout.fits(wide, tall), high, layout.height, target_size.unit)
    if min_length is not None:
        raise OutputError(
            "figure text does not fit in {width} x {height}: minimum height at this width {least}",
            width=format_inches(wide, target_size.unit),
            height=format_inches(high, target_size.unit),
            least=format_inches(min_length, target_size.unit),
        )
    if fig.narrow_layout is not None:
        return _fit(fig.build_narrow(fig.narrow_layout, title), target_size, title)
    # no height fits: search the minimum width at the original aspect ratio
    share = layout.height / layout.width
    min_length = min_size(
        lambda broad: layout.fits(broad, round_up(max(high, share * broad), target_size.unit)), wide, layout.width, target_size.unit
    )
    min_width = max_size(wide, layout.width, target_size.unit) if min_length is None else min_length
    raise OutputError(
        "figure text does not fit in {width} x {height} nor at any height of this width: use {enough} x {tall}",
        width=format_inches(wide, target_size.unit),
        height=format_inches(high, target_size.unit),
        enough=format_inches(min_width, target_size.unit),
        tall=format_inches(round_up(max(high, share * min_width), target_size.unit), target_size.unit),
    )


@dataclass(frozen=True, eq=False)
class Layout:
    """Original layout of a figure, the starting point for every trial size.

    Parameters
    ----------
    fig : StyledFigure
    width, height : float, inch
    texts : list of (Text, str, float)
        Text artists other than tick labels, with content and font size, points.
    rulers : list of (Axis, float)
        Axes and font size of their tick labels.
    keys : dict
        Handles and options of each legend.
    places : list of (Axes, Bbox)
        Panels and their positions before layout, fractions of the figure; every layout starts from these.
    """

    fig: StyledFigure
    width: float
    height: float
    texts: list[tuple[Text, str, float]]
    rulers: list[tuple[Axis, float]]
    keys: dict[Any, tuple[list[Any], dict[str, Any]]]
    places: list[tuple[Axes, Bbox]]

    @classmethod
    def of(cls, fig: StyledFigure) -> Layout:
        """Return the current layout of a figure."""
        rulers = fig.findobj(Axis)
        numbers = {id(label) for ruler in rulers for label in (*ruler.get_ticklabels(), *ruler.get_ticklabels(minor=True))}
        texts = [text for text in fig.findobj(Text) if id(text) not in numbers]
        return cls(
            fig,
            float(fig.get_figwidth()),
            float(fig.get_figheight()),
            [(text, text.get_text(), float(text.get_fontsize())) for text in texts],
            [(ruler, float(ruler.get_tick_params().get("labelsize", TICK_LABEL_SIZE))) for ruler in rulers],
            dict(fig.keys),
            [(axis, axis.get_position(original=True)) for axis in fig.axes],
        )

    def fits(self, width: float, height: float) -> bool:
        """Set the figure to a size, inch, and return True if all text fits without overlap."""
        fig = self.fig
        # restore the original state before every trial, which depends on nothing tried before
        share = max(min(width / self.width, height / self.height, 1.0), MIN_FONT_SCALE)
        fig.set_size_inches(width, height)
        for text, content, size in self.texts:
            text.set_text(content)
            text.set_fontsize(share * size)
        for ruler, size in self.rulers:
            ruler.set_tick_params(labelsize=share * size)
        for axis, place in self.places:
            axis.set_position(place)
            axis.set_in_layout(True)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning)
            # panels that collapse end the trial at once
            warnings.filterwarnings("error", ".*collapsed to zero", UserWarning)
            try:
                self._lay_out(share)
            except UserWarning:
                return False
        return min(_panel_sides(fig)) >= MIN_PANEL and not has_overlaps(fig)

    def _lay_out(self, share: float) -> None:
        """Lay out and draw the figure with fonts scaled by `share`; raise matplotlib's UserWarning if panels collapse."""
        fig = self.fig
        _redraw_legends(fig, self.keys, share, {})
        with use_fonts(fig, fig.locale):
            fig.get_layout_engine().execute(fig)  # type: ignore[union-attr]
            changes = _legend_changes(fig)
            if changes:
                _redraw_legends(fig, self.keys, share, changes)
                set_fonts(fig, fig.locale)
            _wrap_labels(fig)
        # as in drawing: move legends above titles, then lay out again
        fig.lift_legends()
        fig.draw_without_rendering()


def _redraw_legends(
    fig: StyledFigure, keys: dict[Any, tuple[list[Any], dict[str, Any]]], share: float, changes: dict[Any, dict[str, Any]]
) -> None:
    """Redraw every legend at a smaller font size, with changed options for some."""
    for axis, (handles, options) in keys.items():
        smaller = {**options, "fontsize": share * options["fontsize"], **changes.get(axis, {})}
        if axis is None:
            add_figure_legend(fig, handles, **smaller)
        else:
            add_legend(axis, **smaller)


def _legend_changes(fig: StyledFigure) -> dict[Any, dict[str, Any]]:
    """Return changed options of legends: fewer columns if too wide, above the panel if they cover much of it."""
    changes: dict[Any, dict[str, Any]] = {}
    for axis, (_, options) in fig.keys.items():
        key, panel = (fig.legends[0], fig.bbox) if axis is None else (axis.get_legend(), axis.get_window_extent())
        assert key is not None
        box, legend_columns = key.get_window_extent(), min(options["ncols"], len(key.get_texts()))
        if box.width > panel.width and legend_columns > 1:
            changes[axis] = {"ncols": max(int(legend_columns * panel.width / box.width), 1)}
        # a legend inside its panel moves above it if it covers too much
        inside = axis is not None and options["bbox_to_anchor"] is None
        if inside and (box.width * box.height > MAX_HIDDEN * panel.width * panel.height or fig.legend_covers_curve(key)):
            changes[axis] = {**changes.get(axis, {}), "loc": "lower right", "bbox_to_anchor": (1.0, LEGEND_Y), "borderaxespad": 0.0}
    return changes


def _panel_sides(fig: StyledFigure) -> Iterator[float]:
    """Yield the shorter side of each panel, inch."""
    for axis in fig.axes:
        box = axis.get_window_extent()
        if axis.get_label() != "<colorbar>":
            yield min(box.width, box.height) / fig.dpi


def _wrap_labels(fig: StyledFigure) -> None:
    """Wrap labels and titles longer than their panels; hide annotations that do not fit in their panel."""
    renderer = fig.canvas.get_renderer()  # type: ignore[attr-defined]
    for axis in fig.axes:
        box = axis.get_window_extent(renderer)
        for text in (axis.xaxis.label, *panel_titles(axis)):
            _wrap_text(text, box.width, text.get_window_extent(renderer).width)
        upright = axis.yaxis.label
        for name in axis.texts:
            name_box = name.get_window_extent(renderer)
            name.set_visible(not name.get_clip_on() or (box.x0 <= name_box.x0 and name_box.x1 <= box.x1))
        _wrap_text(upright, box.height, upright.get_window_extent(renderer).height)


def _wrap_text(text: Text, available: float, extent: float) -> None:
    """Wrap a text longer than the available length."""
    content = text.get_text()
    if not content or extent <= available:
        return
    longest = max(map(display_width, content.split("\n")))  # `extent` is that of the longest line
    lines = wrap_text(content.replace("\n", " "), max(int(longest * available / extent), 1))
    if len(lines) <= MAX_LINES:
        text.set_text("\n".join(lines))


def has_overlaps(figure: Figure) -> bool:
    """Return True if a text leaves the canvas or overlaps another."""
    renderer = figure.canvas.get_renderer()  # type: ignore[attr-defined]
    boxes = np.array([text.get_window_extent(renderer).extents for text in _visible_texts(figure)])
    edge = 0.01 * figure.dpi
    if boxes[:, :2].min() < -edge or np.any(boxes[:, 2:].max(axis=0) > np.array(figure.bbox.size) + edge):
        return True
    low = np.maximum(boxes[:, None, :2], boxes[None, :, :2])
    high = np.minimum(boxes[:, None, 2:], boxes[None, :, 2:])
    # overlap of every pair over the smaller area, so that a short label inside a long one counts fully
    area = np.prod(boxes[:, 2:] - boxes[:, :2], axis=1)
    shared = np.prod(np.maximum(high - low, 0.0), axis=2) / np.minimum(area[:, None], area[None, :])
    np.fill_diagonal(shared, 0.0)
    return bool((shared > MAX_OVERLAP).any())


def _visible_texts(figure: Figure) -> list[Text]:
    """Return the visible text artists, without tick labels outside the view."""
    parts = figure.findobj()  # one search for both kinds: it takes as long as a tenth of a layout
    off_scale: set[int] = set()
    for ruler in (part for part in parts if isinstance(part, Axis)):
        first, last = sorted(ruler.get_view_interval())
        for tick in (*ruler.get_major_ticks(), *ruler.get_minor_ticks()):
            if not first <= tick.get_loc() <= last:
                off_scale |= {id(tick.label1), id(tick.label2)}
    texts = (part for part in parts if isinstance(part, Text) and part.get_visible() and part.get_text().strip())
    return [text for text in texts if id(text) not in off_scale]

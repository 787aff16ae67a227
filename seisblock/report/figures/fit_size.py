"""A figure of the size asked for: letters shrink, labels and titles break, keys give way; what still does not fit is refused."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.text import Text
from matplotlib.transforms import Bbox

from seisblock.core.errors import OutputError
from seisblock.core.units import FigureSize
from seisblock.report.figures.fonts import use_fonts
from seisblock.report.figures.min_size import MAX_SCALE, format_inches, min_size, round_up
from seisblock.report.figures.style import (
    DPI,
    INCH,
    LEGEND_Y,
    MAX_PIXELS,
    MIN_FONT_SCALE,
    TICK_LABEL_SIZE,
    StyledFigure,
    add_figure_legend,
    add_legend,
)
from seisblock.report.text.wrap import display_width, wrap_text

MAX_OVERLAP = 0.05
"""Share of a text's box that may lie in another's: boxes are a little larger than letters."""

MIN_PANEL = 0.16
"""Inches, 4 mm: a panel that is flatter or narrower shows nothing."""

MAX_LINES = 3
"""Of a label or a title."""

MAX_HIDDEN = 0.25
"""Share of a panel that a key inside it may take."""


def fit_figure_size(
    figure: Figure, *, size: tuple[float, float] | FigureSize | None = None, dpi: int = DPI, title: str | None = None
) -> Figure:
    """Return a figure in the size, at the resolution and under the title asked for.

    Parameters
    ----------
    figure : Figure
    size : (float, float) or Size, m, optional
        Width and height; what is refused is told in the unit of a :class:`~seisblock.core.units.FigureSize`, else in cm.
    dpi : int, 1/inch
    title : str, optional
        Instead of the figure's own; empty for none.

    Returns
    -------
    Figure
        The one given, or the form it has with its columns below each other, where only that one fits.

    Raises
    ------
    OutputError
        If that makes more pixels than a picture can hold, or its texts do not fit: with the least height, or size, in which they do.
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
    """Refuse a picture of too many pixels."""
    if max(wide, high) > MAX_PIXELS:
        raise OutputError(
            "a figure of {wide:.0f} x {high:.0f} pixels is larger than {most}: make it smaller, or give it fewer dots per inch",
            wide=wide,
            high=high,
            most=MAX_PIXELS,
        )


def _fit(fig: StyledFigure, target_size: FigureSize, title: str | None) -> StyledFigure:
    """Return a figure in a size, or refuse it with the least height in which its texts fit, or the least size where no height will do."""
    layout = Layout.of(fig)
    wide, high = target_size.width / INCH, target_size.height / INCH
    if layout.fits(wide, high):
        return fig
    min_length = min_size(lambda tall: layout.fits(wide, tall), high, layout.height, target_size.unit)
    if min_length is not None:
        raise OutputError(
            "the texts of this figure do not fit into {width} x {height}: at this width it must be {least} high at least",
            width=format_inches(wide, target_size.unit),
            height=format_inches(high, target_size.unit),
            least=format_inches(min_length, target_size.unit),
        )
    if fig.narrow_layout is not None:
        return _fit(fig.build_narrow(fig.narrow_layout, title), target_size, title)
    share = layout.height / layout.width
    min_length = min_size(
        lambda broad: layout.fits(broad, round_up(max(high, share * broad), target_size.unit)), wide, layout.width, target_size.unit
    )
    min_width = round_up(MAX_SCALE * max(layout.width, wide), target_size.unit) if min_length is None else min_length
    raise OutputError(
        "the texts of this figure do not fit into {width} x {height}, nor at any height of this width: give it {enough} x {tall}",
        width=format_inches(wide, target_size.unit),
        height=format_inches(high, target_size.unit),
        enough=format_inches(min_width, target_size.unit),
        tall=format_inches(round_up(max(high, share * min_width), target_size.unit), target_size.unit),
    )


@dataclass(frozen=True, eq=False)
class Layout:
    """A figure as it was made, from which every size is tried anew.

    Parameters
    ----------
    fig : Sheet
    width, height : float, inch
    texts : list of (Text, str, float)
        Each text but the numbers along axes, what it says, and the size of its letters, points.
    rulers : list of (Axis, float)
        The axes and the size of their numbers.
    keys : dict
        How each key was made.
    places : list of (Axes, Bbox)
        Where each panel is before panels are laid out, shares of the figure: a layout begins at these, whatever was tried before.
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
        """Return how a figure is."""
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
        """Give the figure a size, inch, and return whether its texts fit, none on another."""
        fig = self.fig
        share = max(min(width / self.width, height / self.height, 1.0), MIN_FONT_SCALE)
        fig.set_size_inches(width, height)
        fig.narrowed = fig.narrowed or width < self.width
        for text, content, size in self.texts:
            text.set_text(content)
            text.set_fontsize(share * size)
        for ruler, size in self.rulers:
            ruler.set_tick_params(labelsize=share * size)
        for axis, place in self.places:
            axis.set_position(place)
            axis.set_in_layout(True)
        with warnings.catch_warnings(record=True) as remarks:
            # that panels have no room left is what is looked for here
            warnings.simplefilter("always", UserWarning)
            _redraw_legends(fig, self.keys, share, {})
            with use_fonts(fig, fig.locale):
                fig.get_layout_engine().execute(fig)  # type: ignore[union-attr]
            if _layout_failed(remarks):
                return False
            changes = _legend_changes(fig)
            if changes:
                _redraw_legends(fig, self.keys, share, changes)
            _wrap_labels(fig)
            # what drawing would lift, and then lay everything out once more
            fig.lift_legends()
            fig.draw_without_rendering()
            return not _layout_failed(remarks) and min(_panel_sides(fig)) >= MIN_PANEL and not has_overlaps(fig)


def _layout_failed(remarks: list[warnings.WarningMessage]) -> bool:
    """Return whether matplotlib found no room for panels, and left them as they were."""
    return any("collapsed to zero" in str(remark.message) for remark in remarks)


def _redraw_legends(
    fig: StyledFigure, keys: dict[Any, tuple[list[Any], dict[str, Any]]], share: float, changes: dict[Any, dict[str, Any]]
) -> None:
    """Draw every key anew in smaller letters, some of them otherwise."""
    for axis, (handles, options) in keys.items():
        smaller = {**options, "fontsize": share * options["fontsize"], **changes.get(axis, {})}
        if axis is None:
            add_figure_legend(fig, handles, **smaller)
        else:
            add_legend(axis, **smaller)


def _legend_changes(fig: StyledFigure) -> dict[Any, dict[str, Any]]:
    """Return how keys are to be drawn that are wider than their panel, in fewer columns, or hide much of it, above it."""
    changes: dict[Any, dict[str, Any]] = {}
    for axis, (_, options) in fig.keys.items():
        key, panel = (fig.legends[0], fig.bbox) if axis is None else (axis.get_legend(), axis.get_window_extent())
        assert key is not None
        box, legend_columns = key.get_window_extent(), min(options["ncols"], len(key.get_texts()))
        if box.width > panel.width and legend_columns > 1:
            changes[axis] = {"ncols": max(int(legend_columns * panel.width / box.width), 1)}
        inside = axis is not None and options["bbox_to_anchor"] is None
        if inside and (box.width * box.height > MAX_HIDDEN * panel.width * panel.height or fig.legend_covers_curve(key)):
            changes[axis] = {**changes.get(axis, {}), "loc": "lower right", "bbox_to_anchor": (1.0, LEGEND_Y), "borderaxespad": 0.0}
    return changes


def _panel_sides(fig: StyledFigure) -> Iterator[float]:
    """Yield the sides of the panels, inch."""
    for axis in fig.axes:
        box = axis.get_window_extent()
        if axis.get_label() != "<colorbar>":
            yield min(box.width, box.height) / fig.dpi


def _wrap_labels(fig: StyledFigure) -> None:
    """Break the labels and titles that are longer than their panels; a name inside a panel that it does not fit into is left out."""
    renderer = fig.canvas.get_renderer()  # type: ignore[attr-defined]
    with use_fonts(fig, fig.locale):
        for axis in fig.axes:
            box = axis.get_window_extent(renderer)
            panel_title = axis.get_title(loc="left")
            titles = [text for text in axis.get_children() if isinstance(text, Text) and panel_title and text.get_text() == panel_title]
            for text in (axis.xaxis.label, *titles):
                _wrap_text(text, box.width, text.get_window_extent(renderer).width)
            upright = axis.yaxis.label
            for name in axis.texts:
                name_box = name.get_window_extent(renderer)
                name.set_visible(not name.get_clip_on() or (box.x0 <= name_box.x0 and name_box.x1 <= box.x1))
            _wrap_text(upright, box.height, upright.get_window_extent(renderer).height)


def _wrap_text(text: Text, available: float, extent: float) -> None:
    """Break a text that is longer than its room, between words."""
    content = text.get_text()
    if not content or extent <= available:
        return
    longest = max(map(display_width, content.split("\n")))  # it is that which is so long
    lines = wrap_text(content.replace("\n", " "), max(int(longest * available / extent), 1))
    if len(lines) <= MAX_LINES:
        text.set_text("\n".join(lines))


def has_overlaps(figure: Figure) -> bool:
    """Return whether a text of a figure leaves the canvas, or lies on another."""
    renderer = figure.canvas.get_renderer()  # type: ignore[attr-defined]
    boxes = np.array([text.get_window_extent(renderer).extents for text in _visible_texts(figure)])
    edge = 0.01 * figure.dpi
    if boxes[:, :2].min() < -edge or np.any(boxes[:, 2:].max(axis=0) > np.array(figure.bbox.size) + edge):
        return True
    low = np.maximum(boxes[:, None, :2], boxes[None, :, :2])
    high = np.minimum(boxes[:, None, 2:], boxes[None, :, 2:])
    area = np.prod(boxes[:, 2:] - boxes[:, :2], axis=1)
    shared = np.prod(np.maximum(high - low, 0.0), axis=2) / np.minimum(area[:, None], area[None, :])
    np.fill_diagonal(shared, 0.0)
    return bool((shared > MAX_OVERLAP).any())


def _visible_texts(figure: Figure) -> list[Text]:
    """Return the texts that a reader sees."""
    off_scale: set[int] = set()
    for ruler in figure.findobj(Axis):
        first, last = sorted(ruler.get_view_interval())
        for tick in (*ruler.get_major_ticks(), *ruler.get_minor_ticks()):
            if not first <= tick.get_loc() <= last:
                off_scale |= {id(tick.label1), id(tick.label2)}
    texts = (text for text in figure.findobj(Text) if text.get_visible() and text.get_text().strip())
    return [text for text in texts if id(text) not in off_scale]

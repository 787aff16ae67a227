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

from seisblock.errors import OutputError
from seisblock.present.figures.canvas import ABOVE, DPI, INCH, MOST_PIXELS, SMALLEST_LETTERS, TICKS, Sheet, legend, legend_outside
from seisblock.present.figures.fonts import set_letters
from seisblock.present.figures.least import LARGEST, least_that, told, up
from seisblock.present.wrap import columns, wrapped
from seisblock.units import Size

TOUCH = 0.05
"""Share of a text's box that may lie in another's: boxes are a little larger than letters."""

LEAST_PANEL = 0.16
"""Inches, 4 mm: a panel that is flatter or narrower shows nothing."""

MOST_LINES = 3
"""Of a label or a title."""

MOST_HIDDEN = 0.25
"""Share of a panel that a key inside it may take."""


def fitted(figure: Figure, *, size: tuple[float, float] | Size | None = None, dpi: int = DPI, title: str | None = None) -> Figure:
    """Return a figure in the size, at the resolution and under the title asked for.

    Parameters
    ----------
    figure : Figure
    size : (float, float) or Size, m, optional
        Width and height; what is refused is told in the unit of a :class:`~seisblock.units.Size`, else in cm.
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
    if title is not None and isinstance(figure, Sheet):
        figure.entitle(title)
    if size is not None:
        asked = size if isinstance(size, Size) else Size(*size)
        _few_enough(asked.width / INCH * dpi, asked.height / INCH * dpi)
        if isinstance(figure, Sheet):
            figure = _fit(figure, asked, title)
        else:
            figure.set_size_inches(asked.width / INCH, asked.height / INCH)
    _few_enough(*(figure.get_size_inches() * dpi))
    return figure


def _few_enough(wide: float, high: float) -> None:
    """Refuse a picture of too many pixels."""
    if max(wide, high) > MOST_PIXELS:
        raise OutputError(
            "a figure of {wide:.0f} x {high:.0f} pixels is larger than {most}: make it smaller, or give it fewer dots per inch",
            wide=wide,
            high=high,
            most=MOST_PIXELS,
        )


def _fit(sheet: Sheet, asked: Size, title: str | None) -> Sheet:
    """Return a figure in a size, or refuse it with the least height in which its texts fit, or the least size where no height will do."""
    usual = Usual.of(sheet)
    wide, high = asked.width / INCH, asked.height / INCH
    if usual.fits(wide, high):
        return sheet
    least = least_that(lambda tall: usual.fits(wide, tall), high, usual.height, asked.unit)
    if least is not None:
        raise OutputError(
            "the texts of this figure do not fit into {width} x {height}: at this width it must be {least} high at least",
            width=told(wide, asked.unit),
            height=told(high, asked.unit),
            least=told(least, asked.unit),
        )
    if sheet.stacked is not None:
        return _fit(sheet.in_a_column(sheet.stacked, title), asked, title)
    share = usual.height / usual.width
    least = least_that(lambda broad: usual.fits(broad, up(max(high, share * broad), asked.unit)), wide, usual.width, asked.unit)
    enough = up(LARGEST * max(usual.width, wide), asked.unit) if least is None else least
    raise OutputError(
        "the texts of this figure do not fit into {width} x {height}, nor at any height of this width: give it {enough} x {tall}",
        width=told(wide, asked.unit),
        height=told(high, asked.unit),
        enough=told(enough, asked.unit),
        tall=told(up(max(high, share * enough), asked.unit), asked.unit),
    )


@dataclass(frozen=True, eq=False)
class Usual:
    """A figure as it was made, from which every size is tried anew.

    Parameters
    ----------
    sheet : Sheet
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

    sheet: Sheet
    width: float
    height: float
    texts: list[tuple[Text, str, float]]
    rulers: list[tuple[Axis, float]]
    keys: dict[Any, tuple[list[Any], dict[str, Any]]]
    places: list[tuple[Axes, Bbox]]

    @classmethod
    def of(cls, sheet: Sheet) -> Usual:
        """Return how a figure is."""
        rulers = sheet.findobj(Axis)
        numbers = {id(label) for ruler in rulers for label in (*ruler.get_ticklabels(), *ruler.get_ticklabels(minor=True))}
        texts = [text for text in sheet.findobj(Text) if id(text) not in numbers]
        return cls(
            sheet,
            float(sheet.get_figwidth()),
            float(sheet.get_figheight()),
            [(text, text.get_text(), float(text.get_fontsize())) for text in texts],
            [(ruler, float(ruler.get_tick_params().get("labelsize", TICKS))) for ruler in rulers],
            dict(sheet.keys),
            [(axis, axis.get_position(original=True)) for axis in sheet.axes],
        )

    def fits(self, width: float, height: float) -> bool:
        """Give the figure a size, inch, and return whether its texts fit, none on another."""
        sheet = self.sheet
        share = max(min(width / self.width, height / self.height, 1.0), SMALLEST_LETTERS)
        sheet.set_size_inches(width, height)
        sheet.narrowed = sheet.narrowed or width < self.width
        for text, said, size in self.texts:
            text.set_text(said)
            text.set_fontsize(share * size)
        for ruler, size in self.rulers:
            ruler.set_tick_params(labelsize=share * size)
        for axis, place in self.places:
            axis.set_position(place)
            axis.set_in_layout(True)
        with warnings.catch_warnings(record=True) as remarks:
            # that panels have no room left is what is looked for here
            warnings.simplefilter("always", UserWarning)
            _rekey(sheet, self.keys, share, {})
            with set_letters(sheet, sheet.spoken):
                sheet.get_layout_engine().execute(sheet)  # type: ignore[union-attr]
            if _without_room(remarks):
                return False
            few = _given_way(sheet)
            if few:
                _rekey(sheet, self.keys, share, few)
            _break(sheet)
            # what drawing would lift, and then lay everything out once more
            sheet.lift_legends()
            sheet.draw_without_rendering()
            return not _without_room(remarks) and min(_panels(sheet)) >= LEAST_PANEL and not crowded(sheet)


def _without_room(remarks: list[warnings.WarningMessage]) -> bool:
    """Return whether matplotlib found no room for panels, and left them as they were."""
    return any("collapsed to zero" in str(remark.message) for remark in remarks)


def _rekey(sheet: Sheet, keys: dict[Any, tuple[list[Any], dict[str, Any]]], share: float, otherwise: dict[Any, dict[str, Any]]) -> None:
    """Draw every key anew in smaller letters, some of them otherwise."""
    for axis, (handles, where) in keys.items():
        smaller = {**where, "fontsize": share * where["fontsize"], **otherwise.get(axis, {})}
        if axis is None:
            legend_outside(sheet, handles, **smaller)
        else:
            legend(axis, **smaller)


def _given_way(sheet: Sheet) -> dict[Any, dict[str, Any]]:
    """Return how keys are to be drawn that are wider than their panel, in fewer columns, or hide much of it, above it."""
    found: dict[Any, dict[str, Any]] = {}
    for axis, (_, where) in sheet.keys.items():
        key, panel = (sheet.legends[0], sheet.bbox) if axis is None else (axis.get_legend(), axis.get_window_extent())
        assert key is not None
        box, several = key.get_window_extent(), min(where["ncols"], len(key.get_texts()))
        if box.width > panel.width and several > 1:
            found[axis] = {"ncols": max(int(several * panel.width / box.width), 1)}
        inside = axis is not None and where["bbox_to_anchor"] is None
        if inside and (box.width * box.height > MOST_HIDDEN * panel.width * panel.height or sheet.hides_a_curve(key)):
            found[axis] = {**found.get(axis, {}), "loc": "lower right", "bbox_to_anchor": (1.0, ABOVE), "borderaxespad": 0.0}
    return found


def _panels(sheet: Sheet) -> Iterator[float]:
    """Yield the sides of the panels, inch."""
    for axis in sheet.axes:
        box = axis.get_window_extent()
        if axis.get_label() != "<colorbar>":
            yield min(box.width, box.height) / sheet.dpi


def _break(sheet: Sheet) -> None:
    """Break the labels and titles that are longer than their panels; a name inside a panel that it does not fit into is left out."""
    renderer = sheet.canvas.get_renderer()  # type: ignore[attr-defined]
    with set_letters(sheet, sheet.spoken):
        for axis in sheet.axes:
            box = axis.get_window_extent(renderer)
            above = axis.get_title(loc="left")
            titles = [text for text in axis.get_children() if isinstance(text, Text) and above and text.get_text() == above]
            for text in (axis.xaxis.label, *titles):
                _shorten(text, box.width, text.get_window_extent(renderer).width)
            upright = axis.yaxis.label
            for name in axis.texts:
                inside = name.get_window_extent(renderer)
                name.set_visible(not name.get_clip_on() or (box.x0 <= inside.x0 and inside.x1 <= box.x1))
            _shorten(upright, box.height, upright.get_window_extent(renderer).height)


def _shorten(text: Text, room: float, long: float) -> None:
    """Break a text that is longer than its room, between words."""
    said = text.get_text()
    if not said or long <= room:
        return
    longest = max(map(columns, said.split("\n")))  # it is that which is so long
    lines = wrapped(said.replace("\n", " "), max(int(longest * room / long), 1))
    if len(lines) <= MOST_LINES:
        text.set_text("\n".join(lines))


def crowded(figure: Figure) -> bool:
    """Return whether a text of a figure leaves the canvas, or lies on another."""
    renderer = figure.canvas.get_renderer()  # type: ignore[attr-defined]
    boxes = np.array([text.get_window_extent(renderer).extents for text in _seen(figure)])
    edge = 0.01 * figure.dpi
    if boxes[:, :2].min() < -edge or np.any(boxes[:, 2:].max(axis=0) > np.array(figure.bbox.size) + edge):
        return True
    low = np.maximum(boxes[:, None, :2], boxes[None, :, :2])
    high = np.minimum(boxes[:, None, 2:], boxes[None, :, 2:])
    area = np.prod(boxes[:, 2:] - boxes[:, :2], axis=1)
    shared = np.prod(np.maximum(high - low, 0.0), axis=2) / np.minimum(area[:, None], area[None, :])
    np.fill_diagonal(shared, 0.0)
    return bool((shared > TOUCH).any())


def _seen(figure: Figure) -> list[Text]:
    """Return the texts that a reader sees."""
    beyond: set[int] = set()
    for ruler in figure.findobj(Axis):
        first, last = sorted(ruler.get_view_interval())
        for tick in (*ruler.get_major_ticks(), *ruler.get_minor_ticks()):
            if not first <= tick.get_loc() <= last:
                beyond |= {id(tick.label1), id(tick.label2)}
    texts = (text for text in figure.findobj(Text) if text.get_visible() and text.get_text().strip())
    return [text for text in texts if id(text) not in beyond]

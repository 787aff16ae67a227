"""One style for every figure: grey for the input, one accent for the response, shaded bands for phases."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import IO, Any

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.text import Text
from matplotlib.transforms import ScaledTranslation

from seisblock.errors import OutputError
from seisblock.present.directions import phase as called
from seisblock.present.figures.fonts import set_letters
from seisblock.present.files import replacing
from seisblock.results import Phase
from seisblock.units import GAL
from seisblock.words import language

INPUT = "0.45"
ACCENT = "#c0392b"
SECOND = "#1f5a8c"
THRESHOLD = "0.15"
BANDS = ("#f4d9c6", "#cfe3d4", "#d5dcef", "#efe3b8", "#e3d3e8")
"""Colours of phases; light enough that curves stay readable, different in grey."""

DPI = 200
"""Dots per inch, unless told otherwise: what a journal asks of a picture with lines."""

SMALLEST_TITLE = 6.5
"""Points; a longer title is cut."""

SMALLEST_LETTERS = 0.72
"""Of their usual size: 5 points, which a journal still prints, for those that are 7."""

INCH = 0.0254
"""m."""

MOST_PIXELS = 20_000
"""Longest side of a picture."""

TICKS = 8
"""Size of the letters of an axis, points."""

ABOVE = 1.0
"""Height at which a legend stands over its panel, of the panel's."""

SUFFIXES = (".png", ".svg", ".pdf")


class Sheet(Figure):
    """A figure in one language, whose letters are settled, and whose title is made to fit, whenever it is drawn, whoever draws it."""

    def __init__(self, width: float, height: float, *, dpi: float = DPI) -> None:
        super().__init__(figsize=(width, height), dpi=dpi, layout="constrained")
        FigureCanvasAgg(self)
        self.spoken = language()
        self.heading: Text | None = None
        self.narrowed = False

    def entitle(self, text: str) -> None:
        """Put a line above all panels; it is text, never mathematics."""
        if self.heading is not None:
            self.heading.set_text("")
        self.heading = self.suptitle(text, fontsize=10, x=0.01, ha="left", parse_math=False) if text else None

    def draw(self, renderer: Any) -> None:
        """Draw, in fonts that hold the letters."""
        with set_letters(self, self.spoken):
            self._fit_title(renderer)
            if self.narrowed:
                self._lift_legends(renderer)
            super().draw(renderer)

    def resize(self, width: float, height: float) -> None:
        """Take another size, inch; where it is narrower, letters are smaller, and a legend that a title would touch stands above it."""
        share = max(min(width / self.get_figwidth(), 1.0), SMALLEST_LETTERS)
        self.set_size_inches(width, height)
        self.narrowed = self.narrowed or share < 1.0
        for text in self.findobj(Text):
            text.set_fontsize(share * float(text.get_fontsize()))
        for each in self.axes:
            for ruler in (each.xaxis, each.yaxis):
                usual = ruler.get_tick_params().get("labelsize", TICKS)
                ruler.set_tick_params(labelsize=share * float(usual))

    def _lift_legends(self, renderer: Any) -> None:
        """Put each legend that lies on its panel's title above it."""
        engine = self.get_layout_engine()
        if engine is not None:
            engine.execute(self)
        for each in self.axes:
            key = each.get_legend()
            if key is None:
                continue
            box = key.get_window_extent(renderer)
            titles = [text for text in each.findobj(Text) if text.get_text() and text.get_text() == each.get_title(loc="left")]
            for title in titles:
                over = title.get_window_extent(renderer)
                if box.overlaps(over.expanded(1.0, 0.5)):
                    up = ScaledTranslation(0.0, (over.y1 - box.y0) / self.dpi, self.dpi_scale_trans)
                    key.set_bbox_to_anchor((1.0, ABOVE), transform=each.transAxes + up)

    def _fit_title(self, renderer: Any) -> None:
        """Make the title as much smaller as it must be, and cut its end off where that is too small to read."""
        title = self.heading
        if title is None:
            return
        room = 0.98 * self.bbox.width
        wide = title.get_window_extent(renderer).width
        if wide > room:
            size = float(title.get_fontsize())
            title.set_fontsize(max(size * room / wide, SMALLEST_TITLE))
            while title.get_window_extent(renderer).width > room and len(title.get_text()) > 2:
                title.set_text(title.get_text()[:-2] + "…")


def titled(text: str, *, width: float, height: float) -> Sheet:
    """Return an empty figure under its title."""
    made = Sheet(width, height)
    made.entitle(text)
    return made


def new_figure(
    rows: int, *, width: float = 8.0, height: float | None = None, title: str = "", columns: int = 1, **layout: Any
) -> tuple[Sheet, list[Axes]]:
    """Return a figure with stacked panels that share the time axis unless told otherwise."""
    figure = titled(title, width=width, height=height or 1.2 + 1.75 * rows)
    share = layout.pop("sharex", columns == 1)
    axes = figure.subplots(rows, columns, sharex=share, squeeze=False, **layout)
    flat = [axis for row in axes for axis in row]
    for axis in flat:
        dress(axis)
    return figure, flat


def dress(axis: Axes) -> None:
    """Give a panel the common style: a faint grid behind the data, two spines, small figures."""
    axis.grid(True, color="0.9", linewidth=0.6)
    axis.set_axisbelow(True)
    axis.spines[["top", "right"]].set_visible(False)
    axis.tick_params(labelsize=TICKS)


def label(axis: Axes, x: str = "", y: str = "") -> None:
    """Label axes as symbol (unit)."""
    if x:
        axis.set_xlabel(x, fontsize=9)
    if y:
        axis.set_ylabel(y, fontsize=9)


def panel_title(axis: Axes, text: str) -> None:
    """Write over a panel, on the left; what a file says there is text, never mathematics."""
    axis.set_title(text, fontsize=9, loc="left", parse_math=False)


def acceleration_unit(*, gal: bool) -> tuple[float, str]:
    """Return the unit in which accelerations are drawn, m/s^2, and its name."""
    return (GAL, "gal") if gal else (1.0, "m/s²")


def shade(axis: Axes, phases: Iterable[Phase], colours: dict[str, str], *, names: bool = False, direction: str = "") -> None:
    """Shade the phases that have a colour, and name each kind once when asked to, in the direction of the motion."""
    named: set[str] = set()
    for phase in phases:
        if phase.name in colours:
            text = called(phase.name, direction) if names and phase.name not in named else None
            named.add(phase.name)
            axis.axvspan(phase.start_s, phase.end_s, color=colours[phase.name], linewidth=0, alpha=0.8, label=text)


def threshold(axis: Axes, levels: Sequence[float], text: str = "") -> None:
    """Draw horizontal thresholds."""
    for index, level in enumerate(levels):
        axis.axhline(level, color=THRESHOLD, linewidth=0.8, linestyle=(0, (6, 2, 1, 2)), label=text if text and index == 0 else None)


def legend(axis: Axes, **placement: Any) -> None:
    """Add a small legend above the panel, where it hides nothing, when there is something to name."""
    if axis.get_legend_handles_labels()[0]:
        where = {"loc": "lower right", "bbox_to_anchor": (1.0, ABOVE), "borderaxespad": 0.0, "ncols": 5, **placement}
        axis.legend(fontsize=7, framealpha=0.85, edgecolor="none", **where)


def fitted(figure: Figure, *, size: tuple[float, float] | None = None, dpi: int = DPI, title: str | None = None) -> Figure:
    """Return a figure in the size, at the resolution and under the title asked for.

    Parameters
    ----------
    figure : Figure
    size : (float, float), m, optional
        Width and height.
    dpi : int, 1/inch
    title : str, optional
        Instead of the figure's own; empty for none.

    Raises
    ------
    OutputError
        If that makes more pixels than a picture can hold.
    """
    if size is not None:
        wide, high = (side / INCH for side in size)
        if isinstance(figure, Sheet):
            figure.resize(wide, high)
        else:
            figure.set_size_inches(wide, high)
    figure.set_dpi(dpi)
    wide, high = figure.get_size_inches() * dpi
    if max(wide, high) > MOST_PIXELS:
        raise OutputError(
            "a figure of {wide:.0f} x {high:.0f} pixels is larger than {most}: make it smaller, or give it fewer dots per inch",
            wide=wide,
            high=high,
            most=MOST_PIXELS,
        )
    if title is not None and isinstance(figure, Sheet):
        figure.entitle(title)
    return figure


def save(figure: Figure, path: Path | str) -> None:
    """Write a figure, whole or not at all; the suffix decides the format.

    Raises
    ------
    OutputError
        If the suffix is none of .png, .svg, .pdf, or the file cannot be written.
    """
    target = Path(path)
    if target.suffix.lower() not in SUFFIXES:
        raise OutputError("cannot draw {target}: the name must end in {suffixes}", target=target, suffixes=list(SUFFIXES))
    with replacing(target) as temporary:
        figure.savefig(temporary, format=target.suffix[1:].lower(), dpi=figure.dpi)


def save_png(figure: Figure, stream: IO[bytes]) -> None:
    """Write a figure as .png to an open stream."""
    figure.savefig(stream, format="png", dpi=figure.dpi)
    stream.flush()

"""One style for every figure: grey for the input, one accent for the response, shaded bands for phases."""

from __future__ import annotations

import io
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import IO, Any

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.layout_engine import LayoutEngine
from matplotlib.legend import Legend
from matplotlib.text import Text
from matplotlib.transforms import ScaledTranslation

from seisblock.core.i18n import escape_control, get_locale, gettext, use_locale
from seisblock.core.results import Phase
from seisblock.report.directions import phase_label as called
from seisblock.report.figures.fonts import use_fonts
from seisblock.report.figures.spans import span_patch
from seisblock.report.io.atomic import atomic_write, check_figure
from seisblock.report.text.wrap import display_width

INPUT = "0.45"
ACCENT = "#c0392b"
SECOND = "#1f5a8c"
THRESHOLD = "0.15"
BANDS = ("#f4d9c6", "#cfe3d4", "#d5dcef", "#efe3b8", "#e3d3e8")
"""Colours of phases; light enough that curves stay readable, different in grey."""

DPI = 200
"""Dots per inch, unless told otherwise: what a journal asks of a picture with lines."""

MIN_TITLE_SIZE = 6.5
"""Points; a longer title is cut."""

MIN_FONT_SCALE = 0.72
"""Of their usual size: 5 points, which a journal still prints, for those that are 7."""

INCH = 0.0254
"""m."""

SEPARATOR = "   "
"""What stands between the parts of a title."""

MAX_PIXELS = 20_000
"""Longest side of a picture."""

TICK_LABEL_SIZE = 8
"""Size of the letters of an axis, points."""

LEGEND_Y = 1.0
"""Height at which a legend stands over its panel, of the panel's."""

MAX_LEVEL_RATIO = 2.0
"""The nearest threshold is in the picture, though nothing reaches it, up to so many times the ground's peak."""

MARGIN = 1.15
"""Height of a panel over the largest that it shows."""


class StyledFigure(Figure):
    """A figure in one language, whose letters are settled, and whose title is made to fit, whenever it is drawn, whoever draws it."""

    def __init__(self, width: float, height: float, *, dpi: float = DPI) -> None:
        super().__init__(figsize=(width, height), dpi=dpi, layout="constrained")
        FigureCanvasAgg(self)
        self.locale = get_locale()
        self.heading: Text | None = None
        self.narrowed = False
        self.laid_out = False
        self.narrow_layout: Callable[[], StyledFigure] | None = None
        self.keys: dict[Axes | None, tuple[list[Any], dict[str, Any]]] = {}

    def set_title(self, text: str) -> None:
        """Put a line above all panels; it is text, never mathematics."""
        if self.heading is not None:
            self.heading.set_text("")
        self.heading = self.suptitle(escape_control(text), fontsize=10, x=0.01, ha="left", parse_math=False) if text else None

    def build_narrow(self, build: Callable[[], StyledFigure], title: str | None) -> StyledFigure:
        """Return this figure as it is built for a narrow page, in its language, at its resolution, under a title if one is given."""
        with use_locale(self.locale):
            fig = build()
        fig.set_dpi(self.dpi)
        if title is not None:
            fig.set_title(title)
        return fig

    def draw(self, renderer: Any) -> None:
        """Draw, in fonts that hold the letters."""
        with use_fonts(self, self.locale):
            self._fit_title(renderer)
            self.laid_out = self.narrowed and self._apply_layout()
            try:
                super().draw(renderer)
            finally:
                self.laid_out = False

    def get_layout_engine(self) -> LayoutEngine | None:
        """Return what gives the panels their places; nothing while they have just been given them, which is half of a drawing's time."""
        return None if self.laid_out else super().get_layout_engine()

    def legend_covers_curve(self, key: Legend) -> bool:
        """Return whether the key of a panel lies on one of its curves."""
        box, lines = key.get_window_extent(), key.axes.lines if key.axes is not None else ()
        return any(line.get_path().transformed(line.get_transform()).intersects_bbox(box, filled=False) for line in lines)

    def _apply_layout(self) -> bool:
        """Give the panels their places, and return whether these hold: no legend had to be lifted."""
        engine = self.get_layout_engine()
        if engine is not None:
            engine.execute(self)
        return not self.lift_legends()

    def lift_legends(self) -> bool:
        """Put each legend that lies on its panel's title above it, and return whether there was one."""
        renderer = self.canvas.get_renderer()  # type: ignore[attr-defined]
        lifted = False
        for axes in self.axes:
            key = axes.get_legend()
            if key is None:
                continue
            box = key.get_window_extent(renderer)
            titles = [text for text in axes.findobj(Text) if text.get_text() and text.get_text() == axes.get_title(loc="left")]
            for title in titles:
                title_box = title.get_window_extent(renderer)
                if box.overlaps(title_box.expanded(1.0, 0.5)):
                    offset = ScaledTranslation(0.0, (title_box.y1 - box.y0) / self.dpi, self.dpi_scale_trans)
                    key.set_bbox_to_anchor((1.0, LEGEND_Y), transform=axes.transAxes + offset)
                    lifted = True
        return lifted

    def _fit_title(self, renderer: Any) -> None:
        """Make the title as much smaller as it must be, and cut its end off where that is too small to read."""
        title = self.heading
        if title is None:
            return
        room = 0.98 * self.bbox.width
        wide = title.get_window_extent(renderer).width
        if wide > room:
            size = float(title.get_fontsize())
            title.set_fontsize(max(size * room / wide, MIN_TITLE_SIZE))
            if title.get_window_extent(renderer).width > room:
                title.set_text(split_in_two(title.get_text(), SEPARATOR))
            while title.get_window_extent(renderer).width > room and len(title.get_text()) > 2:
                title.set_text(title.get_text()[:-2] + "…")


def split_in_two(text: str, separator: str = " ") -> str:
    """Return a text in two lines, broken between two of its parts as near to the middle as there are.

    Examples
    --------
    >>> split_in_two("rise of G (cm)").splitlines()
    ['rise of', 'G (cm)']
    """
    parts = text.split(separator)
    halves = [(separator.join(parts[:i]), separator.join(parts[i:])) for i in range(1, len(parts))]
    return "\n".join(min(halves, key=lambda pair: max(map(display_width, pair)))) if halves else text


def titled_figure(text: str, *, width: float, height: float) -> StyledFigure:
    """Return an empty figure under its title."""
    fig = StyledFigure(width, height)
    fig.set_title(text)
    return fig


def new_figure(
    rows: int, *, width: float = 8.0, height: float | None = None, title: str = "", columns: int = 1, **layout: Any
) -> tuple[StyledFigure, list[Axes]]:
    """Return a figure with stacked panels that share the time axis unless told otherwise."""
    figure = titled_figure(title, width=width, height=height or 1.2 + 1.75 * rows)
    share = layout.pop("sharex", columns == 1)
    axes = figure.subplots(rows, columns, sharex=share, squeeze=False, **layout)
    flat = [axis for row in axes for axis in row]
    for axis in flat:
        style_axes(axis)
    return figure, flat


def style_axes(axis: Axes) -> None:
    """Give a panel the common style: a faint grid behind the data, two spines, small figures."""
    axis.grid(True, color="0.9", linewidth=0.6)
    axis.set_axisbelow(True)
    axis.spines[["top", "right"]].set_visible(False)
    axis.tick_params(labelsize=TICK_LABEL_SIZE)


def label_axes(axis: Axes, x: str = "", y: str = "") -> None:
    """Label axes as symbol (unit)."""
    if x:
        axis.set_xlabel(x, fontsize=9)
    if y:
        axis.set_ylabel(y, fontsize=9)


def set_panel_title(axis: Axes, text: str) -> None:
    """Write over a panel, on the left; what a file says there is text, never mathematics."""
    axis.set_title(text, fontsize=9, loc="left", parse_math=False)


def shade_phases(axis: Axes, phases: Iterable[Phase], colours: dict[str, str], *, names: bool = False, direction: str = "") -> None:
    """Shade the phases that have a colour, and name each kind once when asked to, in the direction of the motion."""
    stretches: dict[str, list[tuple[float, float]]] = {}
    for phase in phases:
        if phase.name in colours:
            stretches.setdefault(phase.name, []).append((phase.start_s, phase.end_s))
    for name, spans in stretches.items():
        text = called(name, direction) if names else None
        axis.add_patch(span_patch(spans, transform=axis.get_xaxis_transform(), color=colours[name], linewidth=0, alpha=0.8, label=text))


def draw_thresholds(axis: Axes, levels: Sequence[float], text: str = "") -> None:
    """Draw horizontal thresholds."""
    for index, level in enumerate(levels):
        axis.axhline(level, color=THRESHOLD, linewidth=0.8, linestyle=(0, (6, 2, 1, 2)), label=text if text and index == 0 else None)


def fit_ylim(axis: Axes, peak: float, levels: Sequence[tuple[float, float, str]], unit: str) -> list[bool]:
    """Fit a panel to what shakes, from -`limit` to `limit`, and return which levels are within reach; of the others its key tells in words.

    Parameters
    ----------
    axis : Axes
    peak : float
        Largest value of what is drawn.
    levels : sequence of (float, float, str)
        A level on each side of zero, and what happens beyond it.
    unit : str
        Of peak and levels.
    """
    nearest = min((min(abs(low), abs(high)) for low, high, _ in levels), default=0.0)
    limit = MARGIN * (max(peak, nearest) if nearest <= MAX_LEVEL_RATIO * peak else peak)
    if limit > 0.0:
        axis.set_ylim(-limit, limit)
    visible = [min(abs(low), abs(high)) < limit for low, high, _ in levels]
    off_scale = [_off_scale_text(*level, unit) for level, is_visible in zip(levels, visible, strict=True) if not is_visible]
    if off_scale:
        axis.plot([], [], " ", label=gettext("out of sight: {levels}", levels=off_scale))
    return visible


def _off_scale_text(low: float, high: float, name: str, unit: str) -> str:
    """Return what happens beyond two levels, and where they are."""
    alike = abs(abs(low) - abs(high)) < 0.005 * abs(high)
    lower, upper = (float(f"{level:.3g}") for level in (low, high))  # three digits, and no power of ten
    level_text = f"±{abs(upper):g} {unit}" if alike else gettext("{low} and {high}", low=f"{lower:g}", high=f"{upper:+g} {unit}")
    return f"{name} {level_text}"


def add_legend(axis: Axes, **placement: Any) -> None:
    """Add a small key above the panel, where it hides nothing, when there is something to name; its lines are of even length."""
    handles = axis.get_legend_handles_labels()[0]
    if handles:
        options = {"loc": "lower right", "bbox_to_anchor": (1.0, LEGEND_Y), "borderaxespad": 0.0, "ncols": 5, "fontsize": 7, **placement}
        lines = -(-len(handles) // options["ncols"])
        options["ncols"] = -(-len(handles) // lines)
        axis.legend(framealpha=0.85, edgecolor="none", **options)
        _store_legend(axis.get_figure(root=True), axis, handles, options)


def add_figure_legend(figure: Figure, handles: list[Any], **placement: Any) -> None:
    """Add a key of all panels outside of them."""
    options = {"fontsize": 7.5, **placement}
    for old_legend in figure.legends[:]:
        old_legend.remove()
    figure.legend(handles=handles, frameon=False, **options)
    _store_legend(figure, None, handles, options)


def _store_legend(figure: Figure | None, axis: Axes | None, handles: list[Any], options: dict[str, Any]) -> None:
    """Have a figure know how a key was made, so that it can be made in another size."""
    if isinstance(figure, StyledFigure):
        figure.keys[axis] = handles, options


def save(figure: Figure, path: Path | str) -> None:
    """Write a figure, whole or not at all; the suffix decides the format.

    Raises
    ------
    OutputError
        If the suffix is none of .png, .svg, .pdf, or the file cannot be written.
    """
    target = Path(path)
    check_figure(target)
    buffer = io.BytesIO()  # a disk that is full meets matplotlib's .pdf in the middle of its compression
    figure.savefig(buffer, format=target.suffix[1:].lower(), dpi=figure.dpi)
    with atomic_write(target) as temporary:
        temporary.write_bytes(buffer.getbuffer())


def save_png(figure: Figure, stream: IO[bytes]) -> None:
    """Write a figure as .png to an open stream."""
    figure.savefig(stream, format="png", dpi=figure.dpi)
    stream.flush()

"""Common style of the figures: grey input, accent colour for the response, shaded phases."""

from __future__ import annotations

import io
from collections.abc import Callable, Iterable, Sequence
from functools import partial, wraps
from pathlib import Path
from typing import IO, Any, ParamSpec

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.layout_engine import LayoutEngine
from matplotlib.legend import Legend
from matplotlib.text import Text
from matplotlib.transforms import ScaledTranslation

from seisblock.core.i18n import escape_control, get_locale, gettext, use_locale
from seisblock.core.results import Phase
from seisblock.output.directions import phase_label
from seisblock.output.figures.fonts import use_fonts
from seisblock.output.figures.spans import span_patch
from seisblock.output.io.atomic import atomic_write, check_figure
from seisblock.output.text.wrap import display_width

P = ParamSpec("P")

INPUT = "0.45"
ACCENT = "#c0392b"
SECOND = "#1f5a8c"
THRESHOLD = "0.15"
BANDS = ("#f4d9c6", "#cfe3d4", "#d5dcef", "#efe3b8", "#e3d3e8")
"""Colours of phases, light enough for curves on top, distinct in greyscale."""

DPI = 200
"""Default resolution, 1/inch."""

MIN_TITLE_SIZE = 6.5
"""Smallest font size of a title, points; a longer title is truncated."""

MIN_FONT_SCALE = 0.72
"""Smallest font scale: 7 points become 5, the usual minimum of journals."""

INCH = 0.0254
"""One inch, m."""

SEPARATOR = "   "
"""Separator of the parts of a title."""

MAX_PIXELS = 20_000
"""Longest side of a picture, pixels."""

TICK_LABEL_SIZE = 8
"""Font size of tick labels, points."""

LEGEND_Y = 1.0
"""Vertical position of a legend above its panel, axes fraction."""

MAX_LEVEL_RATIO = 2.0
"""The nearest threshold is on scale up to this ratio to the peak of the curve."""

FOOTER_SIZE = 7
"""Font size of the lines below the panels."""

MARGIN = 1.15
"""Limit of an axis over the largest value shown."""


class StyledFigure(Figure):
    """Figure with the locale, fonts and title fitting of the package, applied at every drawing."""

    def __init__(self, width: float, height: float, *, dpi: float = DPI) -> None:
        super().__init__(figsize=(width, height), dpi=dpi, layout="constrained")
        FigureCanvasAgg(self)
        self.locale = get_locale()
        self.heading: Text | None = None
        self.footer: Text | None = None
        self.laid_out = False
        self.narrow_layout: Callable[[], StyledFigure] | None = None
        self.keys: dict[Axes | None, tuple[list[Any], dict[str, Any]]] = {}

    def set_title(self, text: str) -> None:
        """Set the title above all panels, without mathtext."""
        if self.heading is not None:
            self.heading.set_text("")
        self.heading = self.suptitle(escape_control(text), fontsize=10, x=0.01, ha="left", parse_math=False) if text else None

    def set_footer(self, lines: Sequence[str]) -> None:
        """Set lines below all panels, without mathtext."""
        text = escape_control("\n".join(lines))
        self.footer = self.supxlabel(text, fontsize=FOOTER_SIZE, x=0.01, ha="left", parse_math=False)

    def build_narrow(self, build: Callable[[], StyledFigure], title: str | None) -> StyledFigure:
        """Return the narrow layout of this figure with its locale and resolution, and optionally another title."""
        with use_locale(self.locale):
            fig = build()
        if self.footer is not None:
            fig.set_footer(self.footer.get_text().splitlines())
        fig.set_dpi(self.dpi)
        if title is not None:
            fig.set_title(title)
        return fig

    def draw(self, renderer: Any) -> None:
        """Draw with fonts that have the glyphs."""
        with use_fonts(self, self.locale):
            self._fit_title(renderer)
            self._fit_footer(renderer)
            self.laid_out = self._apply_layout()
            try:
                super().draw(renderer)
            finally:
                self.laid_out = False

    def get_layout_engine(self) -> LayoutEngine | None:
        """Return the layout engine; None directly after a layout, which saves half of the drawing time."""
        return None if self.laid_out else super().get_layout_engine()

    def legend_covers_curve(self, key: Legend) -> bool:
        """Return True if the legend of a panel covers one of its curves."""
        box, lines = key.get_window_extent(), key.axes.lines if key.axes is not None else ()
        return any(line.get_path().transformed(line.get_transform()).intersects_bbox(box, filled=False) for line in lines)

    def _apply_layout(self) -> bool:
        """Execute the layout; return True if no legend had to be moved afterwards."""
        engine = self.get_layout_engine()
        if engine is not None:
            engine.execute(self)
        return not self.lift_legends()

    def lift_legends(self) -> bool:
        """Move legends that overlap the title of their panel above the title; return True if any was moved."""
        lifted = False
        for axes in self.axes:
            key = axes.get_legend()
            if key is None:
                continue
            box = key.get_window_extent()
            for title in panel_titles(axes):
                title_box = title.get_window_extent()
                if box.overlaps(title_box.expanded(1.0, 0.5)):
                    offset = ScaledTranslation(0.0, (title_box.y1 - box.y0) / self.dpi, self.dpi_scale_trans)
                    key.set_bbox_to_anchor((1.0, LEGEND_Y), transform=axes.transAxes + offset)
                    lifted = True
        return lifted

    def _fit_footer(self, renderer: Any) -> None:
        """Break the lines of the footer in two where the longest exceeds the figure, or the room beside a legend."""
        text = self.footer
        beside = max((key.get_window_extent(renderer).width for key in self.legends), default=0.0)
        if text is None or text.get_window_extent(renderer).width <= 0.98 * self.bbox.width - beside:
            return
        lines = text.get_text().splitlines()
        text.set_text("\n".join(split_in_two(line, "、" if "、" in line else " ") for line in lines))

    def _fit_title(self, renderer: Any) -> None:
        """Reduce the font size of the title to fit; below the minimum break it in two lines and truncate."""
        title = self.heading
        if title is None:
            return
        available = 0.98 * self.bbox.width
        extent = title.get_window_extent(renderer).width
        if extent > available:
            size = float(title.get_fontsize())
            title.set_fontsize(max(size * available / extent, MIN_TITLE_SIZE))
            if title.get_window_extent(renderer).width > available:
                text = title.get_text()
                title.set_text(split_in_two(text, next((mark for mark in (SEPARATOR, "、") if mark in text), " ")))
            while title.get_window_extent(renderer).width > available and len(title.get_text()) > 2:
                title.set_text(title.get_text()[:-2] + "…")


def narrow_too(build: Callable[P, StyledFigure]) -> Callable[P, StyledFigure]:
    """Return a function of figures that keep its keyword ``narrow=True`` as their layout of a column."""

    @wraps(build)
    def make(*args: P.args, **keywords: P.kwargs) -> StyledFigure:
        fig = build(*args, **keywords)
        narrow: Any = {**keywords, "narrow": True}
        fig.narrow_layout = partial(build, *args, **narrow)
        return fig

    return make


def split_in_two(text: str, separator: str = " ") -> str:
    """Break a text in two lines at the separator nearest to the middle.

    Examples
    --------
    >>> split_in_two("rise of G (cm)").splitlines()
    ['rise of', 'G (cm)']
    """
    parts = text.split(separator)
    halves = [(separator.join(parts[:i]), separator.join(parts[i:])) for i in range(1, len(parts))]
    return "\n".join(min(halves, key=lambda pair: max(map(display_width, pair)))) if halves else text


def titled_figure(text: str, *, width: float, height: float) -> StyledFigure:
    """Return an empty figure with a title."""
    fig = StyledFigure(width, height)
    fig.set_title(text)
    return fig


def new_figure(
    rows: int, *, width: float = 8.0, height: float | None = None, title: str = "", columns: int = 1, **layout: Any
) -> tuple[StyledFigure, list[Axes]]:
    """Return a figure and its panels; a single column shares the x axis by default."""
    figure = titled_figure(title, width=width, height=height or 1.2 + 1.75 * rows)
    share = layout.pop("sharex", columns == 1)
    axes = figure.subplots(rows, columns, sharex=share, squeeze=False, **layout)
    flat = [axis for row in axes for axis in row]
    for axis in flat:
        style_axes(axis)
    return figure, flat


def style_axes(axis: Axes) -> None:
    """Style a panel: faint grid behind the data, two spines, small tick labels."""
    axis.grid(True, color="0.9", linewidth=0.6)
    axis.set_axisbelow(True)
    axis.spines[["top", "right"]].set_visible(False)
    axis.tick_params(labelsize=TICK_LABEL_SIZE)


def panel_titles(axis: Axes) -> list[Text]:
    """Return the text artist of the left-aligned title of a panel, if it has one."""
    content = axis.get_title(loc="left")
    return [part for part in axis.get_children() if isinstance(part, Text) and part.get_text() == content] if content else []


def label_axes(axis: Axes, x: str = "", y: str = "") -> None:
    """Label the axes, in the form "symbol (unit)"."""
    if x:
        axis.set_xlabel(x, fontsize=9)
    if y:
        axis.set_ylabel(y, fontsize=9)


def set_panel_title(axis: Axes, text: str) -> None:
    """Set the title of a panel, left-aligned, without mathtext (text from files may have dollar signs)."""
    axis.set_title(text, fontsize=9, loc="left", parse_math=False)


def shade_phases(axis: Axes, phases: Iterable[Phase], colours: dict[str, str], *, names: bool = False, direction: str = "") -> None:
    """Shade the phases that have a colour, with one legend entry per kind if `names`."""
    stretches: dict[str, list[tuple[float, float]]] = {}
    for phase in phases:
        if phase.name in colours:
            stretches.setdefault(phase.name, []).append((phase.start_s, phase.end_s))
    for name, spans in stretches.items():
        text = phase_label(name, direction) if names else None
        axis.add_patch(span_patch(spans, transform=axis.get_xaxis_transform(), color=colours[name], linewidth=0, alpha=0.8, label=text))


def draw_thresholds(axis: Axes, levels: Sequence[float], text: str = "") -> None:
    """Draw horizontal lines at threshold levels, the first with a legend entry."""
    for index, level in enumerate(levels):
        axis.axhline(level, color=THRESHOLD, linewidth=0.8, linestyle=(0, (6, 2, 1, 2)), label=text if text and index == 0 else None)


def fit_ylim(axis: Axes, peak: float, levels: Sequence[tuple[float, float, str]], unit: str) -> list[bool]:
    """Set symmetric y limits for a curve and return which levels are on scale; the legend lists the others as off scale.

    Parameters
    ----------
    axis : Axes
    peak : float
        Largest absolute value of the curve.
    levels : sequence of (float, float, str)
        Level on each side of zero, and its name.
    unit : str
        Unit of peak and levels.
    """
    nearest = min((min(abs(low), abs(high)) for low, high, _ in levels), default=0.0)
    limit = MARGIN * (max(peak, nearest) if nearest <= MAX_LEVEL_RATIO * peak else peak)
    if limit > 0.0:
        axis.set_ylim(-limit, limit)
    visible = [min(abs(low), abs(high)) < limit for low, high, _ in levels]
    off_scale = [_off_scale_text(*level, unit) for level, is_visible in zip(levels, visible, strict=True) if not is_visible]
    if off_scale:
        axis.plot([], [], " ", label=gettext("off scale: {levels}", levels=off_scale))
    return visible


def _off_scale_text(low: float, high: float, name: str, unit: str) -> str:
    """Return name and values of a pair of levels."""
    alike = abs(abs(low) - abs(high)) < 0.005 * abs(high)
    lower, upper = (float(f"{level:.3g}") for level in (low, high))  # three digits, without exponent
    level_text = f"{abs(upper):g} {unit}" if alike else gettext("{low} and {high}", low=f"{lower:g}", high=f"{upper:+g} {unit}")
    return f"{name} {level_text}"


def add_legend(axis: Axes, **placement: Any) -> None:
    """Add a legend above the panel if any curve has a label, with balanced rows."""
    handles = axis.get_legend_handles_labels()[0]
    if handles:
        options = {"loc": "lower right", "bbox_to_anchor": (1.0, LEGEND_Y), "borderaxespad": 0.0, "ncols": 5, "fontsize": 7, **placement}
        lines = -(-len(handles) // options["ncols"])
        options["ncols"] = -(-len(handles) // lines)
        axis.legend(framealpha=0.85, edgecolor="none", **options)
        _store_legend(axis.get_figure(root=True), axis, handles, options)


def add_figure_legend(figure: Figure, handles: list[Any], **placement: Any) -> None:
    """Add a legend of the figure outside the panels."""
    options = {"fontsize": 7.5, **placement}
    for old_legend in figure.legends[:]:
        old_legend.remove()
    figure.legend(handles=handles, frameon=False, **options)
    _store_legend(figure, None, handles, options)


def _store_legend(figure: Figure | None, axis: Axes | None, handles: list[Any], options: dict[str, Any]) -> None:
    """Store handles and options of a legend for redrawing at another size."""
    if isinstance(figure, StyledFigure):
        figure.keys[axis] = handles, options


def save(figure: Figure, path: Path | str) -> None:
    """Write a figure atomically in the format of the suffix.

    Raises
    ------
    OutputError
        If the suffix is not .png, .svg or .pdf, or the file cannot be written.
    """
    target = Path(path)
    check_figure(target)
    buffer = io.BytesIO()  # matplotlib's PDF writer does not handle a full disk cleanly
    figure.savefig(buffer, format=target.suffix[1:].lower(), dpi=figure.dpi)
    with atomic_write(target) as temporary:
        temporary.write_bytes(buffer.getbuffer())


def save_png(figure: Figure, stream: IO[bytes]) -> None:
    """Write a figure as PNG to an open stream."""
    figure.savefig(stream, format="png", dpi=figure.dpi)
    stream.flush()

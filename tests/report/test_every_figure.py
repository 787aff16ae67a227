"""Every kind of figure, drawn of a record of 300 s in both languages: what a journal would send back is found here first."""

import functools
import io
import itertools
import re

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from matplotlib.container import ErrorbarContainer
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from matplotlib.text import Text

from seisblock.core.errors import OutputError
from seisblock.core.i18n import use_locale
from seisblock.core.units import FigureSize
from seisblock.output.figures import fit_size
from seisblock.output.figures.fit_size import fit_figure_size
from seisblock.output.figures.style import MIN_FONT_SCALE, add_legend, new_figure, set_panel_title
from seisblock.output.figures.svg import embed_figure
from tests.i18n.test_commands import MINUS_NOTHING
from tests.report.long_record import EVERY, OF_THE_RECORD, drawing_functions

pytestmark = pytest.mark.slow

COLUMN, PAGE = 0.085, 0.18
"""Width of a journal column and of its type area, m."""

WIDE = 8.0
"""Inches by default, from which on a figure takes the page."""

TOUCH = 0.05
"""Share of a text's box that may lie in another's: boxes are a little larger than letters."""

APART = 0.12
"""Smallest difference of lightness, of 1, at which two greys are distinct in print."""

UNITS = ("gal", "m/s²")

ALWAYS_GAL = {"a record", "a motion", "response spectrum", "field test", "as fig. 16", "paper, curves", "paper, rates"}
"""A notebook's, and the papers'."""


def test_every_figure_function_is_listed():
    """A new function that returns a figure belongs into the list, or nothing here would look at it."""
    assert {function for function, _ in EVERY.values()} == drawing_functions()
    assert len(EVERY) >= 30


@functools.cache
def figure_of(name, lang):
    """Return a figure, drawn once in a language: every test looks at the same one."""
    with use_locale(lang):
        figure = EVERY[name][1](True)
        figure.draw_without_rendering()
    return figure


@functools.cache
def texts_of(name, lang):
    """Return the texts of a figure, cached: finding them takes as long as drawing."""
    return tuple(visible_texts(figure_of(name, lang)))


def texts_in_unit(name, *, gal):
    """Return the texts of a figure in a unit, which is fixed before it is drawn."""
    if gal:
        return [text.get_text() for text in texts_of(name, "en")]
    with use_locale("en"):
        return [text.get_text() for text in EVERY[name][1](False).findobj(Text)]


@pytest.mark.parametrize("lang", ["en", "ja"])
@pytest.mark.parametrize("name", EVERY)
def test_figure_texts_do_not_overlap_or_leave_canvas(name, lang):
    """F3: every text that is drawn stands by itself, within the figure; and no zero has a sign."""
    assert overlapping_texts(figure_of(name, lang), texts_of(name, lang)) == []
    assert not [text.get_text() for text in texts_of(name, lang) if MINUS_NOTHING.search(text.get_text())]


@pytest.mark.parametrize("name", sorted(set(EVERY) - {"field test"}))  # no command draws that one: it has no --size
def test_figures_fit_journal_column_widths(name):
    """At 85 and 180 mm no texts overlap and none is too small to print; legends give way to titles."""
    with use_locale("ja"):
        figure = EVERY[name][1](True)
        figure = fit_figure_size(figure, size=(PAGE if figure.get_figwidth() >= WIDE else COLUMN, 0.0254 * figure.get_figheight()), dpi=300)
        figure.draw_without_rendering()
    texts = tuple(visible_texts(figure))
    assert overlapping_texts(figure, texts) == []
    assert min(text.get_fontsize() for text in texts) >= 6.5 * MIN_FONT_SCALE


TOO_SMALL = {
    "respond", "rock", "slide", "jump", "uplift", "stack", "rigid3d", "rigid3d, falls", "rigid3d, all azimuths", "any model",
    "measure", "criteria", "fit", "modes", "rate with dowels", "harmonic", "a scan", "fragility of nine", "risk of nine", "secure", "twist",
}  # fmt: skip
"""What has more panels, or columns of them, than 85 mm x 60 mm hold; two components side by side have twice those of one."""


@pytest.mark.parametrize("name", sorted(name for name in EVERY if name != "field test" and not name.endswith(", two")))
def test_small_size_fits_or_is_rejected_with_sufficient_size(name, monkeypatch):
    """At 85 mm x 60 mm no texts overlap or leave the canvas; otherwise the message names a sufficient size in mm."""
    monkeypatch.setattr(fit_size, "RELATIVE_TOLERANCE", 2.0)  # the first size that will do, not the least
    with use_locale("en"):
        figure = EVERY[name][1](True)
        try:
            figure = fit_figure_size(figure, size=FigureSize(COLUMN, 0.06, "mm"))
        except OutputError as error:
            assert name in TOO_SMALL
            figure = EVERY[name][1](True)
            items = [float(side) / 1000 for side in re.findall(r"(\d+) mm", str(error).rpartition(": ")[2])]
            figure = fit_figure_size(figure, size=FigureSize(*([COLUMN, *items] if len(items) == 1 else items), "mm"))
        else:
            assert name not in TOO_SMALL
            assert tuple(figure.get_size_inches()) == pytest.approx((COLUMN / 0.0254, 0.06 / 0.0254))
        figure.draw_without_rendering()
    texts = tuple(visible_texts(figure))
    assert overlapping_texts(figure, texts) == []
    assert min(text.get_fontsize() for text in texts) >= 6.5 * MIN_FONT_SCALE


@pytest.mark.parametrize(
    ("name", "lang"),
    [
        ("rock", "en"),
        ("rock, two", "ja"),
        ("slide, two", "en"),
        ("jump, two", "ja"),
        ("respond, two", "en"),
        ("uplift", "ja"),
        ("uplift, two", "en"),
        ("estimate", "en"),
    ],
)
def test_panels_stack_vertically_at_column_width(name, lang):
    """A column of 85 mm, as high as a page, holds histories, phase planes and both components with the title."""
    with use_locale(lang):
        high = {"uplift, two": 0.4, "rock, two": 0.25}.get(name, 0.235)  # twelve panels; titles of two lines above phase planes
        figure = fit_figure_size(EVERY[name][1](True), size=(COLUMN, high), title="as asked")
        figure.draw_without_rendering()
    assert overlapping_texts(figure, tuple(visible_texts(figure))) == []
    assert figure.get_size_inches() == pytest.approx((COLUMN / 0.0254, high / 0.0254))
    assert figure.heading.get_text() == "as asked"


@pytest.mark.parametrize("lang", ["en", "ja"])
@pytest.mark.parametrize("number", [3, 4])
def test_legend_of_small_figure_moves_above_axes(number, lang):
    """Letters shrink less than a figure: a key that had room among the curves goes above them."""
    with use_locale(lang):
        figure = EVERY[f"as fig. {number} of Okumura"][1](True)
        figure.draw_without_rendering()
        assert not figure.legend_covers_curve(figure.axes[0].get_legend())
        figure = fit_figure_size(figure, size=FigureSize(COLUMN, 0.06, "mm"))
        figure.draw_without_rendering()
    assert not figure.legend_covers_curve(figure.axes[0].get_legend())


def test_footer_leaves_room_for_legend_of_figure():
    """The lines below the criteria ran into the legend beside them."""
    figure = figure_of("criteria", "en")
    (legend,) = figure.legends
    assert not figure.footer.get_window_extent().overlaps(legend.get_window_extent())


@pytest.mark.parametrize("suffix", ["png", "svg"])
def test_legend_moves_above_long_panel_title(suffix):
    """The title of the tutorial's overturned gravestone lost its factor behind the legend."""
    figure, (axis,) = new_figure(1, width=6.0)
    axis.plot([0.0, 1.0], label="rest: |a| < (g + a_v) tan α")
    set_panel_title(axis, "EW  block: overturned; α 0.266 rad, e 0.897; does not overturn at a scale factor of 1.009")
    add_legend(axis)
    figure.savefig(io.BytesIO(), format=suffix)
    assert overlapping_texts(figure, tuple(visible_texts(figure))) == []


@pytest.mark.parametrize("name", ["fragility", "fragility of nine"])
def test_fragility_legend_covers_no_curve(name):
    """Curves rise to the right: the key stands in the corner that they leave."""
    figure = figure_of(name, "en")
    assert [axis for axis in figure.axes if axis.get_legend() and figure.legend_covers_curve(axis.get_legend())] == []


def test_nine_risk_curves_are_distinct_and_labelled():
    """Each has a line of its own, and its name stands within the figure."""
    figure = figure_of("risk of nine", "ja")
    curves = figure.axes[1].lines
    assert len({(str(curve.get_color()), str(curve._unscaled_dash_pattern)) for curve in curves}) == len(curves) == 9
    assert {text.get_text() for text in figure.legends[0].get_texts()} == {curve.get_label() for curve in curves}


@pytest.mark.parametrize("lang", ["en", "ja"])
def test_legend_does_not_cover_title_in_report(lang):
    """A figure that is narrowed for a page lifts its titles over the keys, with the tails of their letters."""
    with use_locale(lang):
        figure = EVERY["measure"][1](True)
        embed_figure(figure, "")
        figure.draw_without_rendering()
    keyed = [axis for axis in figure.axes if axis.get_legend() and axis.get_title(loc="left")]
    assert len(keyed) >= 2
    for axis in keyed:
        title = next(text for text in axis.findobj(Text) if text.get_text() == axis.get_title(loc="left"))
        assert title.get_window_extent().y0 >= axis.get_legend().get_window_extent().y1


@pytest.mark.parametrize("name", OF_THE_RECORD)
def test_figure_title_names_record_and_time(name):
    """F3, P4: station and local time stand above every figure of a record; a name is text, not mathematics (R15)."""
    figure = figure_of(name, "en")
    assert figure.heading.get_text().startswith("X012 小さな町 $a_b$   2024-01-01 16:10:00 JST")
    assert not figure.heading.get_parse_math()


@pytest.mark.parametrize("name", EVERY)
def test_figure_uses_one_acceleration_unit(name):
    """F3: a figure is in gal or m/s², never both; values in m/s² are a hundredth of those in gal."""
    assert not texts_with_unit(UNITS[1], texts_in_unit(name, gal=True))
    if texts_with_unit(UNITS[0], texts_in_unit(name, gal=True)) and name not in ALWAYS_GAL:
        texts = texts_in_unit(name, gal=False)
        assert not texts_with_unit(UNITS[0], texts)
        assert texts_with_unit(UNITS[1], texts)


@pytest.mark.parametrize("name", EVERY)
def test_figures_have_no_empty_panel_or_legend(name):
    """F3: what did not happen has neither."""
    for axis in figure_of(name, "en").axes:
        assert axis.has_data() or axis.get_label() == "<colorbar>"
        if axis.get_legend():
            assert all(text.get_text() for text in axis.get_legend().get_texts())


@pytest.mark.parametrize("name", EVERY)
def test_legend_entries_differ_in_greyscale(name):
    """F3: no two entries of a legend differ in hue alone: in dash, marker or lightness they do, for every eye and every printer."""
    figure = figure_of(name, "en")
    keys = [axis.get_legend_handles_labels() for axis in figure.axes if axis.get_legend()]
    keys += [(key.legend_handles, [text.get_text() for text in key.get_texts()]) for key in figure.legends]
    for handles, names in keys:
        looks = [(name, style_of(handle)) for name, handle in zip(names, handles, strict=True)]
        for (first, (kind, style, light)), (second, (kind_2, style_2, light_2)) in itertools.combinations(looks, 2):
            assert (kind, style) != (kind_2, style_2) or abs(light - light_2) >= APART, (first, second)


def style_of(handle):
    """Return of an entry of a legend what does not depend on its hue: what it is, its dashes and marker, its lightness."""
    if isinstance(handle, Patch):
        return "patch", None, lightness(handle.get_facecolor())
    if isinstance(handle, ErrorbarContainer):
        handle = handle.lines[0]
    if hasattr(handle, "get_marker"):
        return "line", (str(handle._dash_pattern), handle.get_marker(), handle.get_linestyle() == "None"), lightness(handle.get_color())
    colours = handle.get_facecolor() if hasattr(handle, "get_facecolor") else []
    marker = tuple(np.round(handle.get_paths()[0].vertices, 3).ravel()) if hasattr(handle, "get_paths") and handle.get_paths() else None
    return type(handle).__name__, marker, lightness(colours[0]) if len(colours) else 0.0


def lightness(colour):
    """Return how light a colour is, CIE L* over 100."""
    linear = np.array([c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in to_rgb(colour)])
    y = float(linear @ (0.2126, 0.7152, 0.0722))
    return (116.0 * np.cbrt(y) - 16.0) / 100.0 if y > 0.008856 else 9.033 * y


def test_layout_checks_detect_known_faults():
    """A text put on another, one beyond the edge, and two greys alike are found."""
    figure = EVERY["sliding"][1](True)
    figure.text(0.5, 0.5, "one text here")
    figure.text(0.5, 0.505, "another here")
    figure.text(0.95, 0.7, "beyond the edge of it")
    figure.draw_without_rendering()
    assert len(overlapping_texts(figure, tuple(visible_texts(figure)))) == 2
    assert abs(lightness("#c0392b") - lightness("#1f5a8c")) < APART < lightness("#f4d9c6") - lightness("#c0392b")


def texts_with_unit(unit, texts):
    """Return the texts that speak in a unit."""
    return [text for text in texts if unit in text.split() or f"({unit})" in text]


def overlapping_texts(figure: Figure, texts: tuple[Text, ...]) -> list[object]:
    """Return the texts that leave the canvas and the pairs that lie on one another."""
    renderer = figure.canvas.get_renderer()
    boxes = [(text.get_text(), text.get_window_extent(renderer)) for text in texts]
    width, height = figure.bbox.width, figure.bbox.height
    edge = 0.01 * figure.dpi
    away = [message for message, box in boxes if min(box.x0, box.y0) < -edge or box.x1 > width + edge or box.y1 > height + edge]
    pairs = itertools.combinations(boxes, 2)
    return [*away, *((a, b) for (a, first), (b, second) in pairs if overlap_share(first, second) > TOUCH)]


def visible_texts(figure: Figure):
    """Yield the texts that a reader sees, each once."""
    observed = set()
    for axis in figure.axes:
        beyond = {*labels_outside(axis.get_xticklabels(), axis.get_xlim(), 0), *labels_outside(axis.get_yticklabels(), axis.get_ylim(), 1)}
        for text in axis.findobj(Text):
            if text not in beyond and text not in observed and text.get_visible() and text.get_text().strip():
                observed.add(text)
                yield text
    rest = [*figure.texts, *(text for key in figure.legends for text in key.get_texts())]
    yield from (text for text in rest if text.get_text().strip())


def labels_outside(labels, limits, kind):
    """Return the numbers along an axis that stand beyond its ends, where matplotlib draws none."""
    return [text for text in labels if not min(limits) <= text.get_position()[kind] <= max(limits)]


def overlap_share(first, second):
    """Return the share of the smaller box inside the other."""
    wide, high = min(first.x1, second.x1) - max(first.x0, second.x0), min(first.y1, second.y1) - max(first.y0, second.y0)
    return max(wide, 0.0) * max(high, 0.0) / min(first.width * first.height, second.width * second.height)

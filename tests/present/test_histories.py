"""What a figure shows of a long record is what was computed: each point in view, and one line that names the record."""

import functools
import itertools
import re
from datetime import UTC, datetime

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.text import Text

from seisblock import (
    Block,
    Contact,
    Pile,
    PileStone,
    SlidingBase,
    SpringBlock,
    TwoLayerBlock,
    solve_jump,
    solve_respond,
    solve_rock,
    solve_slide,
    solve_stack,
    solve_uplift,
)
from seisblock.measures import measure
from seisblock.present.faces import figure_of
from seisblock.present.figures.curves import MOST_POINTS, thin
from seisblock.present.figures.measure import measure_figure
from seisblock.records import Component, Preparation, Record, motion_of
from seisblock.records.process import scale
from seisblock.words import speaking

DT, SAMPLES = 0.01, 30_000


@functools.cache
def record():
    """Return 300 s at 100 Hz, three components, of which some twenty seconds shake."""
    rng = np.random.default_rng(11)
    time = DT * np.arange(SAMPLES)
    envelope = np.where(time < 50.0, 0.0, ((time - 50.0) / 4.0) ** 2 * np.exp(-(time - 50.0) / 3.0)) + 1e-4
    f = np.fft.rfftfreq(SAMPLES, DT)
    parts = []
    for code, peak, middle in (("NS", 4.5, 1.3), ("EW", 3.6, 1.0), ("UD", 1.4, 4.0)):
        shape = f**2 / ((f**2 - middle**2) ** 2 + (1.2 * middle * f) ** 2 + 1e-9)
        values = np.fft.irfft(np.fft.rfft(rng.standard_normal(SAMPLES)) * shape, SAMPLES) * envelope
        parts.append(Component(code, values * peak / np.abs(values).max()))
    told = {"clock": "JST", "station_name": "小さな町 $a_b$"}
    return Record(tuple(parts), DT, station="X012", start=datetime(2024, 1, 1, 7, 10, tzinfo=UTC), metadata=told)


def motion(component="NS", factor=1.0):
    return motion_of(scale(record(), factor), component)


PAVILION = TwoLayerBlock(2.08, 2.50, 1.06, 1.84, 1303.7, 160.0)
STONES = Pile("two", (PileStone("base", 0.5, 0.5, 0.2), PileStone("sao", 0.25, 0.25, 0.7, on="base")))

SOLVED = {
    "respond": lambda c: solve_respond(Block(0.45, 1.8), motion(c), mu=0.3),
    "rock": lambda c: solve_rock(Block(0.3, 0.9), motion(c)),
    "slide": lambda c: solve_slide(SlidingBase(0.15), motion(c)),
    "jump": lambda c: solve_jump(PAVILION, motion(c, 1.6), contact=Contact(mu=0.18)),
    "uplift": lambda c: solve_uplift(SpringBlock.from_frequency(1.0, 1.0, 2.0, frequency_vertical=6.0, beta=0.7), motion(c)),
    "stack": lambda c: solve_stack(STONES, motion(c)),
}

DRAWN = {
    "respond": lambda r: {"x (cm)": 100.0 * r["displacement"], "θ/α": r["rotation"] / min(r.body.slendernesses)},
    "rock": lambda r: {"θ/α": r["rotation"] / r.outcome.slenderness_rad, "a (gal)": 100.0 * r["ground_acceleration"]},
    "slide": lambda r: {"x − z (mm)": 1e3 * r["displacement"], "velocity (m/s)": r["ground_velocity"] + r["velocity"]},
    "jump": lambda r: {"θ (deg)": np.degrees(r["rotation"]), "x of G (mm)": 1e3 * r["displacement"]},
    "uplift": lambda r: {f"u{'₁₂₃₄'[i]} (mm)": 1e3 * r[f"uplift_{i + 1}"] for i in range(4)},
    "stack": lambda r: {"tilt θ (deg)": np.degrees(r["sao_tilt"]), "slip s (mm)": 1e3 * r["sao_slip"]},
}
"""What each model's figure shows of its response, by the label of the panel's axis."""


@functools.cache
def response(model, component="NS"):
    return SOLVED[model](component)


def deviation(axis, line, time, values):
    """Return how far a line is from what it shows, of the panel's height: where it has each point, or bin by bin."""
    first, last = axis.get_xlim()
    x, y = (np.asarray(data, dtype=float) for data in line.get_data())
    inside = (time >= first) & (time <= last)
    assert inside.sum() > 50
    low, high = axis.get_ylim()
    if inside.sum() <= MOST_POINTS:
        shown = (x >= first) & (x <= last) & ~np.isnan(y)
        if not np.array_equal(x[shown], time[inside]):
            return np.inf  # another line of the panel
        return np.abs(y[shown] - values[inside]).max() / (high - low)
    # as many points as that are told apart by no eye: the extrema of each 2000th of the view
    edges = np.linspace(first, last, 501)
    bins, drawn = (np.digitize(each, edges) for each in (time[inside], x))
    worst = 0.0
    for index in np.unique(bins):
        true, seen = values[inside][bins == index], y[drawn == index]
        if not seen.size:
            return np.inf
        worst = max(worst, abs(true.max() - seen.max()), abs(true.min() - seen.min()))
    return worst / (high - low)


@pytest.mark.parametrize("model", SOLVED)
def test_each_point_in_view_is_drawn(model):
    """F1: no curve is thinned before it is cut to what is shown; what was computed and what the artists hold are compared."""
    found = response(model)
    figure = figure_of([found])
    figure.canvas.draw()
    for text, values in DRAWN[model](found).items():
        (axis,) = [axis for axis in figure.axes if axis.get_ylabel() == text]
        lines = [line for line in axis.get_lines() if len(line.get_xdata()) > 2]
        assert min(deviation(axis, line, found.time, values) for line in lines) < 0.01


def test_the_drawing_on_file_is_the_response(tmp_path):
    """F1: the path in an .svg, taken back to seconds and degrees, is nowhere half a pixel from the response."""
    found = response("jump")
    figure = figure_of([found])
    (axis,) = [axis for axis in figure.axes if axis.get_ylabel() == "θ (deg)"]
    (line,) = [line for line in axis.get_lines() if len(line.get_xdata()) > 2]
    line.set_gid("tilt")
    path = tmp_path / "tilt.svg"
    figure.savefig(path)
    drawn = re.search(r'<g id="tilt">\s*<path d="([^"]+)"', path.read_text(encoding="utf-8"))[1]
    points = np.array([[float(n) for n in pair] for pair in re.findall(r"[ML] (\S+) (\S+)", drawn)])
    points[:, 1] = figure.get_figheight() * 72 - points[:, 1]
    data = axis.transData.inverted().transform(points * figure.dpi / 72)
    first, last = axis.get_xlim()
    inside = (found.time > first) & (found.time < last) & np.append(True, np.diff(found.time) > 0)
    tilt = np.degrees(found["rotation"])[inside]
    pixel = (axis.get_ylim()[1] - axis.get_ylim()[0]) / axis.bbox.height
    assert np.abs(np.interp(found.time[inside], *data.T) - tilt).max() < 2.0 * pixel


def test_a_closer_look_draws_more():
    """What is thinned in one view is whole in a narrower one."""
    figure = measure_figure(record(), measure(record()))
    axis = next(axis for axis in figure.axes if axis.get_title(loc="left").startswith("NS   PGV"))
    axis.set_xlim(0.0, 300.0)
    assert len(axis.get_lines()[0].get_xdata()) <= MOST_POINTS + 4
    axis.set_xlim(55.0, 56.0)
    assert len(axis.get_lines()[0].get_xdata()) == 101 + 2


def test_thinning_keeps_extremes_and_gaps():
    """Against the plain definition: of every bin the lowest and the highest, and the curve is broken where it was."""
    rng = np.random.default_rng(4)
    time, values = np.arange(50_000.0), rng.standard_normal(50_000)
    values[20_000:20_400] = np.nan
    x, y = thin(time, values, 1000)
    assert x.size < 1100 and np.all(np.diff(x) > 0)
    wide = 100
    for start in range(0, 50_000, wide):
        part, kept = values[start : start + wide], y[(x >= start) & (x < start + wide)]
        if not np.isnan(part).all():
            assert np.nanmin(kept) == np.nanmin(part) and np.nanmax(kept) == np.nanmax(part)
    assert np.isnan(y[(x >= 20_000) & (x < 20_400)]).all()


def figures():
    """Yield every figure of a time history, with its name."""
    for model in SOLVED:
        yield model, lambda model=model: figure_of([response(model)])
    yield "respond, two", lambda: figure_of([response("respond", c) for c in ("NS", "EW")])
    yield "measure", lambda: measure_figure(record(), measure(record()))


FIGURES = dict(figures())


@pytest.mark.parametrize("lang", ["en", "ja"])
@pytest.mark.parametrize("name", FIGURES)
def test_no_text_lies_on_another_or_leaves_the_canvas(name, lang):
    """F3: every text that is drawn stands by itself, within the figure."""
    with speaking(lang):
        figure = FIGURES[name]()
        figure.canvas.draw()
    renderer = figure.canvas.get_renderer()
    drawn = [text for text in visible_texts(figure) if text.get_text().strip()]
    boxes = [(text.get_text(), text.get_window_extent(renderer)) for text in drawn]
    width, height = figure.bbox.width, figure.bbox.height
    outside = [told for told, box in boxes if box.x0 < -2 or box.y0 < -2 or box.x1 > width + 2 or box.y1 > height + 2]
    assert not outside
    overlapping = [(a, b) for (a, one), (b, other) in itertools.combinations(boxes, 2) if shared(one, other) > 0.05]
    assert not overlapping


def visible_texts(figure: Figure):
    """Yield the texts that a reader sees."""
    for axis in figure.axes:
        for text in axis.findobj(Text):
            low, high = axis.get_xlim()
            if text in axis.get_xticklabels() and not low <= text.get_position()[0] <= high:
                continue
            bottom, top = axis.get_ylim()
            if text in axis.get_yticklabels() and not min(bottom, top) <= text.get_position()[1] <= max(bottom, top):
                continue
            if text.get_visible():
                yield text
    yield from figure.texts


def shared(one, other):
    """Return how much of the smaller box lies in the other."""
    wide, high = min(one.x1, other.x1) - max(one.x0, other.x0), min(one.y1, other.y1) - max(one.y0, other.y0)
    return max(wide, 0.0) * max(high, 0.0) / min(one.width * one.height, other.width * other.height)


@pytest.mark.parametrize("name", FIGURES)
def test_the_title_says_which_record(name):
    """F3: station, local time and directions stand above every figure; a name is text, not mathematics (R15)."""
    figure = FIGURES[name]()
    figure.canvas.draw()
    assert figure.heading.get_text().startswith("X012 小さな町 $a_b$   2024-01-01 16:10:00 JST")
    assert not figure.heading.get_parse_math()


def test_the_title_says_what_was_done():
    """What was done to the samples is named, without its particulars; a title that is too long is cut, and ends in the figure."""
    prepared = Preparation(highpass_hz=0.1, scale=1.23456789).apply(record())
    figure = figure_of([solve_slide(SlidingBase(0.15), motion_of(prepared, "37"))])
    assert figure.heading.get_text().endswith("37°   high-pass 0.1 Hz; scaled by 1.235")
    figure.entitle("a long name " * 40)
    figure.canvas.draw()
    assert figure.heading.get_text().endswith("…")
    assert figure.heading.get_window_extent().x1 <= figure.bbox.width


def test_a_long_record_opens_on_what_matters():
    """The view holds all motion; the whole record stands as a strip above it, and not where the view shows all of it."""
    found = response("slide")
    figure = figure_of([found])
    strip, *panels = figure.axes
    assert strip.get_xlim() == (0.0, pytest.approx(DT * (SAMPLES - 1)))
    first, last = panels[0].get_xlim()
    slips = [phase for phase in found.phases if phase.name.startswith("slip")]
    assert first <= slips[0].start_s and slips[-1].end_s <= last and last - first < 100.0
    from seisblock.records.process import crop

    short = motion_of(crop(record(), first, last), "NS")
    assert len(figure_of([solve_slide(SlidingBase(0.15), short)]).axes) == 3


def test_what_did_not_happen_has_no_panel():
    """F3: a block at rest has its ground motion and nothing empty beside it."""
    at_rest = solve_rock(Block(1.0, 1.0), motion())
    axes = figure_of([at_rest]).axes
    assert [axis.get_ylabel() for axis in axes] == ["", "a (gal)"]
    with_names = [text.get_text() for axis in axes if axis.get_legend() for text in axis.get_legend().get_texts()]
    assert with_names == ["rests within ± g tan α"]

"""Figures of long records show the computed response: every point in view, and a line that names the record."""

import re

import numpy as np
import pytest
from scipy.integrate import cumulative_simpson

from seisblock import Block, Contact, SlidingBase, solve_jump, solve_respond, solve_rock, solve_slide
from seisblock.measures import measure
from seisblock.models.jump.chain import JumpPhase
from seisblock.models.jump.interpolate import POINTS_PER_PHASE, interpolate_phases
from seisblock.output.figures.curves import MAX_POINTS, decimate, draw_curve
from seisblock.output.figures.solver import response_figure
from seisblock.output.figures.style import new_figure
from seisblock.records import Motion, Preparation, motion_of
from seisblock.records.process import crop
from seisblock.report.figures.measure import measure_figure
from tests.report.long_record import DT, PAVILION, SAMPLES, SOLVED, motion, record, response

VERTICES = 5
"""Of a bar, whose last is its first."""


def tilt_until_fall(result, name):
    """Return the tilt of a stone, and nothing from its fall on."""
    (fell,) = (stone.fell_at_s for stone in result.outcome.stones if stone.name == name)
    return np.where(result.time <= fell, result[f"{name}_tilt"], np.nan)


MAPPING = {
    "respond": lambda r: {"x (cm)": 100.0 * r["displacement"], "θ/α": r["rotation"] / min(r.body.slendernesses)},
    "rock": lambda r: {"θ/α": r["rotation"] / r.outcome.slenderness_rad, "a (gal)": 100.0 * r["ground_acceleration"]},
    "slide": lambda r: {"x − z (cm)": 100.0 * r["displacement"], "v (kine)": 100.0 * (r["ground_velocity"] + r["velocity"])},
    "jump": lambda r: {"θ (deg)": np.degrees(r["rotation"]), "x of G (cm)": 100.0 * r["displacement"]},
    "uplift": lambda r: {f"u{'₁₂₃₄'[i]} (cm)": 100.0 * r[f"uplift_{i + 1}"] for i in range(4)},
    "rigid3d": lambda r: {"tilt (deg)": np.degrees(r["tilt"]), "displacement (cm)": 100.0 * (r["x"] - r["x"][0])},
    "stack": lambda r: {"tilt θ (deg)": np.degrees(tilt_until_fall(r, "sao")), "slip s (cm)": 100.0 * r["base_slip"]},
}
"""What each model's figure shows of its response, by the label of the panel's axis."""


def line_deviation(axis, line, time, values):
    """Return how far a line is from what it shows, of the panel's height: where it has each point, or bin by bin."""
    first, last = axis.get_xlim()
    x, y = (np.asarray(data, dtype=float) for data in line.get_data())
    inside = (time >= first) & (time <= last)
    assert inside.sum() > 50
    low, high = axis.get_ylim()
    if inside.sum() <= MAX_POINTS:
        mask = (x >= first) & (x <= last) & ~np.isnan(y)
        mask &= np.isin(x, time)  # between them a flight has more points than the response
        if not np.array_equal(x[mask], time[inside]):
            return np.inf  # another line of the panel
        return np.abs(y[mask] - values[inside]).max() / (high - low)
    # as many points as that are told apart by no eye: the extrema of each 2000th of the view
    edges = np.linspace(first, last, 501)
    bins, curve = (np.digitize(item, edges) for item in (time[inside], x))
    worst = 0.0
    for index in np.unique(bins):
        true, observed = values[inside][bins == index], y[curve == index]
        if not observed.size:
            return np.inf
        worst = max(worst, abs(true.max() - observed.max()), abs(true.min() - observed.min()))
    return worst / (high - low)


@pytest.mark.parametrize("model", SOLVED)
def test_history_draws_every_point_in_view(model):
    """F1: curves are cut to the shown window before they are thinned; computed and plotted values agree."""
    solution = response(model)
    figure = response_figure([solution])
    figure.canvas.draw()
    for text, values in MAPPING[model](solution).items():
        (axis,) = [axis for axis in figure.axes if axis.get_ylabel() == text]
        lines = [line for line in axis.get_lines() if len(line.get_xdata()) > 2]
        value = np.isfinite(values)
        assert min(line_deviation(axis, line, solution.time[value], values[value]) for line in lines) < 0.01


def test_svg_path_equals_response_within_half_pixel(tmp_path):
    """F1: the path in an .svg, taken back to seconds and degrees, is nowhere half a pixel from the response."""
    solution = response("jump")
    figure = response_figure([solution])
    (axis,) = [axis for axis in figure.axes if axis.get_ylabel() == "θ (deg)"]
    (line,) = [line for line in axis.get_lines() if len(line.get_xdata()) > 2]
    line.set_gid("tilt")
    path = tmp_path / "tilt.svg"
    figure.savefig(path)
    text = re.search(r'<g id="tilt">\s*<path d="([^"]+)"', path.read_text(encoding="utf-8"))[1]
    points = np.array([[float(n) for n in pair] for pair in re.findall(r"[ML] (\S+) (\S+)", text)])
    points[:, 1] = figure.get_figheight() * 72 - points[:, 1]
    data = axis.transData.inverted().transform(points * figure.dpi / 72)
    first, last = axis.get_xlim()
    inside = (solution.time > first) & (solution.time < last) & np.append(True, np.diff(solution.time) > 0)
    tilt = np.degrees(solution["rotation"])[inside]
    pixel = (axis.get_ylim()[1] - axis.get_ylim()[0]) / axis.bbox.height
    assert np.abs(np.interp(solution.time[inside], *data.T) - tilt).max() < 2.0 * pixel


def test_flight_is_drawn_as_parabola():
    """Between two samples a body in the air is where gravity and the ground, as straight as its samples, bring it."""
    solution = response("jump")
    time, curve = interpolate_phases(solution)
    flights = [phase for phase in solution.phases if phase.name == JumpPhase.FLIGHT]
    assert len(flights) > 2
    for flight in flights:
        mask = (time > flight.start_s) & (time < flight.end_s)
        assert mask.sum() >= POINTS_PER_PHASE[JumpPhase.FLIGHT] - 1
        steps = np.append(flight.start_s, time[mask]) - flight.start_s
        low, high = (
            solution["height"][np.searchsorted(solution.time, flight.start_s)],
            solution["height"][np.searchsorted(solution.time, flight.end_s)],
        )
        long = flight.end_s - flight.start_s
        parabola = low + (high - low) * steps / long + 9.80665 / 2 * steps * (long - steps)
        assert np.abs(curve["height"][mask] - parabola[1:]).max() < 1e-7
    # one flight again, by Simpson's rule, twice, of the ground
    flight = max(flights, key=lambda phase: phase.duration_s)
    inside = (time >= flight.start_s) & (time <= flight.end_s)
    t, x = time[inside][1:-1], curve["displacement"][inside][1:-1]
    push = -np.interp(t, solution.motion.time, solution.motion.horizontal)
    speed = cumulative_simpson(push, x=t, initial=0.0)
    path = cumulative_simpson(speed, x=t, initial=0.0)
    assert np.ptp(x - path - np.polyval(np.polyfit(t, x - path, 1), t)) < 1e-6


def test_rocking_between_samples_is_drawn_as_arc():
    """Between samples it leans as on a motion of ten times the samples that runs along the same straight lines; chords do not."""
    time = np.arange(61) * 0.01
    push = np.where(time < 0.03, 9.0, -4.0)
    shaken = Motion.from_arrays(push, 0.01)
    often = Motion.from_arrays(np.interp(np.arange(601) * 0.001, time, push), 0.001)
    result, truth = (solve_jump(PAVILION, item, contact=Contact(mu=0.18), first=True) for item in (shaken, often))
    (rocking,) = [phase for phase in result.phases if phase.name == JumpPhase.ROCKING]
    drawn_at, curve = interpolate_phases(result)
    for name, values in curve.items():
        inside, observed = ((item >= rocking.start_s) & (item <= rocking.end_s) for item in (truth.time, drawn_at))
        true, high = truth[name][inside], np.ptp(truth[name][inside])
        assert np.abs(np.interp(truth.time[inside], drawn_at[observed], values[observed]) - true).max() < 0.01 * high
        assert np.abs(np.interp(truth.time[inside], result.time, result[name]) - true).max() > 0.03 * high


def test_narrower_view_is_not_thinned():
    """A narrower view of a thinned history is complete."""
    figure = measure_figure(record(), measure(record()))
    axis = next(axis for axis in figure.axes if axis.get_title(loc="left").startswith("NS   PGV"))
    axis.set_xlim(0.0, 300.0)
    assert len(axis.get_lines()[0].get_xdata()) <= MAX_POINTS + 4
    axis.set_xlim(55.0, 56.0)
    assert len(axis.get_lines()[0].get_xdata()) == 101 + 2


def test_thinning_keeps_extremes_and_gaps():
    """Against the plain definition: of every bin the lowest and the highest, and the curve is broken where it was."""
    rng = np.random.default_rng(4)
    time, values = np.arange(50_000.0), rng.standard_normal(50_000)
    values[20_000:20_400] = np.nan
    x, y = decimate(time, values, 1000)
    assert x.size < 1100 and np.all(np.diff(x) > 0)
    wide = 100
    for start in range(0, 50_000, wide):
        part, remaining = values[start : start + wide], y[(x >= start) & (x < start + wide)]
        if not np.isnan(part).all():
            assert np.nanmin(remaining) == np.nanmin(part) and np.nanmax(remaining) == np.nanmax(part)
    assert np.isnan(y[(x >= 20_000) & (x < 20_400)]).all()


@pytest.mark.parametrize(("limits", "top"), [((0.0, 2.0), 2.0), (None, 9.0)])
def test_curve_scales_to_the_interval_shown(limits, top):
    """`rigid3d` cut its data to the interval shown; the other figures were scaled by what no panel shows."""
    _, (axis,) = new_figure(1)
    if limits:
        axis.set_xlim(*limits)
    time = np.linspace(0.0, 9.0, 901)
    draw_curve(axis, time, time)
    assert axis.get_ylim()[1] == pytest.approx(top, rel=0.06)
    if limits:
        axis.set_xlim(0.0, 9.0)
        assert axis.lines[0].get_xdata()[-1] == 9.0


def test_thinning_keeps_points_of_quiet_part():
    """Thinning keeps every point of the quiet part beside ten thousand bounces in one second."""
    quiet, crowd = np.arange(0.0, 60.0, 0.02), np.linspace(60.0, 61.0, 300_000)
    time, values = np.concatenate([quiet, crowd]), np.sin(np.concatenate([quiet, 500.0 * crowd]))
    x, y = decimate(time, values, 4000)
    assert x.size < 4100
    np.testing.assert_array_equal(x[x < 60.0 - 61.0 / 2000], quiet[: np.count_nonzero(x < 60.0 - 61.0 / 2000)])
    assert np.interp(quiet, x, y) == pytest.approx(np.sin(quiet), abs=1e-3)


def test_title_lists_processing_steps():
    """The title lists the processing steps without details; a long title is cut within the figure."""
    prepared = Preparation(highpass_hz=0.1, scale=1.23456789).apply(record())
    figure = response_figure([solve_slide(SlidingBase(0.15), motion_of(prepared, "37"))])
    assert figure.heading.get_text().endswith("37°   high-pass 0.1 Hz; scaled by 1.235")
    figure.set_title("a long name " * 40)
    figure.canvas.draw()
    assert figure.heading.get_text().endswith("…")
    assert figure.heading.get_window_extent().x1 <= figure.bbox.width


def test_long_sentence_as_title_is_broken_between_words():
    """A title of one sentence loses nothing where two lines hold it."""
    text = "a tall wooden cabinet with glass doors, JMA intensity 6 upper: overturning probability 0 %, target 5 %: no measure required"
    figure, _ = new_figure(1, width=5.0, height=2.0, title=text)
    figure.draw_without_rendering()
    assert figure.heading.get_text().split("\n") != [text]
    assert " ".join(figure.heading.get_text().split()) == text
    assert figure.heading.get_window_extent().x1 <= figure.bbox.width


def test_long_record_view_contains_all_motion():
    """The view holds all motion; the whole record stands as a strip above it, and not where the view shows all of it."""
    solution = response("slide")
    figure = response_figure([solution])
    strip, *panels = figure.axes
    assert strip.get_xlim() == (0.0, pytest.approx(DT * (SAMPLES - 1)))
    first, last = panels[0].get_xlim()
    slips = [phase for phase in solution.phases if phase.name.startswith("slip")]
    assert first <= slips[0].start_s and slips[-1].end_s <= last and last - first < 100.0
    short = motion_of(crop(record(), first, last), "NS")
    assert len(response_figure([solve_slide(SlidingBase(0.15), short)]).axes) == 3


def test_overview_strip_of_cropped_record_is_labelled():
    """The strip above the strong part labels a cropped record as such."""
    for output, text in ((record(), "NS, full record"), (crop(record(), 40.0, 200.0), "NS, cropped record")):
        strip, *_ = response_figure([solve_slide(SlidingBase(0.15), motion_of(output, "NS"))]).axes
        assert strip.get_title(loc="left").startswith(text)


def test_visible_phases_are_shaded():
    """F1: the width of a band is judged in the shown window, not in the whole record."""
    solution = response("rock")
    (axis,) = [axis for axis in response_figure([solution]).axes if axis.get_ylabel() == "θ/α" and axis.patches]
    first, last = axis.get_xlim()
    shaded = [phase for phase in solution.phases if phase.name != "rest" and phase.duration_s > (last - first) / 2000]
    bands = [band for patch in axis.patches for band in patch.get_path().vertices[:, 0].reshape(-1, VERTICES)]
    assert sorted((band.min(), band.max()) for band in bands) == sorted((phase.start_s, phase.end_s) for phase in shaded)
    assert len(axis.patches) == len({phase.name for phase in shaded})
    assert len(shaded) > len([phase for phase in shaded if phase.duration_s > solution.time[-1] / 2000]) > 3


def test_block_at_rest_has_ground_motion_panel_only():
    """F3: a block at rest has its ground motion and nothing empty beside it."""
    at_rest = solve_rock(Block(0.8, 1.0), motion(), vertical=False)
    axes = response_figure([at_rest]).axes
    assert [axis.get_ylabel() for axis in axes] == ["", "a (gal)"]
    with_names = [text.get_text() for axis in axes if axis.get_legend() for text in axis.get_legend().get_texts()]
    assert with_names == ["rest: |a| < g tan α"]


@pytest.mark.parametrize(
    ("solve", "message"),
    [
        (lambda faint: solve_rock(Block(0.3, 0.9), faint), "rocking threshold 327 gal"),
        (lambda faint: solve_slide(SlidingBase(0.3), faint), "sliding threshold 294 gal"),
        (lambda faint: solve_respond(Block(0.45, 1.8), faint, mu=0.3), "rocking threshold 245 gal, sliding threshold 294 gal"),
        (lambda faint: solve_jump(PAVILION, faint, contact=Contact(mu=0.18)), "rocking threshold 461 gal"),
    ],
    ids=["rock", "slide", "respond", "jump"],
)
def test_weak_record_fills_its_panel(solve, message):
    """The panel of a weak record scales to the record; its key states the limits."""
    faint = motion("NS", 0.007)
    _, axis = response_figure([solve(faint)]).axes
    peak = 100.0 * np.abs(faint.horizontal).max()
    assert axis.get_ylim() == pytest.approx((-1.15 * peak, 1.15 * peak))
    assert [text.get_text() for text in axis.get_legend().get_texts()] == [f"off scale: {message}"]
    assert len([line for line in axis.get_lines() if line.get_xdata().size]) == 1 and not axis.collections


@pytest.mark.parametrize("height", [0.7, 0.74, 0.78, 0.82, 0.9, 2.4])
def test_overturning_limit_is_labelled_only_when_visible(height):
    """F3: the phase plane of a block that leans a little shows no edge, and its legend names none."""
    figure = response_figure([solve_rock(Block(0.3, height), motion())])
    plane = next(axis for axis in figure.axes if axis.get_ylabel() == "θ'/(p α)")
    items = [line for line in plane.get_lines() if not line.get_label().startswith("_")]
    assert all(line.get_path().transformed(line.get_transform()).intersects_bbox(plane.bbox, filled=False) for line in items)
    assert (plane.get_legend() is not None) == bool(items)

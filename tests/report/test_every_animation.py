"""Every film of a long record shows what was computed: the scene, the curves below it, which record it is, as pictures and as a page."""

import functools
import itertools
import json
import math
import re
import shutil
import subprocess

import numpy as np
import pytest
from PIL import Image

from seisblock import Block, load_pile, motion_of, read, solve_respond, solve_rock, solve_stack
from seisblock.bodies.spring_block import CORNER_SIGNS
from seisblock.core.i18n import use_locale
from seisblock.core.registry import get_solver, solver_names
from seisblock.measures import ground_history
from seisblock.models.jump import animate as jump
from seisblock.models.respond import animate as respond
from seisblock.models.rigid3d import animate as rigid3d
from seisblock.models.rock import animate as rock
from seisblock.models.slide import animate as slide
from seisblock.models.stack import animate as stack
from seisblock.models.stack.outcome import rotate_vectors
from seisblock.models.uplift import animate as uplift
from seisblock.output.animation.frames import animation_frames, build_figure
from seisblock.output.animation.html import animation_html
from seisblock.output.animation.render import MAX_FRAMES, AnimationOptions, frame_times
from seisblock.output.animation.scene3d import project, view_axes
from seisblock.output.animation.writers import write_animation
from seisblock.records import crop, scale
from tests.i18n.english import english_words, visible_text
from tests.report.long_record import motion, response
from tests.report.test_every_figure import overlap_share, visible_texts
from tests.report.test_histories import line_deviation, tilt_until_fall

pytestmark = pytest.mark.slow

FILMS = {
    "respond": respond.respond_animation,
    "rock": rock.rocking_animation,
    "slide": slide.slide_animation,
    "jump": jump.jump_animation,
    "uplift": uplift.uplift_animation,
    "stack": stack.stack_animation,
    "rigid3d": rigid3d.rigid3d_animation,
}
SPANS = {
    "respond": respond.motion_interval,
    "rock": rock.motion_interval,
    "slide": lambda r: slide.motion_interval(r.phases, slide.COLOURS, 0.0, 300.0),
    "jump": lambda r: jump.motion_interval(r.phases, jump.COLOURS, 0.0, 300.0),
    "uplift": uplift.motion_interval,
    "stack": lambda r: stack.motion_interval(r, margin=1.5),
    "rigid3d": rigid3d.motion_interval,
}
CURVES = {
    "respond": lambda r: {"x (cm)": 100.0 * r["displacement"], "θ (deg)": np.degrees(r["rotation"])},
    "rock": lambda r: {"θ (deg)": np.degrees(r["rotation"])},
    "slide": lambda r: {"x − z (cm)": 100.0 * r["displacement"]},
    "jump": lambda r: {"θ (deg)": np.degrees(r["rotation"]), "rise of G (cm)": 100.0 * (r["height"] - r.body.centroid_height)},
    "uplift": lambda r: {"u (cm)": 100.0 * r["uplift_1"]},
    "stack": lambda r: {"tilt θ (deg)": np.degrees(tilt_until_fall(r, "sao"))},
    "rigid3d": lambda r: {"tilt (deg)": np.degrees(r["tilt"])},
}
"""What each film shows of its response, by the label of its strip."""

CHROMIUM = shutil.which("chromium") or shutil.which("google-chrome")


def film(model, pictures=200, **options):
    """Return the film of a record of 300 s, at so many moments."""
    solution = response(model)
    return FILMS[model](solution, np.linspace(*SPANS[model](solution), pictures), **options)


@functools.cache
def drawn_stage(model, lang="en", *, gal=True):
    """Return the picture of the middle of a film, drawn once: every test of texts, curves and scales looks at the same one."""
    with use_locale(lang):
        stage = build_figure(film(model, gal=gal), gal=gal)
        stage.show(100, "real time")
        stage.fig.canvas.draw()
    return stage


def test_every_model_has_an_animation():
    """Every model with motion has an animation that is tested here."""
    assert set(FILMS) == {name for name in solver_names() if get_solver(name).animate}
    assert set(solver_names()) == set(FILMS)


@pytest.mark.parametrize("model", FILMS)
def test_frames_draw_every_point_of_the_curve(model):
    """F1: the curves in .gif and .mp4 hold every point of the response in view."""
    result, stage = response(model), drawn_stage(model)
    for label, values in CURVES[model](result).items():
        (axis,) = [axis for axis in stage.panels if " ".join(axis.get_ylabel().split("\n")) == label]
        lines = [line for line in axis.get_lines() if len(line.get_xdata()) > 2]
        value = np.isfinite(values)
        assert min(line_deviation(axis, line, result.time[value], values[value]) for line in lines) < 0.01


@pytest.mark.parametrize("model", FILMS)
def test_pages_draw_every_point_of_the_curve(model):
    """F1: each point of the response in view is on the curve of the page, within a 300th of the height of the strip."""
    solution = response(model)
    data = data_of(animation_html(film(model), AnimationOptions()))
    first, last = data["first"], data["last"]
    for label, values in CURVES[model](solution).items():
        inside = (solution.time > first) & (solution.time < last) & np.isfinite(values)
        (strip,) = [strip for strip in data["strips"] if strip["label"] == label]
        low, high = strip["range"]
        apart = []
        for line in strip["lines"]:
            time, remaining = np.array(line["time"]), np.array(line["values"], dtype=float)
            value = np.interp(solution.time[inside], time, remaining)
            # where two values share an instant, or are thinned to the extremes of a bin, either is right
            nearby = np.fmin(np.abs(value - values[inside]), np.abs(value_before(solution.time[inside], time, remaining) - values[inside]))
            apart.append(np.quantile(nearby, 0.99) / (high - low))
            assert time[0] <= first + 0.11 and time[-1] >= last - 0.11
        assert min(apart) < 1 / 300


def value_before(times, time, values):
    """Return the value of the point before each time."""
    return values[np.clip(np.searchsorted(time, times, side="right") - 1, 0, None)]


def data_of(page):
    """Return what the script of a page is given."""
    return json.loads(re.search(r'id="film">(.*?)</script>', page, re.DOTALL).group(1))


@pytest.mark.parametrize("model", FILMS)
def test_animation_titles_name_the_record(model):
    """Station, local time and direction stand above pictures and pages as above figures."""
    animation = film(model)
    assert drawn_stage(model).fig.heading.get_text().startswith("X012 小さな町 $a_b$   2024-01-01 16:10:00 JST   NS")
    page = animation_html(animation, AnimationOptions())
    assert '<p class="soft">X012 小さな町 $a_b$ · 2024-01-01 16:10:00 JST · NS' in page
    assert ("scaled by 1.6" in page) == (model == "jump")


@pytest.mark.parametrize("model", FILMS)
def test_animation_title_does_not_give_away_the_end(model, tmp_path):
    """The title is the body, with the probability where there are samples; no result stands in it."""
    title = film(model).title
    assert ":" not in title and not re.search("overturn|fall|slid|uplift|jump", title)
    page = tmp_path / "film.html"
    write_animation(lambda times: film(model), (0.0, 1.0), page, AnimationOptions(probability="overturning probability 74 %"))
    assert f"<h1>{title}, overturning probability 74 %</h1>" in page.read_text(encoding="utf-8").replace("\xa0", " ")


@pytest.mark.parametrize("lang", ["en", "ja"])
@pytest.mark.parametrize("model", FILMS)
def test_frame_texts_do_not_overlap(model, lang):
    """Titles, clock, legends and labels stand by themselves, within the picture."""
    stage = drawn_stage(model, lang)
    renderer = stage.fig.canvas.get_renderer()
    boxes = [(text.get_text(), text.get_window_extent(renderer)) for text in visible_texts(stage.fig) if text.get_text().strip()]
    width, height = stage.fig.bbox.width, stage.fig.bbox.height
    assert not [message for message, box in boxes if box.x0 < -2 or box.y0 < -2 or box.x1 > width + 2 or box.y1 > height + 2]
    assert not [(a, b) for (a, first), (b, second) in itertools.combinations(boxes, 2) if overlap_share(first, second) > 0.05]


@pytest.mark.parametrize("model", FILMS)
def test_animation_pages_are_translated(model):
    """Title, notes, legends and labels of the player; and a page of a long record stays small enough to send."""
    with use_locale("ja"):
        page = animation_html(film(model, 3000), AnimationOptions())
    assert not english_words(visible_text(page).replace("$a_b$", "")) and "再生" in page
    assert not english_words(" ".join(strip["label"] for strip in data_of(page)["strips"]))
    assert len(page.encode()) < 1_000_000


@pytest.mark.parametrize("model", FILMS)
def test_acceleration_strip_uses_requested_unit(model):
    """--si: the strip of the ground is in m/s2, its thresholds too."""
    (gal, si) = (film(model, gal=gal).strips[0] for gal in (True, False))
    assert (gal.label, si.label) == ("a (gal)", "a (m/s²)")
    np.testing.assert_allclose(gal.lines[0].values, 100.0 * si.lines[0].values)
    np.testing.assert_allclose(gal.levels, np.multiply(si.levels, 100.0))


@pytest.mark.parametrize(("gal", "unit", "size"), [(True, "cm", 0.01), (False, "m", 1.0)])
def test_magnified_window_uses_requested_unit(gal, unit, size):
    """cm, or with --si m, in pictures; a page's bar of scale knows which, too."""
    animation, stage = film("jump", 40), drawn_stage("jump", gal=gal)
    axis = stage.actors[1].trails[0][1].axes
    assert (axis.get_xlabel(), axis.get_ylabel()) == (f"x ({unit})", f"z ({unit})")
    for ruler in (axis.xaxis, axis.yaxis):
        texts = [float(label.get_text().replace("\N{MINUS SIGN}", "-")) for label in ruler.get_ticklabels()]
        np.testing.assert_allclose(np.multiply(texts, size), ruler.get_ticklocs(), atol=1e-9)
    assert data_of(animation_html(animation, AnimationOptions(gal=gal)))["si"] is not gal


@pytest.mark.parametrize("model", FILMS)
def test_cursor_is_drawn_in_first_and_last_frame(model):
    """It stands on the edge of its strips there: every row of them has it, and it has a head."""
    animation = film(model, 3)
    first, middle, last = (np.asarray(picture, dtype=int) for picture in animation_frames(animation, 1.0, AnimationOptions()))
    for axis in drawn_stage(model).panels:
        box = axis.get_window_extent()
        rows = slice(round(first.shape[0] - box.y1) + 2, round(first.shape[0] - box.y0) - 2)
        begins, ends = (
            np.abs(single[rows, round(x) - 4 : round(x) + 5] - middle[rows, round(x) - 4 : round(x) + 5]).max(axis=2) > 60
            for single, x in ((first, box.x0), (last, box.x1))
        )
        assert ends.any(axis=1).all()
        assert begins.any()


@pytest.mark.parametrize("gal", [True, False])
@pytest.mark.parametrize("model", FILMS)
def test_scale_bar_length_equals_its_label(model, gal):
    """The scale bar has a round length, drawn true to scale in each frame, inside the scene."""
    stage = drawn_stage(model, gal=gal)
    line, text = stage.actors[0].bar
    number, unit = text.get_text().split()
    left, right = line.get_xdata()
    assert right - left == pytest.approx(float(number) * {"mm": 0.001, "cm": 0.01, "m": 1.0}[unit])
    assert gal or unit == "m"
    assert {line, text} <= set(stage.moving)
    view = sorted(line.axes.get_xlim())
    assert 0.1 < (right - left) / (view[1] - view[0]) < 0.34 and view[0] < left and right < view[1]
    if ticks := getattr(stage.actors[0], "ticks", None):  # the marks on the ground stay clear of it
        ground = line.axes.transData.transform((0.0, stage.actors[0].level))[1]
        assert text.get_window_extent().y1 < ground - ticks.get_markersize() * stage.fig.dpi / 72.0 / 2.0


@pytest.mark.parametrize("model", FILMS)
def test_legend_names_every_shaded_band_once(model):
    """Whatever is shaded in a picture is named in it, once."""
    animation = film(model)
    expected = {animation.phase_label(phase.name) for phase in animation.visible_phases if phase.name in animation.colours}
    key = drawn_stage(model).panels[0].get_legend()
    texts = [text.get_text() for text in key.get_texts()] if key else []
    assert sorted(texts) == sorted(expected)


@pytest.mark.parametrize("model", ["respond", "slide", "jump"])
def test_thinned_path_keeps_its_extremes(model, monkeypatch):
    """F1: a thinned path keeps its extent on all sides, however many points it has."""
    animation = film(model, 40)
    (path, *_) = animation.scene.trails
    inside = (path.time >= animation.time[0]) & (path.time <= animation.time[-1])
    monkeypatch.setattr("seisblock.output.animation.html.MAX_PATH_POINTS", 60)
    curve = data_of(animation_html(animation, AnimationOptions()))["scene"]["trails"][0]
    assert len(curve["time"]) < 0.1 * np.count_nonzero(inside)
    assert curve["time"] == sorted(curve["time"])
    for axis in "xz":
        full = getattr(path, axis)[inside]
        assert (min(curve[axis]), max(curve[axis])) == pytest.approx((full.min(), full.max()), abs=5.1e-6)


def test_long_animation_is_limited_to_maximum_frames():
    """A fast animation states its speed."""
    times, speed = frame_times(0.0, 300.0)
    assert len(times) <= MAX_FRAMES and speed == 8.0
    animation = FILMS["slide"](response("slide"), np.asarray(times))
    pictures = list(itertools.islice(animation_frames(animation, speed, AnimationOptions()), 3))
    assert all(isinstance(picture, Image.Image) for picture in pictures) and pictures[0].size == pictures[-1].size


def test_animation_at_rest_has_acceleration_strip_only():
    """Before anything moves the ground's acceleration is all there is."""
    solution = response("rock")
    assert [strip.label for strip in FILMS["rock"](solution, np.linspace(0.0, 5.0, 20)).panels] == ["a (gal)"]


def test_stone_corners_equal_response_channels():
    """Each corner of each stone in a picture is that of the channels, on ground that moves along and up as its displacement."""
    solution = response("stack")
    animation = film("stack", 60)
    scene, motion = animation.scene, solution.motion
    for row, axis in ((0, 0), (2, 2)):
        moved = ground_history(motion.acceleration[row], motion.dt).displacement
        np.testing.assert_allclose(scene.ground_displacement[:, axis], np.interp(animation.time, motion.time, moved), atol=1e-15)
    for stone, solid in zip(solution.body.stones, scene.solids, strict=True):
        index = 40
        nearby = int(np.argmin(np.abs(solution.time - animation.time[index])))
        turn = np.array([solution[f"{stone.name}_q{axis}"][nearby] for axis in "wxyz"])
        corner = np.array([solution[f"{stone.name}_{axis}"][nearby] for axis in "xyz"]) + rotate_vectors(turn, 0.5 * np.array(stone.size))
        assert np.linalg.norm(solid.corners_at(index)[7] - corner) < 0.05 * max(stone.size)


@pytest.mark.parametrize("model", ["stack", "uplift"])
def test_ground_stays_within_view_box(model):
    """The patch of ground stays inside the frame, however far it moves."""
    scene = film(model, 100).scene
    left, right, bottom, _ = scene.extent()
    for index in range(100):
        x, z = project(scene.floor(index)).T
        assert left <= x.min() and x.max() <= right and bottom <= z.min()


def test_ground_patch_extends_below_fallen_stones():
    """The patch of ground is as wide as what has fallen; it was as wide as the foot alone, and stones hung in the air beside it."""
    scene = film("stack", 20).scene
    (left, front), (right, back) = scene.patch[[0, 2], :2]
    beside = np.array([solid.corners_at(-1)[:, :2] for solid in scene.solids if scene.ends_in_sight(solid)])
    assert np.abs(beside).max() > scene.half
    assert left < beside[..., 0].min() and beside[..., 0].max() < right and front < beside[..., 1].min() and beside[..., 1].max() < back


def test_visible_faces_are_drawn_back_to_front():
    """A convex body shows a face if and only if its outward normal points to the viewer; far ones are drawn before near ones."""
    scene, ahead = film("stack", 20).scene, view_axes()[2]
    faces = list(scene.faces(0, 0.0))
    depths = [float(points.mean(axis=0) @ ahead) for points, _, _ in faces]
    assert len(faces) == 3 * len(scene.solids) and depths == sorted(depths)


def test_corner_path_equals_response_with_few_frames():
    """F1: the path behind the foot runs through every point of the response, and ends where the foot is in the picture."""
    result, output = response("jump"), film("jump", 40)
    scene, body = output.scene, output.scene.bodies[0]
    corner = np.array([body.pieces[0].corners[:, 0].max(), body.pieces[0].corners[:, 1].min()])
    stage = build_figure(output)
    stage.show(30, "")
    (items,) = [line for trail, line in stage.actors[0].trails if trail is scene.trails[1]]
    past, come = result.time <= output.time[30], scene.trails[1].time <= output.time[30]
    x, z = items.get_data()
    np.testing.assert_array_equal(x[:-1] - scene.shift[30], scene.trails[1].x[come])
    turn, body_value = result["rotation"][past], np.isin(scene.trails[1].time[come], result.time)  # between them lie points of flights
    np.testing.assert_allclose(z[:-1][body_value], result["height"][past] + corner[1] * np.cos(turn) - corner[0] * np.sin(turn), atol=1e-12)
    np.testing.assert_allclose([x[-1], z[-1]], body.corners_at(corner[None], 30)[0] + [scene.shift[30], 0.0], atol=1e-4)


def test_fallen_stone_changes_colour_at_fall_time():
    """Its edges change colour at the time of the answer."""
    solution = response("stack")
    fell = {stone.name: stone.fell_at_s for stone in solution.outcome.stones}
    assert any(time is not None for time in fell.values())
    for name, solid in zip(solution.body.names, film("stack", 20).scene.solids, strict=True):
        assert solid.fell_s == (math.inf if fell[name] is None else fell[name])


def test_animation_ends_seconds_after_last_fall():
    """Film and figure end some seconds after the last fall, though the fallen drums of a column roll for as long as they are followed."""

    def roll(solution, after):
        place = np.stack([solution[f"{name}_{axis}"] for name in solution.body.names for axis in "xy"])
        return np.abs(place[:, -1] - place[:, solution.time < after][:, -1]).max() > 1.0

    # a collapse is chaotic: in some of them a drum stays up, or the drums stop each other
    record = crop(read("synthetic_jma.csv"), 24.0, 36.0)
    for factor in (1.2, 1.25, 1.3, 1.35):
        solution = solve_stack(load_pile("column"), motion_of(scale(record, factor), "NS"))
        falls = [stone.fell_at_s for stone in solution.outcome.stones]
        if None not in falls and roll(solution, max(falls) + 5.0):
            assert max(falls) < stack.motion_interval(solution, margin=1.5)[1] <= max(falls) + 3.5
            return
    pytest.fail("no drum rolls")


def test_uplifted_corner_is_marked():
    """Uplift: the mark of each corner shows whether its spring is open; the block stands on the magnified heights of its corners."""
    result, output = response("uplift"), film("uplift", 400)
    factor = uplift.magnification(result)
    for i, spring in enumerate(output.scene.springs):
        rise = np.interp(output.time, result.time, result[f"uplift_{i + 1}"])
        np.testing.assert_array_equal(spring.lifted, rise > 0.0)
        assert spring.lifted.any()
        np.testing.assert_allclose(spring.top[:, 2] - spring.free, factor * rise, atol=1e-12)


def test_springs_move_with_the_ground():
    """The drawn springs kept their ends at a fixed height while the ground moved up and down, apart from their corners."""
    animation = film("uplift", 60)
    stage = build_figure(animation)
    heights, ground = [], animation.scene.ground_displacement
    assert np.ptp(ground[:, 2]) > 0.005
    for index, time in enumerate(animation.time):
        stage.actors[0].place(index, time)
        heights.append([np.ptp(coil[:, 1]) for coil in stage.actors[0].springs.get_segments()])
    expected = [np.minimum(spring.top[:, 2], spring.free) * view_axes()[1][2] for spring in animation.scene.springs]
    np.testing.assert_allclose(heights, np.transpose(expected), atol=1e-9)


def test_uplift_tilt_agrees_with_corner_heights():
    """The turn of the cuboid and the heights of its corners, found independently, agree to the curvature of the turn."""
    animation = film("uplift", 100)
    (block,), springs = animation.scene.solids, animation.scene.springs
    for (x, y), spring in zip(CORNER_SIGNS, springs, strict=True):
        corner = block.centre + rotate_vectors(block.turn, 0.5 * np.array(block.size) * np.array([x, y, -1.0]))
        assert np.abs(corner - spring.top).max() < 0.02 * block.size[2]


@functools.cache
def uplift_magnification():
    return uplift.magnification(response("uplift"))


def test_small_motion_is_magnified_by_round_factor():
    """The magnification is 1, 2 or 5 times a power of ten, keeps tilt and rise in the frame, and is stated on the page."""
    factor, result = uplift_magnification(), response("uplift")
    digits = factor / 10.0 ** math.floor(math.log10(factor) + 1e-9)
    assert min(abs(digits - step) for step in (1.0, 2.0, 5.0)) < 1e-9
    rise = max(float(np.abs(result[f"uplift_{i}"]).max()) for i in (1, 2, 3, 4))
    fill = factor * max(result.outcome.max_rotation_rad / uplift.MAX_LEAN, rise / (uplift.MAX_RISE * result.body.height))
    assert 0.39 < fill <= 1.0
    assert f"magnified {factor:g} times" in animation_html(film("uplift"), AnimationOptions())


@pytest.mark.skipif(CHROMIUM is None, reason="no browser is installed")
@pytest.mark.parametrize("model", ["stack", "uplift"])
def test_3d_animation_page_runs_in_browser(model, tmp_path):
    """The script runs: clock at the time of the address, scene and curves drawn, nothing outside the page."""
    probe = """<script>
    const inked = id => { const { width, height } = byId(id), pen = byId(id).getContext("2d");
      return pen.getImageData(0, 0, width, height).data.some((v, i) => i % 4 < 3 && v > 0); };
    document.title = [inked("scene"), inked("strip1"), document.documentElement.scrollWidth <= innerWidth].join();
    </script>"""
    path = tmp_path / "film.html"
    path.write_text(animation_html(film(model), AnimationOptions()) + probe, encoding="utf-8")
    options = ["--headless=new", "--no-sandbox", "--disable-gpu", "--window-size=390,900", "--virtual-time-budget=300"]
    command = [CHROMIUM, *options, f"--user-data-dir={tmp_path}/profile", "--dump-dom", f"{path.as_uri()}#t=56.25"]
    result = subprocess.run(command, capture_output=True, text=True, check=True, timeout=600)
    assert 'id="clock">56.250 s<' in result.stdout
    assert "<title>true,true,true</title>" in result.stdout


def worn_block_that_falls():
    """Return the response of a block with edges worn by a sixth of its width, in the models in which it overturns."""
    block = Block(0.24, 0.9, inset=0.04)
    return solve_rock(block, motion("NS", 1.6)), solve_respond(block, motion("NS", 1.6), mu=0.7)


def test_worn_block_comes_to_rest_on_ground():
    """The block never penetrates the ground nor floats: it turns about its edge, rests on its bevel, then on its side."""
    for result in worn_block_that_falls():
        assert result.outcome.overturned
        (body,) = FILMS[result.model](result, result.time).scene.bodies
        lowest = np.array([body.corners_at(body.pieces[0].corners, i)[:, 1].min() for i in range(result.time.size)])
        leaning = np.abs(result["rotation"]) < math.radians(44.0)
        assert lowest.min() >= -1e-9 and lowest[~leaning].max() < 1e-9 and np.abs(result["rotation"]).max() > math.radians(80.0)


@pytest.mark.parametrize("lang", ["en", "ja"])
@pytest.mark.parametrize("model", FILMS)
def test_strip_labels_fit_their_strips(model, lang):
    """Labels of strips below each other do not run into one another; a foot that is nowhere in the window is not in its key."""
    stage = drawn_stage(model, lang)
    assert all(axis.yaxis.label.get_window_extent().height <= 1.12 * axis.get_window_extent().height for axis in stage.panels)
    for actor in (actor for actor in stage.actors if getattr(actor, "key", None)):
        left, right, bottom, top = actor.scene.close
        texts = {text.get_text() for key in actor.key for text in key.get_texts()}
        for trail in actor.scene.trails:
            mask = (left < trail.x) & (trail.x < right) & (bottom < trail.z) & (trail.z < top)
            assert mask.any() == (trail.name in texts)

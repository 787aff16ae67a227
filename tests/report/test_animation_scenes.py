"""A film shows what the solver found: where the feet are, how the ground moves, as pictures and as one page."""

import json
import re
import shutil
import subprocess
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from seisblock.bodies.block import Block
from seisblock.bodies.toml import read_body_toml
from seisblock.bodies.two_layer import Contact, contact_from_table, two_layer_from_table
from seisblock.measures import ground_history
from seisblock.models.jump.animate import animate as animate_jump
from seisblock.models.jump.animate import jump_animation
from seisblock.models.jump.solve import solve_jump
from seisblock.models.rock.animate import animate as animate_rock
from seisblock.models.rock.animate import rocking_animation
from seisblock.models.rock.solve import solve_rock
from seisblock.output.animation.animation import Animation, Line, Strip
from seisblock.output.animation.frames import format_speed
from seisblock.output.animation.html import animation_html
from seisblock.output.animation.render import AnimationOptions
from seisblock.output.animation.scene2d import Body, Piece, Scene2D, rectangle, rotate
from seisblock.readers import read
from seisblock.records import Motion, motion_of
from seisblock.records.process import crop

CHROMIUM = shutil.which("chromium") or shutil.which("google-chrome")


@pytest.fixture(scope="module")
def jump_response():
    """The bundled record's jump off a floor 30 cm above the ground."""
    body = read_body_toml("chozusha")
    motion = motion_of(crop(read("synthetic_jma.csv"), 26.1, 27.6), "EW")
    return solve_jump(two_layer_from_table(body, "short"), motion, contact=Contact(**contact_from_table(body)), drop=0.3)


@pytest.fixture(scope="module")
def jump_film(jump_response):
    """Its film at 500 moments."""
    return jump_animation(jump_response, np.linspace(jump_response.time[0], jump_response.time[-1], 500))


def points_in_phase(jump_film, name):
    """Return which points of the feet's paths lie in a phase, its ends left out."""
    time = jump_film.scene.trails[0].time
    inside = np.zeros(time.size, dtype=bool)
    for phase in jump_film.phases:
        if phase.name == name:
            inside |= (time > phase.start_s + 1e-3) & (time < phase.end_s - 1e-3)
    return inside


def test_positive_rotation_moves_top_to_plus_x():
    """Positive is clockwise, seen with x to the right and z up."""
    np.testing.assert_allclose(rotate(np.array([[0.0, 1.0]]), 0.1), [[np.sin(0.1), np.cos(0.1)]], atol=1e-15)


def test_rocking_keeps_one_corner_fixed_and_flight_none(jump_film):
    """The pivot is where it was, the flight is free of the floor, and no foot is ever below the ground."""
    left, right = jump_film.scene.trails
    rocking, flying = points_in_phase(jump_film, "rocking"), points_in_phase(jump_film, "flight")
    np.testing.assert_allclose(left.z[rocking], 0.0, atol=1e-4)
    np.testing.assert_allclose(left.x[rocking], left.x[0], atol=1e-4)
    assert np.minimum(left.z, right.z)[flying].max() > 0.01
    assert min(left.z.min(), right.z.min()) > -0.3 - 1e-6


def test_corner_paths_end_at_total_displacement(jump_film, jump_response):
    """The path of each foot ends at the total displacement, 0.3 m further down."""
    total = jump_response.outcome.chains[0].total_displacement_m
    for trail in jump_film.scene.trails:
        assert trail.x[-1] - trail.x[0] == pytest.approx(total, abs=1e-6)
        assert trail.z[-1] == pytest.approx(-0.3, abs=1e-6)


def test_ground_shift_equals_record_displacement(jump_film, jump_response):
    """The shift is the record's displacement on the baseline of PGD."""
    moved = ground_history(jump_response.motion.horizontal, jump_response.motion.dt).displacement
    np.testing.assert_allclose(jump_film.scene.shift, np.interp(jump_film.time, jump_response.motion.time, moved), atol=1e-15)


def test_view_box_contains_every_corner_of_every_frame(jump_film):
    """The box holds every corner of every picture, ground displacement included."""
    left, right, bottom, top = jump_film.scene.extent
    for index in range(0, jump_film.time.size, 7):
        for body in jump_film.scene.bodies:
            for piece in body.pieces:
                corners = body.corners_at(piece.corners, index) + np.array([jump_film.scene.shift[index], 0.0])
                assert (corners >= [left, bottom]).all() and (corners <= [right, top]).all()


def test_scale_bar_is_below_the_ground_marks_of_a_block_on_plinths():
    """The bar lay across a plinth and the marks on the ground."""
    still = np.zeros(2)
    body = Body((Piece(rectangle(-1.0, 1.0, 0.0, 3.0), "w"),), still, still, still)
    scene = Scene2D(still, (body,), (rectangle(-9.0, 9.0, -3.3, -0.3), rectangle(-1.1, -0.9, -0.3, 0.0)))
    bottom, top = scene.extent[2:]
    # the bar is 4 % of the height above the bottom
    assert bottom + 0.04 * (top - bottom) < -0.3 - 0.04 * (top - bottom)


def test_animation_page_is_self_contained(jump_film):
    """Data, script and style stand in the page; what it holds is the film to 0.01 mm."""
    page = animation_html(jump_film, AnimationOptions(slow=4.0))
    data = json.loads(re.search(r'id="film">(.*?)</script>', page, re.DOTALL).group(1))
    curve = data["scene"]["trails"][1]
    path = jump_film.scene.trails[1]
    np.testing.assert_allclose(curve["x"], path.x[(path.time >= jump_film.time[0]) & (path.time <= jump_film.time[-1])], atol=5.1e-6)
    assert data["pace"] == 0.25 and '<option value="0.25" selected>' in page
    assert not re.search(r"https?://|src=|@import|url\(", page)
    assert len(page) < 150_000


def test_animation_page_escapes_titles():
    """A body named like a tag cannot break the page."""
    body = Body((Piece(rectangle(0, 1, 0, 1)),), *np.zeros((3, 2)))
    film = Animation(
        "</script><b>", np.array([0.0, 1.0]), Scene2D(np.zeros(2), (body,), (rectangle(-1, 1, -1, 0),)), heading="<b>", note="<b>"
    )
    page = animation_html(film, AnimationOptions())
    assert "<b>" not in page and page.count("</script>") == 2


@pytest.mark.slow
def test_slow_option_multiplies_frame_count(jump_response, tmp_path):
    """--slow 4 takes four times the pictures, of which each stands as long."""
    for slow in (1.0, 4.0):
        animate_jump(jump_response, tmp_path / f"{slow:g}.gif", AnimationOptions(slow=slow))
    with Image.open(tmp_path / "1.gif") as fast, Image.open(tmp_path / "4.gif") as slow:
        assert slow.n_frames == pytest.approx(4 * fast.n_frames, abs=4)
        assert fast.info["duration"] == slow.info["duration"] == 50
    assert [format_speed(1.0), format_speed(0.25), format_speed(2.0)] == ["real time", "1/4 × real time", "2 × real time"]


def test_animation_reports_progress_per_frame(tmp_path):
    """Progress ends at the number of pictures, which is that of the response's length in real time."""
    t = np.arange(301) * 0.01
    response = solve_rock(Block(0.3, 0.9), Motion.from_arrays(3.4 * np.sin(2 * np.pi * 1.7 * t), 0.01, name="NS"))
    collected = []
    animate_rock(response, tmp_path / "rock.gif", AnimationOptions(progress=lambda result, total: collected.append((result, total))))
    assert collected[-1][0] == collected[-1][1] > 50


def test_rocking_block_stands_on_its_pivot():
    """Leaning to +x the right foot is on the ground and the left one above it."""
    t = np.arange(301) * 0.01
    response = solve_rock(Block(0.3, 0.9), Motion.from_arrays(4.0 * np.sin(2 * np.pi * 1.7 * t), 0.01, name="NS"))
    film = rocking_animation(response, response.time)
    corners = film.scene.bodies[0].pieces[0].corners
    feet = [film.scene.bodies[0].path(corners[i])[1] for i in (0, 1)]
    np.testing.assert_allclose(np.minimum(*feet), 0.0, atol=1e-12)
    lean = response["rotation"]
    assert (feet[0][lean > 1e-6] > 0).all() and (feet[1][lean < -1e-6] > 0).all()


@pytest.mark.skipif(CHROMIUM is None, reason="no browser is installed")
@pytest.mark.parametrize("width", [390, 1280])
def test_animation_page_runs_in_browser(jump_film, tmp_path, width):
    """The script runs: the clock shows the time, and the scene is not empty."""
    path = tmp_path / "film.html"
    path.write_text(animation_html(jump_film, AnimationOptions()) + "<script>document.title = String(byId('scene').width > 300)</script>")
    target = render_in_browser(path, tmp_path, width)
    assert re.search(r'id="clock">2[67]\.\d{3} s<', target)
    assert "<title>true</title>" in target


@pytest.mark.skipif(CHROMIUM is None, reason="no browser is installed")
def test_axis_numbers_of_page_are_not_clipped(jump_film, tmp_path):
    """Numbers end left of their strip and begin inside the page, with any number of digits."""
    tiny = replace(jump_film, strips=(Strip("x (m)", (Line(jump_film.time, np.linspace(0.0, -0.000602, jump_film.time.size)),)),))
    path = tmp_path / "film.html"
    observed = """<script>
      const told = []; CanvasRenderingContext2D.prototype.fillText = function (text, x) {
        told.push([text, this.textAlign === "right" ? x - this.measureText(text).width : x]); };
      draw(); document.title = JSON.stringify(told.filter(each => each[0].includes("0.000602")).map(each => each[1] >= 0));
    </script>"""
    path.write_text(animation_html(tiny, AnimationOptions()) + observed)
    assert "<title>[true]</title>" in render_in_browser(path, tmp_path, 390)


def render_in_browser(path, folder, width):
    """Return a page as a browser has it after its script has run."""
    return subprocess.run(
        [
            CHROMIUM,
            "--headless=new",
            "--no-sandbox",
            "--disable-gpu",
            f"--window-size={width},900",
            "--virtual-time-budget=500",
            f"--user-data-dir={folder}/profile",
            "--dump-dom",
            path.as_uri(),
        ],
        capture_output=True,
        text=True,
        check=True,
        timeout=600,
    ).stdout

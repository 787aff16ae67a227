"""The film of a slide puts the object where its path along the base leads."""

import math

import numpy as np
import pytest
from PIL import Image

from seisblock.bodies.sliding_base import SlidingBase
from seisblock.core.i18n import use_locale
from seisblock.models.slide.animate import animate, position_on_base, slide_animation
from seisblock.models.slide.solve import solve_slide
from seisblock.output.animation.render import AnimationOptions
from seisblock.records import Motion


@pytest.fixture(scope="module")
def response():
    """Six seconds of sliding on level ground."""
    t = np.arange(601) * 0.01
    return solve_slide(0.2, Motion.from_arrays(4.0 * np.sin(2 * np.pi * t), 0.01, name="EW"))


@pytest.mark.parametrize("slope", [-25.0, 0.0, 25.0])
def test_slide_path_length_equals_slip(slope):
    """Along a slope the distance from the start is the slip, downhill on both sides."""
    slip = np.linspace(-0.4, 0.9, 27)
    x, z, turn = position_on_base(SlidingBase(0.8, 0.8, slope), slip)
    np.testing.assert_allclose(np.hypot(x, z), np.abs(slip), atol=1e-15)
    np.testing.assert_allclose(z, -slip * math.sin(math.radians(slope)), atol=1e-15)
    np.testing.assert_allclose(turn, math.radians(slope))


def test_slide_path_is_level_beyond_foot():
    """The path is continuous at the foot, and level behind it."""
    base = SlidingBase(0.8, 0.8, 30.0, slope_length=0.5)
    slip = np.array([0.5 - 1e-9, 0.5, 0.5 + 1e-9, 2.0])
    x, z, turn = position_on_base(base, slip)
    assert np.abs(np.diff(x[:3])).max() < 2e-9 and z[1] == pytest.approx(-0.25) and z[3] == z[1]
    assert x[3] == pytest.approx(0.5 * math.cos(math.radians(30.0)) + 1.5)
    assert list(turn[2:]) == [0.0, 0.0]


def test_object_position_equals_relative_displacement(response):
    """On level ground x is the relative displacement, the base is under it at every picture."""
    film = slide_animation(response, response.time)
    np.testing.assert_array_equal(film.scene.bodies[0].x, response["displacement"])
    left, right, _, _ = film.scene.extent
    floor = film.scene.floors[0][:, 0]
    assert floor.min() + film.scene.shift.max() < left and floor.max() + film.scene.shift.min() > right


@pytest.mark.slow
def test_slide_animation_is_written_as_gif_and_page(response, tmp_path):
    """As a .gif and as a page."""
    animate(response, tmp_path / "slide.gif", AnimationOptions())
    with use_locale("ja"):
        animate(response, tmp_path / "slide.html", AnimationOptions())
    with Image.open(tmp_path / "slide.gif") as image:
        assert image.n_frames > 40
    assert "相対変位" in (tmp_path / "slide.html").read_text(encoding="utf-8")

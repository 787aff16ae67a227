"""One walks around a scene in three dimensions, and all that is in sight stays in the picture."""

import json
import math
import re

import numpy as np
import pytest

from seisblock.output.animation.html import VIEW_AZIMUTHS, animation_html
from seisblock.output.animation.render import AnimationOptions
from seisblock.output.animation.scene3d import AZIMUTH, ELEVATION, Scene3D, Solid, view_axes
from tests.report.test_every_animation import film

PLACE = AZIMUTH + 2.0 * math.pi * np.arange(VIEW_AZIMUTHS) / VIEW_AZIMUTHS


def boxes(model):
    """Return what the page of a film knows: how much of the picture is taken, seen from each direction."""
    animation = re.search(
        r'<script[^>]*type="application/json"[^>]*>(.*?)</script>', animation_html(film(model, 100), AnimationOptions()), re.DOTALL
    )
    return np.array(json.loads(animation.group(1))["scene"]["extents"])


def seen_from(azimuth, points):
    """Return where points stand in the picture of a viewer at an azimuth, to the right and upwards."""
    right, up, _ = view_axes(azimuth, ELEVATION)
    return points @ right, points @ up


@pytest.mark.parametrize("model", ["stack", "uplift"])
@pytest.mark.parametrize("between", [0.0, 0.5])
def test_view_box_contains_all_stones_from_each_azimuth(model, between):
    """Ground and stones on it are in the box of each direction and between two; the box of the first view was taken for all."""
    scene, expected = film(model, 100).scene, boxes(model)
    lying = [solid.corners_at(-1) for solid in scene.solids]
    low, high = scene.patch[0, :2], scene.patch[2, :2]
    on_ground = [corners for corners in lying if (low <= corners[:, :2]).all() and (corners[:, :2] <= high).all()]
    points = np.concatenate([scene.patch, *on_ground]) + scene.ground_displacement[-1]
    for k, azimuth in enumerate(PLACE):
        left, end, bottom, top = (1.0 - between) * expected[k] + between * expected[(k + 1) % VIEW_AZIMUTHS]
        across, rise = seen_from(azimuth + between * 2.0 * math.pi / VIEW_AZIMUTHS, points)
        assert left < across.min() and across.max() < end and bottom < rise.min() and rise.max() < top


def test_view_box_of_first_azimuth_is_too_narrow_for_others():
    """The view box of one azimuth is too narrow for a camera that turns around the fallen stones."""
    expected = boxes("stack")
    assert (np.abs(expected - expected[0]).max(axis=1) > 0.2).any()
    np.testing.assert_allclose(expected[0], film("stack", 100).scene.extent(), atol=1e-4)


def test_view_box_contains_a_body_that_falls_at_its_border():
    """A gravestone that fell to the right was cut in two by the border of the picture: its centre was in sight, its far end was not."""
    right = seen_from(AZIMUTH, np.eye(3))[0]
    half, lying = math.sqrt(0.5), math.atan2(right[1], right[0])
    # lies along the horizontal of the picture
    turn = np.array(
        [math.cos(lying / 2.0) * half, -math.sin(lying / 2.0) * half, math.cos(lying / 2.0) * half, math.sin(lying / 2.0) * half]
    )
    start, end = [0.0, 0.0, 0.315], [*(0.8 * right[:2]), 0.12]
    solid = Solid((0.24, 0.24, 0.63), np.array([start, end]), np.array([[1.0, 0.0, 0.0, 0.0], turn]))
    scene = Scene3D(np.zeros((2, 3)), (solid,), 0.26)
    across, rise = seen_from(AZIMUTH, solid.corners_at(1))
    assert across.max() > scene.visible_radius
    left, end, bottom, top = scene.extent()
    assert left < across.min() and across.max() < end and bottom < rise.min() and rise.max() < top
    assert scene.patch[:, 0].max() > solid.corners_at(1)[:, 0].max()


@pytest.mark.parametrize("displacement", [-3.0, 3.0])
def test_view_box_follows_ground_that_rises_in_the_picture(displacement):
    """A gravestone lost its top where the ground moved away from the viewer."""
    ground = np.linspace(0.0, 1.0, 5)[:, np.newaxis] * [0.0, displacement, 0.0]
    solid = Solid((0.24, 0.24, 0.63), np.tile([0.0, 0.0, 0.315], (5, 1)), np.tile([1.0, 0.0, 0.0, 0.0], (5, 1)))
    left, end, bottom, top = Scene3D(ground, (solid,), 0.26).extent()
    across, rise = seen_from(AZIMUTH, np.concatenate([solid.corners_at(k) + ground[k] for k in range(5)]))
    assert left < across.min() and across.max() < end and bottom < rise.min() and rise.max() < top

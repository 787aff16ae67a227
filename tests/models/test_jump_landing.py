"""Landing and impact: hold or slip of the foot, departure from the floor, the paper's spin."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from seisblock.bodies.two_layer import TwoLayerBlock
from seisblock.models.jump import modes
from seisblock.models.jump.flight import flight_reset
from seisblock.models.jump.impact import launch, spin_ratio

pytestmark = pytest.mark.kernel

G = 9.8
SHORT = TwoLayerBlock(2.08, 2.50, 1.06, 1.84, 1303.7, 160.0)
LONG = TwoLayerBlock(2.50, 2.08, 1.06, 1.84, 1303.7, 160.0)


def forces_on_a_foot_that_holds(side, theta, omega, shake):
    """Return the horizontal and the normal force of the ground on a held corner: Newton and Euler for the centroid, as linear equations.

    Unknown: the angular acceleration and both forces. The corner is at (cx, cy) from the centroid and does not move on the ground.
    """
    m, inertia, half, h = SHORT.mass, SHORT.centroid_inertia, SHORT.width / 2, SHORT.centroid_height
    cx = side * half * math.cos(theta) + h * math.sin(theta)
    cy = side * half * math.sin(theta) - h * math.cos(theta)
    # the centroid accelerates by theta'' x (-c) + omega^2 c, on a ground that accelerates by `shake`
    equations = [[m * cy, -1.0, 0.0], [-m * cx, 0.0, -1.0], [inertia, cy, -cx]]
    _, push, normal = np.linalg.solve(equations, [-m * (shake + omega**2 * cx), -m * (G + omega**2 * cy), 0.0])
    return push, normal


@settings(max_examples=300, deadline=None, derandomize=True)
@given(st.sampled_from([-1, 1]), st.floats(0.01, 0.7), st.floats(-3.0, 3.0), st.floats(-8.0, 8.0), st.floats(0.05, 1.2))
def test_landed_foot_sticks_within_static_friction(side, tilt, omega, shake, mu):
    """[Sugimoto2017]_ eqs. (12b), (12c), (14), centrifugal force included: held if |H| <= mu N, else it slips against the push it lacks."""
    theta = -side * tilt
    push, normal = forces_on_a_foot_that_holds(side, theta, omega, shake)
    assume(abs(abs(push) - mu * normal) > 1e-6 * SHORT.mass * G)
    p = modes.flight_parameters(SHORT, G, mu, 0.01, 0.0, 0.01)
    y = np.array([theta, omega, 0.3, 1.0, 0.1, -1.0, *[0.0] * 4])
    corner = modes.RIGHT if side > 0 else modes.LEFT
    result = flight_reset(modes.FLIGHT, corner, y, np.array([[shake, 0.0]]), p)
    if abs(push) <= mu * normal:
        assert result == modes.contact_mode(corner, modes.STICK)
    else:
        assert result == modes.contact_mode(corner, modes.SLIP_FORWARD if push < 0.0 else modes.SLIP_BACKWARD)


def test_centrifugal_force_changes_stick_to_slip():
    """The cases above are no idle ones: turning at 2 rad/s a foot slips that would hold if it came down without turning."""
    for omega, holds in ((0.0, True), (2.0, False), (-2.0, False)):
        push, normal = forces_on_a_foot_that_holds(1, -0.3, omega, 0.0)
        assert (abs(push) <= 0.5 * normal) == holds


@pytest.mark.parametrize("ratio", [-0.9, -0.86, -0.84, -0.3, 0.0, 0.3, 0.84, 0.86, 0.9])
@pytest.mark.parametrize("restitution_y", [0.85, 0.5])
def test_jump_requires_both_corners_to_rise(ratio, restitution_y):
    """[Sugimoto2017]_ eq. (8b): whichever way it spins, the corner that the spin turns down must rise all the same."""
    go = launch(SHORT, -1.3, ratio, 0.95, restitution_y)
    corners = [go.vertical + side * go.spin * SHORT.width / 2 for side in (-1, 1)]
    assert go.jumps == (min(corners) > 0.0)


@pytest.mark.parametrize(("block", "clockwise"), [(SHORT, 0.126), (LONG, -0.013)])
def test_printed_spin_equals_eq_7a_times_depth(block, clockwise):
    """[Sugimoto2017]_ eq. (7a) to the letter, times the depth: 0.126 clockwise on the short side, 0.013 the other way on the long."""
    assert spin_ratio(block, "printed", 0.95, 0.85) == pytest.approx(clockwise, abs=5e-4)


def test_spin_by_angular_momentum_equals_sum_over_slices():
    """Every slice of the block keeps e_x of its horizontal and e_y of its vertical velocity: the moment of momentum of 400 x 400 pieces."""
    ex, ey = 0.95, 0.85
    for block in (SHORT, LONG):
        heights = np.array([block.lower_height, block.upper_height])
        n = 400
        x = (np.arange(n) + 0.5) / n * block.width - block.width / 2
        total = turning = 0.0
        for mass, bottom, height in ((block.lower_mass, 0.0, heights[0]), (block.upper_mass, heights[0], heights[1])):
            y = bottom + (np.arange(n) + 0.5) / n * height - block.centroid_height
            piece = mass / n**2
            total += piece * (n * (x**2).sum() + n * (y**2).sum())
            turning += piece * (ex * n * (y**2).sum() - ey * n * (x**2).sum())
        # pieces of finite size miss 1 / n^2 of each sum, 6e-6
        assert spin_ratio(block, "momentum", ex, ey) == pytest.approx(turning / total, abs=1e-5)

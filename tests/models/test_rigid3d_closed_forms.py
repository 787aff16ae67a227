"""Rigid body in three dimensions against published motions: rimless wheel, Euler's disk, a can that rocks and rolls.

A cylinder is a prism, whose corners strike the ground: its loss of energy, and the difference from the smooth body, halve as the number of
sides doubles.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from seisblock import ConvexBody, Motion, solve_rigid3d

GRAVITY = 9.80665
VERTICAL = np.array([0.0, 0.0, 1.0])


def still(seconds, dt=0.001):
    """Return a motion of zeros."""
    return Motion(np.zeros((3, round(seconds / dt) + 1)), dt)


def axis_of(response):
    """Return the body's axis in the axes of the ground, (3, n)."""
    w, x, y, z = (response[name] for name in ("qw", "qx", "qy", "qz"))
    return np.array([2.0 * (x * z + w * y), 2.0 * (y * z - w * x), w * w - x * x - y * y + z * z])


@pytest.mark.parametrize("sides", [8, 12, 16])
@pytest.mark.parametrize("strikes", [2, 5])
def test_solve_rigid3d_rolls_as_a_rimless_wheel(sides, strikes):
    """Each strike of a rolling prism multiplies the spin by (cos(2 pi/n) + k^2)/(1 + k^2) (McGeer 1990); it stops below the barrier."""
    radius = 0.3
    angles = (np.arange(sides) + 0.5) * 2.0 * math.pi / sides
    ring = [(radius * math.sin(angle), radius * (1.0 - math.cos(angle))) for angle in angles]
    wheel = ConvexBody.polyhedron([(x, y, z) for x, z in ring for y in (-0.2, 0.2)])
    gyration = wheel.inertia[1][1] / (wheel.mass * radius**2)
    ratio = (math.cos(2.0 * math.pi / sides) + gyration) / (1.0 + gyration)
    # square of the spin that lifts the centre over a corner
    barrier = 2.0 * GRAVITY * (1.0 - math.cos(math.pi / sides)) / (radius * (1.0 + gyration))
    # the last strike leaves a spin below the barrier, the one before a spin above it by the same factor
    spin = math.sqrt(barrier) * ratio ** (0.5 - strikes)
    half = radius * math.sin(math.pi / sides)
    speed = np.cross((0.0, spin, 0.0), (-half, 0.0, radius * math.cos(math.pi / sides)))
    outcome = solve_rigid3d(wheel, still(0.1), mu=5.0, initial={"velocity": speed, "spin": (0.0, spin, 0.0)}, settle_s=30.0).outcome
    assert outcome.settled
    assert outcome.final_displacement_m[0] == pytest.approx(2.0 * half * strikes, rel=1e-6)
    energy = 0.5 * wheel.mass * radius**2 * (1.0 + gyration) * spin**2
    assert outcome.energy_contacts_j == pytest.approx(energy, rel=1e-6)


def test_solve_rigid3d_precesses_as_euler_s_disk():
    """A thin disk that rolls with its centre at rest precesses at sqrt(4 g/(a sin alpha)) (Moffatt 2000, without dissipation)."""
    radius, tilt = 0.1, 0.5
    rate = math.sqrt(4.0 * GRAVITY / (radius * math.sin(tilt)))
    # the spin lies along the diameter through the contact
    spin = -rate * math.sin(tilt) * np.array([math.cos(tilt), 0.0, -math.sin(tilt)])
    losses = []
    for sides in (256, 512):
        disk = ConvexBody.cylinder(2.0 * radius, 0.005 * radius, mass=1.0, sides=sides)
        initial = {"quaternion": (math.cos(0.5 * tilt), 0.0, math.sin(0.5 * tilt), 0.0), "spin": spin}
        response = solve_rigid3d(disk, still(0.3), mu=2.0, initial=initial, settle_s=0.0)
        x, y, _ = axis_of(response)
        turned = np.unwrap(np.arctan2(y, x))
        assert turned[-1] == pytest.approx(0.3 * rate, rel=3e-3)
        assert np.hypot(response["x"], response["y"]).max() < 0.01 * radius
        losses.append(tilt - response["tilt"][-1])
    assert 0.0 < losses[1] < 0.02 * tilt
    assert losses[0] == pytest.approx(2.0 * losses[1], rel=0.1)


def rolling_cylinder(radius, height, moments, axis, spin, times):
    """Integrate a cylinder of unit mass that rolls on its rim without slip; return axis and spin, (6, n)."""
    across, along = moments

    def rate(_, state):
        e, w = state[:3], state[3:]
        away = VERTICAL - e * e[2]
        sine = np.linalg.norm(away)
        lowest = -away / sine
        arm = radius * lowest - 0.5 * height * e
        turning = np.cross(w, e)
        change = -(turning * e[2] + e * turning[2])
        arm_rate = radius * -(change - lowest * (lowest @ change)) / sine - 0.5 * height * turning
        inertia = across * np.eye(3) + (along - across) * np.outer(e, e)
        # the contact point of the body is at rest: v = -w x arm
        about_contact = inertia + arm @ arm * np.eye(3) - np.outer(arm, arm)
        force = GRAVITY * VERTICAL - np.cross(w, arm_rate)
        return np.concatenate([turning, np.linalg.solve(about_contact, np.cross(arm, force) - np.cross(w, inertia @ w))])

    start = np.concatenate([axis, spin])
    return solve_ivp(rate, (0.0, times[-1]), start, t_eval=times, rtol=1e-10, atol=1e-12).y


def test_solve_rigid3d_rocks_and_rolls_as_a_can():
    """A can rocks not from edge to edge, but rolls quickly round half its rim each time (Srinivasan and Ruina 2008)."""
    radius, height, tilt, spin = 0.1, 0.4, 0.12, np.array([0.25, 0.0, 0.0])
    axis = np.array([math.sin(tilt), 0.0, math.cos(tilt)])
    arm = np.array([radius * math.cos(tilt) - 0.5 * height * axis[0], 0.0, -radius * math.sin(tilt) - 0.5 * height * axis[2]])
    initial = {
        "quaternion": (math.cos(0.5 * tilt), 0.0, math.sin(0.5 * tilt), 0.0),
        "spin": spin,
        "velocity": -np.cross(spin, arm),
    }
    errors = []
    for sides in (256, 512):
        can = ConvexBody.cylinder(2.0 * radius, height, mass=1.0, sides=sides)
        response = solve_rigid3d(can, still(0.6), mu=5.0, initial=initial, settle_s=0.0)
        exact = rolling_cylinder(radius, height, (can.inertia[0][0], can.inertia[2][2]), axis, spin, response.time)
        errors.append(np.abs(axis_of(response) - exact[:3]).max())
        turned = np.degrees(np.unwrap(np.arctan2(*axis_of(response)[1::-1])))
        # two quick turns round half the rim within 0.6 s, of 190 to 220 degrees with the slow parts between them
        assert turned[-1] == pytest.approx(math.degrees(np.unwrap(np.arctan2(exact[1], exact[0]))[-1]), abs=0.5)
        assert abs(turned[-1]) > 400.0
    assert errors[1] < 0.012 * tilt
    assert errors[0] == pytest.approx(2.0 * errors[1], rel=0.1)

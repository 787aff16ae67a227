"""Real tosses of a cube (see the head of `cube_tosses.csv`): face and place of rest, with the published friction and restitution."""

from __future__ import annotations

import csv
import math
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from seisblock import ConvexBody, Motion, solve_rigid3d

HALF, MASS, FRICTION, RESTITUTION = 0.0524, 0.37, 0.18, 0.125
"""Half width, m, mass, kg, and the experimenters' own fit."""


def tosses():
    lines = Path(__file__).with_name("cube_tosses.csv").read_text(encoding="utf-8").splitlines()
    return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(line for line in lines if not line.startswith("#"))]


def lower_face(quaternion):
    """Return axis and sign of the face that points upwards most."""
    up = Rotation.from_quat(np.roll(quaternion, -1)).as_matrix()[2]
    axis = int(np.argmax(np.abs(up)))
    return axis, math.copysign(1.0, up[axis])


def test_rigid3d_rolls_real_cubes_onto_their_face():
    """Eight in ten come to rest on the right face, half a cube or less from the right place; no toss creates energy."""
    cube = ConvexBody.box(2.0 * HALF, 2.0 * HALF, 2.0 * HALF, mass=MASS)
    right, misses = [], []
    for toss in tosses():
        initial = {
            "position": [HALF * toss[f"start_{axis}"] for axis in "xyz"],
            "quaternion": [toss[f"q{axis}"] for axis in "wxyz"],
            "velocity": [HALF * toss[f"v{axis}"] for axis in "xyz"],
            "spin": [toss[f"w{axis}"] for axis in "xyz"],
        }
        ground = Motion(np.zeros((3, math.ceil(toss["seconds"] / 0.01) + 1)), 0.01)
        response = solve_rigid3d(cube, ground, mu=FRICTION, restitution=RESTITUTION, initial=initial)
        end = [response[f"q{axis}"][-1] for axis in "wxyz"]
        right.append(lower_face(end) == lower_face([toss[f"end_q{axis}"] for axis in "wxyz"]))
        misses.append(math.hypot(response["x"][-1] / HALF - toss["end_x"], response["y"][-1] / HALF - toss["end_y"]))
        assert response.outcome.created_j <= 1e-9 * MASS * 9.80665 * HALF
    assert len(right) > 50
    assert np.mean(right) > 0.8
    assert np.median(misses) < 0.5

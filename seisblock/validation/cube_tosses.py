"""Real tosses of an acrylic cube ([PfrommerHalmPosa2020]_): face and place of rest in three dimensions, from the state before the contact.

``cube_tosses.csv`` holds every fifth toss of a half of the set, with its licence (BSD-3). Friction and restitution are the experimenters' own
fit; nothing is fitted here. The reference is MuJoCo 4.0 with contacts as stiff as steps of 0.5 ms allow, friction 0.18, plastic.
"""

from __future__ import annotations

import csv
import math
from functools import cache
from pathlib import Path

import numpy as np

from seisblock.bodies.convex import ConvexBody
from seisblock.core.typing import FloatArray
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.models.rigid3d.params import quaternion_matrix
from seisblock.models.rigid3d.solve import solve_rigid3d
from seisblock.records.motion import Motion
from seisblock.validation.case import Case

FILE = Path(__file__).with_name("cube_tosses.csv")
HALF, MASS, FRICTION, RESTITUTION = 0.0524, 0.37, 0.18, 0.125
"""Half width, m, mass, kg, and the experimenters' fit."""

DT = 0.01
ENGINE_SHARE, ENGINE_DISTANCE = 0.789, 0.498
"""Share on the right face, and median distance from the measured place, half widths, of the reference engine on the same tosses."""

SHARE_TOLERANCE, DISTANCE_TOLERANCE = 0.054, 0.05
"""Standard error of the share of 57 tosses, and of the difference of two medians of the distance (bootstrap)."""

CREATED_TOLERANCE = 1e-9
"""Largest energy created, a share of m g times the half width: round-off."""


def tosses() -> list[dict[str, float]]:
    """Return the tosses: state at the start and pose at the end, lengths in half widths."""
    lines = FILE.read_text(encoding="utf-8").splitlines()
    return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(line for line in lines if not line.startswith("#"))]


@cache
def results() -> FloatArray:
    """Return, per toss, whether the face is right, the distance from the measured place, half widths, and the energy created, (n, 3)."""
    cube = ConvexBody.box(2.0 * HALF, 2.0 * HALF, 2.0 * HALF, mass=MASS)
    rows = []
    for toss in tosses():
        initial = {
            "position": [HALF * toss[f"start_{axis}"] for axis in "xyz"],
            "quaternion": [toss[f"q{axis}"] for axis in "wxyz"],
            "velocity": [HALF * toss[f"v{axis}"] for axis in "xyz"],
            "spin": [toss[f"w{axis}"] for axis in "xyz"],
        }
        ground = Motion(np.zeros((3, math.ceil(toss["seconds"] / DT) + 1)), DT)
        response = solve_rigid3d(cube, ground, mu=FRICTION, restitution=RESTITUTION, initial=initial)
        end = np.array([response[f"q{axis}"][-1] for axis in "wxyz"])
        measured = np.array([toss[f"end_q{axis}"] for axis in "wxyz"])
        distance = math.hypot(response["x"][-1] / HALF - toss["end_x"], response["y"][-1] / HALF - toss["end_y"])
        created = response.outcome.created_j / (MASS * STANDARD_GRAVITY * HALF)
        rows.append((float(_upper_face(end) == _upper_face(measured)), distance, created))
    return np.array(rows)


def _upper_face(quaternion: FloatArray) -> tuple[int, float]:
    """Return axis and sign of the face that points upwards."""
    up = quaternion_matrix(quaternion / np.linalg.norm(quaternion))[2]
    axis = int(np.argmax(np.abs(up)))
    return axis, math.copysign(1.0, up[axis])


def right_share() -> float:
    """Return the share of tosses that end on the right face."""
    return float(results()[:, 0].mean())


def median_distance() -> float:
    """Return the median distance from the measured place, half widths."""
    return float(np.median(results()[:, 1]))


def most_created() -> float:
    """Return the largest energy that a toss created, over m g times the half width."""
    return float(results()[:, 2].max())


CASES = (
    Case(
        "cube-tosses-face",
        "[PfrommerHalmPosa2020]_",
        "share of tosses of a cube that end on the right face",
        "1",
        ENGINE_SHARE,
        SHARE_TOLERANCE,
        right_share,
        kind="derived",
        note="reference: MuJoCo with stiff contacts on the same tosses; tolerance: standard error of 57 tosses",
        quick=False,
    ),
    Case(
        "cube-tosses-place",
        "[PfrommerHalmPosa2020]_",
        "median distance between computed and measured place of rest of a cube, half widths",
        "1",
        ENGINE_DISTANCE,
        DISTANCE_TOLERANCE,
        median_distance,
        status="differs",
        kind="derived",
        today=(0.4097, 0.01),
        note="reference: MuJoCo with stiff contacts on the same tosses, which ends farther from the measured places; cause unknown",
        quick=False,
    ),
    Case(
        "cube-tosses-energy",
        "[PfrommerHalmPosa2020]_",
        "largest energy that contacts of a tossed cube created, over m g times the half width",
        "1",
        0.0,
        CREATED_TOLERANCE,
        most_created,
        kind="derived",
        note="impacts and friction only dissipate",
        quick=False,
    ),
)
"""Face, place and energy of the tosses."""

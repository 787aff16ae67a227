"""Arrays that the kernels of a rigid body read and write, and the constants that name their columns."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from seisblock._jit import types
from seisblock.core.typing import BoolArray, FloatArray, IntArray
from seisblock.dynamics.array_types import INTEGERS, MATRIX, VECTOR

_t = types()

X, Q, V, W, ALPHA = 0, 3, 7, 10, 13
STATE_SIZE = 16
"""State: centre of gravity relative to the ground (3), quaternion w first (4), velocity (3), spin in the body's axes (3), and the angular
acceleration of the last step in the ground's axes (3), which is a first guess only."""

MASS, MU, RESTITUTION, GRAVITY, SIZE, GAP, SPEED, RATE, BASE_HEIGHT = range(9)
"""Constants: kg; 1; 1; m/s^2; largest distance of a vertex from the centre, m; gap below which a vertex touches, m; speed below which the
body rests, m/s; largest frequency of its motion, rad/s; height of the centre above the base in the body's axes, m."""

(
    CREATED, DISSIPATED, WORK, MAX_TILT, OVERTURNING_TIME, UP_X, UP_Y, IMPACTS, UNCONVERGED, MAX_DISTANCE, REST_TIME, LIFT_TIME,
    START_X, START_Y, PATH,
) = range(15)  # fmt: skip
LEDGER_SIZE = 15
"""Ledger of a run: energy created and dissipated by contacts and work of the ground, J; largest tilt, rad; time of overturning, s, and the
direction of the body's axis there; numbers of impacts and of unconverged solutions; largest
horizontal distance from the start, m; time at which the body came to rest for good, and time of the first motion, s; place at the
start (2), m; largest path of a vertex since the near vertices were listed, m."""

SAMPLE, AT_REST, EDGES, PAST_BASE, NEAR = range(5)
COUNTER_SIZE = 5
"""Counters of a run: next sample; whether the body is at rest; edges of the polygon on which it rests; whether its centre is past the
edge of its base; near vertices."""


class RigidHull(NamedTuple):
    """Constants of a body.

    Parameters
    ----------
    vertices : (3, n) array, m
        Vertices of the convex hull about the centre of gravity, in the body's axes.
    inertia : (9,) array, kg m^2
        Inertia matrix about the centre of gravity.
    is_base : (n,) array of bool
        Vertices of the base.
    base : (m, 3) array
        Edges of the base: outward normal (2) and distance from the centre of gravity, m.
    constants : (9,) array
    """

    vertices: FloatArray
    inertia: FloatArray
    is_base: BoolArray
    base: FloatArray
    constants: FloatArray


class Workspace(NamedTuple):
    """State of a run and work space of its kernels.

    Parameters
    ----------
    state, trial : (16,) arrays
    counters : (5,) array of int
    ledger : (15,) array
    heights, ids, near : (n,) arrays
        Heights of the vertices, the vertices in contact, and those near the ground, whose heights are up to date.
    contacts, impulses : (n, 5), (n, 15) arrays
    support : (n, 3) array
        Edges of the polygon on which the body rests.
    rotation, spatial, left, gyroscopic, mean_inertia, inverse : (9,) arrays
    momentum, velocity, change : (6,) arrays
    system : (6, 7) array
    """

    state: FloatArray
    trial: FloatArray
    counters: IntArray
    ledger: FloatArray
    heights: FloatArray
    ids: IntArray
    near: IntArray
    contacts: FloatArray
    impulses: FloatArray
    support: FloatArray
    rotation: FloatArray
    spatial: FloatArray
    left: FloatArray
    gyroscopic: FloatArray
    mean_inertia: FloatArray
    inverse: FloatArray
    momentum: FloatArray
    velocity: FloatArray
    change: FloatArray
    system: FloatArray


BODY = _t.NamedTuple((MATRIX, VECTOR, _t.Array(_t.boolean, 1, "C"), MATRIX, VECTOR), RigidHull)
SCRATCH = _t.NamedTuple(
    (VECTOR, VECTOR, INTEGERS, VECTOR, VECTOR, INTEGERS, INTEGERS, MATRIX, MATRIX, MATRIX, *((VECTOR,) * 9), MATRIX),
    Workspace,
)


def make_workspace(vertices: int) -> Workspace:
    """Return the work space of a body with a number of vertices."""
    return Workspace(  # type: ignore[call-arg]
        np.zeros(STATE_SIZE),
        np.zeros(STATE_SIZE),
        np.zeros(COUNTER_SIZE, dtype=np.int64),
        np.zeros(LEDGER_SIZE),
        np.zeros(vertices),
        np.zeros(vertices, dtype=np.int64),
        np.zeros(vertices, dtype=np.int64),
        np.zeros((vertices, 5)),
        np.zeros((vertices, 15)),
        np.zeros((vertices, 3)),
        *(np.zeros(9) for _ in range(6)),
        *(np.zeros(6) for _ in range(3)),
        np.zeros((6, 7)),
    )

"""What the pile's kernels are given and what they leave behind, as named tuples of arrays."""

from __future__ import annotations

from typing import NamedTuple

from seisblock._jit import types
from seisblock.core.typing import FloatArray, IntArray
from seisblock.dynamics.array_types import ARRAY_4D, BLOCK, INTEGER_BLOCK, INTEGER_TABLE, INTEGERS, MATRIX, VECTOR

_t = types()


class PileLayout(NamedTuple):
    """What does not change; the meaning of columns stands where they are named.

    Parameters
    ----------
    joints, constants, grids : (n, 4), (n, 10), (n, orbits, 4, 3) arrays
        Joints between boxes: integers, constants, and points on the carrier's face.
    pairs, pair_constants : (p, 2), (p, 8) arrays
        Boxes that may meet, and the constants of one of their corners.
    corners, counts, edges : (b, 16, 7), (b,), (b, 12, 2) arrays
        Corners of each box, how many, and the pairs of corners that make its edges. Behind the corners stand outward normal and offset,
        m, of its faces: those between rings of four corners, from below, then the lower and the upper one.
    boxes, owner : (b, 6), (b,) arrays
        Half sizes and places of the boxes, and the bodies they belong to; the ground last.
    cores, rims : (b, 3), (b, 4, 2) arrays, m
        Half sizes of what other stones meet of a box that has tilted off its joint; radius and height of the circles that bound a round
        one: of its lower face, of its upper face, and of its sides where these faces are worn; zero where there is none.
    inertias : (m, 19) array
        Masses, inertia matrices and their inverses.
    """

    joints: IntArray
    constants: FloatArray
    grids: FloatArray
    pairs: IntArray
    pair_constants: FloatArray
    corners: FloatArray
    counts: IntArray
    edges: IntArray
    boxes: FloatArray
    owner: IntArray
    cores: FloatArray
    rims: FloatArray
    inertias: FloatArray


class PileMemory(NamedTuple):
    """What contacts remember from step to step.

    Parameters
    ----------
    stretches : (n, orbits, 4, 2) array, m
        Shear springs at the points of joints.
    joint_slots : (n, orbits, 4, 17) array
        Rigid contacts at the points of joints.
    corner_slots, edge_slots : (p, 2, 16, 17), (p, 2, 24, 17) arrays
        Contacts of corners and of edges of each pair, in both roles; rigid ones stand in the first, as they are and as they were.
    pair_states : (p,) array of int
        Which pairs their joint takes care of.
    contact_matrix : (m + 1, m + 1) array
        Which bodies have touched since it was last cleared.
    bounds : (b, 6) array, m
        Centres of the boxes and how far they reach.
    scratch : (36, 18) array
        Scratch.
    contact_ids, constraint_rows : (k, 8), (k, 92) arrays
        Rigid contacts of a step: their bodies and the slots they are remembered in, and what they are solved with.
    inverses, body_velocities : (m + 1, 9), (m + 1, 15) arrays
        Inverse inertia of the bodies as they lie; velocities, spins, and how these change by turning.
    step_info : (9,) array
        Of the steps.
    sleep_states, support_points : (m + 1, 3), (m + 1, 17, 17) arrays
        Stones that lie still, and the points on which they do.
    """

    stretches: FloatArray
    joint_slots: FloatArray
    corner_slots: FloatArray
    edge_slots: FloatArray
    pair_states: IntArray
    contact_matrix: FloatArray
    bounds: FloatArray
    scratch: FloatArray
    contact_ids: IntArray
    constraint_rows: FloatArray
    inverses: FloatArray
    body_velocities: FloatArray
    step_info: FloatArray
    sleep_states: IntArray
    support_points: FloatArray


class PileSettings(NamedTuple):
    """How a run goes.

    Parameters
    ----------
    gravity : float, m/s^2
    dt : float, s
        Sampling interval.
    steps : int
        How many of them are in it.
    stop_at_fall : bool
    row_tolerance : float, m and rad
        Movement that makes a row.
    max_row_interval : int
        Most samples between rows.
    record_end : int
        Sample from which the run ends as soon as every stone is still.
    last : int
        Sample at which it ends at the latest.
    """

    gravity: float
    dt: float
    steps: int
    stop_at_fall: bool
    row_tolerance: float
    max_row_interval: int
    record_end: int
    last: int


class PileState(NamedTuple):
    """Where a run is; the loop moves it on, and goes on from it when it is called again: integers, and the bodies, the ground last."""

    counters: IntArray
    bodies: FloatArray


SAMPLE, STEP, ROW_COUNT, SAMPLES_SINCE_ROW, HAS_FALLEN, STEPS_REMAINING, FIRST_SAMPLE = range(7)
"""A cursor's integers: sample, step in it, rows kept, samples since the last of them, whether a stone fell in this sample, how many
steps may be taken before the loop pauses, and which sample of the motion is the first that the loop is given."""

N_COUNTERS = 7


class PileOutput(NamedTuple):
    """What a run leaves behind.

    Parameters
    ----------
    fall_states : (m, 6) array
    rows : (r, 1 + 7 m) array
        Time, centres and quaternions where something has moved; where there is no room for all of them, the last ones share the last row.
    last_contact : (m + 1, m + 1) array, s
        When two bodies last touched; negative: never.
    energy_ledger : (8,) array
        Of energy and momentum.
    """

    fall_states: FloatArray
    rows: FloatArray
    last_contact: FloatArray
    energy_ledger: FloatArray


LAYOUT = _t.NamedTuple(
    (
        INTEGER_TABLE,
        MATRIX,
        ARRAY_4D,
        INTEGER_TABLE,
        MATRIX,
        BLOCK,
        INTEGERS,
        INTEGER_BLOCK,
        MATRIX,
        INTEGERS,
        MATRIX,
        BLOCK,
        MATRIX,
    ),
    PileLayout,
)
MEMORY = _t.NamedTuple(
    (
        *(ARRAY_4D, ARRAY_4D, ARRAY_4D, ARRAY_4D),
        *(INTEGERS, MATRIX, MATRIX, MATRIX),
        *(INTEGER_TABLE, MATRIX, MATRIX, MATRIX, VECTOR),
        *(INTEGER_TABLE, BLOCK),
    ),
    PileMemory,
)
SETTINGS = _t.NamedTuple((_t.float64, _t.float64, _t.int64, _t.boolean, _t.float64, _t.int64, _t.int64, _t.int64), PileSettings)
STATE = _t.NamedTuple((INTEGERS, MATRIX), PileState)
OUTPUT = _t.NamedTuple((MATRIX, MATRIX, MATRIX, VECTOR), PileOutput)

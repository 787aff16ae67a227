"""Named tuples of arrays that the kernels of a pile read and write."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from seisblock._jit import types
from seisblock.core.typing import FloatArray, IntArray
from seisblock.dynamics.array_types import ARRAY_4D, BLOCK, INTEGER_BLOCK, INTEGER_TABLE, INTEGERS, MATRIX, VECTOR

_t = types()


class ShapeKernels(NamedTuple):
    """Pointers to the kernels for contacts of worn boxes and of cylinders: piles without such stones do not compile them.

    Parameters
    ----------
    separating_axis, edge_edge, face_manifold : callable
        Of worn boxes: :mod:`seisblock.models.stack.chamfered_box` and :mod:`seisblock.models.stack.chamfered_faces`.
    face_overlap : callable
        Of cylinders: :mod:`seisblock.models.stack.face_overlap`.
    """

    separating_axis: Callable[..., Any]
    edge_edge: Callable[..., Any]
    face_manifold: Callable[..., Any]
    face_overlap: Callable[..., Any]


SEPARATING_AXIS_KERNEL = _t.float64(VECTOR, _t.int64, _t.int64, _t.float64, _t.float64, BLOCK, INTEGERS, MATRIX, VECTOR)
EDGE_EDGE_KERNEL = _t.boolean(VECTOR, _t.int64, _t.int64, _t.float64, BLOCK, INTEGERS, VECTOR, MATRIX, VECTOR)
FACE_MANIFOLD_KERNEL = _t.int64(VECTOR, _t.int64, _t.int64, _t.float64, BLOCK, INTEGERS, VECTOR, MATRIX, _t.float64, MATRIX, MATRIX)
FACE_OVERLAP_KERNEL = _t.int64(_t.int64, _t.int64, VECTOR, BLOCK, MATRIX, BLOCK, VECTOR, MATRIX, MATRIX)


class PileLayout(NamedTuple):
    """Constant arrays of a pile, and kernels for its shapes; columns are documented at the constants that name them.

    Parameters
    ----------
    joints, constants, grids : (n, 4), (n, 10), (n, orbits, 4, 3) arrays
        Joints between boxes: integers, constants, and points on the carrier's face.
    pairs, pair_constants : (p, 2), (p, 8) arrays
        Pairs of boxes that may touch, and the contact constants of one of their corners.
    corners, counts, edges : (b, 16, 7), (b,), (b, 12, 2) arrays
        Corners of each box, their number, and the pairs of corners that make its edges. Columns 3 to 6 hold outward normal and offset, m,
        of its faces: those between rings of four corners, from below, then the lower and the upper face.
    boxes, owner : (b, 6), (b,) arrays
        Half sizes and centres of the boxes, m, and the body each belongs to; the ground last.
    cores, rims : (b, 3), (b, 4, 2) arrays, m
        Half sizes of the box used for contacts off the joint; radius and height of the bounding circles of a cylinder: of its lower face,
        its upper face, and of its sides where these faces are worn; zero where there is none.
    inertias : (m, 19) array
        Masses, inertia matrices and their inverses.
    shapes : ShapeKernels
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
    shapes: ShapeKernels


class PileMemory(NamedTuple):
    """Contact state carried from step to step (warm start, sleeping bodies, broad phase), and scratch.

    Parameters
    ----------
    stretches : (n, orbits, 4, 2) array, m
        Shear springs at the points of joints.
    joint_slots : (n, orbits, 4, 17) array
        Rigid contacts at the points of joints.
    corner_slots, edge_slots : (p, 2, 16, 17), (p, 2, 24, 17) arrays
        Contacts of corners and of edges of each pair, in both roles; rigid contacts use the first: the current ones and the previous ones.
    pair_states : (p,) array of int
        State of each pair: positive where its joint handles the contacts.
    contact_matrix : (m + 1, m + 1) array
        1 for bodies that have touched since the matrix was last cleared.
    bounds : (b, 6) array, m
        Axis-aligned bounding boxes: centres and half sizes.
    scratch : (36, 18) array
        Scratch.
    contact_ids, constraint_rows : (k, 8), (k, ROW_COLUMNS) arrays
        Rigid contacts of a step: their bodies and slots, and their constraint rows.
    inverses, body_velocities : (m + 1, 9), (m + 1, 15) arrays
        Inverse inertia of the bodies in the ground's axes; velocities, spins, and gyroscopic change of the spins.
    step_info : (10,) array
        Scalars of the steps.
    newton_blocks, newton_bodies : (m + 1, m + 1, 36), (m + 1, 28) arrays
        Scratch of the Newton solver.
    sleep_states, support_points : (m + 1, 3), (m + 1, 17, 17) arrays
        Sleeping bodies, and the points on which they rest.
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
    newton_blocks: FloatArray
    newton_bodies: FloatArray
    sleep_states: IntArray
    support_points: FloatArray


class PileSettings(NamedTuple):
    """Settings of a run.

    Parameters
    ----------
    gravity : float, m/s^2
    dt : float, s
        Sampling interval.
    steps : int
        Steps per sampling interval.
    stop_at_fall : bool
    row_tolerance : float, m and rad
        Movement after which a row is stored.
    max_row_interval : int
        Largest number of samples between two rows.
    record_end : int
        Sample from which the run ends once every stone is still.
    last : int
        Sample at which the run ends at the latest.
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
    """Position of a run, advanced by the loop and resumed at the next call: counters, and the bodies, the ground last."""

    counters: IntArray
    bodies: FloatArray


SAMPLE, STEP, ROW_COUNT, SAMPLES_SINCE_ROW, HAS_FALLEN, STEPS_REMAINING, FIRST_SAMPLE, STILL_SAMPLES = range(8)
"""Counters of a run: sample, step within the sample, rows stored, samples since the last row, fall in this sample (0 or 1), steps left
before the loop pauses, index of the first sample of the motion array passed to the loop, and samples for which all stones were still."""

N_COUNTERS = 8


class PileOutput(NamedTuple):
    """Output of a run.

    Parameters
    ----------
    fall_states : (m, 6) array
    rows : (r, 1 + 7 m) array
        Time, centres and quaternions, a row where something moved; when the array is full, the last row is overwritten.
    last_contact : (m + 1, m + 1) array, s
        Time of the last contact of two bodies; negative: never.
    energy_ledger : (10,) array
        Energy and momentum balance.
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
        _t.NamedTuple(
            tuple(
                _t.FunctionType(signature)
                for signature in (SEPARATING_AXIS_KERNEL, EDGE_EDGE_KERNEL, FACE_MANIFOLD_KERNEL, FACE_OVERLAP_KERNEL)
            ),
            ShapeKernels,
        ),
    ),
    PileLayout,
)
MEMORY = _t.NamedTuple(
    (
        *(ARRAY_4D, ARRAY_4D, ARRAY_4D, ARRAY_4D),
        *(INTEGERS, MATRIX, MATRIX, MATRIX),
        *(INTEGER_TABLE, MATRIX, MATRIX, MATRIX, VECTOR),
        *(BLOCK, MATRIX, INTEGER_TABLE, BLOCK),
    ),
    PileMemory,
)
SETTINGS = _t.NamedTuple((_t.float64, _t.float64, _t.int64, _t.boolean, _t.float64, _t.int64, _t.int64, _t.int64), PileSettings)
STATE = _t.NamedTuple((INTEGERS, MATRIX), PileState)
OUTPUT = _t.NamedTuple((MATRIX, MATRIX, MATRIX, VECTOR), PileOutput)

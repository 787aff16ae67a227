"""Propagators of a block on corner springs: matrices of the exact solution over a step, one for each contact state (derived here).

Columns are the solutions from a unit coordinate or rate, and under a unit load or slope of a linear ground motion.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from seisblock._jit import kernel, types
from seisblock.bodies.spring_block import SpringBlock
from seisblock.core.typing import FloatArray
from seisblock.dynamics.array_types import MATRIX, VECTOR
from seisblock.dynamics.buffers import SCRATCH
from seisblock.dynamics.model_api import SERIES
from seisblock.models.uplift.constants import ALL_CORNERS, GRAVITY, N_STATES, PROPAGATORS, SETTLEMENT, STEP, TURN_X
from seisblock.models.uplift.series import evaluate, z_datum

_t = types()

MAX_PHASE = 1.0
"""Largest phase of the highest mode per step, rad: longer steps leave most samples undecided, and their power series converge slowly."""

N_ROWS, N_COLUMNS = 10, 17
"""Five coordinates and their rates; a constant, these, load and slope along x, y and z."""

HEIGHT, LOAD_UP = 4, 14
"""Columns, after the first, of the height and of a vertical load; the row of the height."""

MAX_DEGREE = 20
"""Largest degree of the power series of the coordinates."""

SIZE = N_ROWS * N_COLUMNS


def step_parameters(bodies: Sequence[SpringBlock], dt: float) -> FloatArray:
    """Return the parameters from ``SUBSTEPS`` to ``FOURTH``, one row per body: steps per sample, and bounds over a step."""
    frequency = np.array([body.omega for body in bodies])
    # highest rates: those of full contact, which has the most springs and dashpots
    k_max = _largest_eigenvalue(bodies, frequency**2)
    c_max = _largest_eigenvalue(bodies, 2.0 * np.array([[body.damping] for body in bodies]) * frequency)
    substeps = np.maximum(np.ceil(np.maximum(np.sqrt(k_max), c_max) * dt / MAX_PHASE), 1.0)
    fourth = np.sqrt(k_max + c_max * c_max)
    return np.column_stack([substeps, dt / substeps, _degrees(fourth * dt / substeps), fourth])


def _largest_eigenvalue(bodies: Sequence[SpringBlock], total: FloatArray) -> FloatArray:
    """Return the largest eigenvalue, relative to the masses, of corner elements with given sums in x, y and z, (m, 3); without torsion."""
    along, across, up = total.T
    alpha, gamma, jx, jy = np.array([(body.alpha, body.gamma, *body.inertia[:2]) for body in bodies]).T
    values = [up]
    # a translation and the rotation in its plane
    for side, width, inertia in ((along, gamma, jy), (across, 1.0, jx)):
        rotation = 0.25 * (alpha * alpha * side + width * width * up) / inertia
        values.append(0.5 * (side + rotation) + np.hypot(0.5 * (side - rotation), 0.5 * alpha * side / np.sqrt(inertia)))
    return np.max(values, axis=0)


def _degrees(phase: FloatArray) -> FloatArray:
    """Return the degrees of power series whose remainder, at most phase^(n - 2) 3!/(n + 1)! of the third term, is below round-off."""
    degrees = np.full(len(phase), MAX_DEGREE)
    for n in range(MAX_DEGREE - 1, 7, -1):
        degrees[phase ** (n - 2) * 6.0 / math.factorial(n + 1) < 2.0**-56] = n
    return degrees


@kernel(_t.void(_t.FunctionType(SERIES), MATRIX, SCRATCH, VECTOR, VECTOR))
def fill_propagators(series, parameters, scratch, y, end):
    """Write the propagators of the 16 contact states to the rows of parameters; the other arrays are work space."""
    c, g, f = scratch.c, scratch.g, scratch.f
    for row in range(parameters.shape[0]):
        p = parameters[row]
        step, gravity, settlement = p[STEP], p[GRAVITY], p[SETTLEMENT]
        # without weight the equations are homogeneous
        p[GRAVITY] = p[SETTLEMENT] = 0.0
        for closed in range(ALL_CORNERS + 1):
            constant = PROPAGATORS + closed * SIZE
            for k in range(N_COLUMNS - 1):
                for i in range(N_STATES):
                    y[i] = 0.0
                for i in range(3):
                    f[i, 0] = f[i, 1] = 0.0
                if k < N_ROWS:
                    y[TURN_X + k] = 1.0
                else:
                    f[(k - N_ROWS) // 2, (k - N_ROWS) % 2] = 1.0
                series(closed, y, f, p, MAX_DEGREE, c, g)
                evaluate(c, MAX_DEGREE, step, end)
                for i in range(N_ROWS):
                    p[constant + N_ROWS * (k + 1) + i] = end[TURN_X + i]
        p[GRAVITY], p[SETTLEMENT] = gravity, settlement
        for closed in range(ALL_CORNERS + 1):
            constant, (datum, weight) = PROPAGATORS + closed * SIZE, z_datum(p, closed)
            for i in range(N_ROWS):
                at, above = constant + i, datum if i == HEIGHT else 0.0
                p[at] = above + weight * p[at + N_ROWS * (LOAD_UP + 1)] - datum * p[at + N_ROWS * (HEIGHT + 1)]

"""Many trajectories of one model through one motion: parameters and gains change, the record is shared, nothing is kept but the end.

One row costs no Python, and the loop holds no GIL: callers split the rows among threads.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from seisblock._jit import kernel, types
from seisblock.dynamics import hybrid
from seisblock.dynamics.arrays import BLOCK, INTEGER_TABLE, INTEGERS, MATRIX, READ_ONLY_MATRIX
from seisblock.dynamics.hybrid import RESET, SERIES, SKIP, integrate
from seisblock.dynamics.model import FAILURES, Model
from seisblock.errors import ParameterError, SolverError
from seisblock.records.motion import Motion
from seisblock.typing import ArrayLike, FloatArray, IntArray

_t = types()
_COUNTS = _t.Array(_t.int64, 3, "C")


@kernel(
    _t.void(
        _t.FunctionType(SERIES),
        _t.FunctionType(RESET),
        _t.FunctionType(SKIP),
        READ_ONLY_MATRIX,
        MATRIX,
        _t.float64,
        _t.int64,
        MATRIX,
        MATRIX,
        INTEGERS,
        BLOCK,
        _COUNTS,
        INTEGER_TABLE,
        MATRIX,
        INTEGERS,
    ),
    allocates=True,
)
def integrate_rows(series, reset, skip, acceleration, gains, dt, mode, states, parameters, sizes, extrema, tallies, infos, ends, statuses):
    """Follow one trajectory per row of `parameters`; see :func:`seisblock.dynamics.hybrid.integrate`."""
    path = np.empty((0, states.shape[1]))
    modes = np.empty(0, np.int64)
    table = np.empty((0, 4), np.int64)
    times = np.empty(0)
    limits = np.empty((0, 2, states.shape[1]))
    for row in range(parameters.shape[0]):
        statuses[row] = integrate(
            series,
            reset,
            skip,
            acceleration,
            gains[row],
            dt,
            0,
            0.0,
            mode,
            states[row],
            parameters[row],
            sizes,
            path,
            modes,
            table,
            times,
            limits,
            extrema[row],
            tallies[row],
            infos[row],
            ends[row],
        )


@dataclass(frozen=True, eq=False)
class Ensemble:
    """The ends of many trajectories, one per row.

    Parameters
    ----------
    model : Model
    dt : float, s
    final : (m, n_states) array
        State at the end.
    final_mode, n_changes : (m,) arrays of int
    end_time : (m,) array, s after sample 0
    first_change : (m,) array, s after sample 0
        Time of the first event, NaN where there was none.
    extrema : (m, n_tracked, 4) array
        Highest value, its time, lowest value, its time; s after sample 0.
    tally : (m, n_guards, n_modes) array of int
        How often each guard led to each mode.
    """

    model: Model
    dt: float
    final: FloatArray
    final_mode: IntArray
    n_changes: IntArray
    end_time: FloatArray
    first_change: FloatArray
    extrema: FloatArray
    tally: IntArray


def follow_many(model: Model, motion: Motion, parameters: ArrayLike, initial: ArrayLike, mode: int, *, gains: ArrayLike) -> Ensemble:
    """Follow a model through a motion once per row of parameters, from its first sample, without the GIL.

    Parameters
    ----------
    model : Model
    motion : Motion
        Piecewise linear between its samples; not copied.
    parameters : (m, n_parameters) array
        In the model's order and units.
    initial : (n_states,) or (m, n_states) array
        State at the first sample.
    mode : int
        Mode at the first sample.
    gains : (3,) or (m, 3) array
        Factors on the rows along, across, up; zero leaves a row out.

    Returns
    -------
    Ensemble

    Raises
    ------
    ParameterError
        If the shapes do not fit.
    SolverError
        If one of the integrations had to be given up.
    """
    p = np.array(parameters, dtype=np.float64, order="C")
    if p.ndim != 2:
        raise ParameterError(f"an ensemble needs one row of parameters per trajectory, found shape {p.shape}")
    m, n_states = p.shape[0], len(model.states)
    states = np.array(np.broadcast_to(np.asarray(initial, dtype=np.float64), (m, n_states)), order="C")
    scale = np.array(np.broadcast_to(np.asarray(gains, dtype=np.float64), (m, 3)), order="C")
    sizes = np.array([model.scratch, len(model.guards), model.tracked, model.order, model.floored], dtype=np.int64)
    extrema = np.zeros((m, max(model.tracked, 1), 4))
    tally = np.zeros((m, len(model.guards), len(model.modes)), dtype=np.int64)
    infos = np.zeros((m, 3), dtype=np.int64)
    ends = np.zeros((m, 2))
    statuses = np.zeros(m, dtype=np.int64)
    integrate_rows(
        model.series,
        model.reset,
        model.skip,
        motion.acceleration,
        scale,
        motion.dt,
        mode,
        states,
        p,
        sizes,
        extrema,
        tally,
        infos,
        ends,
        statuses,
    )
    end_time = infos[:, hybrid.INFO_SAMPLE] * motion.dt + ends[:, hybrid.LAST_TAU]
    for row in np.flatnonzero(np.isin(statuses, list(FAILURES)))[:1]:
        raise SolverError(
            f"{model.name}, row {row}: given up at {motion.start_s + end_time[row]:.6f} s, where {FAILURES[int(statuses[row])]}"
        )
    return Ensemble(
        model,
        motion.dt,
        states,
        infos[:, hybrid.INFO_MODE],
        infos[:, hybrid.INFO_EVENTS],
        end_time,
        ends[:, hybrid.FIRST_EVENT],
        extrema[:, : model.tracked],
        tally,
    )

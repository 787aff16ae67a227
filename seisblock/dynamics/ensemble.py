"""Many trajectories of one model through one motion: parameters and gains change, the record is shared, nothing is kept but the end.

One row costs no Python, and the loop holds no GIL: callers split the rows among threads.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from seisblock._jit import kernel, types
from seisblock.dynamics.arguments import BASE, BEYOND, FIRST_EVENT, FOUND, MODE, SAMPLE, SHAPE, STEPS_LEFT, TAU, Cursor, Ground, Kept
from seisblock.dynamics.arrays import BLOCK, INTEGER_BLOCK, INTEGER_TABLE, INTEGERS, MATRIX, READ_ONLY_MATRIX
from seisblock.dynamics.following import SLICE, cursor_at
from seisblock.dynamics.halt import heed
from seisblock.dynamics.hybrid import POINTERS, go_on, room
from seisblock.dynamics.model import Model
from seisblock.dynamics.status import FAILURES, PAUSED
from seisblock.dynamics.trajectory import Instant
from seisblock.errors import ParameterError, SolverError
from seisblock.records.motion import Motion
from seisblock.typing import ArrayLike, FloatArray, IntArray
from seisblock.words import said

_t = types()


class Grounds(NamedTuple):
    """What shakes: a motion or a stretch of it, (rows, n), m/s^2, with factors of each trajectory's own, (m, rows), every dt seconds."""

    acceleration: FloatArray
    gains: FloatArray
    dt: float


class Rows(NamedTuple):
    """Where each trajectory is, and what it leaves: first axis m; else as in a cursor, and in what is kept of a single one."""

    places: IntArray
    clocks: FloatArray
    states: FloatArray
    extrema: FloatArray
    tallies: IntArray
    stays: FloatArray
    statuses: IntArray


_GROUNDS = _t.NamedTuple((READ_ONLY_MATRIX, MATRIX, _t.float64), Grounds)
_ROWS = _t.NamedTuple((INTEGER_TABLE, MATRIX, MATRIX, BLOCK, INTEGER_BLOCK, BLOCK, INTEGERS), Rows)


@kernel(_t.int64(*POINTERS, _GROUNDS, SHAPE, MATRIX, _ROWS, _t.int64, _t.int64), allocates=True)
def integrate_rows(series, reset, skip, grounds, shape, parameters, rows, first, steps):
    """Follow one trajectory per row of `parameters` from row `first` on, for so many steps in all; return the row to go on with."""
    n_states = rows.states.shape[1]
    path = np.empty((0, n_states))
    modes = np.empty(0, np.int64)
    events = np.empty((0, 4), np.int64)
    times = np.empty(0)
    limits = np.empty((0, 2, n_states))
    scratch = room(shape, n_states, grounds.acceleration.shape[0])
    row = first
    while row < parameters.shape[0] and steps > 0:
        if rows.statuses[row] != PAUSED:
            # it ended in an earlier stretch of the motion
            row += 1
            continue
        place = rows.places[row]
        place[STEPS_LEFT] = steps
        rows.statuses[row] = go_on(
            series,
            reset,
            skip,
            Ground(grounds.acceleration, grounds.gains[row], grounds.dt),
            shape,
            parameters[row],
            Cursor(place, rows.clocks[row], rows.states[row]),
            Kept(path, modes, events, times, limits, rows.extrema[row], rows.tallies[row], rows.stays[row]),
            scratch,
        )
        steps = place[STEPS_LEFT] - 1
        through = place[BEYOND] > 0 and place[SAMPLE] - place[BASE] == grounds.acceleration.shape[1] - 1
        if rows.statuses[row] != PAUSED or through:
            row += 1
    return row


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
    stays : (m, n_modes, 2) array, s
        How long it was in each mode, in all and at the longest stretch between two events.
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
    stays: FloatArray


def follow_many(model: Model, motion: Motion, parameters: ArrayLike, initial: ArrayLike, mode: int, *, gains: ArrayLike) -> Ensemble:
    """Follow a model through a motion once per row of parameters, from its first sample, without the GIL.

    Parameters
    ----------
    model : Model
    motion : Motion
        Piecewise linear between its samples; not copied, but for a stretch of a long one at a time.
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
        raise ParameterError("an ensemble needs one row of parameters per trajectory, found shape {shape}", shape=str(p.shape))
    m, n_states = p.shape[0], len(model.states)
    states = np.array(np.broadcast_to(np.asarray(initial, dtype=np.float64), (m, n_states)), order="C")
    scale = np.array(np.broadcast_to(np.asarray(gains, dtype=np.float64), (m, 3)), order="C")
    begin = cursor_at(Instant(), mode, states[0])
    rows = Rows(
        np.tile(begin.place, (m, 1)),
        np.tile(begin.clock, (m, 1)),
        states,
        np.zeros((m, model.tracked, 4)),
        np.zeros((m, len(model.guards), len(model.modes)), dtype=np.int64),
        np.zeros((m, len(model.modes), 2)),
        np.full(m, PAUSED, dtype=np.int64),
    )
    for stretch in motion.stretches((scale != 0.0).any(axis=0).tolist()):
        grounds = Grounds(stretch.acceleration, scale, motion.dt)
        rows.places[:, BASE], rows.places[:, BEYOND] = stretch.first, stretch.beyond
        row = 0
        while row < m:
            heed()
            row = integrate_rows(*model.pointers, grounds, model.shape, p, rows, row, SLICE)
    end_time = rows.places[:, SAMPLE] * motion.dt + rows.clocks[:, TAU]
    for row in np.flatnonzero(np.isin(rows.statuses, list(FAILURES)))[:1]:
        raise SolverError(
            "{name}, row {row}: given up at {at:.6f} s, where {failure}",
            name=model.name,
            row=row,
            at=motion.start_s + end_time[row],
            failure=said(FAILURES[int(rows.statuses[row])]),
        )
    return Ensemble(
        model,
        motion.dt,
        states,
        rows.places[:, MODE],
        rows.places[:, FOUND],
        end_time,
        rows.clocks[:, FIRST_EVENT],
        rows.extrema,
        rows.tallies,
        rows.stays,
    )

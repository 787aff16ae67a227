"""Many trajectories of one model through one motion: parameters and gains change, the record is shared, nothing is kept but the end.

One row costs no Python, and the loop holds no GIL: callers split the rows among threads.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from seisblock._jit import kernel, types
from seisblock.dynamics.arguments import (
    BASE,
    BEYOND,
    FIRST_EVENT,
    FOUND,
    GROUNDS,
    MODE,
    ROWS,
    SAMPLE,
    SHAPE,
    STEPS_LEFT,
    TAU,
    Cursor,
    Ground,
    Grounds,
    Kept,
    Rows,
)
from seisblock.dynamics.arrays import MATRIX
from seisblock.dynamics.changes import BEGINNING, Instant, Instants
from seisblock.dynamics.contract import FIELDS, LANES
from seisblock.dynamics.following import SLICE, cursor_at
from seisblock.dynamics.halt import heed
from seisblock.dynamics.hybrid import POINTERS, go_on, make_room, room
from seisblock.dynamics.lanes import integrate_in_lanes
from seisblock.dynamics.model import Model
from seisblock.dynamics.status import FAILURES, PAUSED, Status
from seisblock.errors import ParameterError, SolverError
from seisblock.records.motion import Motion
from seisblock.typing import ArrayLike, BoolArray, FloatArray, IntArray
from seisblock.words import said

_t = types()

_FAILED = np.array([status in FAILURES for status in Status])


@kernel(_t.int64(*POINTERS, GROUNDS, SHAPE, MATRIX, ROWS, _t.int64, _t.int64), allocates=True)
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
        through = place[BEYOND] > 0 and place[SAMPLE] - place[BASE] >= grounds.acceleration.shape[1] - 1
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
    end : Instants
    first_change : (m,) array, s after sample 0
        Time of the first event, NaN where there was none.
    extrema : (m, n_tracked, 4) array
        Highest value, its time, lowest value, its time; s after sample 0.
    tally : (m, n_guards, n_modes) array of int
        How often each guard led to each mode.
    stays : (m, n_modes, 2) array, s
        How long it was in each mode, in all and at the longest stretch between two events.
    failed : (m,) array of bool
        Rows that were given up: what stands in them is the state in which that happened, and no answer.
    """

    model: Model
    dt: float
    final: FloatArray
    final_mode: IntArray
    n_changes: IntArray
    end: Instants
    first_change: FloatArray
    extrema: FloatArray
    tally: IntArray
    stays: FloatArray
    failed: BoolArray

    @property
    def end_time(self) -> FloatArray:
        """Times at which the integrations ended, (m,), s after sample 0."""
        return self.end.sample * self.dt + self.end.tau


def follow_many(
    model: Model,
    motion: Motion,
    parameters: ArrayLike,
    initial: ArrayLike,
    mode: int | IntArray,
    *,
    gains: ArrayLike,
    start: Instant | Instants = BEGINNING,
    called: IntArray | None = None,
    allow_failures: bool = False,
) -> Ensemble:
    """Follow a model through a motion once per row of parameters, without the GIL.

    Parameters
    ----------
    model : Model
    motion : Motion
        Piecewise linear between its samples; not copied, but for a stretch of a long one at a time.
    parameters : (m, n_parameters) array
        In the model's order and units.
    initial : (n_states,) or (m, n_states) array
        State at `start`.
    mode : int or (m,) array of int
        Mode at `start`.
    gains : (3,) or (m, 3) array
        Factors on the rows along, across, up; zero leaves a row out.
    start : Instant or Instants
        Where to begin, all of them or each.
    called : (m,) array of int
        The numbers by which an error names the rows, where they are some of many.
    allow_failures : bool
        Whether rows that had to be given up are marked in the answer instead of ending all of them in an error.

    Returns
    -------
    Ensemble

    Raises
    ------
    ParameterError
        If the shapes do not fit.
    SolverError
        If one of the integrations had to be given up and failures are not allowed.
    """
    p = np.array(parameters, dtype=np.float64, order="C")
    if p.ndim != 2:
        raise ParameterError("an ensemble needs one row of parameters per trajectory, found shape {shape}", shape=str(p.shape))
    m, n_states = p.shape[0], len(model.states)
    states, scale = np.empty((m, n_states)), np.empty((m, 3))
    states[:], scale[:] = initial, gains
    begin = cursor_at(BEGINNING, 0, np.empty(n_states))
    rows = Rows(
        np.tile(begin.place, (m, 1)),
        np.tile(begin.clock, (m, 1)),
        states,
        np.zeros((m, model.tracked, 4)),
        np.zeros((m, len(model.guards), len(model.modes)), dtype=np.int64),
        np.zeros((m, len(model.modes), 2)),
        np.full(m, PAUSED, dtype=np.int64),
    )
    rows.places[:, MODE], rows.places[:, SAMPLE], rows.clocks[:, TAU] = mode, start.sample, start.tau
    for stretch in motion.stretches((scale != 0.0).any(axis=0).tolist()):
        grounds = Grounds(stretch.acceleration, scale, motion.dt)
        rows.places[:, BASE], rows.places[:, BEYOND] = stretch.first, stretch.beyond
        row = 0
        if model.stride is not None:
            through_in_lanes(model, grounds, p, rows)
            continue
        while row < m:
            heed()
            row = integrate_rows(*model.pointers, grounds, model.shape, p, rows, row, SLICE)
    end = Instants(rows.places[:, SAMPLE], rows.clocks[:, TAU])
    failed: BoolArray = _FAILED[rows.statuses]
    for row in () if allow_failures else np.flatnonzero(failed)[:1]:
        raise SolverError(
            "{name}, row {row}: given up at {at:.6f} s, where {failure}",
            name=model.name,
            row=row if called is None else called[row],
            at=motion.start_s + end.sample[row] * motion.dt + end.tau[row],
            failure=said(FAILURES[int(rows.statuses[row])]),
        )
    return Ensemble(
        model,
        motion.dt,
        states,
        rows.places[:, MODE],
        rows.places[:, FOUND],
        end,
        rows.clocks[:, FIRST_EVENT],
        rows.extrema,
        rows.tallies,
        rows.stays,
        failed,
    )


def through_in_lanes(model: Model, grounds: Grounds, p: FloatArray, rows: Rows) -> None:
    """Follow all rows to the end of a motion, or of a stretch of it, in lanes."""
    chosen, waits = np.full(LANES, -1), np.ones(LANES, dtype=np.int64)
    lanes, n_states = np.zeros(FIELDS * LANES), rows.states.shape[1]
    path, modes, events = np.empty((0, n_states)), np.empty(0, dtype=np.int64), np.empty((0, 4), dtype=np.int64)
    times, limits = np.empty(0), np.empty((0, 2, n_states))
    nothing = Kept(path, modes, events, times, limits, np.empty((0, 4)), np.empty((0, 0), dtype=np.int64), np.empty((0, 2)))
    scratch = make_room(model.shape, n_states, grounds.acceleration.shape[0])
    functions = (*model.pointers, model.stride_pointer)
    row = 0
    while row < p.shape[0] or (chosen >= 0).any():
        heed()
        row = integrate_in_lanes(*functions, grounds, model.shape, p, rows, chosen, waits, lanes, nothing, scratch, row, SLICE)

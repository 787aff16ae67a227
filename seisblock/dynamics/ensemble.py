"""Batch integration of one model under one motion for many sets of parameters and gains; only final states are stored.

The loop over the rows is compiled and releases the GIL, so that callers can split the rows among threads.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from seisblock._jit import function_pointer, kernel, types
from seisblock.core.errors import ParameterError, SolverError
from seisblock.core.i18n import lazy_gettext
from seisblock.core.status import FAILURES, PAUSED, Status
from seisblock.core.typing import ArrayLike, BoolArray, FloatArray, IntArray
from seisblock.dynamics.array_types import MATRIX
from seisblock.dynamics.buffers import (
    BATCH_FORCING,
    BATCH_STATE,
    FIRST_EVENT_TIME,
    MODE,
    N_EVENTS,
    N_FLUSHED,
    OUTPUT,
    SAMPLE,
    SAMPLES_AFTER,
    SCRATCH,
    SEGMENT_START,
    SHAPE,
    STEPS_LEFT,
    TAU,
    BatchForcing,
    BatchState,
    Forcing,
    Output,
    Scratch,
    State,
)
from seisblock.dynamics.cancellation import check_cancelled
from seisblock.dynamics.events import BEGINNING, Instant, Instants, allocate_events
from seisblock.dynamics.hybrid import LOOP_POINTERS, allocate_scratch
from seisblock.dynamics.integration import STEPS_PER_SLICE, initial_state
from seisblock.dynamics.model import Model
from seisblock.dynamics.model_api import LANE_FIELDS, N_LANES, OBSERVE, observe_nothing
from seisblock.dynamics.simd import integrate_in_lanes
from seisblock.records.motion import Motion

_t = types()

_IS_FAILURE = np.array([status in FAILURES for status in Status])


ROW_ARGUMENTS = BATCH_FORCING, SHAPE, MATRIX, BATCH_STATE, OUTPUT, SCRATCH, MATRIX, _t.int64, _t.int64


@kernel(_t.int64(*LOOP_POINTERS, _t.FunctionType(OBSERVE), *ROW_ARGUMENTS))
def integrate_rows(advance, series, reset, skip, observe, forcing, shape, parameters, rows, output, scratch, observed, first_row, steps):
    """Integrate one trajectory per row of `parameters` from `first_row` on, for `steps` steps in total; return the next row.

    An observer without a path sees the events in several portions; with a path, a trajectory with too many of them stays paused.
    """
    row = first_row
    while row < parameters.shape[0] and steps > 0:
        if rows.statuses[row] != PAUSED:
            # the trajectory ended in an earlier segment of the motion
            row += 1
            continue
        counters = rows.counters[row]
        counters[STEPS_LEFT] = steps
        row_forcing = Forcing(forcing.acceleration, forcing.gains[row], forcing.dt)
        state = State(counters, rows.clocks[row], rows.states[row])
        row_output = Output(
            output.path,
            output.modes,
            output.events,
            output.times,
            output.limits,
            rows.extrema[row],
            rows.transition_counts[row],
            rows.dwell_times[row],
        )
        rows.statuses[row] = advance(series, reset, skip, row_forcing, shape, parameters[row], state, row_output, scratch)
        # one step is charged for the call itself, so that rows at rest use up the allowance, too
        steps = counters[STEPS_LEFT] - 1
        segment_done = counters[SAMPLES_AFTER] > 0 and counters[SAMPLE] - counters[SEGMENT_START] >= forcing.acceleration.shape[1] - 1
        if rows.statuses[row] != PAUSED:
            observe(row_forcing, parameters[row], state, row_output, observed[row])
        is_full = 2 * (counters[N_EVENTS] - counters[N_FLUSHED]) > output.times.size > 0
        if is_full and output.path.shape[0] == 0 and rows.statuses[row] == PAUSED:
            observe(row_forcing, parameters[row], state, row_output, observed[row])
            counters[N_FLUSHED] = counters[N_EVENTS]
        elif rows.statuses[row] != PAUSED or segment_done or is_full:
            row += 1
    return row


@dataclass(frozen=True)
class Observer:
    """Function that observes each trajectory of a batch.

    Parameters
    ----------
    observe : compiled function
        Function with the signature ``OBSERVE`` of :mod:`seisblock.dynamics.model_api`.
    size : int
        How many numbers it writes.
    has_path : bool
        True to store the path for it.
    """

    observe: Callable[..., Any]
    size: int
    has_path: bool = False

    @cached_property
    def pointer(self) -> Any:
        """Function pointer of the function."""
        return function_pointer(self.observe, OBSERVE)


NO_OBSERVER = Observer(observe_nothing, 0)

EVENT_CAPACITY = 1 << 13
"""Capacity of the event tables of an observer; half of it is available for a trajectory."""


@dataclass(frozen=True, eq=False)
class Ensemble:
    """Final states of many trajectories, one per row.

    Parameters
    ----------
    model : Model
    dt : float, s
    final : (m, n_states) array
        State at the end of the integration.
    final_mode, n_events : (m,) arrays of int
    end : Instants
    first_event_time : (m,) array, s after sample 0
        Time of the first event, NaN without events.
    extrema : (m, n_tracked, 4) array
        Maximum, its time, minimum, its time; times in s after sample 0.
    transition_counts : (m, n_guards, n_modes) array of int
        Number of transitions by guard and next mode.
    dwell_times : (m, n_modes, 2) array, s
        Time spent in each mode: total, and longest interval between two events.
    failed : (m,) array of bool
        Rows whose integration failed; they hold the state at the failure, which is not a valid result.
    observed : (m, n) array
        Numbers of the observer; NaN for failed rows and those with too many events for a path.
    """

    model: Model
    dt: float
    final: FloatArray
    final_mode: IntArray
    n_events: IntArray
    end: Instants
    first_event_time: FloatArray
    extrema: FloatArray
    transition_counts: IntArray
    dwell_times: FloatArray
    failed: BoolArray
    observed: FloatArray

    @property
    def end_time(self) -> FloatArray:
        """End times of the integrations, (m,), s after sample 0."""
        return self.end.sample * self.dt + self.end.tau


def integrate_many(
    model: Model,
    motion: Motion,
    parameters: ArrayLike,
    initial: ArrayLike,
    mode: int | IntArray,
    *,
    gains: ArrayLike,
    start: Instant | Instants = BEGINNING,
    row_ids: IntArray | None = None,
    allow_failures: bool = False,
    observer: Observer = NO_OBSERVER,
) -> Ensemble:
    """Integrate a model under a motion once per row of parameters, without the GIL.

    Parameters
    ----------
    model : Model
    motion : Motion
        Acceleration, linear between samples. Not copied, except for one segment at a time of a long motion.
    parameters : (m, n_parameters) array
        In the model's order and units.
    initial : (n_states,) or (m, n_states) array
        Initial state at `start`.
    mode : int or (m,) array of int
        Initial mode at `start`.
    gains : (3,) or (m, 3) array
        Factors on the longitudinal, transverse and vertical acceleration; rows with a zero factor are not read.
    start : Instant or Instants
        Start of the integration, common or per row.
    row_ids : (m,) array of int
        Row numbers in error messages, if the rows are a subset.
    allow_failures : bool
        True to mark failed rows in the result instead of raising an error.
    observer : Observer
        For motions that are not long.

    Returns
    -------
    Ensemble

    Raises
    ------
    ParameterError
        If the shapes do not match.
    SolverError
        If an integration fails and failures are not allowed.
    """
    p = np.array(parameters, dtype=np.float64, order="C")
    if p.ndim != 2:
        raise ParameterError("`parameters` must have one row per trajectory, found shape {shape}", shape=str(p.shape))
    m, n_states = p.shape[0], len(model.states)
    states, scale = np.empty((m, n_states)), np.empty((m, 3))
    # broadcasting copies: the kernel advances the rows in place
    states[:], scale[:] = initial, gains
    template = initial_state(BEGINNING, 0, np.empty(n_states))
    rows = BatchState(
        np.tile(template.counters, (m, 1)),
        np.tile(template.clock, (m, 1)),
        states,
        np.zeros((m, model.tracked, 4)),
        np.zeros((m, len(model.guards), len(model.modes)), dtype=np.int64),
        np.zeros((m, len(model.modes), 2)),
        np.full(m, PAUSED, dtype=np.int64),
    )
    rows.counters[:, MODE], rows.counters[:, SAMPLE], rows.clocks[:, TAU] = mode, start.sample, start.tau
    output, observed = _make_output(observer, motion.samples, n_states), np.full((m, observer.size), np.nan)
    # all rows pass one segment before the next is read, so that one segment is in memory
    for segment in motion.segments((scale != 0.0).any(axis=0).tolist(), int(rows.counters[:, SAMPLE].min(initial=motion.samples))):
        forcing = BatchForcing(segment.acceleration, scale, motion.dt)
        rows.counters[:, SEGMENT_START], rows.counters[:, SAMPLES_AFTER] = segment.first, segment.samples_after
        row = 0
        work = output, allocate_scratch(model.shape, n_states, segment.acceleration.shape[0])
        if model.stride is not None:
            assert observer is NO_OBSERVER
            integrate_rows_simd(model, forcing, p, rows, *work)
        else:
            while row < m:
                check_cancelled()
                functions = *model.pointers, observer.pointer
                row = integrate_rows(*functions, forcing, model.shape, p, rows, *work, observed, row, STEPS_PER_SLICE)
        if not (rows.statuses == PAUSED).any():
            break
    end = Instants(rows.counters[:, SAMPLE], rows.clocks[:, TAU])
    failed: BoolArray = _IS_FAILURE[rows.statuses]
    observed[failed] = np.nan
    for row in () if allow_failures else np.flatnonzero(failed)[:1]:
        raise SolverError(
            "{name}, row {row}: integration stopped at {at:.6f} s: {failure}",
            name=model.name,
            row=row if row_ids is None else row_ids[row],
            at=motion.start_s + end.sample[row] * motion.dt + end.tau[row],
            failure=lazy_gettext(FAILURES[int(rows.statuses[row])]),
        )
    return Ensemble(
        model,
        motion.dt,
        states,
        rows.counters[:, MODE],
        rows.counters[:, N_EVENTS],
        end,
        rows.clocks[:, FIRST_EVENT_TIME],
        rows.extrema,
        rows.transition_counts,
        rows.dwell_times,
        failed,
        observed,
    )


def _make_output(observer: Observer, samples: int, n_states: int) -> Output:
    """Return the output of an observer, without rows where it needs none."""
    size = samples if observer.has_path else 0
    tables = allocate_events(EVENT_CAPACITY if observer.size else 0, n_states)
    path, modes = np.empty((size, n_states)), np.empty(size, dtype=np.int64)
    return Output(path, modes, *tables, np.empty((0, 4)), np.empty((0, 0), dtype=np.int64), np.empty((0, 2)))


def integrate_rows_simd(model: Model, forcing: BatchForcing, p: FloatArray, rows: BatchState, no_output: Output, scratch: Scratch) -> None:
    """Integrate all rows to the end of a motion or segment, side by side in lanes."""
    lane_rows, needs_engine = np.full(N_LANES, -1), np.ones(N_LANES, dtype=np.int64)
    lane_state = np.zeros(LANE_FIELDS * N_LANES)
    functions = (*model.pointers, model.stride_pointer)
    row = 0
    # the lanes keep their trajectories between the calls
    while row < p.shape[0] or (lane_rows >= 0).any():
        check_cancelled()
        row = integrate_in_lanes(
            *functions, forcing, model.shape, p, rows, lane_rows, needs_engine, lane_state, no_output, scratch, row, STEPS_PER_SLICE
        )

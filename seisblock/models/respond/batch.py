"""Many runs at once: rows of settings and factors through one record and on to rest, with no Python between the samples."""

from __future__ import annotations

import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, fields
from threading import Event

import numpy as np

from seisblock.core import checks
from seisblock.core.errors import ParameterError, SolverError
from seisblock.core.typing import ArrayLike, BoolArray, FloatArray, IntArray
from seisblock.dynamics import Ensemble, integrate_many
from seisblock.dynamics.buffers import LONGEST, TOTAL
from seisblock.dynamics.cancellation import cancel_scope, current_events
from seisblock.models.respond import constants
from seisblock.models.respond.batch_params import RespondBatchParams
from seisblock.models.respond.describe import FLIGHT, REST, ROCK, SLIDE, SLIDE_ROCK
from seisblock.models.respond.params import Initial, RespondParams
from seisblock.models.respond.run import check_settling, zero_motion
from seisblock.records import Motion
from seisblock.records._validation import validate_motion

MIN_ROWS_PER_TASK = 8
"""Rows that a thread takes at a time, at least: some fall at once, others hop for a minute."""

SAMPLES_PER_TASK = 10_000
"""Samples times rows that a thread takes at a time, where the motion is short."""

MODE_COLUMNS = (REST, SLIDE, ROCK, SLIDE_ROCK, FLIGHT)
"""Modes as columns of :attr:`RespondBatchResult.time_in_mode_s`."""


@dataclass(frozen=True, eq=False)
class RespondBatchResult:
    """The ends of many runs, arrays with one entry per row, (m,) unless told.

    Parameters
    ----------
    overturned, settled, gave_up : bool
        A run that was given up, among its hops or where its motion could not be followed on, has no answer: its other entries are
        those of the instant at which that happened.
    direction : int
        +1 or -1 where it has fallen to +x or -x, else 0.
    final_displacement_m, max_displacement_m : m
        Of the centre of gravity from x = 0; the former signed.
    max_rotation_rad : rad
    slip_path_m : m
    impacts : int
    end_s : s
        After the motion's first sample.
    time_in_mode_s : (m, 5) array, s
        At rest, sliding, rocking, sliding while rocking, in flight, up to the end.
    longest_flight_s : s
        From one impact to the next.
    """

    overturned: BoolArray
    settled: BoolArray
    gave_up: BoolArray
    direction: IntArray
    final_displacement_m: FloatArray
    max_displacement_m: FloatArray
    max_rotation_rad: FloatArray
    slip_path_m: FloatArray
    impacts: IntArray
    end_s: FloatArray
    time_in_mode_s: FloatArray
    longest_flight_s: FloatArray

    def require_complete(self) -> RespondBatchResult:
        """Return these fates, all of them answers.

        Raises
        ------
        SolverError
            If one was given up: whether it would fall is not known.
        """
        count = int(np.count_nonzero(self.gave_up))
        if count:
            raise no_answer(count, len(self.gave_up), int(self.impacts[self.gave_up].min()))
        return self


def no_answer(count: int, runs: int, impacts: int) -> SolverError:
    """Return the error of so many of some runs, which were given up after so many impacts at least."""
    return SolverError(
        "{count} of {runs} runs were given up after {impacts} impacts and have no answer: they hop without end; lower the restitution",
        count=count,
        runs=runs,
        impacts=impacts,
    )


def respond_many(
    params: Sequence[RespondParams] | RespondBatchParams,
    motion: Motion,
    *,
    gains: ArrayLike = (1.0, 0.0, 1.0),
    initial: Initial = None,
    settle_s: float = 60.0,
    workers: int | None = None,
) -> RespondBatchResult:
    """Return the fates of many bodies, or of versions of one, under one motion; bit by bit those of single runs ([ShentonJones1991]_).

    Parameters
    ----------
    params : Settings, or sequence of Setting
        One per row, all with as many further points, all with tenons or none.
    motion : Motion
    gains : (3,) or (m, 3) array
        Factors on the motion's rows along, across and up: (s cos, s sin, s_v) turns it by an angle and scales it.
    initial : six floats or None, m, rad, m/s, rad/s
        As in :func:`seisblock.models.respond.solve.solve_respond`, the same for all.
    settle_s : float, s
    workers : int or None
        Threads; None: one per core. The answer does not depend on it.

    Examples
    --------
    >>> import numpy as np
    >>> from seisblock.bodies.block import Block
    >>> from seisblock.models.respond.solve import respond_params
    >>> pulse = Motion.from_arrays(4.0 * np.sin(np.linspace(0.0, np.pi, 101)), 0.01)
    >>> respond_many([respond_params(Block(0.24, 0.8), mu=0.5)] * 2, pulse, gains=[(0.5, 0.0, 0.0), (1.0, 0.0, 0.0)]).overturned.tolist()
    [False, True]
    """
    validate_motion(motion)
    check_settling(settle_s)
    if not len(params):
        raise ParameterError("an ensemble needs at least one row")
    for row_params in () if isinstance(params, RespondBatchParams) else params:
        checks.instance(row_params, RespondParams)
    rows = np.array(np.broadcast_to(np.asarray(gains, dtype=np.float64), (len(params), 3)))
    chunk_size = max(MIN_ROWS_PER_TASK, SAMPLES_PER_TASK // motion.samples)
    pool, cancel_event = ThreadPoolExecutor(workers or os.cpu_count()), Event()
    events = (*current_events(), cancel_event)

    def run_chunk(first: int) -> RespondBatchResult:
        """Follow some rows, as long as anybody waits for them."""
        last = first + chunk_size
        with cancel_scope(events):
            return _run_batch(params[first:last], motion, rows[first:last], initial, settle_s)

    try:
        results = list(pool.map(run_chunk, range(0, len(params), chunk_size)))
    finally:
        cancel_event.set()
        pool.shutdown(cancel_futures=True)
    return RespondBatchResult(
        *(np.concatenate([getattr(result, field.name) for result in results]) for field in fields(RespondBatchResult))
    )


def _run_batch(
    params: Sequence[RespondParams] | RespondBatchParams, motion: Motion, gains: FloatArray, initial: Initial, settle_s: float
) -> RespondBatchResult:
    """Return the fates of some rows, on this thread."""
    if isinstance(params, RespondBatchParams):
        template, initial_states = params.row_params(0), params.states(initial)
    else:
        template, initial_states = params[0], np.array([row_params.state(initial) for row_params in params])
    model = template.model
    duration = (motion.samples - 1) * motion.dt
    record_run = integrate_many(
        model, motion, _parameter_rows(params, motion.dt, duration), initial_states, template.first_mode, gains=gains, allow_failures=True
    )
    failed = record_run.failed.copy()
    final, mode, end = record_run.final.copy(), record_run.final_mode.copy(), record_run.end_time.copy()
    high, low = _extrema(record_run)
    mode_times, longest_times = _mode_times(record_run)
    moving = ~failed & (mode >= 0) & (mode % constants.TENON_OFFSET != constants.REST)
    if settle_s > 0.0 and moving.any():
        ground = zero_motion(settle_s)
        p = _parameter_rows(params, ground.dt, duration + settle_s, ground_at_rest=True)
        for kind in np.unique(mode[moving]):
            rows = np.flatnonzero(moving & (record_run.final_mode == kind))
            free_run = integrate_many(model, ground, p[rows], record_run.final[rows], int(kind), gains=(1.0, 0.0, 1.0), allow_failures=True)
            failed[rows] = free_run.failed
            final[rows], mode[rows] = free_run.final, free_run.final_mode
            end[rows] = duration + free_run.end_time
            higher, lower = _extrema(free_run)
            high[rows], low[rows] = np.maximum(high[rows], higher), np.minimum(low[rows], lower)
            free_times = _mode_times(free_run)
            mode_times[rows] += free_times[0]
            longest_times[rows] = np.maximum(longest_times[rows], free_times[1])
    is_overturned = mode == constants.OVERTURNED
    return RespondBatchResult(
        overturned=is_overturned,
        settled=~failed & ((mode == constants.SETTLED) | ((mode >= 0) & (mode % constants.TENON_OFFSET == constants.REST))),
        gave_up=failed | (mode == constants.GAVE_UP),
        direction=np.where(is_overturned, np.sign(final[:, constants.THETA]), 0.0).astype(np.int64),
        final_displacement_m=final[:, constants.X],
        max_displacement_m=np.maximum(high[:, constants.X], -low[:, constants.X]) + 0.0,
        max_rotation_rad=np.maximum(high[:, constants.THETA], -low[:, constants.THETA]) + 0.0,
        slip_path_m=final[:, constants.PATH],
        impacts=final[:, constants.IMPACTS].astype(np.int64),
        end_s=end,
        time_in_mode_s=mode_times,
        longest_flight_s=longest_times[:, MODE_COLUMNS.index(FLIGHT)],
    )


def _parameter_rows(
    params: Sequence[RespondParams] | RespondBatchParams, dt: float, duration_s: float, *, ground_at_rest: bool = False
) -> FloatArray:
    """Return the parameters of the model, one row for each."""
    if isinstance(params, RespondBatchParams):
        return params.parameters(dt, duration_s=duration_s, ground_at_rest=ground_at_rest)
    return np.array([row_params.parameters(dt, duration_s=duration_s, ground_at_rest=ground_at_rest) for row_params in params])


def _mode_times(ensemble: Ensemble) -> tuple[FloatArray, FloatArray]:
    """Return the time in each mode, in all and at the longest stretch, (m, 5) each, whichever corner and with or without tenons."""
    columns = [[i for i, mode in enumerate(constants.MODES[: 2 * constants.TENON_OFFSET]) if mode == kind] for kind in MODE_COLUMNS]
    total = [ensemble.dwell_times[:, column, TOTAL].sum(axis=1) for column in columns]
    longest = [ensemble.dwell_times[:, column, LONGEST].max(axis=1) for column in columns]
    return np.column_stack(total), np.column_stack(longest)


def _extrema(ensemble: Ensemble) -> tuple[FloatArray, FloatArray]:
    """Return the highest and the lowest values of the tracked states, (m, 2) each."""
    return ensemble.extrema[:, :, 0].copy(), ensemble.extrema[:, :, 2].copy()

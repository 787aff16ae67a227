"""Batch solver of the full-response model: many parameter rows and gains under one motion, in compiled loops and threads."""

from __future__ import annotations

import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, fields
from threading import Event

import numpy as np

from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import ParameterError, SolverError
from seisblock.core.typing import ArrayLike, BoolArray, FloatArray, IntArray
from seisblock.criteria.initiation import Mode
from seisblock.dynamics import Ensemble, integrate_many
from seisblock.dynamics.buffers import LONGEST, TOTAL
from seisblock.dynamics.cancellation import cancel_scope, current_events
from seisblock.dynamics.ensemble import NO_OBSERVER, Observer
from seisblock.dynamics.model import Model
from seisblock.models.respond import constants
from seisblock.models.respond.params import FLAT_SHARE, Initial, RespondBatchParams, RespondParams
from seisblock.models.respond.run import are_rest, check_settling, zero_motion
from seisblock.records import Motion
from seisblock.records._validation import gain_rows, validate_motion

MIN_ROWS_PER_TASK = 8
"""Smallest number of rows per task: run times differ, from immediate overturning to a minute of rebounds."""

SAMPLES_PER_TASK = 10_000
"""Samples times rows per task of a short motion."""

MODE_COLUMNS = (Mode.REST, Mode.SLIDE, Mode.ROCK, Mode.SLIDE_ROCK, Mode.FLIGHT)
"""Modes as columns of :attr:`RespondBatchResult.time_in_mode_s`."""


@dataclass(frozen=True, eq=False, repr=False)
class RespondBatchResult(DisplayMixin):
    """Results of m runs; arrays of shape (m,) unless noted.

    Parameters
    ----------
    overturned, settled, gave_up : bool
        `gave_up`: the run was abandoned (endless rebounds or failed integration) and has no result; its other entries refer to the
        instant of abandonment.
    direction : int
        +1 or -1 for overturning to +x or -x, else 0.
    final_displacement_m, max_displacement_m : m
        Displacement of the centre of gravity from x = 0; the former signed.
    max_rotation_rad : rad
    max_rotation_ratio : 1
        Peak tilt over the overturning angle of the corner concerned.
    slip_path_m : m
    impacts : int
    end_s : s
        End of the motion, after the first sample.
    time_in_mode_s : (m, 5) array, s
        Time at rest, sliding, rocking, slide-rocking and in flight.
    longest_flight_s : s
        Longest time between two impacts in flight.
    """

    overturned: BoolArray
    settled: BoolArray
    gave_up: BoolArray
    direction: IntArray
    final_displacement_m: FloatArray
    max_displacement_m: FloatArray
    max_rotation_rad: FloatArray
    max_rotation_ratio: FloatArray
    slip_path_m: FloatArray
    impacts: IntArray
    end_s: FloatArray
    time_in_mode_s: FloatArray
    longest_flight_s: FloatArray

    def require_complete(self) -> RespondBatchResult:
        """Return this result if every run is complete.

        Raises
        ------
        SolverError
            If a run was abandoned.
        """
        count = int(np.count_nonzero(self.gave_up))
        if count:
            raise no_answer(count, len(self.gave_up), int(self.impacts[self.gave_up].min()))
        return self


def no_answer(count: int, runs: int, impacts: int) -> SolverError:
    """Return the error for `count` of `runs` runs abandoned after at least `impacts` impacts."""
    return SolverError(
        "{count} of {runs} runs have no result: still bouncing after {impacts} impacts; use a smaller `restitution`",
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
    """Solve many bodies or parameter samples under one motion, bit by bit as single runs ([ShentonJones1991]_).

    Parameters
    ----------
    params : RespondBatchParams, or sequence of RespondParams
        One per row; all with the same number of further points, all with or all without tenons.
    motion : Motion
    gains : (3,) or (m, 3) array
        Factors on the motion's rows along, across and up; (s cos(a), s sin(a), s_v) rotates by an azimuth a and scales.
    initial : six floats or None, m, rad, m/s, rad/s
        Initial state of all rows, see :func:`seisblock.models.respond.solve.solve_respond`.
    settle_s : float, s
        Longest time on ground at rest after the record.
    workers : int or None
        Threads; None: one per core. Results do not depend on it.

    Returns
    -------
    RespondBatchResult

    Examples
    --------
    >>> from seisblock.models import respond_many
    >>> import numpy as np
    >>> from seisblock.bodies.block import Block
    >>> from seisblock.models.respond.options import RespondOptions
    >>> from seisblock.models.respond.solve import respond_params
    >>> pulse = Motion.from_arrays(4.0 * np.sin(np.linspace(0.0, np.pi, 101)), 0.01)
    >>> params = respond_params(Block(0.24, 0.8), options=RespondOptions(mu=0.5))
    >>> respond_many([params] * 2, pulse, gains=[(0.5, 0.0, 0.0), (1.0, 0.0, 0.0)]).overturned.tolist()
    [False, True]
    """
    validate_motion(motion)
    check_settling(settle_s)
    if not len(params):
        raise ParameterError("`params` is empty: at least one row is required")
    for row_params in () if isinstance(params, RespondBatchParams) else params:
        checks.instance(row_params, RespondParams)
    rows = np.array(np.broadcast_to(gain_rows(gains, len(params)), (len(params), 3)))
    chunk_size = max(MIN_ROWS_PER_TASK, SAMPLES_PER_TASK // motion.samples)
    pool, cancel_event = ThreadPoolExecutor(workers or os.cpu_count()), Event()
    events = (*current_events(), cancel_event)

    def run_chunk(first: int) -> RespondBatchResult:
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


@dataclass(eq=False)
class Runs:
    """Ends of m runs; arrays of shape (m,), (m, 2) of the tracked states, (m, n_states), (m, 5) of the modes, (m, n) of the observer."""

    failed: BoolArray
    mode: IntArray
    final: FloatArray
    time: FloatArray
    high: FloatArray
    low: FloatArray
    mode_times: FloatArray
    longest_times: FloatArray
    observed: FloatArray


def solve_runs(
    params: Sequence[RespondParams] | RespondBatchParams,
    motion: Motion,
    gains: FloatArray,
    initial: Initial,
    settle_s: float,
    observer: Observer = NO_OBSERVER,
) -> Runs:
    """Solve runs through a motion and up to rest; the observer counts, so that both parts are added."""
    if isinstance(params, RespondBatchParams):
        template, initial_states = params.row_params(0), params.states(initial)
    else:
        template, initial_states = params[0], np.array([row_params.state(initial) for row_params in params])
    model = template.model
    duration = (motion.samples - 1) * motion.dt
    # a failed row must not fail the others: it is reported, and excluded from what follows
    p = _parameter_rows(params, motion.dt, duration)
    runs = _integrate_rows(model, motion, p, initial_states, template.first_mode, gains, observer)
    record_mode = runs.mode.copy()
    moving = ~runs.failed & (record_mode >= 0) & ~are_rest(record_mode)
    # without a moving row there is nothing to prepare
    if settle_s > 0.0 and moving.any():
        ground = zero_motion(settle_s)
        p = _parameter_rows(params, ground.dt, duration + settle_s, ground_at_rest=True)
        rows = np.flatnonzero(moving)
        free = _integrate_rows(model, ground, p[rows], runs.final[rows], record_mode[rows], np.array([[1.0, 0.0, 1.0]]), observer)
        runs.failed[rows], runs.final[rows], runs.mode[rows], runs.time[rows] = free.failed, free.final, free.mode, duration + free.time
        runs.high[rows], runs.low[rows] = np.maximum(runs.high[rows], free.high), np.minimum(runs.low[rows], free.low)
        runs.mode_times[rows] += free.mode_times
        runs.longest_times[rows] = np.maximum(runs.longest_times[rows], free.longest_times)
        runs.observed[rows] += free.observed
    return runs


def _run_batch(
    params: Sequence[RespondParams] | RespondBatchParams, motion: Motion, gains: FloatArray, initial: Initial, settle_s: float
) -> RespondBatchResult:
    runs = solve_runs(params, motion, gains, initial, settle_s)
    mode, final, high, low = runs.mode, runs.final, runs.high, runs.low
    is_overturned = mode == constants.OVERTURNED
    tilts = np.array([high[:, constants.THETA], -low[:, constants.THETA]])
    if isinstance(params, RespondBatchParams):
        slendernesses = params.blocks.slendernesses
    else:
        slendernesses = np.array([row_params.rigid_body.slendernesses for row_params in params])
    return RespondBatchResult(
        overturned=is_overturned,
        settled=~runs.failed & are_rest(mode),
        gave_up=runs.failed | (mode == constants.GAVE_UP),
        direction=np.where(is_overturned, np.sign(final[:, constants.THETA]), 0.0).astype(np.int64),
        final_displacement_m=final[:, constants.X],
        max_displacement_m=np.maximum(high[:, constants.X], -low[:, constants.X]) + 0.0,
        max_rotation_rad=np.maximum(*tilts) + 0.0,
        max_rotation_ratio=np.maximum(*(tilts / slendernesses.T)) + 0.0,
        slip_path_m=final[:, constants.PATH],
        impacts=final[:, constants.IMPACTS].astype(np.int64),
        end_s=runs.time,
        time_in_mode_s=runs.mode_times,
        longest_flight_s=runs.longest_times[:, MODE_COLUMNS.index(Mode.FLIGHT)],
    )


def _integrate_rows(
    model: Model, motion: Motion, p: FloatArray, initial: FloatArray, mode: int | IntArray, gains: FloatArray, observer: Observer
) -> Runs:
    """Integrate rows; repeat those with bodies set flat whose impacts do not end."""

    def attempt(rows: IntArray, p: FloatArray) -> Runs:
        first = np.broadcast_to(initial, (runs, np.shape(initial)[-1]))[rows]
        kind, factors = np.broadcast_to(mode, runs)[rows], np.broadcast_to(gains, (runs, 3))[rows]
        ensemble = integrate_many(model, motion, p, first, kind, gains=factors, allow_failures=True, observer=observer)
        high, low = ensemble.extrema[:, :, 0].copy(), ensemble.extrema[:, :, 2].copy()
        times = _mode_times(ensemble)
        return Runs(ensemble.failed, ensemble.final_mode, ensemble.final, ensemble.end_time, high, low, *times, ensemble.observed)

    runs = len(p)
    result = attempt(np.arange(runs), p)
    rows = np.flatnonzero(result.failed)
    if rows.size:
        flat = p[rows]
        flat[:, constants.FLAT_RATE] = FLAT_SHARE * flat[:, constants.SMALL_RATE]
        repeated = attempt(rows, flat)
        for item in fields(Runs):
            getattr(result, item.name)[rows] = getattr(repeated, item.name)
        # the tables of an observer may have been too small
        result.observed[rows] = np.nan
    return result


def _parameter_rows(
    params: Sequence[RespondParams] | RespondBatchParams, dt: float, duration_s: float, *, ground_at_rest: bool = False
) -> FloatArray:
    """Return the parameter vectors of the model, (m, n_parameters)."""
    if isinstance(params, RespondBatchParams):
        return params.parameters(dt, duration_s=duration_s, ground_at_rest=ground_at_rest)
    return np.array([row_params.parameters(dt, duration_s=duration_s, ground_at_rest=ground_at_rest) for row_params in params])


def _mode_times(ensemble: Ensemble) -> tuple[FloatArray, FloatArray]:
    """Return the total and the longest continuous time in each mode, (m, 5) each, s; corners, slip directions and tenons merged."""
    columns = [[i for i, mode in enumerate(constants.MODES[: 2 * constants.TENON_OFFSET]) if mode == kind] for kind in MODE_COLUMNS]
    total = [ensemble.dwell_times[:, column, TOTAL].sum(axis=1) for column in columns]
    longest = [ensemble.dwell_times[:, column, LONGEST].max(axis=1) for column in columns]
    return np.column_stack(total), np.column_stack(longest)

"""Continuation of a jump run on ground at rest after the record."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from seisblock.core.typing import ArrayLike, BoolArray, FloatArray, IntArray
from seisblock.dynamics import Ensemble, Instant, Instants, Model, Path, Trajectory, integrate, integrate_many
from seisblock.records import Motion

CHUNK_S, MAX_FREE_S = 4.0, 60.0
"""Length of one segment of ground at rest, and largest total length, s."""


def continue_after_record(
    model: Model,
    motion: Motion,
    parameters: ArrayLike,
    initial: ArrayLike,
    mode: int,
    *,
    gains: Sequence[float],
    start: Instant,
) -> Trajectory:
    """Integrate a model through a motion and then through at most 60 s of ground at rest.

    Parameters are those of :func:`seisblock.dynamics.integrate`. The ground acceleration jumps from its last sample to zero. Sample numbers
    of the trajectory continue beyond the record.
    """
    # the sampling interval of the record, so that sample numbers continue beyond it
    count = math.ceil(CHUNK_S / motion.dt) + 1
    zero_motion = Motion(np.zeros((3, count)), motion.dt)
    if start.sample < motion.samples - 1:
        trajectory = integrate(model, motion, parameters, initial, mode, gains=gains, start=start)
    else:
        trajectory = _shift_time(integrate(model, zero_motion, parameters, initial, mode, start=Instant(0, start.tau)), start.sample)
    # short segments: most runs come to an end within the first
    for _ in range(math.ceil(MAX_FREE_S / CHUNK_S)):
        if trajectory.final_mode < 0:
            break
        trajectory = _concatenate(
            trajectory,
            _shift_time(integrate(model, zero_motion, parameters, trajectory.final, trajectory.final_mode), trajectory.end.sample),
        )
    return trajectory


def _shift_time(trajectory: Trajectory, samples: int) -> Trajectory:
    """Return a trajectory shifted in time by `samples` samples."""
    seconds = samples * trajectory.dt
    extrema = trajectory.extrema.copy()
    # columns 1 and 3 are the times of maximum and minimum
    extrema[:, 1::2] += seconds

    def walk() -> Iterator[Path]:
        return (
            replace(path, first=path.first + samples, events=path.events.shift_time(samples, seconds)) for path in trajectory.iter_paths()
        )

    end = Instant(trajectory.end.sample + samples, trajectory.end.tau)
    return replace(trajectory, iter_paths=walk, extrema=extrema, events=trajectory.events.shift_time(samples, seconds), end=end)


def _concatenate(head: Trajectory, tail: Trajectory) -> Trajectory:
    """Return a trajectory and its continuation as one."""
    higher = tail.extrema[:, 0] > head.extrema[:, 0]
    lower = tail.extrema[:, 2] < head.extrema[:, 2]
    extrema = head.extrema.copy()
    extrema[higher, :2] = tail.extrema[higher, :2]
    extrema[lower, 2:] = tail.extrema[lower, 2:]

    def walk() -> Iterator[Path]:
        yield from head.iter_paths()
        for path in tail.iter_paths():
            # the first sample of the continuation repeats the last one of the head
            overlap = 1 if path.first == head.end.sample else 0
            yield replace(path, first=path.first + overlap, states=path.states[overlap:], modes=path.modes[overlap:])

    return replace(tail, iter_paths=walk, events=head.events + tail.events, n_events=head.n_events + tail.n_events, extrema=extrema)


def continue_batch_after_record(
    model: Model,
    motion: Motion,
    parameters: ArrayLike,
    initial: ArrayLike,
    mode: int,
    *,
    gains: ArrayLike,
    start: Instants,
) -> BatchEnds:
    """Integrate many runs through a motion and ground at rest, bit by bit as :func:`continue_after_record`.

    Parameters are those of :func:`seisblock.dynamics.integrate_many`, with one row of parameters and gains per run.
    """
    p, scale = np.asarray(parameters, dtype=np.float64), np.asarray(gains, dtype=np.float64)
    runs, last = len(p), motion.samples - 1
    states: FloatArray = np.array(np.broadcast_to(np.asarray(initial, dtype=np.float64), (runs, len(model.states))))
    result = BatchEnds(
        states, np.full(runs, mode), Instants(start.sample.copy(), start.tau.copy()), np.full(runs, np.nan), np.zeros(runs, dtype=np.bool_)
    )
    shaken_rows = np.flatnonzero(start.sample < last)
    if shaken_rows.size:
        starts = Instants(start.sample[shaken_rows], start.tau[shaken_rows])
        ensemble = integrate_many(
            model, motion, p[shaken_rows], states[shaken_rows], mode, gains=scale[shaken_rows], start=starts, allow_failures=True
        )
        result.store(shaken_rows, ensemble, 0)
    active_rows = np.flatnonzero((result.final_mode >= 0) & ~result.failed)
    if active_rows.size:
        # a run that starts after the record gets one more segment, as in the single run
        chunk = math.ceil(CHUNK_S / motion.dt)
        is_late = start.sample[active_rows] >= last
        first_sample = np.where(is_late, 0, chunk)
        zero_motion = Motion(np.zeros((3, (math.ceil(MAX_FREE_S / CHUNK_S) + 1) * chunk + 1)), motion.dt)
        starts = Instants(first_sample, result.end.tau[active_rows])
        state, modes = result.final[active_rows], result.final_mode[active_rows]
        free_run = integrate_many(
            model, zero_motion, p[active_rows], state, modes, gains=(1.0, 0.0, 0.0), start=starts, allow_failures=True
        )
        result.store(active_rows, free_run, result.end.sample[active_rows] - first_sample)
    return result


@dataclass(frozen=True, eq=False)
class BatchEnds:
    """Final states of many runs.

    Parameters
    ----------
    final, final_mode : (m, n_states), (m,) arrays
    end : Instants
    first_event_time : (m,) array, s after sample 0
        Time of the first event, NaN without one.
    failed : (m,) array of bool
        Abandoned rows.
    """

    final: FloatArray
    final_mode: IntArray
    end: Instants
    first_event_time: FloatArray
    failed: BoolArray

    def store(self, rows: IntArray, ensemble: Ensemble, samples: IntArray | int) -> None:
        """Store the ends of `rows` from an ensemble whose time origin is sample `samples`."""
        self.final[rows], self.final_mode[rows] = ensemble.final, ensemble.final_mode
        self.end.sample[rows], self.end.tau[rows] = ensemble.end.sample + samples, ensemble.end.tau
        self.failed[rows] = ensemble.failed
        first_change = self.first_event_time[rows]
        # rows with an event in an earlier part keep its time
        self.first_event_time[rows] = np.where(np.isnan(first_change), ensemble.first_event_time + samples * ensemble.dt, first_change)

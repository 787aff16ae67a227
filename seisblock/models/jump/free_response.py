"""Ground that stands still once the record has ended: what the record began comes to its end, as it does for `rock` and `slide`."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from seisblock.core.typing import ArrayLike, BoolArray, FloatArray, IntArray
from seisblock.dynamics import Ensemble, Instant, Instants, Model, Path, Trajectory, integrate, integrate_many
from seisblock.records import Motion

CHUNK_S, MAX_FREE_S = 4.0, 60.0
"""Still ground is added in stretches of so many seconds, and at most so long."""


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
    """Follow a model through a motion and, from its last sample on, for at most 60 s of still ground.

    Parameters are those of :func:`seisblock.dynamics.integrate`. The ground stops at once: its acceleration leaps from that of the last
    sample to zero. The trajectory counts samples on, as if the record had gone on.
    """
    count = math.ceil(CHUNK_S / motion.dt) + 1
    zero_motion = Motion(np.zeros((3, count)), motion.dt)
    if start.sample < motion.samples - 1:
        trajectory = integrate(model, motion, parameters, initial, mode, gains=gains, start=start)
    else:
        trajectory = _shift_time(integrate(model, zero_motion, parameters, initial, mode, start=Instant(0, start.tau)), start.sample)
    for _ in range(math.ceil(MAX_FREE_S / CHUNK_S)):
        if trajectory.final_mode < 0:
            break
        trajectory = _concatenate(
            trajectory,
            _shift_time(integrate(model, zero_motion, parameters, trajectory.final, trajectory.final_mode), trajectory.end.sample),
        )
    return trajectory


def _shift_time(trajectory: Trajectory, samples: int) -> Trajectory:
    """Return a trajectory that was followed on a clock which started so many samples late."""
    seconds = samples * trajectory.dt
    extrema = trajectory.extrema.copy()
    extrema[:, 1::2] += seconds

    def walk() -> Iterator[Path]:
        return (
            replace(path, first=path.first + samples, events=path.events.shift_time(samples, seconds)) for path in trajectory.iter_paths()
        )

    end = Instant(trajectory.end.sample + samples, trajectory.end.tau)
    return replace(trajectory, iter_paths=walk, extrema=extrema, events=trajectory.events.shift_time(samples, seconds), end=end)


def _concatenate(head: Trajectory, tail: Trajectory) -> Trajectory:
    """Return one trajectory from one that reached a sample and its continuation from there."""
    higher = tail.extrema[:, 0] > head.extrema[:, 0]
    lower = tail.extrema[:, 2] < head.extrema[:, 2]
    extrema = head.extrema.copy()
    extrema[higher, :2] = tail.extrema[higher, :2]
    extrema[lower, 2:] = tail.extrema[lower, 2:]

    def walk() -> Iterator[Path]:
        yield from head.iter_paths()
        for path in tail.iter_paths():
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
    """Follow many as :func:`continue_after_record` follows one, bit by bit.

    Parameters are those of :func:`seisblock.dynamics.integrate_many`, with a row each of parameters and gains.
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
        # what begins on still ground has a stretch more, as it has alone
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
    """The ends of many that were followed on.

    Parameters
    ----------
    final, final_mode : (m, n_states), (m,) arrays
    end : Instants
    first_event_time : (m,) array, s after sample 0
        Time of the first event, NaN where there was none.
    failed : (m,) array of bool
        Rows that were given up.
    """

    final: FloatArray
    final_mode: IntArray
    end: Instants
    first_event_time: FloatArray
    failed: BoolArray

    def store(self, rows: IntArray, ensemble: Ensemble, samples: IntArray | int) -> None:
        """Write what some rows came to on a clock that started so many samples late."""
        self.final[rows], self.final_mode[rows] = ensemble.final, ensemble.final_mode
        self.end.sample[rows], self.end.tau[rows] = ensemble.end.sample + samples, ensemble.end.tau
        self.failed[rows] = ensemble.failed
        first_change = self.first_event_time[rows]
        self.first_event_time[rows] = np.where(np.isnan(first_change), ensemble.first_event_time + samples * ensemble.dt, first_change)

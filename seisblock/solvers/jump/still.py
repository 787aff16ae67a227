"""Ground that stands still once the record has ended: what the record began comes to its end, as it does for `rock` and `slide`."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from seisblock.dynamics import Ensemble, Instant, Instants, Model, Path, Trajectory, follow, follow_many
from seisblock.records import Motion
from seisblock.typing import ArrayLike, BoolArray, FloatArray, IntArray

STRETCH_S, MOST_S = 4.0, 60.0
"""Still ground is added in stretches of so many seconds, and at most so long."""


def follow_on(
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

    Parameters are those of :func:`seisblock.dynamics.follow`. The ground stops at once: its acceleration leaps from that of the last
    sample to zero. The trajectory counts samples on, as if the record had gone on.
    """
    count = math.ceil(STRETCH_S / motion.dt) + 1
    still = Motion(np.zeros((3, count)), motion.dt)
    if start.sample < motion.samples - 1:
        found = follow(model, motion, parameters, initial, mode, gains=gains, start=start)
    else:
        found = _later(follow(model, still, parameters, initial, mode, start=Instant(0, start.tau)), start.sample)
    for _ in range(math.ceil(MOST_S / STRETCH_S)):
        if found.final_mode < 0:
            break
        found = _joined(found, _later(follow(model, still, parameters, found.final, found.final_mode), found.end.sample))
    return found


def _later(part: Trajectory, samples: int) -> Trajectory:
    """Return a trajectory that was followed on a clock which started so many samples late."""
    seconds = samples * part.dt
    extrema = part.extrema.copy()
    extrema[:, 1::2] += seconds

    def walk() -> Iterator[Path]:
        return (replace(path, first=path.first + samples, changes=path.changes.later(samples, seconds)) for path in part.walk())

    end = Instant(part.end.sample + samples, part.end.tau)
    return replace(part, walk=walk, extrema=extrema, changes=part.changes.later(samples, seconds), end=end)


def _joined(one: Trajectory, two: Trajectory) -> Trajectory:
    """Return one trajectory from one that reached a sample and its continuation from there."""
    higher = two.extrema[:, 0] > one.extrema[:, 0]
    lower = two.extrema[:, 2] < one.extrema[:, 2]
    extrema = one.extrema.copy()
    extrema[higher, :2] = two.extrema[higher, :2]
    extrema[lower, 2:] = two.extrema[lower, 2:]

    def walk() -> Iterator[Path]:
        yield from one.walk()
        for path in two.walk():
            again = 1 if path.first == one.end.sample else 0
            yield replace(path, first=path.first + again, states=path.states[again:], modes=path.modes[again:])

    return replace(two, walk=walk, changes=one.changes + two.changes, n_changes=one.n_changes + two.n_changes, extrema=extrema)


def follow_many_on(
    model: Model,
    motion: Motion,
    parameters: ArrayLike,
    initial: ArrayLike,
    mode: int,
    *,
    gains: ArrayLike,
    start: Instants,
) -> FollowedOn:
    """Follow many as :func:`follow_on` follows one, bit by bit.

    Parameters are those of :func:`seisblock.dynamics.follow_many`, with a row each of parameters and gains.
    """
    p, scale = np.asarray(parameters, dtype=np.float64), np.asarray(gains, dtype=np.float64)
    runs, last = len(p), motion.samples - 1
    each: FloatArray = np.array(np.broadcast_to(np.asarray(initial, dtype=np.float64), (runs, len(model.states))))
    found = FollowedOn(
        each, np.full(runs, mode), Instants(start.sample.copy(), start.tau.copy()), np.full(runs, np.nan), np.zeros(runs, dtype=np.bool_)
    )
    shaken = np.flatnonzero(start.sample < last)
    if shaken.size:
        here = Instants(start.sample[shaken], start.tau[shaken])
        some = follow_many(model, motion, p[shaken], each[shaken], mode, gains=scale[shaken], start=here, allow_failures=True)
        found.put(shaken, some, 0)
    going = np.flatnonzero((found.final_mode >= 0) & ~found.failed)
    if going.size:
        # what begins on still ground has a stretch more, as it has alone
        stretch = math.ceil(STRETCH_S / motion.dt)
        late = start.sample[going] >= last
        begin = np.where(late, 0, stretch)
        still = Motion(np.zeros((3, (math.ceil(MOST_S / STRETCH_S) + 1) * stretch + 1)), motion.dt)
        here = Instants(begin, found.end.tau[going])
        state, modes = found.final[going], found.final_mode[going]
        after = follow_many(model, still, p[going], state, modes, gains=(1.0, 0.0, 0.0), start=here, allow_failures=True)
        found.put(going, after, found.end.sample[going] - begin)
    return found


@dataclass(frozen=True, eq=False)
class FollowedOn:
    """The ends of many that were followed on.

    Parameters
    ----------
    final, final_mode : (m, n_states), (m,) arrays
    end : Instants
    first_change : (m,) array, s after sample 0
        Time of the first event, NaN where there was none.
    failed : (m,) array of bool
        Rows that were given up.
    """

    final: FloatArray
    final_mode: IntArray
    end: Instants
    first_change: FloatArray
    failed: BoolArray

    def put(self, rows: IntArray, found: Ensemble, samples: IntArray | int) -> None:
        """Write what some rows came to on a clock that started so many samples late."""
        self.final[rows], self.final_mode[rows] = found.final, found.final_mode
        self.end.sample[rows], self.end.tau[rows] = found.end.sample + samples, found.end.tau
        self.failed[rows] = found.failed
        first = self.first_change[rows]
        self.first_change[rows] = np.where(np.isnan(first), found.first_change + samples * found.dt, first)

"""Ground that stands still once the record has ended: what the record began comes to its end, as it does for `rock` and `slide`."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from seisblock.dynamics import Instant, Model, Trajectory, follow
from seisblock.records import Motion
from seisblock.typing import ArrayLike, FloatArray, IntArray

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
    states: FloatArray = np.concatenate([np.zeros((samples, part.states.shape[1])), part.states])
    modes: IntArray = np.concatenate([np.zeros(samples, dtype=np.int64), part.modes])
    extrema = part.extrema.copy()
    extrema[:, 1::2] += seconds
    changes = tuple(replace(c, at=Instant(c.at.sample + samples, c.at.tau), time=c.time + seconds) for c in part.changes)
    end = Instant(part.end.sample + samples, part.end.tau)
    return replace(part, first=part.first + samples, states=states, modes=modes, extrema=extrema, changes=changes, end=end)


def _joined(one: Trajectory, two: Trajectory) -> Trajectory:
    """Return one trajectory from one that reached a sample and its continuation from there."""
    cut = one.end.sample + 1
    higher = two.extrema[:, 0] > one.extrema[:, 0]
    lower = two.extrema[:, 2] < one.extrema[:, 2]
    extrema = one.extrema.copy()
    extrema[higher, :2] = two.extrema[higher, :2]
    extrema[lower, 2:] = two.extrema[lower, 2:]
    return replace(
        two,
        first=one.first,
        states=np.concatenate([one.states[:cut], two.states[cut:]]),
        modes=np.concatenate([one.modes[:cut], two.modes[cut:]]),
        changes=one.changes + two.changes,
        n_changes=one.n_changes + two.n_changes,
        extrema=extrema,
    )

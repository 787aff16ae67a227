"""Ground that stands still once the record has ended: what the record began comes to its end, as it does for `rock` and `slide`."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from seisblock.dynamics import Instant, Model, Path, Trajectory, follow
from seisblock.records import Motion
from seisblock.typing import ArrayLike

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

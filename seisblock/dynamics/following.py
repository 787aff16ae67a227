"""Following a model through a motion gives a trajectory.

Room for the path is taken only where the motion is short. A long one is followed stretch by stretch, and its path, where somebody asks for
it, by following it again.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TypeVar

import numpy as np

from seisblock.dynamics import hybrid
from seisblock.dynamics.arguments import (
    BASE,
    BEYOND,
    FOUND,
    LOGGED,
    MODE,
    SAMPLE,
    STEPS_LEFT,
    TAU,
    Cursor,
    Ground,
    Kept,
)
from seisblock.dynamics.changes import BEGINNING, EVENT_SAMPLE, Changes, Instant, bytes_each, joined_changes, room_for
from seisblock.dynamics.halt import heed, tell_samples
from seisblock.dynamics.model import Model
from seisblock.dynamics.status import FAILURES, PAUSED, TOO_MANY_EVENTS
from seisblock.dynamics.trajectory import Path, Trajectory
from seisblock.errors import SolverError
from seisblock.limits import check_changes
from seisblock.records.motion import Motion, Stretch
from seisblock.typing import ArrayLike, FloatArray, IntArray
from seisblock.words import said

SLICE = 1 << 16
"""Steps that compiled code takes before Python may be interrupted: 10 to 150 ms, and no more than 1e-3 of that to come back."""

_FIRST_CAPACITY = 1 << 12
_LAST_CAPACITY = 1 << 18
"""Events for which the tables have room, half of them in a single interval between two samples: at first, and at the most."""

_MANY, _MANY_PER_SAMPLE = 1 << 24, 4
"""Events, and of a long motion events per sample, beyond which a motion changes its mode without end."""

Rows = TypeVar("Rows", FloatArray, IntArray)

_NO_TALLY, _NO_STAYS = np.empty((0, 0), dtype=np.int64), np.empty((0, 2))


def follow(
    model: Model,
    motion: Motion,
    parameters: ArrayLike,
    initial: ArrayLike,
    mode: int,
    *,
    gains: Sequence[float] = (1.0, 0.0, 0.0),
    start: Instant = BEGINNING,
    keep_path: bool = True,
    keep_events: bool = True,
) -> Trajectory:
    """Follow a model through a motion.

    Parameters
    ----------
    model : Model
    motion : Motion
        Piecewise linear between its samples.
    parameters : (n_parameters,) array
        In the model's order and units.
    initial : (n_states,) array
        State at `start`.
    mode : int
        Mode at `start`.
    gains : three floats
        Factors on the rows along, across, up; zero leaves a row out.
    start : Instant
        Where to begin.
    keep_path, keep_events : bool
        Whether states at samples, and events, are kept on the way. A path that was not kept, as that through a long motion never is, is
        followed again when it is asked for.

    Returns
    -------
    Trajectory

    Raises
    ------
    SolverError
        If the integration had to be given up.
    """
    course = _Course(model, motion, np.array(parameters, dtype=np.float64), np.array(gains, dtype=np.float64))
    n_states = len(model.states)
    extrema = np.zeros((model.tracked, 4))
    keeps = keep_path and not motion.is_long
    path, modes = (np.empty((motion.samples, n_states)), np.empty(motion.samples, dtype=np.int64)) if keeps else _no_path(n_states)
    capacity = _FIRST_CAPACITY if keep_events else 0
    while True:
        cursor = cursor_at(start, mode, np.array(initial, dtype=np.float64))
        kept = Kept(path, modes, *room_for(capacity, n_states), extrema, _NO_TALLY, _NO_STAYS)
        status, parts = PAUSED, list[Changes]()
        for stretch in course.stretches(start.sample):
            status = course.follow_on(stretch, cursor, kept, parts)
            if status != PAUSED:
                break
        if not (status == TOO_MANY_EVENTS and cursor.place[FOUND] - cursor.place[LOGGED] == capacity < _LAST_CAPACITY):
            break
        capacity *= 8
    found, final_mode = int(cursor.place[FOUND]), int(cursor.place[MODE])
    ended = Instant(int(cursor.place[SAMPLE]), float(cursor.clock[TAU]))
    if status in FAILURES:
        at = motion.start_s + ended.sample * motion.dt + ended.tau
        raise SolverError("{name}: given up at {at:.6f} s, where {failure}", name=model.name, at=at, failure=said(FAILURES[status]))
    if keep_events:
        check_changes(found, bytes_each(n_states))
        parts.append(_logged(kept, cursor, motion.dt))
    changes = joined_changes(parts) if parts else _none(n_states)
    if keeps:
        reached = slice(_first_kept(start), ended.sample + 1)
        whole = Path(motion.dt, reached.start, _held(path, reached), _held(modes, reached), changes)
        walk: Callable[[], Iterator[Path]] = partial(iter, (whole,))
    else:
        walk = partial(course.walk, start, mode, np.array(initial, dtype=np.float64), changes)
    return Trajectory(model, motion.dt, status, changes, found, extrema, ended, cursor.state, final_mode, walk)


def cursor_at(start: Instant, mode: int, state: FloatArray) -> Cursor:
    """Return the cursor of a trajectory that is about to begin; the state is moved in place."""
    # sample, mode, events, events at one instant, still, not started, steps, first sample given, samples beyond, events taken
    return Cursor(np.array([start.sample, mode, 0, 0, 1, 0, 0, 0, 0, 0]), np.array([start.tau, np.nan, 0.0]), state)


@dataclass(frozen=True, eq=False)
class _Course:
    """What determines a trajectory but where it begins."""

    model: Model
    motion: Motion
    p: FloatArray
    gains: FloatArray

    def stretches(self, first: int) -> Iterator[Stretch]:
        """Return the stretches of the motion from a sample on."""
        return self.motion.stretches((self.gains != 0.0).tolist(), first)

    def follow_on(self, stretch: Stretch, cursor: Cursor, kept: Kept, parts: list[Changes]) -> int:
        """Follow a trajectory on through a stretch, in slices between which Python may be interrupted; return the status.

        Events are taken out of their tables when these are half full; the rest of them stays there.
        """
        ground = Ground(stretch.acceleration, self.gains, self.motion.dt)
        cursor.place[BASE], cursor.place[BEYOND] = stretch.first, stretch.beyond
        last = stretch.first + stretch.acceleration.shape[1] - 1
        status = PAUSED
        while status == PAUSED and (cursor.place[SAMPLE] < last or not stretch.beyond):
            heed()
            cursor.place[STEPS_LEFT] = SLICE
            status = hybrid.integrate(*self.model.pointers, ground, self.model.shape, self.p, cursor, kept)
            if status == PAUSED and 2 * (cursor.place[FOUND] - cursor.place[LOGGED]) > kept.times.size > 0:
                if cursor.place[FOUND] > max(_MANY, _MANY_PER_SAMPLE * self.motion.samples):
                    return TOO_MANY_EVENTS
                check_changes(int(cursor.place[FOUND]), bytes_each(cursor.state.size))
                parts.append(_logged(kept, cursor, self.motion.dt))
                cursor.place[LOGGED] = cursor.place[FOUND]
            tell_samples(int(cursor.place[SAMPLE]), self.motion.samples - 1)
        return int(status)

    def walk(self, start: Instant, mode: int, initial: FloatArray, changes: Changes) -> Iterator[Path]:
        """Yield the path that leads through some changes, piece by piece, as it is followed again."""
        cursor, first, passed = cursor_at(start, mode, initial.copy()), _first_kept(start), 0
        extrema = np.zeros((self.model.tracked, 4))
        for stretch in self.stretches(start.sample):
            size = stretch.acceleration.shape[1]
            path, modes = np.empty((size, initial.size)), np.empty(size, dtype=np.int64)
            status = self.follow_on(stretch, cursor, Kept(path, modes, *room_for(0, initial.size), extrema, _NO_TALLY, _NO_STAYS), [])
            reached = int(cursor.place[SAMPLE])
            rows = slice(first - stretch.first, reached + 1 - stretch.first)
            ahead = int(np.searchsorted(changes.sample, reached)) if status == PAUSED else len(changes)
            yield Path(self.motion.dt, first, path[rows], modes[rows], changes[passed:ahead])
            first, passed = reached + 1, ahead
            if status != PAUSED:
                return


def _first_kept(start: Instant) -> int:
    """Return the first sample at which a trajectory has a state."""
    return start.sample if start.tau == 0.0 else start.sample + 1


def _no_path(n_states: int) -> tuple[FloatArray, IntArray]:
    """Return room for no path."""
    return np.empty((0, n_states)), np.empty(0, dtype=np.int64)


def _none(n_states: int) -> Changes:
    """Return no events."""
    log, tau, limits = room_for(0, n_states)
    return Changes(log, tau, tau, limits)


def _logged(kept: Kept, cursor: Cursor, dt: float) -> Changes:
    """Return the events in the loop's tables, whose room may then be used again."""
    count = int(cursor.place[FOUND] - cursor.place[LOGGED])
    log, tau = kept.events[:count].copy(), kept.times[:count].copy()
    return Changes(log, tau, log[:, EVENT_SAMPLE] * dt + tau, kept.limits[:count].copy())


def _held(rows: Rows, reached: slice) -> Rows:
    """Return the rows that were reached, without the room for the others where these are the most of it."""
    found = rows[reached]
    return found if 2 * len(found) > len(rows) else found.copy()

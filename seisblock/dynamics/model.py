"""A model is three tables of names and two functions; following it gives a trajectory."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from seisblock._jit import pointer
from seisblock.dynamics import hybrid
from seisblock.dynamics.arguments import (
    EVENT_FROM,
    EVENT_GUARD,
    EVENT_SAMPLE,
    EVENT_TO,
    FOUND,
    MODE,
    SAMPLE,
    STEPS_LEFT,
    TAU,
    Cursor,
    Ground,
    Kept,
    Shape,
)
from seisblock.dynamics.halt import heed
from seisblock.dynamics.status import FAILURES, PAUSED, TOO_MANY_EVENTS
from seisblock.errors import SolverError
from seisblock.records.motion import Motion
from seisblock.typing import ArrayLike, FloatArray, IntArray
from seisblock.words import said

ORDER = 12
"""Terms of the power series; at 100 Hz the thirteenth is below round-off."""

SLICE = 1 << 16
"""Steps that compiled code takes before Python may be interrupted: 10 to 150 ms, and no more than 1e-3 of that to come back."""

_FIRST_CAPACITY = 256
_LAST_CAPACITY = 1 << 18

_NO_TALLY, _NO_STAYS = np.empty((0, 0), dtype=np.int64), np.empty((0, 2))


@dataclass(frozen=True)
class Model:
    """What the engine needs to know of a model.

    Parameters
    ----------
    name : str
    series, reset : compiled functions
        Signatures ``SERIES`` and ``RESET`` of :mod:`seisblock.dynamics.hybrid`.
    states, guards, modes : tuple of str
        Names, in the order of the model's named integers. Negative modes end the integration and are named from the end:
        mode -1 is ``modes[-1]``.
    scratch : int
        Rows that ``series`` needs beside the states.
    tracked : int
        How many of the first states have their exact extrema kept.
    order : int
        Terms of a series that does not end by itself.
    skip : compiled function
        Signature ``SKIP``: the short cut through samples at which nothing happens.
    floored : bool
        Whether the parameters end in one size per state below which it counts as that large, for the step's length.
    sharp : int
        How many of the first guards are states set to exact values: however small they start, they are not taken for zero.
    """

    name: str
    series: Callable[..., Any]
    reset: Callable[..., Any]
    states: tuple[str, ...]
    guards: tuple[str, ...]
    modes: tuple[str, ...]
    scratch: int = 0
    tracked: int = 1
    order: int = ORDER
    skip: Callable[..., Any] = hybrid.stay
    floored: bool = False
    sharp: int = 0

    @cached_property
    def pointers(self) -> tuple[Any, Any, Any]:
        """Series, reset and skip, as compiled loops take them."""
        return pointer(self.series, hybrid.SERIES), pointer(self.reset, hybrid.RESET), pointer(self.skip, hybrid.SKIP)

    @cached_property
    def shape(self) -> Shape:
        """Sizes that the engine needs."""
        return Shape(self.scratch, len(self.guards), self.tracked, self.order, int(self.floored), self.sharp)


@dataclass(frozen=True)
class Instant:
    """A time of a sampled motion, exact to the sample: `tau` seconds after sample number `sample`."""

    sample: int = 0
    tau: float = 0.0


@dataclass(frozen=True, eq=False)
class Change:
    """An event as the engine logs it; times in s after sample 0 of the motion."""

    at: Instant
    time: float
    guard: int
    source: int
    target: int
    before: FloatArray
    after: FloatArray


@dataclass(frozen=True, eq=False)
class Trajectory:
    """What the engine found.

    Parameters
    ----------
    model, dt, status : Model, float, int
    first : int
        Sample from which `states` and `modes` are meaningful.
    states, modes : (n, n_states), (n,) arrays
        State and mode at each sample reached; empty when they were not asked for.
    changes : tuple of Change
    n_changes : int
        How many there were, kept or not.
    extrema : (n_tracked, 4) array
        Highest value, its time, lowest value, its time; s after sample 0.
    end : Instant
    final, final_mode : (n_states,) array, int
    """

    model: Model
    dt: float
    status: int
    first: int
    states: FloatArray
    modes: IntArray
    changes: tuple[Change, ...]
    n_changes: int
    extrema: FloatArray
    end: Instant
    final: FloatArray
    final_mode: int

    @property
    def end_time(self) -> float:
        """Time at which the integration ended, s after sample 0."""
        return self.end.sample * self.dt + self.end.tau

    def table(self) -> tuple[FloatArray, FloatArray, IntArray]:
        """Return times, states and modes at the samples and at both limits of every event, in order.

        Returns
        -------
        time : (m,) array, s after sample 0
        states : (m, n_states) array
        modes : (m,) array
        """
        last = self.end.sample + 1
        time = self.dt * np.arange(self.first, last, dtype=np.float64)
        states = self.states[self.first : last]
        modes = self.modes[self.first : last]
        if not self.changes:
            return time, states, modes
        at = np.array([change.at.sample for change in self.changes]) + 1 - self.first
        where = np.clip(np.repeat(at, 2), 0, time.size)
        both = np.array([limit for change in self.changes for limit in (change.before, change.after)])
        kinds = np.array([mode for change in self.changes for mode in (change.source, change.target)])
        times = np.repeat([change.time for change in self.changes], 2)
        return np.insert(time, where, times), np.insert(states, where, both, axis=0), np.insert(modes, where, kinds)

    def sampled(self, values: FloatArray) -> FloatArray:
        """Return a sampled input, straight between samples, at the times of :meth:`table`, (m,)."""
        part = values[self.first : self.end.sample + 1]
        if not self.changes:
            return part
        at = np.array([change.at.sample for change in self.changes])
        share = np.array([change.at.tau for change in self.changes]) / self.dt
        there = values[at] + share * (values[np.minimum(at + 1, values.size - 1)] - values[at])
        return np.insert(part, np.clip(np.repeat(at + 1 - self.first, 2), 0, part.size), np.repeat(there, 2))


def follow(
    model: Model,
    motion: Motion,
    parameters: ArrayLike,
    initial: ArrayLike,
    mode: int,
    *,
    gains: Sequence[float] = (1.0, 0.0, 0.0),
    start: Instant = Instant(),
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
        Whether states at samples, and events, are kept (ensembles need neither).

    Returns
    -------
    Trajectory

    Raises
    ------
    SolverError
        If the integration had to be given up.
    """
    p = np.array(parameters, dtype=np.float64)
    ground = Ground(motion.acceleration, np.array(gains, dtype=np.float64), motion.dt)
    n_states = len(model.states)
    rows = motion.samples if keep_path else 0
    path, modes = np.empty((rows, n_states)), np.empty(rows, dtype=np.int64)
    extrema = np.zeros((model.tracked, 4))
    capacity = _FIRST_CAPACITY if keep_events else 0
    while True:
        cursor = cursor_at(start, mode, np.array(initial, dtype=np.float64))
        events, times, limits = np.empty((capacity, 4), dtype=np.int64), np.empty(capacity), np.empty((capacity, 2, n_states))
        status = follow_on(model, ground, p, cursor, Kept(path, modes, events, times, limits, extrema, _NO_TALLY, _NO_STAYS))
        if not (status == TOO_MANY_EVENTS and cursor.place[FOUND] == capacity < _LAST_CAPACITY):
            break
        capacity *= 8
    found, final_mode = int(cursor.place[FOUND]), int(cursor.place[MODE])
    ended = Instant(int(cursor.place[SAMPLE]), float(cursor.clock[TAU]))
    if status in FAILURES:
        at = motion.start_s + ended.sample * motion.dt + ended.tau
        raise SolverError("{name}: given up at {at:.6f} s, where {failure}", name=model.name, at=at, failure=said(FAILURES[status]))
    changes = _changes(events[:found], times[:found], limits[:found], motion.dt) if keep_events else ()
    first = start.sample if start.tau == 0.0 else start.sample + 1
    return Trajectory(model, motion.dt, status, first, path, modes, changes, found, extrema, ended, cursor.state, final_mode)


def cursor_at(start: Instant, mode: int, state: FloatArray) -> Cursor:
    """Return the cursor of a trajectory that is about to begin; the state is moved in place."""
    # sample, mode, events, events at one instant, still, not started, steps
    return Cursor(np.array([start.sample, mode, 0, 0, 1, 0, 0]), np.array([start.tau, np.nan, 0.0]), state)


def follow_on(model: Model, ground: Ground, p: FloatArray, cursor: Cursor, kept: Kept) -> int:
    """Follow a trajectory on to its end, in slices between which Python may be interrupted; return the status."""
    status = PAUSED
    while status == PAUSED:
        heed()
        cursor.place[STEPS_LEFT] = SLICE
        status = hybrid.integrate(*model.pointers, ground, model.shape, p, cursor, kept)
    return int(status)


def _changes(events: IntArray, times: FloatArray, limits: FloatArray, dt: float) -> tuple[Change, ...]:
    """Return the events from the loop's tables."""
    rows = zip(events.tolist(), times.tolist(), limits.copy(), strict=True)
    return tuple(
        Change(
            Instant(row[EVENT_SAMPLE], tau),
            row[EVENT_SAMPLE] * dt + tau,
            row[EVENT_GUARD],
            row[EVENT_FROM],
            row[EVENT_TO],
            before,
            after,
        )
        for row, tau, (before, after) in rows
    )

"""A model is three tables of names and two functions; following it gives a trajectory."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from seisblock.dynamics import hybrid
from seisblock.errors import SolverError
from seisblock.records.motion import Motion
from seisblock.typing import ArrayLike, FloatArray, IntArray

ORDER = 12
"""Terms of the power series; at 100 Hz the thirteenth is below round-off."""

_FIRST_CAPACITY = 256
_LAST_CAPACITY = 1 << 18

FAILURES = {
    hybrid.TOO_MANY_EVENTS: "it changes its mode without end",
    hybrid.CHATTERING: "two modes return to each other at one instant",
    hybrid.NOT_FINITE: "its state overflows",
    hybrid.STEP_TOO_SMALL: "its power series does not converge on any step",
}
"""Statuses that are no answer, in words."""


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
    scale = np.array(gains, dtype=np.float64)
    n_states = len(model.states)
    sizes = np.array([model.scratch, len(model.guards), model.tracked, model.order, model.floored], dtype=np.int64)
    rows = motion.samples if keep_path else 0
    path = np.empty((rows, n_states))
    modes = np.empty(rows, dtype=np.int64)
    extrema = np.zeros((max(model.tracked, 1), 4))
    info = np.zeros(3, dtype=np.int64)
    end = np.zeros(2)
    capacity = _FIRST_CAPACITY if keep_events else 0
    while True:
        y = np.array(initial, dtype=np.float64)
        table = np.empty((capacity, 4), dtype=np.int64)
        times = np.empty(capacity)
        limits = np.empty((capacity, 2, n_states))
        status = int(
            hybrid.integrate(
                model.series,
                model.reset,
                model.skip,
                motion.acceleration,
                scale,
                motion.dt,
                start.sample,
                start.tau,
                mode,
                y,
                p,
                sizes,
                path,
                modes,
                table,
                times,
                limits,
                extrema,
                hybrid.NO_TALLY,
                info,
                end,
            )
        )
        if status != hybrid.TOO_MANY_EVENTS or capacity >= _LAST_CAPACITY:
            break
        capacity *= 8
    found, last, final_mode = (int(value) for value in info)
    ended = Instant(last, float(end[hybrid.LAST_TAU]))
    if status in FAILURES:
        raise SolverError(f"{model.name}: given up at {motion.start_s + last * motion.dt + ended.tau:.6f} s, where {FAILURES[status]}")
    changes = (
        tuple(
            Change(
                Instant(int(row[hybrid.EVENT_SAMPLE]), float(tau)),
                float(row[hybrid.EVENT_SAMPLE] * motion.dt + tau),
                int(row[hybrid.EVENT_GUARD]),
                int(row[hybrid.EVENT_FROM]),
                int(row[hybrid.EVENT_TO]),
                both[0].copy(),
                both[1].copy(),
            )
            for row, tau, both in zip(table[:found], times[:found], limits[:found], strict=True)
        )
        if keep_events
        else ()
    )
    first = start.sample if start.tau == 0.0 else start.sample + 1
    return Trajectory(model, motion.dt, status, first, path, modes, changes, found, extrema[: model.tracked], ended, y, final_mode)

"""What the engine found: the end, the changes on the way, and the path, which a long trajectory follows again when it is asked for."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from seisblock.core.limits import check_curve_memory
from seisblock.core.typing import FloatArray, IntArray
from seisblock.dynamics.events import EventLog, Instant, concatenate_events

EXTRA_CURVES = 6
"""Curves that are no states: time, mode, ground motion, and what else is drawn."""

if TYPE_CHECKING:
    from seisblock.dynamics.model import Model


@dataclass(frozen=True, eq=False)
class Path:
    """Where a trajectory is at samples that follow each other, and what happens before each of them.

    Parameters
    ----------
    dt : float, s
    first : int
        Number of the first sample.
    states, modes : (n, n_states), (n,) arrays
        State and mode at each sample.
    events : Changes
        Since the sample before the first; and those after the last one where the trajectory ends there.
    """

    dt: float
    first: int
    states: FloatArray
    modes: IntArray
    events: EventLog

    def table(self, samples: IntArray | None = None) -> tuple[FloatArray, FloatArray, IntArray]:
        """Return times, states and modes at the samples and at both limits of every event, in order.

        Parameters
        ----------
        samples : (k,) array of int or None
            Which samples of the path are wanted, in rising order; all when left out.

        Returns
        -------
        time : (m,) array, s after sample 0
        states : (m, n_states) array
        modes : (m,) array
        """
        time, modes = self.times_and_modes(samples)
        states = self.states if samples is None else self.states[samples]
        if not self.events:
            return time, states, modes
        return time, _insert_rows(states, self._insert_positions(samples), self.events.limits.reshape(-1, states.shape[1])), modes

    def times_and_modes(self, samples: IntArray | None = None) -> tuple[FloatArray, IntArray]:
        """Return the times and modes of :meth:`table` alone, (m,) each."""
        time = self.dt * np.arange(self.first, self.first + self.modes.size, dtype=np.float64)
        modes = self.modes
        if samples is not None:
            time, modes = time[samples], modes[samples]
        if not self.events:
            return time, modes
        event_modes, positions = np.stack([self.events.source, self.events.target], axis=1).ravel(), self._insert_positions(samples)
        return np.insert(time, positions, np.repeat(self.events.time, 2)), np.insert(modes, positions, event_modes)

    def row_indices(self, samples: IntArray) -> IntArray:
        """Return which rows of the whole table those of :meth:`table` at some samples are, (m,)."""
        if not self.events:
            return samples
        positions = self._event_positions
        at_samples = samples + np.searchsorted(positions, samples, side="right")
        return np.insert(at_samples, self._insert_positions(samples), positions + np.arange(positions.size))

    def values(self, state: int) -> FloatArray:
        """Return one state at the times of :meth:`table`, (m,)."""
        at_samples: FloatArray = self.states[:, state]
        if not self.events:
            return at_samples
        return np.insert(at_samples, self._insert_positions(), self.events.limits[:, :, state].ravel())

    def interpolate(self, values: FloatArray, samples: IntArray | None = None) -> FloatArray:
        """Return a sampled input, straight between samples, at the times of :meth:`table`, (m,)."""
        part = values[self.first : self.first + self.modes.size]
        if samples is not None:
            part = part[samples]
        if not self.events:
            return part
        indices, fraction = self.events.sample, self.events.tau / self.dt
        at_events = values[indices] + fraction * (values[np.minimum(indices + 1, values.size - 1)] - values[indices])
        return np.insert(part, self._insert_positions(samples), np.repeat(at_events, 2))

    @cached_property
    def _event_positions(self) -> IntArray:
        """Return before which sample of the path each limit of each event stands."""
        samples = self.events.sample + 1 - self.first
        return np.clip(np.repeat(samples, 2), 0, self.modes.size)

    def _insert_positions(self, samples: IntArray | None = None) -> IntArray:
        """Return before which of the samples chosen each limit of each event stands."""
        positions = self._event_positions
        return positions if samples is None else np.searchsorted(samples, positions)


def _insert_rows(rows: FloatArray, positions: IntArray, inserts: FloatArray) -> FloatArray:
    """Return rows with others in rising order among them; numpy's insert does so six times slower, a row at a time."""
    result = np.empty((len(rows) + len(inserts), rows.shape[1]))
    insert_rows = positions + np.arange(len(inserts))
    is_original = np.ones(len(result), dtype=bool)
    is_original[insert_rows] = False
    result[insert_rows] = inserts
    for column, values in zip(result.T, rows.T, strict=True):
        column[is_original] = values
    return result


def concatenate_paths(paths: Iterable[Path]) -> Path:
    """Return one path from some that follow each other."""
    pieces = list(paths)
    if len(pieces) == 1:
        return pieces[0]
    states = np.concatenate([part.states for part in pieces])
    modes = np.concatenate([part.modes for part in pieces])
    return Path(pieces[0].dt, pieces[0].first, states, modes, concatenate_events([part.events for part in pieces]))


@dataclass(frozen=True, eq=False)
class Trajectory:
    """What the engine found.

    Parameters
    ----------
    model, dt, status : Model, float, int
    events : Changes
    n_events : int
        How many there were, kept or not.
    extrema : (n_tracked, 4) array
        Highest value, its time, lowest value, its time; s after sample 0.
    end : Instant
    final, final_mode : (n_states,) array, int
    iter_paths : callable
        Yields the path piece by piece: all of it where it was kept, else as it is followed again, to the same bits.
    """

    model: Model
    dt: float
    status: int
    events: EventLog
    n_events: int
    extrema: FloatArray
    end: Instant
    final: FloatArray
    final_mode: int
    iter_paths: Callable[[], Iterator[Path]]

    @cached_property
    def path(self) -> Path:
        """All of the path.

        Raises
        ------
        ParameterError
            If it, and the curves made of it, would take more memory than they may.
        """
        check_curve_memory(self.end.sample, 2 * self.final.size + EXTRA_CURVES)
        return concatenate_paths(self.iter_paths())

    @property
    def states(self) -> FloatArray:
        """States at the samples reached, (n, n_states), from the first one on."""
        return self.path.states

    @property
    def modes(self) -> IntArray:
        """Modes at the samples reached, (n,)."""
        return self.path.modes

    @property
    def end_time(self) -> float:
        """Time at which the integration ended, s after sample 0."""
        return self.end.sample * self.dt + self.end.tau

    def table(self) -> tuple[FloatArray, FloatArray, IntArray]:
        """Return times, states and modes of all of the path, see :meth:`Path.table`."""
        return self.path.table()

    def interpolate(self, values: FloatArray) -> FloatArray:
        """Return a sampled input at the times of :meth:`table`, (m,)."""
        return self.path.interpolate(values)

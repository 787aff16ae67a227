"""Result of an integration: final state, events, extrema, and the path, which is recomputed on access for long motions."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from seisblock.core.i18n import N_
from seisblock.core.limits import check_memory
from seisblock.core.typing import FloatArray, IntArray
from seisblock.dynamics.events import EventLog, Instant, concatenate_events

EXTRA_CURVES = 6
"""Number of time histories beside the states (time, mode, ground motion and derived channels), for the memory limit."""

if TYPE_CHECKING:
    from seisblock.dynamics.model import Model


@dataclass(frozen=True, eq=False)
class Path:
    """States and modes at consecutive samples, and the events between them.

    Parameters
    ----------
    dt : float, s
    first : int
        Number of the first sample.
    states, modes : (n, n_states), (n,) arrays
        State and mode at each sample.
    events : EventLog
        Events after the sample before the first one; also those after the last sample if the trajectory ends there.
    """

    dt: float
    first: int
    states: FloatArray
    modes: IntArray
    events: EventLog

    def table(self, samples: IntArray | None = None) -> tuple[FloatArray, FloatArray, IntArray]:
        """Return times, states and modes at the samples and on both sides of every event, in order.

        Parameters
        ----------
        samples : (k,) array of int or None
            Indices of samples of the path, ascending; None for all.

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
        """Return times and modes of :meth:`table` without the states, (m,) each."""
        time = self.dt * np.arange(self.first, self.first + self.modes.size, dtype=np.float64)
        modes = self.modes
        if samples is not None:
            time, modes = time[samples], modes[samples]
        if not self.events:
            return time, modes
        # two rows per event: the state before and after it, at the same time
        event_modes, positions = np.stack([self.events.source, self.events.target], axis=1).ravel(), self._insert_positions(samples)
        return np.insert(time, positions, np.repeat(self.events.time, 2)), np.insert(modes, positions, event_modes)

    def values(self, state: int) -> FloatArray:
        """Return one state at the times of :meth:`table`, (m,)."""
        at_samples: FloatArray = self.states[:, state]
        if not self.events:
            return at_samples
        return np.insert(at_samples, self._insert_positions(), self.events.limits[:, :, state].ravel())

    def interpolate(self, values: FloatArray, samples: IntArray | None = None) -> FloatArray:
        """Return a sampled input, interpolated linearly, at the times of :meth:`table`, (m,)."""
        part = values[self.first : self.first + self.modes.size]
        if samples is not None:
            part = part[samples]
        if not self.events:
            return part
        # the input is continuous: both sides of an event have the same value
        indices, fraction = self.events.sample, self.events.tau / self.dt
        at_events = values[indices] + fraction * (values[np.minimum(indices + 1, values.size - 1)] - values[indices])
        return np.insert(part, self._insert_positions(samples), np.repeat(at_events, 2))

    @cached_property
    def _event_positions(self) -> IntArray:
        """Index of the sample of the path before which each side of each event is inserted, (2 k,)."""
        # an event after sample k stands before sample k + 1
        samples = self.events.sample + 1 - self.first
        return np.clip(np.repeat(samples, 2), 0, self.modes.size)

    def _insert_positions(self, samples: IntArray | None = None) -> IntArray:
        """Return the same indices relative to a selection of samples."""
        positions = self._event_positions
        return positions if samples is None else np.searchsorted(samples, positions)


def _insert_rows(rows: FloatArray, positions: IntArray, inserts: FloatArray) -> FloatArray:
    """Return rows with others inserted at ascending positions; six times faster than ``numpy.insert``."""
    result = np.empty((len(rows) + len(inserts), rows.shape[1]))
    insert_rows = positions + np.arange(len(inserts))
    is_original = np.ones(len(result), dtype=bool)
    is_original[insert_rows] = False
    result[insert_rows] = inserts
    for column, values in zip(result.T, rows.T, strict=True):
        column[is_original] = values
    return result


def concatenate_paths(paths: Iterable[Path]) -> Path:
    """Return the concatenation of consecutive paths."""
    pieces = list(paths)
    if len(pieces) == 1:
        return pieces[0]
    states = np.concatenate([part.states for part in pieces])
    modes = np.concatenate([part.modes for part in pieces])
    return Path(pieces[0].dt, pieces[0].first, states, modes, concatenate_events([part.events for part in pieces]))


@dataclass(frozen=True, eq=False)
class Trajectory:
    """Result of an integration.

    Parameters
    ----------
    model, dt, status : Model, float, int
    events : EventLog
    n_events : int
        Number of events, stored or not.
    extrema : (n_tracked, 4) array
        Maximum, its time, minimum, its time; times in s after sample 0.
    end : Instant
    final, final_mode : (n_states,) array, int
    iter_paths : callable
        Function that yields the path piece by piece: stored, or recomputed to the same bits.
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
        """Whole path.

        Raises
        ------
        ParameterError
            If the path and the time histories derived from it exceed the memory limit.
        """
        check_memory(N_("samples of time histories"), self.end.sample, 8 * (2 * self.final.size + EXTRA_CURVES))
        return concatenate_paths(self.iter_paths())

    @property
    def states(self) -> FloatArray:
        """States at the samples, (n, n_states)."""
        return self.path.states

    @property
    def modes(self) -> IntArray:
        """Modes at the samples, (n,)."""
        return self.path.modes

    @property
    def end_time(self) -> float:
        """End time of the integration, s after sample 0."""
        return self.end.sample * self.dt + self.end.tau

    def table(self) -> tuple[FloatArray, FloatArray, IntArray]:
        """Return times, states and modes of the whole path, see :meth:`Path.table`."""
        return self.path.table()

    def interpolate(self, values: FloatArray) -> FloatArray:
        """Return a sampled input at the times of :meth:`table`, (m,)."""
        return self.path.interpolate(values)

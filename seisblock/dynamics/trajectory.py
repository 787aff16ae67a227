"""What the engine found: the end, the changes on the way, and the path, which a long trajectory follows again when it is asked for."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from seisblock.dynamics.changes import Changes, Instant, joined_changes
from seisblock.limits import check_curves
from seisblock.typing import FloatArray, IntArray

OTHERS = 6
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
    changes : Changes
        Since the sample before the first; and those after the last one where the trajectory ends there.
    """

    dt: float
    first: int
    states: FloatArray
    modes: IntArray
    changes: Changes

    def table(self, chosen: IntArray | None = None) -> tuple[FloatArray, FloatArray, IntArray]:
        """Return times, states and modes at the samples and at both limits of every event, in order.

        Parameters
        ----------
        chosen : (k,) array of int or None
            Which samples of the path are wanted, in rising order; all when left out.

        Returns
        -------
        time : (m,) array, s after sample 0
        states : (m, n_states) array
        modes : (m,) array
        """
        time, modes = self.course(chosen)
        states = self.states if chosen is None else self.states[chosen]
        if not self.changes:
            return time, states, modes
        return time, _inserted(states, self._before(chosen), self.changes.limits.reshape(-1, states.shape[1])), modes

    def course(self, chosen: IntArray | None = None) -> tuple[FloatArray, IntArray]:
        """Return the times and modes of :meth:`table` alone, (m,) each."""
        time = self.dt * np.arange(self.first, self.first + self.modes.size, dtype=np.float64)
        modes = self.modes
        if chosen is not None:
            time, modes = time[chosen], modes[chosen]
        if not self.changes:
            return time, modes
        kinds, before = np.stack([self.changes.source, self.changes.target], axis=1).ravel(), self._before(chosen)
        return np.insert(time, before, np.repeat(self.changes.time, 2)), np.insert(modes, before, kinds)

    def numbers(self, chosen: IntArray) -> IntArray:
        """Return which rows of the whole table those of :meth:`table` at some samples are, (m,)."""
        if not self.changes:
            return chosen
        before = self._places
        at_samples = chosen + np.searchsorted(before, chosen, side="right")
        return np.insert(at_samples, self._before(chosen), before + np.arange(before.size))

    def values(self, state: int) -> FloatArray:
        """Return one state at the times of :meth:`table`, (m,)."""
        at_samples: FloatArray = self.states[:, state]
        if not self.changes:
            return at_samples
        return np.insert(at_samples, self._before(), self.changes.limits[:, :, state].ravel())

    def sampled(self, values: FloatArray, chosen: IntArray | None = None) -> FloatArray:
        """Return a sampled input, straight between samples, at the times of :meth:`table`, (m,)."""
        part = values[self.first : self.first + self.modes.size]
        if chosen is not None:
            part = part[chosen]
        if not self.changes:
            return part
        at, share = self.changes.sample, self.changes.tau / self.dt
        there = values[at] + share * (values[np.minimum(at + 1, values.size - 1)] - values[at])
        return np.insert(part, self._before(chosen), np.repeat(there, 2))

    @cached_property
    def _places(self) -> IntArray:
        """Return before which sample of the path each limit of each event stands."""
        at = self.changes.sample + 1 - self.first
        return np.clip(np.repeat(at, 2), 0, self.modes.size)

    def _before(self, chosen: IntArray | None = None) -> IntArray:
        """Return before which of the samples chosen each limit of each event stands."""
        before = self._places
        return before if chosen is None else np.searchsorted(chosen, before)


def _inserted(rows: FloatArray, before: IntArray, others: FloatArray) -> FloatArray:
    """Return rows with others in rising order among them; numpy's insert does so six times slower, a row at a time."""
    found = np.empty((len(rows) + len(others), rows.shape[1]))
    at = before + np.arange(len(others))
    kept = np.ones(len(found), dtype=bool)
    kept[at] = False
    found[at] = others
    for column, values in zip(found.T, rows.T, strict=True):
        column[kept] = values
    return found


def joined(paths: Iterable[Path]) -> Path:
    """Return one path from some that follow each other."""
    parts = list(paths)
    if len(parts) == 1:
        return parts[0]
    states = np.concatenate([part.states for part in parts])
    modes = np.concatenate([part.modes for part in parts])
    return Path(parts[0].dt, parts[0].first, states, modes, joined_changes([part.changes for part in parts]))


@dataclass(frozen=True, eq=False)
class Trajectory:
    """What the engine found.

    Parameters
    ----------
    model, dt, status : Model, float, int
    changes : Changes
    n_changes : int
        How many there were, kept or not.
    extrema : (n_tracked, 4) array
        Highest value, its time, lowest value, its time; s after sample 0.
    end : Instant
    final, final_mode : (n_states,) array, int
    walk : callable
        Yields the path piece by piece: all of it where it was kept, else as it is followed again, to the same bits.
    """

    model: Model
    dt: float
    status: int
    changes: Changes
    n_changes: int
    extrema: FloatArray
    end: Instant
    final: FloatArray
    final_mode: int
    walk: Callable[[], Iterator[Path]]

    @cached_property
    def path(self) -> Path:
        """All of the path.

        Raises
        ------
        ParameterError
            If it, and the curves made of it, would take more memory than they may.
        """
        check_curves(self.end.sample, 2 * self.final.size + OTHERS)
        return joined(self.walk())

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

    def sampled(self, values: FloatArray) -> FloatArray:
        """Return a sampled input at the times of :meth:`table`, (m,)."""
        return self.path.sampled(values)

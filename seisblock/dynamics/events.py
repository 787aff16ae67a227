"""Events of a trajectory, stored in columns and returned as objects on access.

Under strong noise a sliding body changes its mode in every second sample; columns need a few bytes per event, objects hundreds.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple, overload

import numpy as np

from seisblock.core.typing import FloatArray, IntArray

CHUNK_SIZE = 2**12
"""Number of events built at a time during iteration."""


EVENT_SAMPLE, EVENT_GUARD, EVENT_FROM, EVENT_TO = range(4)
"""Columns of the event log."""


class Instant(NamedTuple):
    """Instant of a sampled motion: `tau` seconds after sample number `sample`, so that precision does not decrease with time."""

    sample: int = 0
    tau: float = 0.0


BEGINNING = Instant()
"""The first sample."""


class Instants(NamedTuple):
    """Instants of many trajectories: `tau` seconds after sample number `sample`, (m,) arrays."""

    sample: IntArray
    tau: FloatArray


class GuardEvent(NamedTuple):
    """Event logged by the engine; times in s after sample 0 of the motion."""

    at: Instant
    time: float
    guard: int
    source: int
    target: int
    before: FloatArray
    after: FloatArray


@dataclass(frozen=True, eq=False)
class EventLog(Sequence[GuardEvent]):
    """Events in chronological order; items are built on access.

    Parameters
    ----------
    log : (n, 4) array of int
        Sample, guard, mode before and after (``EVENT_SAMPLE`` to ``EVENT_TO``), as written by the loop.
    tau, time : (n,) arrays, s
        Time after that sample, and after sample 0 of the motion.
    limits : (n, 2, n_states) array
        State before and after the event.
    """

    log: IntArray
    tau: FloatArray
    time: FloatArray
    limits: FloatArray

    @property
    def sample(self) -> IntArray:
        """Sample before each event, (n,)."""
        return self.log[:, EVENT_SAMPLE]

    @property
    def guard(self) -> IntArray:
        """Guard that fired, (n,)."""
        return self.log[:, EVENT_GUARD]

    @property
    def source(self) -> IntArray:
        """Mode before each event, (n,)."""
        return self.log[:, EVENT_FROM]

    @property
    def target(self) -> IntArray:
        """Mode after each event, (n,)."""
        return self.log[:, EVENT_TO]

    @property
    def before(self) -> FloatArray:
        """State before each event, (n, n_states)."""
        return self.limits[:, 0]

    @property
    def after(self) -> FloatArray:
        """State after each event, (n, n_states)."""
        return self.limits[:, 1]

    def __len__(self) -> int:
        return self.time.size

    @overload
    def __getitem__(self, index: int) -> GuardEvent: ...
    @overload
    def __getitem__(self, index: slice) -> EventLog: ...
    def __getitem__(self, index: int | slice) -> GuardEvent | EventLog:
        if isinstance(index, slice):
            return EventLog(self.log[index], self.tau[index], self.time[index], self.limits[index])
        sample, guard, source, target = self.log[index].tolist()
        at = Instant(sample, float(self.tau[index]))
        return GuardEvent(at, float(self.time[index]), guard, source, target, self.limits[index, 0], self.limits[index, 1])

    def __iter__(self) -> Iterator[GuardEvent]:
        for begin in range(0, len(self), CHUNK_SIZE):
            part = slice(begin, begin + CHUNK_SIZE)
            # lists of a chunk: much faster than single items of arrays
            sample, guard, source, target = (column.tolist() for column in self.log[part].T)
            instants = map(Instant._make, zip(sample, self.tau[part].tolist(), strict=True))
            limits = self.limits[part]
            columns = instants, self.time[part].tolist(), guard, source, target, limits[:, 0], limits[:, 1]
            yield from map(GuardEvent._make, zip(*columns, strict=True))

    def __add__(self, other: EventLog) -> EventLog:
        """Return the concatenation with a later log."""
        return concatenate_events([self, other]) if len(other) else self

    def shift_time(self, samples: int, seconds: float) -> EventLog:
        """Return the log with `samples` added to the sample numbers and `seconds` to the times."""
        log = self.log.copy()
        log[:, EVENT_SAMPLE] += samples
        return replace(self, log=log, time=self.time + seconds)


def bytes_per_event(n_states: int) -> int:
    """Return the memory of one event of a model with `n_states` states, bytes."""
    return 8 * (4 + 1 + 1 + 2 * n_states)


def allocate_events(count: int, n_states: int) -> tuple[IntArray, FloatArray, FloatArray]:
    """Return empty output tables for `count` events: log, times, limits."""
    return np.empty((count, 4), dtype=np.int64), np.empty(count), np.empty((count, 2, n_states))


def concatenate_events(logs: Sequence[EventLog]) -> EventLog:
    """Return the concatenation of consecutive logs; a list is emptied on the way, so that memory is not needed twice."""
    if len(logs) == 1:
        return logs[0]
    remaining = logs if isinstance(logs, list) else list(logs)
    count, n_states = sum(map(len, remaining)), remaining[0].limits.shape[2]
    log, tau, limits = allocate_events(count, n_states)
    result = EventLog(log, tau, np.empty(count), limits)
    # parts are popped from the end and released one by one after copying
    remaining.reverse()
    begin = 0
    while remaining:
        part = remaining.pop()
        rows = slice(begin, begin + len(part))
        result.log[rows], result.tau[rows], result.time[rows], result.limits[rows] = part.log, part.tau, part.time, part.limits
        begin = rows.stop
    return result

"""The events of a trajectory: a column for each thing that is known of them, and a value for whoever looks at one.

Strong noise changes the mode of a sliding object in every second sample; a column holds an event in a few bytes where an object takes
hundreds.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple, overload

import numpy as np

from seisblock.core.typing import FloatArray, IntArray

CHUNK_SIZE = 2**12
"""Events that are made at a time for whoever goes through them."""


EVENT_SAMPLE, EVENT_GUARD, EVENT_FROM, EVENT_TO = range(4)
"""Columns of a log of events."""


class Instant(NamedTuple):
    """A time of a sampled motion, exact to the sample: `tau` seconds after sample number `sample`."""

    sample: int = 0
    tau: float = 0.0


BEGINNING = Instant()
"""The first sample."""


class Instants(NamedTuple):
    """Times of many, one each: `tau` seconds after sample number `sample`, (m,) arrays."""

    sample: IntArray
    tau: FloatArray


class GuardEvent(NamedTuple):
    """An event as the engine logs it; times in s after sample 0 of the motion."""

    at: Instant
    time: float
    guard: int
    source: int
    target: int
    before: FloatArray
    after: FloatArray


@dataclass(frozen=True, eq=False)
class EventLog(Sequence[GuardEvent]):
    """Events in the order of time; one of them, or a part, is made when it is looked at.

    Parameters
    ----------
    log : (n, 4) array of int
        Sample, guard, mode before and after (``EVENT_SAMPLE`` to ``EVENT_TO``), as the loop writes them.
    tau, time : (n,) arrays, s
        After that sample, and after sample 0 of the motion.
    limits : (n, 2, n_states) array
        Both limits of the state.
    """

    log: IntArray
    tau: FloatArray
    time: FloatArray
    limits: FloatArray

    @property
    def sample(self) -> IntArray:
        """The samples after which they are, (n,)."""
        return self.log[:, EVENT_SAMPLE]

    @property
    def guard(self) -> IntArray:
        """Which guards fired, (n,)."""
        return self.log[:, EVENT_GUARD]

    @property
    def source(self) -> IntArray:
        """The modes before, (n,)."""
        return self.log[:, EVENT_FROM]

    @property
    def target(self) -> IntArray:
        """The modes after, (n,)."""
        return self.log[:, EVENT_TO]

    @property
    def before(self) -> FloatArray:
        """The states before, (n, n_states)."""
        return self.limits[:, 0]

    @property
    def after(self) -> FloatArray:
        """The states after, (n, n_states)."""
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
            sample, guard, source, target = (column.tolist() for column in self.log[part].T)
            instants = map(Instant._make, zip(sample, self.tau[part].tolist(), strict=True))
            limits = self.limits[part]
            columns = instants, self.time[part].tolist(), guard, source, target, limits[:, 0], limits[:, 1]
            yield from map(GuardEvent._make, zip(*columns, strict=True))

    def __add__(self, other: EventLog) -> EventLog:
        """Return these and those that follow them."""
        return concatenate_events([self, other]) if len(other) else self

    def shift_time(self, samples: int, seconds: float) -> EventLog:
        """Return the same on a clock that started so many samples, and seconds, earlier."""
        log = self.log.copy()
        log[:, EVENT_SAMPLE] += samples
        return replace(self, log=log, time=self.time + seconds)


def bytes_per_event(n_states: int) -> int:
    """Return what an event of a model with so many states takes."""
    return 8 * (4 + 1 + 1 + 2 * n_states)


def allocate_events(count: int, n_states: int) -> tuple[IntArray, FloatArray, FloatArray]:
    """Return the loop's tables for so many events."""
    return np.empty((count, 4), dtype=np.int64), np.empty(count), np.empty((count, 2, n_states))


def concatenate_events(logs: Sequence[EventLog]) -> EventLog:
    """Return the events of some parts that follow each other; a list is emptied meanwhile, so that nothing is held twice."""
    if len(logs) == 1:
        return logs[0]
    remaining = logs if isinstance(logs, list) else list(logs)
    count, n_states = sum(map(len, remaining)), remaining[0].limits.shape[2]
    log, tau, limits = allocate_events(count, n_states)
    result = EventLog(log, tau, np.empty(count), limits)
    remaining.reverse()
    begin = 0
    while remaining:
        part = remaining.pop()
        rows = slice(begin, begin + len(part))
        result.log[rows], result.tau[rows], result.time[rows], result.limits[rows] = part.log, part.tau, part.time, part.limits
        begin = rows.stop
    return result

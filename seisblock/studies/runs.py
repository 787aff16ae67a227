"""Many independent runs: in threads, in order, with bounded memory."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Callable, Generator, Iterable, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from contextvars import copy_context
from threading import Event
from typing import TypeVar

from seisblock.dynamics.halt import halting, heeding
from seisblock.typing import Progress
from seisblock.words import Said, noted, said

Item = TypeVar("Item")
Answer = TypeVar("Answer")

BATCH = 32
"""Runs that one thread takes at a time where an ensemble does several."""

AHEAD = 128
"""Runs that are under way, or done and not yet asked for, at a time."""

RECORDS = 16
"""The same of runs that hold a record each."""


MOST_NAMED = 5
"""Versions without an answer that are named, at most."""


def left_out_versions(numbers: Sequence[int], answered: int) -> Said | None:
    """Return a sentence on the versions of a body that were given up, None where there are none.

    Parameters
    ----------
    numbers : sequence of int
        Of those versions, from 1.
    answered : int
        Versions that have an answer.

    Examples
    --------
    >>> print(left_out_versions((3, 17), 198))
    2 of 200 versions were given up and are left out: numbers 3, 17
    """
    if not numbers:
        return None
    text = noted("{count} of {all} versions were given up and are left out: numbers {numbers}")
    more = noted("{count} of {all} versions were given up and are left out: numbers {numbers} and others")
    named = ", ".join(str(number) for number in numbers[:MOST_NAMED])
    return said(text if len(numbers) <= MOST_NAMED else more, count=len(numbers), all=answered + len(numbers), numbers=named)


def cores() -> int:
    """Return how many cores this process may use."""
    try:
        return len(os.sched_getaffinity(0))
    except AttributeError:
        return os.cpu_count() or 1


def in_threads(
    work: Callable[[Item], Answer],
    items: Iterable[Item],
    *,
    progress: Progress | None = None,
    workers: int | None = None,
    ahead: int = AHEAD,
) -> Generator[Answer, None, None]:
    """Yield the answers of many runs, in the order of their items.

    Kernels release the GIL, so threads use all cores.

    Parameters
    ----------
    work : callable
        One run.
    items : iterable
        What each run is given; taken as they are needed.
    progress : callable
        Told the number of runs done and the number in all, where the items are a sequence.
    workers : int
        Threads; as many as there are cores when left out.
    ahead : int
        Items that are taken before the first of their answers is: as many are held, and at least one for each thread and one to follow.
    """
    count = workers or cores()
    ahead = max(ahead, 2 * count)
    pool = ThreadPoolExecutor(count)
    gone = Event()
    events = (*halting(), gone)

    def run(item: Item) -> Answer:
        """Do one run, as long as anybody waits for it."""
        with heeding(events):
            return work(item)

    def told(item: Item) -> Answer:
        """Do one run in the language, and whatever else holds, where the answers are asked for: threads begin with nothing of it."""
        return context.copy().run(run, item)

    def answers() -> Iterator[Answer]:
        """Yield one answer after the other, and begin a run for each that is taken."""
        under_way: deque[Future[Answer]] = deque()
        for item in items:
            under_way.append(pool.submit(told, item))
            if len(under_way) == ahead:
                yield under_way.popleft().result()
        while under_way:
            yield under_way.popleft().result()

    context = copy_context()
    try:
        for done, answer in enumerate(answers(), start=1):
            yield answer
            if progress is not None and isinstance(items, Sequence):
                progress(done, len(items))
    finally:
        # after an interruption no run begins, and those under way end at the next pause of their kernels
        gone.set()
        pool.shutdown(cancel_futures=True)


def in_batches(
    work: Callable[[slice], Answer], runs: int, *, size: int = BATCH, progress: Progress | None = None, workers: int | None = None
) -> Iterator[Answer]:
    """Yield the answers for one stretch of runs after another, in their order: for work that does several runs at once.

    Parameters
    ----------
    work : callable
        Some runs, as a slice of all of them.
    runs, size : int
        How many there are, and how many a stretch holds.
    progress, workers
        As for :func:`in_threads`.
    """
    parts = [slice(first, min(first + size, runs)) for first in range(0, runs, size)]
    answers = in_threads(work, parts, workers=workers)
    for part, answer in zip(parts, answers, strict=True):
        yield answer
        if progress is not None:
            progress(part.stop, runs)

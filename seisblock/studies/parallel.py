"""Many independent runs: in threads, in order, with bounded memory."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Callable, Generator, Iterable, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from contextvars import copy_context
from threading import Event
from typing import TypeVar

from seisblock.core.i18n import N_, Message, lazy_gettext
from seisblock.core.typing import Progress
from seisblock.dynamics.cancellation import cancel_scope, current_events

Item = TypeVar("Item")
Result = TypeVar("Result")

BATCH_SIZE = 32
"""Runs that one thread takes at a time where an ensemble does several."""

MAX_PENDING = 128
"""Runs that are under way, or done and not yet asked for, at a time."""

MAX_PENDING_RECORDS = 16
"""The same of runs that hold a record each."""


MOST_NAMED = 5
"""Versions without an answer that are named, at most."""


def left_out_versions(numbers: Sequence[int], answered: int) -> Message | None:
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
    text = N_("{count} of {all} versions were given up and are left out: numbers {numbers}")
    more = N_("{count} of {all} versions were given up and are left out: numbers {numbers} and others")
    named = ", ".join(str(number) for number in numbers[:MOST_NAMED])
    return lazy_gettext(text if len(numbers) <= MOST_NAMED else more, count=len(numbers), all=answered + len(numbers), numbers=named)


def cpu_count() -> int:
    """Return how many cores this process may use."""
    try:
        return len(os.sched_getaffinity(0))
    except AttributeError:
        return os.cpu_count() or 1


def map_threads(
    work: Callable[[Item], Result],
    items: Iterable[Item],
    *,
    progress: Progress | None = None,
    workers: int | None = None,
    max_pending: int = MAX_PENDING,
) -> Generator[Result, None, None]:
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
    max_pending : int
        Items that are taken before the first of their answers is: as many are held, and at least one for each thread and one to follow.
    """
    count = workers or cpu_count()
    max_pending = max(max_pending, 2 * count)
    pool = ThreadPoolExecutor(count)
    stopped = Event()
    events = (*current_events(), stopped)

    def run(item: Item) -> Result:
        """Do one run, as long as anybody waits for it."""
        with cancel_scope(events):
            return work(item)

    def run_in_context(item: Item) -> Result:
        """Do one run in the language, and whatever else holds, where the answers are asked for: threads begin with nothing of it."""
        return context.copy().run(run, item)

    def iter_results() -> Iterator[Result]:
        """Yield one answer after the other, and begin a run for each that is taken."""
        pending: deque[Future[Result]] = deque()
        for item in items:
            pending.append(pool.submit(run_in_context, item))
            if len(pending) == max_pending:
                yield pending.popleft().result()
        while pending:
            yield pending.popleft().result()

    context = copy_context()
    try:
        for finished, result in enumerate(iter_results(), start=1):
            yield result
            if progress is not None and isinstance(items, Sequence):
                progress(finished, len(items))
    finally:
        # after an interruption no run begins, and those under way end at the next pause of their kernels
        stopped.set()
        pool.shutdown(cancel_futures=True)


def map_batches(
    work: Callable[[slice], Result], runs: int, *, size: int = BATCH_SIZE, progress: Progress | None = None, workers: int | None = None
) -> Iterator[Result]:
    """Yield the answers for one stretch of runs after another, in their order: for work that does several runs at once.

    Parameters
    ----------
    work : callable
        Some runs, as a slice of all of them.
    runs, size : int
        How many there are, and how many a stretch holds.
    progress, workers
        As for :func:`map_threads`.
    """
    parts = [slice(first, min(first + size, runs)) for first in range(0, runs, size)]
    results = map_threads(work, parts, workers=workers)
    for part, result in zip(parts, results, strict=True):
        yield result
        if progress is not None:
            progress(part.stop, runs)

"""Parallel runs in threads: ordered results, bounded memory, cancellation."""

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
"""Default number of runs per batch."""

MAX_PENDING = 128
"""Largest number of runs in progress or with unread results."""

MAX_PENDING_RECORDS = 16
"""The same for runs with a record each."""

MAX_LISTED = 5
"""Largest number of stopped samples listed by number."""


def left_out_versions(numbers: Sequence[int], completed: int) -> Message | None:
    """Return a note on stopped samples of a body, None without any.

    Parameters
    ----------
    numbers : sequence of int
        Of the stopped samples, from 1.
    completed : int
        Number of samples with a result.

    Examples
    --------
    >>> print(left_out_versions((3, 17), 198))
    2 of 200 samples stopped without a result and excluded (numbers 3, 17)
    """
    if not numbers:
        return None
    text = N_("{count} of {all} samples stopped without a result and excluded (numbers {numbers})")
    truncated_text = N_("{count} of {all} samples stopped without a result and excluded (numbers {numbers} and others)")
    listed_numbers = ", ".join(str(number) for number in numbers[:MAX_LISTED])
    return lazy_gettext(
        text if len(numbers) <= MAX_LISTED else truncated_text, count=len(numbers), all=completed + len(numbers), numbers=listed_numbers
    )


def cpu_count() -> int:
    """Return the number of cores available to this process."""
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
    """Yield the results of many runs, in the order of their items.

    Kernels release the GIL, so threads use all cores.

    Parameters
    ----------
    work : callable
        One run.
    items : iterable
        Argument of each run; consumed on demand.
    progress : callable
        Called with the number of finished runs and the total, if the items are a sequence.
    workers : int
        Threads; default: the number of cores.
    max_pending : int
        Largest number of items consumed before the first unread result, at least two per thread.
    """
    count = workers or cpu_count()
    max_pending = max(max_pending, 2 * count)
    pool = ThreadPoolExecutor(count)
    stop_event = Event()
    events = (*current_events(), stop_event)

    def run(item: Item) -> Result:
        """Do one run within the cancellation scope."""
        with cancel_scope(events):
            return work(item)

    def run_in_context(item: Item) -> Result:
        """Do one run in the caller's context variables (language and others), which threads do not inherit."""
        return context.copy().run(run, item)

    def iter_results() -> Iterator[Result]:
        """Yield results in order; submit one run per consumed result."""
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
        # after an interruption no run starts, and those in progress end at the next cancellation check of their kernels
        stop_event.set()
        pool.shutdown(cancel_futures=True)


def map_batches(
    work: Callable[[slice], Result], runs: int, *, size: int = BATCH_SIZE, progress: Progress | None = None
) -> Iterator[Result]:
    """Yield the results of consecutive batches of runs, in order, for work that does several runs at once.

    Parameters
    ----------
    work : callable
        Some runs, as a slice of all of them.
    runs, size : int
        Number of runs, and runs per batch.
    progress : callable, optional
        As for :func:`map_threads`.
    """
    parts = [slice(first, min(first + size, runs)) for first in range(0, runs, size)]
    results = map_threads(work, parts)
    for part, result in zip(parts, results, strict=True):
        yield result
        if progress is not None:
            progress(part.stop, runs)

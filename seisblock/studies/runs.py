"""Many independent runs: in threads, in order, with bounded memory."""

from __future__ import annotations

import itertools
import os
from collections.abc import Callable, Generator, Iterable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextvars import copy_context
from threading import Event
from typing import TypeVar

from seisblock.dynamics.halt import halting, heeding
from seisblock.typing import Progress

Item = TypeVar("Item")
Answer = TypeVar("Answer")

BATCH = 32
"""Runs that one thread takes at a time where an ensemble does several."""

CHUNK = 128
"""Runs handed out at a time."""


def cores() -> int:
    """Return how many cores this process may use."""
    try:
        return len(os.sched_getaffinity(0))
    except AttributeError:
        return os.cpu_count() or 1


def in_threads(
    work: Callable[[Item], Answer], items: Iterable[Item], *, progress: Progress | None = None, workers: int | None = None
) -> Generator[Answer, None, None]:
    """Yield the answers of many runs, in the order of their items.

    Kernels release the GIL, so threads use all cores; no more than ``CHUNK`` runs are under way.

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
    """
    remaining = iter(items)
    finished = 0
    pool = ThreadPoolExecutor(workers or cores())
    gone = Event()
    events = (*halting(), gone)

    def run(item: Item) -> Answer:
        """Do one run, as long as anybody waits for it."""
        with heeding(events):
            return work(item)

    def told(item: Item) -> Answer:
        """Do one run in the language, and whatever else holds, where the answers are asked for: threads begin with nothing of it."""
        return context.copy().run(run, item)

    context = copy_context()
    try:
        while chunk := list(itertools.islice(remaining, CHUNK)):
            yield from pool.map(told, chunk)
            finished += len(chunk)
            if progress is not None and isinstance(items, Sequence):
                progress(finished, len(items))
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

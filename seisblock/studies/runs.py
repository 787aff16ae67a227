"""Many independent runs: in threads, in order, with bounded memory."""

from __future__ import annotations

import itertools
import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from threading import Event
from typing import TypeVar

from seisblock.dynamics.halt import halting, heeding
from seisblock.typing import Progress

Item = TypeVar("Item")
Answer = TypeVar("Answer")

CHUNK = 128
"""Runs handed out at a time."""


def cores() -> int:
    """Return how many cores this process may use."""
    try:
        return len(os.sched_getaffinity(0))
    except AttributeError:
        return os.cpu_count() or 1


def in_threads(
    work: Callable[[Item], Answer], items: Sequence[Item], *, progress: Progress | None = None, workers: int | None = None
) -> Iterator[Answer]:
    """Yield the answers of many runs, in the order of their items.

    Kernels release the GIL, so threads use all cores; no more than ``CHUNK`` runs are under way.

    Parameters
    ----------
    work : callable
        One run.
    items : sequence
        What each run is given.
    progress : callable
        Told the number of runs done and the number in all.
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

    try:
        while chunk := list(itertools.islice(remaining, CHUNK)):
            yield from pool.map(run, chunk)
            finished += len(chunk)
            if progress is not None:
                progress(finished, len(items))
    finally:
        # after an interruption no run begins, and those under way end at the next pause of their kernels
        gone.set()
        pool.shutdown(cancel_futures=True)

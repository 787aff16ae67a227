"""Many independent runs: in threads, in order, with bounded memory."""

from __future__ import annotations

import itertools
import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

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
    try:
        while chunk := list(itertools.islice(remaining, CHUNK)):
            yield from pool.map(work, chunk)
            finished += len(chunk)
            if progress is not None:
                progress(finished, len(items))
    finally:
        # an interruption waits for the runs under way, not for those that have not begun
        pool.shutdown(cancel_futures=True)

"""A batch on a Dask scheduler: each record with all its rows is a task, so that a task takes seconds and travels once."""

from __future__ import annotations

import logging
import pickle
from collections import deque
from collections.abc import Callable, Generator, Iterable, Iterator
from concurrent.futures import CancelledError
from contextlib import contextmanager, suppress
from functools import partial
from itertools import islice
from time import monotonic
from typing import TYPE_CHECKING, Any, TypeVar

from seisblock.core.errors import ParameterError

if TYPE_CHECKING:
    from distributed import Client

Task = TypeVar("Task")
Result = TypeVar("Result")

LOCAL_PREFIX = "local:"
"""What the name of a cluster of this machine's own processes begins with."""

CONNECT_TIMEOUT_S = 10
"""How long a scheduler may take to answer."""

TASKS_PER_THREAD = 4
"""Tasks handed out for each thread of the workers: enough that none waits, few enough that memory stays flat."""

POLL_INTERVAL_S = 1.0
"""How often a scheduler is asked how many threads its workers have: they come and go, and each question is a round trip."""

QUIET_DASK_CONFIG = {
    "distributed.admin.tick.interval": "1s",
    "distributed.admin.system-monitor.interval": "5s",
    "distributed.worker.profile.enabled": False,
}
"""How seldom the processes started here look at themselves: by default fifty to a hundred times a second, and nobody reads it."""


@contextmanager
def connect(address: str) -> Iterator[Client]:
    """Give a client of a scheduler, or of processes started here that end with the block.

    Parameters
    ----------
    address : str
        ``tcp://host:8786`` or the like, or ``local:N`` for N processes of this machine.

    Raises
    ------
    ParameterError
        If the package is not installed, the address is none, or no scheduler answers there.
    """
    try:
        import dask
        from distributed import Client, LocalCluster
    except ImportError as error:
        raise ParameterError("a cluster requires Dask: pip install 'seisblock[distributed]'") from error
    if address.startswith(LOCAL_PREFIX):
        with (
            dask.config.set(QUIET_DASK_CONFIG),
            LocalCluster(
                n_workers=_process_count(address), threads_per_worker=1, dashboard_address=None, silence_logs=50, memory_limit=0
            ) as cluster,
            Client(cluster) as client,
        ):
            yield client
        return
    try:
        client = Client(address, timeout=CONNECT_TIMEOUT_S)
    except (OSError, ValueError, TypeError, MemoryError) as error:  # what a web server answers begins, to Dask, with an enormous length
        raise ParameterError(
            "no Dask scheduler responds at {address}; start one, or use {local} for processes on this machine",
            address=address[:200],
            local=LOCAL_PREFIX + "2",
        ) from error
    logging.getLogger("distributed.client").setLevel(logging.CRITICAL)  # a scheduler that goes is told here, in a sentence
    with client:
        yield client


def _process_count(address: str) -> int:
    """Return how many processes ``local:N`` asks for."""
    number = address[len(LOCAL_PREFIX) :]
    if not number.isdecimal() or not 1 <= int(number) <= 512:
        raise ParameterError("a local cluster is given as local:N with N from 1 to 512; found {address}", address=address[:200])
    return int(number)


def map_cluster(
    client: Client, work: Callable[[Task], Result], tasks: Iterable[Task], *, on_lost: Callable[[Task, str], Result]
) -> Generator[Result, None, None]:
    """Yield the answers of many tasks, in their order; those of a worker that dies are done by another.

    Parameters
    ----------
    client : distributed.Client
    work : callable
        One task; travels with each, so that no worker's death loses it.
    tasks : iterable
        Taken as they are needed.
    on_lost : callable
        ``lost(task, reason)``: the answer for a task that every worker which takes it dies of.

    Raises
    ------
    ParameterError
        If the scheduler goes away.
    """
    from distributed import wait

    remaining = iter(tasks)
    pending: deque[tuple[Task, Any]] = deque()
    pickled_work = partial(_pickled_result, work)
    capacity, polled_s = 0, -POLL_INTERVAL_S
    try:
        while True:
            if monotonic() - polled_s >= POLL_INTERVAL_S:
                capacity, polled_s = TASKS_PER_THREAD * max(sum(client.nthreads().values()), 1), monotonic()
            pending.extend(
                (task, client.submit(pickled_work, task, pure=False)) for task in islice(remaining, max(capacity - len(pending), 0))
            )
            if not pending:
                return
            task, future = pending[0]
            result, reason = _wait_for_result(client, future)
            if reason:  # what waited in a worker is blamed for its death, too: the one that is to blame dies alone as well
                wait([future for _, future in pending])
                pending[0] = task, client.submit(pickled_work, task, pure=False)
                result, reason = _wait_for_result(client, pending[0][1])
            pending.popleft()
            yield on_lost(task, reason) if reason else pickle.loads(result)
    except (OSError, CancelledError) as error:
        if not _is_disconnected(client, error):
            raise
        raise ParameterError("the Dask scheduler stopped responding; restart it and resume") from error
    finally:
        if client.status == "running":
            with suppress(OSError):  # it may go this very moment
                client.cancel([future for _, future in pending])


def _pickled_result(work: Callable[[Task], Result], task: Task) -> bytes:
    """Return the answer of a task as bytes: rows that Dask sees into travel one by one."""
    return pickle.dumps(work(task))


def _wait_for_result(client: Client, future: Any) -> tuple[Any, str]:
    """Return the answer of a task, or why it has none: every worker that took it died."""
    from distributed import KilledWorker

    try:
        return future.result(), ""
    except (KilledWorker, CancelledError) as error:
        if _is_disconnected(client, error):
            raise
        return None, str(error)[:200] or type(error).__name__


def _is_disconnected(client: Client, error: BaseException) -> bool:
    """Return whether an error tells of a scheduler that is gone, of which no task is to blame."""
    return client.status != "running" or getattr(error, "reason", "") == "scheduler-connection-lost"

"""Batch on a Dask scheduler: one task per record with all its rows, so that transfer costs are small."""

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
"""Prefix of cluster names with processes on this machine."""

CONNECT_TIMEOUT_S = 10
"""Connection timeout, s."""

TASKS_PER_THREAD = 4
"""Submitted tasks per worker thread: keeps workers busy at bounded memory."""

POLL_INTERVAL_S = 1.0
"""Interval between queries of the number of worker threads, s; each one is a round trip."""

QUIET_DASK_CONFIG = {
    "distributed.admin.tick.interval": "1s",
    "distributed.admin.system-monitor.interval": "5s",
    "distributed.worker.profile.enabled": False,
}
"""Slower self-monitoring of local processes; the default is 50 to 100 times per second."""


@contextmanager
def connect(address: str) -> Iterator[Client]:
    """Context manager of a client of a scheduler, or of local processes closed at exit.

    Parameters
    ----------
    address : str
        ``tcp://host:8786`` or the like, or ``local:N`` for N processes of this machine.

    Raises
    ------
    ParameterError
        If the package is not installed, the address is invalid, or no scheduler responds.
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
    # Dask reads the answer of a web server as a huge message length: MemoryError
    except (OSError, ValueError, TypeError, MemoryError) as error:
        raise ParameterError(
            "no Dask scheduler responds at {address}; start one, or use {local} for processes on this machine",
            address=address[:200],
            local=LOCAL_PREFIX + "2",
        ) from error
    # a lost scheduler is reported by an exception below
    logging.getLogger("distributed.client").setLevel(logging.CRITICAL)
    with client:
        yield client


def _process_count(address: str) -> int:
    """Return the number of processes of ``local:N``."""
    number = address[len(LOCAL_PREFIX) :]
    if not number.isdecimal() or not 1 <= int(number) <= 512:
        raise ParameterError("a local cluster is given as local:N with N from 1 to 512; found {address}", address=address[:200])
    return int(number)


def map_cluster(
    client: Client, work: Callable[[Task], Result], tasks: Iterable[Task], *, on_lost: Callable[[Task, str], Result]
) -> Generator[Result, None, None]:
    """Yield the results of tasks in their order; tasks of dead workers are repeated on others.

    Parameters
    ----------
    client : distributed.Client
    work : callable
        Function of one task; sent with each task, so that the death of a worker does not lose it.
    tasks : iterable
        Consumed lazily.
    on_lost : callable
        ``on_lost(task, reason)``: the result of a task that kills all its workers.

    Raises
    ------
    ParameterError
        If the scheduler stops responding.
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
            # tasks queued on a dead worker are blamed, too: rerun alone to find out whether this one is the cause
            if reason:
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
            # the scheduler may disappear at this moment
            with suppress(OSError):
                client.cancel([future for _, future in pending])


def _pickled_result(work: Callable[[Task], Result], task: Task) -> bytes:
    """Return the result of a task as bytes; Dask would otherwise serialise each row separately."""
    return pickle.dumps(work(task))


def _wait_for_result(client: Client, future: Any) -> tuple[Any, str]:
    """Return the result of a task, or the reason of its failure if all its workers died."""
    from distributed import KilledWorker

    try:
        return future.result(), ""
    except (KilledWorker, CancelledError) as error:
        if _is_disconnected(client, error):
            raise
        return None, str(error)[:200] or type(error).__name__


def _is_disconnected(client: Client, error: BaseException) -> bool:
    """Return whether an error means a lost scheduler rather than a failed task."""
    return client.status != "running" or getattr(error, "reason", "") == "scheduler-connection-lost"

"""A batch on Dask: the same table, and a worker that is killed in the middle costs nothing."""

import contextlib
import os
import signal
import socket
import threading
from contextlib import suppress

import pytest

import seisblock
from seisblock.core.errors import ParameterError
from seisblock.studies.batch import cluster, run
from tests.studies.batch.conftest import write_record

pytestmark = pytest.mark.slow

distributed = pytest.importorskip("distributed")


@pytest.fixture(scope="module")
def client():
    """Return a client of two processes of this machine."""
    with cluster.connect("local:2") as result:
        yield result


@pytest.fixture
def records(tmp_path):
    """Return the names of twelve records."""
    return [str(write_record(tmp_path / f"r{seed:02d}.csv", seed, samples=3000, peak=5.0)) for seed in range(12)]


def test_batch_rejects_address_without_scheduler():
    """A web server at that address answers something else: its first letters, as a length, were 3 EiB and a traceback."""

    def answer():
        with contextlib.suppress(OSError):
            while True:
                peer, _ = listening.accept()
                with peer:
                    peer.sendall(b"HTTP/1.1 400 Bad Request\r\n\r\n")

    with socket.create_server(("127.0.0.1", 0)) as listening:
        threading.Thread(target=answer, daemon=True).start()
        address = "{}:{}".format(*listening.getsockname())
        with pytest.raises(ParameterError, match=f"no Dask scheduler responds at {address}"), cluster.connect(address):
            pass
        listening.shutdown(socket.SHUT_RDWR)


BODIES = {f"b{n}": seisblock.Block(0.15 + 0.01 * n, 0.9) for n in range(6)}


def test_batch_on_dask_equals_threads(client, records):
    """Bit by bit as on threads, a record that cannot be read included."""
    names = [*records, "gone.csv"]
    single = seisblock.run_batch(names, BODIES, "respond", mu=0.5, runs=2)
    together = seisblock.run_batch(names, BODIES, "respond", mu=0.5, runs=2, client=client)
    assert len(single) == 12 * 2 * 6 + 1
    assert list(together.cells()) == list(single.cells())


def test_dask_result_is_one_frame(client, monkeypatch):
    """Two hundred rows of a record were two hundred frames to Dask, and before each record the scheduler was asked who works for it."""
    futures, calls = [], []
    submit, nthreads = client.submit, client.nthreads
    monkeypatch.setattr(client, "submit", lambda *arguments, **how: futures.append(submit(*arguments, **how)) or futures[-1])
    monkeypatch.setattr(client, "nthreads", lambda: calls.append(True) or nthreads())
    monkeypatch.setattr(cluster, "POLL_INTERVAL_S", 3600.0)
    tasks = [[{"body": f"b{row}", "impacts": row}] * 3 for row in range(12)]
    assert list(cluster.map_cluster(client, list, tasks, on_lost=None)) == tasks
    assert {future.type for future in futures} == {bytes}
    assert len(calls) == 1


def test_batch_on_dask_accepts_records_in_memory(client, records):
    """They travel as they are."""
    read = [seisblock.read(name) for name in records[:3]]
    assert list(seisblock.run_batch(read, BODIES, "rock", client=client).cells()) == list(seisblock.run_batch(read, BODIES, "rock").cells())


def test_batch_survives_death_of_worker(client, records):
    """One of two processes is killed when the first answer is there, while others are under way in it."""
    victim = next(iter(client.run(os.getpid).values()))
    plan, _ = run.make_plan(BODIES, "respond", options={"mu": 0.5}, read_options=run.ReadOptions())
    read = [seisblock.read(name) for name in records]
    collected = []
    for rows in run.iter_record_rows(iter(read), plan, total=12, client=client):
        if not collected:
            os.kill(victim, signal.SIGKILL)
        collected += rows
    assert collected == list(seisblock.run_batch(read, BODIES, "respond", mu=0.5).rows)
    assert victim not in client.run(os.getpid).values()


def test_record_that_kills_workers_becomes_failed_row(client):
    """It does not end the batch, and those that waited in the worker that it took along have their answers."""
    missing = []

    def work(task):
        if task == "deadly":
            os.kill(os.getpid(), signal.SIGKILL)
        return task

    def reason(task, cause):
        missing.append(cause)
        return f"lost {task}"

    def forgive(times, dask_scheduler):
        dask_scheduler.allowed_failures, before = times, dask_scheduler.allowed_failures
        return before

    usual = client.run_on_scheduler(forgive, 0)  # whatever is in a worker that dies is blamed at once
    try:
        answers = list(cluster.map_cluster(client, work, ["a", "deadly", "b", "c", "d", "deadly", "e", "f"], on_lost=reason))
    finally:
        client.run_on_scheduler(forgive, usual)
    assert answers == ["a", "lost deadly", "b", "c", "d", "lost deadly", "e", "f"]
    assert len(missing) == 2


def test_lost_scheduler_is_not_recorded_as_record_failure(records):
    """One sentence, and the records under way have no rows: they stood in the table as records of which every worker had died."""
    result, read = [], [seisblock.read(name) for name in records]
    plan, _ = run.make_plan(BODIES, "respond", options={"mu": 0.5}, read_options=run.ReadOptions())
    local = distributed.LocalCluster(n_workers=1, threads_per_worker=1, processes=False, dashboard_address=":0", silence_logs=60)
    with distributed.Client(local, timeout=1) as client, pytest.raises(ParameterError, match="stopped responding"):
        for rows in run.iter_record_rows(iter(read), plan, total=12, client=client):
            result += rows
            local.sync(local.scheduler.close)
    with suppress(TimeoutError):  # its scheduler is closed already
        local.close(timeout=1)
    assert result and not [row for row in result if row.get("failure")]

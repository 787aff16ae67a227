"""Cost of a batch row beside the solver's own call, and of a record beside its rows."""

from __future__ import annotations

import os
import time

import pytest

from seisblock.bodies.block import Block
from seisblock.models.respond import solve_respond
from seisblock.models.rock.solve import solve_rock
from seisblock.models.slide.solve import solve_slide
from seisblock.records import Component, Record, motion_of
from seisblock.studies.batch import cluster
from seisblock.studies.batch.run import run_batch
from seisblock.studies.parallel import cpu_count
from tests.studies.batch.conftest import shaking, write_record

BODIES = {f"block {number}": Block(0.15 + 0.01 * number, 1.0) for number in range(20)}
FRICTIONS = {f"mu {number}": 0.05 + 0.02 * number for number in range(20)}


def minute(seed, peak=3.0):
    """Return 60 s of three components at 100 Hz."""
    _, rows = shaking(seed, samples=6000, peak=peak)
    return Record(tuple(Component(code, row) for code, row in zip(("NS", "EW", "UD"), rows, strict=True)), 0.01, source=f"{seed}.csv")


@pytest.mark.parametrize(
    ("solver", "bodies", "options", "single"),
    [
        ("rock", BODIES, {}, solve_rock),
        ("respond", BODIES, {"mu": 0.5}, solve_respond),
        ("slide", FRICTIONS, {}, solve_slide),
    ],
    ids=["rock", "respond", "slide"],
)
def test_batch_row(benchmark, solver, bodies, options, single):
    """At most 0.3 ms more than the solver's own call, on one thread."""
    record = minute(3)
    motion = motion_of(record, "NS")

    def rows():
        return run_batch([record], bodies, solver, components="NS", workers=1, **options)

    def calls():
        return [single(body, motion, **options) for body in bodies.values()]

    assert len(rows()) == len(calls()) == 20
    benchmark(rows)
    if benchmark.stats is not None:
        separate = min(_seconds(calls) for _ in range(5)) / 20
        together = benchmark.stats.stats.min / 20
        benchmark.extra_info |= {"ms_per_row": 1e3 * together, "ms_per_call": 1e3 * separate}
        assert together < separate + 0.3e-3


def test_batch_on_two_dask_processes(benchmark, tmp_path):
    """Two workers of a local cluster against one; overhead of client and scheduler is reported, independent of load."""
    pytest.importorskip("distributed")
    if benchmark.disabled or cpu_count() < 2 or os.getloadavg()[0] > 0.5:
        pytest.skip("is a measurement, on two idle cores")
    names = [str(write_record(tmp_path / f"r{seed:02d}.csv", seed, samples=6000, peak=3.0)) for seed in range(20)]
    bodies = {f"block {number}": Block(0.15 + 0.005 * number, 0.9) for number in range(100)}
    single, beside = _on_processes(1, names, bodies)
    with cluster.connect("local:2") as client:
        run_batch(names[:4], bodies, "rock", client=client)
        table = benchmark.pedantic(run_batch, args=(names, bodies, "rock"), kwargs={"client": client}, rounds=3)
    assert len(table) == 20 * 2 * 100
    if benchmark.stats is not None:
        benchmark.extra_info |= {"times_one": single / benchmark.stats.stats.min, "client_ms_per_record": 1e3 * beside / len(names)}


def _on_processes(count, names, bodies):
    """Return how long a batch takes on some processes, at best, and the time of a processor that this one spends meanwhile."""
    with cluster.connect(f"local:{count}") as client:
        run_batch(names[: 2 * count], bodies, "rock", client=client)
        collected = []
        for _ in range(3):
            duration = time.process_time()
            collected.append((_seconds(lambda: run_batch(names, bodies, "rock", client=client)), time.process_time() - duration))
    return min(selection for selection, _ in collected), min(seconds for _, seconds in collected)


def _seconds(work):
    """Return how long something takes."""
    begun = time.perf_counter()
    work()
    return time.perf_counter() - begun

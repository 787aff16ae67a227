"""Cost of a batch row beside the bare integration, and of a record beside its rows."""

from __future__ import annotations

import os
import time
from dataclasses import replace

import numpy as np
import pytest

from seisblock.bodies.block import Block
from seisblock.bodies.sliding_base import SlidingBase
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.dynamics import integrate_many
from seisblock.models import respond_many, respond_params
from seisblock.models.respond.options import RespondOptions
from seisblock.models.rock.options import RockOptions
from seisblock.models.rock.params import rock_params
from seisblock.models.rock.verdicts import rock_verdicts
from seisblock.models.slide import model as slide_model
from seisblock.records import Component, Record, motion_of
from seisblock.studies.batch import cluster
from seisblock.studies.batch.run import run_batch
from seisblock.studies.parallel import cpu_count
from tests.studies.batch.conftest import shaking, write_record

BODIES = {f"block {number}": Block(0.15 + 0.002 * number, 1.0) for number in range(100)}
FRICTIONS = {f"mu {number}": 0.05 + 0.004 * number for number in range(100)}


def minute(seed, peak=3.0):
    """Return 60 s of three components at 100 Hz."""
    _, rows = shaking(seed, samples=6000, peak=peak)
    return Record(tuple(Component(code, row) for code, row in zip(("NS", "EW", "UD"), rows, strict=True)), 0.01, source=f"{seed}.csv")


def slide_rows(motions):
    """Integrate the sliding of all frictions."""
    rows = [slide_model.parameters(SlidingBase(mu), STANDARD_GRAVITY) for mu in FRICTIONS.values()]
    for motion in motions:
        integrate_many(slide_model.SLIDE, motion, rows, np.zeros(4), slide_model.STICK, gains=(1.0, 0.0, 1.0))


def rock_rows(motions):
    """Integrate the rocking of all blocks."""
    params = [rock_params(block, motions[0], RockOptions()) for block in BODIES.values()]
    for motion in motions:
        rock_verdicts(params, motion, params[0].gains())


def respond_rows(motions):
    """Integrate the full response of all blocks, once each."""
    params = [respond_params(block, RespondOptions(mu=0.5)) for block in BODIES.values()]
    for motion in motions:
        respond_many(params, motion, workers=1)


@pytest.mark.parametrize(
    ("solver", "bodies", "options", "own_rows", "bound"),
    [("rock", BODIES, {}, rock_rows, 3.0), ("respond", BODIES, {"mu": 0.5}, respond_rows, 6.0), ("slide", FRICTIONS, {}, slide_rows, 4.0)],
    ids=["rock", "respond", "slide"],
)
def test_batch_row(benchmark, solver, bodies, options, own_rows, bound):
    """Records and bodies on one thread, beside the bare integration of the same rows: the ratio does not depend on the machine."""
    records = [minute(seed) for seed in range(1 if benchmark.disabled else 4)]
    motions = [motion_of(record, "NS") for record in records]

    def batch():
        return run_batch([replace(record) for record in records], bodies, solver, components="NS", workers=1, **options)

    assert len(batch()) == 100 * len(records)
    benchmark(batch)
    if benchmark.stats is not None:
        own_rows(motions)
        ratio = min(_seconds(batch) / _seconds(lambda: own_rows(motions)) for _ in range(5))
        benchmark.extra_info |= {"ms_per_row": 10.0 * benchmark.stats.stats.min / len(records), "times_own_rows": ratio}
        assert ratio < bound


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

"""Speed of fragilities: runs, fits of all samples of the records, and both together."""

import numpy as np
import pytest

from seisblock.bodies.block import Block
from seisblock.studies.fragility.lognormal import fit_lognormals
from seisblock.studies.fragility.run import run_fragility
from tests.motions import synthetic_suite

BODIES = {f"shelf {number}": Block(0.32, 0.7 + 0.17 * number) for number in range(9)}


@pytest.mark.slow
def test_fragility_of_nine_blocks(benchmark):
    """44 records of 40 s x 60 levels x 9 blocks, 23 760 runs with fits and intervals: at most 8 s of this process on all its cores.

    Where benchmarks are disabled, eight records.
    """
    records = synthetic_suite(8 if benchmark.disabled else 44, seconds=40.0, dt=0.01)
    ask = {"im": "pgv", "levels": np.geomspace(0.05, 5.0, 60)}
    study = benchmark.pedantic(run_fragility, (records, BODIES, "rock"), ask, rounds=1, warmup_rounds=0)
    assert len(study.curves) == 9 and all(curve.median_interval for curve in study.curves)
    assert benchmark.stats is None or benchmark.stats.stats.min < 8.0


def test_bootstrap_of_1000_samples(benchmark):
    """The bootstrap of one curve, 1000 samples at 60 levels: at most 0.2 s."""
    levels = np.geomspace(0.1, 5.0, 60)
    rng = np.random.default_rng(0)
    counts = np.array([(0.7 * np.exp(0.45 * rng.normal(size=44))[:, None] <= levels).sum(axis=0) for _ in range(1000)], dtype=float)
    medians, _ = benchmark(fit_lognormals, levels, counts, np.full((1, 60), 44.0))
    assert np.isfinite(medians).all()
    assert benchmark.stats is None or benchmark.stats.stats.min < 0.2

"""Speed of uplift."""

from __future__ import annotations

import numpy as np
import pytest

from seisblock.bodies.spring_block import SpringBlock
from seisblock.models.uplift.batch import uplift_many
from seisblock.models.uplift.harmonic import uplift_thresholds
from seisblock.models.uplift.solve import solve_uplift
from seisblock.records.motion import Motion
from tests.benchmarks.test_slide_speed import best
from tests.models.uplift_motions import shaking


def test_uplift_harmonic_curve_of_1000_frequencies(benchmark):
    """A harmonic curve of 1000 frequencies takes less than 50 ms."""
    body = SpringBlock.from_ratios(1.0, 0.707)
    ratio = np.linspace(0.005, 5.0, 1000)
    curve = benchmark(uplift_thresholds, body, ratio, phi_deg=45.0, rho_deg=45.0)
    assert np.isfinite(curve).all()
    assert benchmark.stats is None or benchmark.stats.stats.min < 0.05


def test_uplift_of_100_s_record(benchmark):
    """A 100 s, 100 Hz three-component record with a vertical frequency of 10 Hz takes less than 0.04 s."""
    body = SpringBlock.from_frequency(0.6, 0.6, 1.8, frequency_vertical=10.0, beta=0.707)
    response = benchmark(solve_uplift, body, shaking(100.0, 0.01))
    assert response.outcome.contact_changes > 100
    assert benchmark.stats is None or benchmark.stats.stats.min < 0.04


@pytest.mark.parametrize(("scale", "lifts"), [(0.02, False), (1.0, True)])
def test_uplift_of_300_s_record(benchmark, scale, lifts):
    """A block that lifts all the time takes less than 1.5 us per sample, with its linear and its repeated run; one that never lifts 0.4."""
    body, motion = SpringBlock.from_frequency(0.6, 0.6, 1.8, frequency_vertical=10.0, beta=0.707), shaking(300.0, 0.01)
    motion = Motion(scale * motion.acceleration, motion.dt)
    response = benchmark(solve_uplift, body, motion)
    assert response.outcome.uplifts is lifts
    assert benchmark.stats is None or benchmark.stats.stats.min < (1.5e-6 if lifts else 0.4e-6) * motion.samples


def test_uplift_many_of_60_s(benchmark):
    """Sixteen blocks side by side take no longer than one after another: two integrations and a linear one."""
    bodies = [SpringBlock.from_frequency(0.6, 0.6, 1.2 + 0.05 * n, frequency_vertical=10.0, beta=0.707) for n in range(16)]
    motion = shaking(60.0, 0.01)
    result = benchmark(uplift_many, bodies, motion)
    assert (result.contact_changes > 100).sum() > 8
    if benchmark.stats is not None:
        benchmark.extra_info["ns_per_sample"] = benchmark.stats.stats.min / (motion.samples * len(bodies)) * 1e9
        single = sum(best(lambda body=body: solve_uplift(body, motion), repeats=3) for body in bodies)
        assert benchmark.stats.stats.min < 1.1 * single

"""How fast uplift answers."""

from __future__ import annotations

import numpy as np

from seisblock.bodies.spring_block import SpringBlock
from seisblock.solvers.uplift_harmonic import uplift_thresholds


def test_harmonic_curve_of_1000_frequencies(benchmark):
    """A harmonic curve of 1000 frequencies takes less than 50 ms."""
    body = SpringBlock.from_ratios(1.0, 0.707)
    ratio = np.linspace(0.005, 5.0, 1000)
    curve = benchmark(uplift_thresholds, body, ratio, phi_deg=45.0, rho_deg=45.0)
    assert np.isfinite(curve).all()
    assert benchmark.stats is None or benchmark.stats.stats.min < 0.05

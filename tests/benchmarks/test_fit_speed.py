"""Speed of a fit: sixty outcomes of long records."""

from __future__ import annotations

import time

import numpy as np
import pytest

from seisblock import Motion
from seisblock.bodies import from_slenderness
from seisblock.models.rock import rock_verdict
from seisblock.studies import Observation, fit_block

FIT_S = 60.0
"""Bound of the CPU time of the fit, s."""

FIRST_PROGRESS_S = 1.0

OUTCOMES, SAMPLES, DT = 60, 6001, 0.01


def outcomes(count):
    """Return what a block does under records of 60 s with a strong phase of 15 s, 0.7 to 4 times the rocking threshold."""
    rng = np.random.default_rng(42)
    block = from_slenderness(0.2, 3.0)
    t = DT * np.arange(SAMPLES)
    observations = []
    for k in range(count):
        row = np.convolve(rng.normal(size=SAMPLES), np.hanning(20), "same") * np.exp(-(((t - 15.0) / 7.5) ** 2))
        peak = 9.80665 * np.tan(0.2) * np.exp(rng.uniform(np.log(0.7), np.log(4.0)))
        motion = Motion.from_arrays(peak * row / np.abs(row).max(), DT)
        scale = float(rng.uniform(0.95, 1.05))
        observations.append(Observation(motion, rock_verdict(block, motion, scale=scale).overturned, record=f"record {k}"))
    return observations


@pytest.mark.slow
def test_fit_of_sixty_long_records(benchmark):
    """Slenderness and size from sixty outcomes on 60 s records: at most 60 s of CPU time, with progress within the first second."""
    # without timing, fewer outcomes hold the same assertions
    observations, progress = outcomes(4 if benchmark.disabled else OUTCOMES), []
    fit_block(observations[:2], free=["alpha"], block=from_slenderness(0.2, 3.0), runs=1, folds=2)
    began = time.process_time()

    def work():
        return fit_block(
            observations, free=["alpha", "p"], progress=lambda done, total: progress.append((time.process_time(), done, total))
        )

    fit = benchmark.pedantic(work, rounds=1)
    counts = [done for _, done, _ in progress]
    assert counts == sorted(counts) and all(done <= total for _, done, total in progress)
    assert fit.effective_blocks >= 200 and fit["alpha"].interval[0] < 0.2 < fit["alpha"].interval[1]
    if benchmark.disabled:
        return
    cpu = progress[-1][0] - began
    print(f"fit of {OUTCOMES} outcomes on {SAMPLES * DT:.0f} s records: {cpu:.1f} s of CPU time, {counts[-1]} runs")
    assert progress[0][0] - began < FIRST_PROGRESS_S
    assert cpu < FIT_S

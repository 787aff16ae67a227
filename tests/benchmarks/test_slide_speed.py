"""Speed of sliding: nanoseconds per sample and parameter set, a study of 10 000 points, pySLAMMER for comparison."""

from __future__ import annotations

import time

import numpy as np
import pytest

from seisblock.bodies.sliding_base import sliding_base
from seisblock.dynamics import integrate_many
from seisblock.models.slide.model import SLIDE, STICK, parameters
from seisblock.models.slide.solve import solve_slide
from seisblock.records import Motion
from seisblock.studies.sliding import slide_study
from tests.crosscheck.test_slide import PYSLAMMER, G, pyslammer_motion

NANOSECONDS_PER_SAMPLE = 20.0
STUDY_S = 2.0

TIMES_FASTER = 75.0
TIMES_FASTER_ALONE = 15.0


def strong_motion(samples=10_000, dt=0.01):
    """Return 100 s of shaking with a strong phase of 30 s, peak 3 m/s^2, vertical half of that."""
    rng = np.random.default_rng(0)
    t = dt * np.arange(samples)
    rows = [np.convolve(rng.normal(size=samples), np.hanning(20), "same") * np.exp(-(((t - 30.0) / 15.0) ** 2)) for _ in range(2)]
    rows = [peak * row / np.abs(row).max() for peak, row in zip((3.0, 1.5), rows, strict=True)]
    return Motion.from_arrays(rows[0], dt, vertical=rows[1])


def best(work, repeats=7):
    """Return the shortest of several times, s."""
    times = []
    for _ in range(repeats):
        began = time.perf_counter()
        work()
        times.append(time.perf_counter() - began)
    return min(times)


def test_slide_kernel_per_sample(benchmark):
    """The kernel needs at most 20 ns per sample and parameter set, over the friction coefficients of a study, with vertical motion."""
    motion = strong_motion()
    mus = np.linspace(0.02, 0.30, 57)
    p = np.array([parameters(sliding_base(mu, kappa=0.5), G) for mu in mus])

    def work():
        return integrate_many(SLIDE, motion, p, np.zeros(4), STICK, gains=[1.0, 0.0, 1.0])

    benchmark.pedantic(work, rounds=5, warmup_rounds=1)
    if benchmark.disabled:
        return
    per_sample = best(work) / (mus.size * motion.samples) * 1e9
    benchmark.extra_info["ns_per_sample"] = per_sample
    print(f"slide kernel: {per_sample:.1f} ns per sample and parameter set on one core")
    assert per_sample < NANOSECONDS_PER_SAMPLE


@pytest.mark.slow
def test_slide_study_of_10000_points(benchmark):
    """10 000 combinations of friction, ratio and vertical motion over a 100 s record take about a second."""
    motion = strong_motion()

    def work():
        return slide_study(np.linspace(0.02, 0.4, 50), motion, kappa=np.linspace(0.3, 1.0, 20), vertical=np.linspace(0.0, 2.0, 10))

    benchmark.pedantic(work, rounds=1, warmup_rounds=1)
    if benchmark.disabled:
        return
    seconds = best(work, repeats=2)
    benchmark.extra_info["study_s"] = seconds
    print(f"slide study: 10 000 points of a 100 s record in {seconds:.2f} s")
    assert seconds < STUDY_S


@pytest.mark.slow
def test_slide_study_is_faster_than_pyslammer(benchmark):
    """An analysis of a study takes less than a seventieth of pySLAMMER's rigid analysis of the same record; side by side, one core each."""
    from pyslammer.ground_motion import GroundMotion
    from pyslammer.rigid_analysis import RigidAnalysis

    records = [(Motion.from_arrays(-G * a, dt), GroundMotion(a, dt, name)) for name in PYSLAMMER for a, dt in [pyslammer_motion(name)]]
    subset, rows = [0.05, 0.1, 0.2, 0.3], np.linspace(0.05, 0.30, 251)

    def mine():
        return [slide_study(rows, motion, one_way=True, workers=1) for motion, _ in records]

    def theirs():
        return [RigidAnalysis(ky, second) for _, second in records for ky in subset]

    benchmark.pedantic(mine, rounds=3, warmup_rounds=1)
    if benchmark.disabled:
        return
    reference = best(theirs, repeats=3) / len(subset)
    ratio = reference / (best(mine) / rows.size)
    single = reference / best(lambda: [solve_slide(sliding_base(0.1, one_way=True), motion) for motion, _ in records])
    benchmark.extra_info["times_faster"] = ratio
    print(f"slide: {ratio:.0f} times faster per analysis than pySLAMMER's; {single:.0f} times for a single one with its time histories")
    assert ratio > TIMES_FASTER


def test_solve_slide_is_faster_than_pyslammer(benchmark):
    """One `solve_slide` of a 300 s record, every curve of it made, takes less than a fifteenth of pySLAMMER's rigid analysis of it."""
    from pyslammer.ground_motion import GroundMotion
    from pyslammer.rigid_analysis import RigidAnalysis

    motion = strong_motion(30_000)
    second, base = GroundMotion(-motion.horizontal / G, motion.dt, "300 s"), sliding_base(0.1, one_way=True)
    curves = benchmark(lambda: solve_slide(base, motion).channels)
    assert len(curves) == 7
    if benchmark.disabled:
        return
    ratio = best(lambda: RigidAnalysis(0.1, second), repeats=5) / best(lambda: solve_slide(base, motion).channels, repeats=50)
    benchmark.extra_info["times_faster"] = ratio
    print(f"slide: a single answer {ratio:.0f} times faster than pySLAMMER's")
    assert ratio > TIMES_FASTER_ALONE

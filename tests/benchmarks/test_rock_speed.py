"""Speed of rocking."""

from __future__ import annotations

import numpy as np

from seisblock.bodies.block import Block, from_slenderness
from seisblock.bodies.block_array import rectangular_blocks
from seisblock.dynamics import integrate, integrate_many
from seisblock.models.rock.model import REST, ROCKING, TO_RIGHT, parameters
from seisblock.models.rock.options import RockOptions
from seisblock.models.rock.params import rock_batch_params, rock_params
from seisblock.models.rock.simd import ROCKING_SIMD_MODEL
from seisblock.models.rock.solve import solve_rock
from seisblock.models.rock.verdicts import rock_verdict
from seisblock.records import Motion
from seisblock.studies.rocking.spectrum import default_sizes, default_slendernesses, rocking_spectrum
from tests.benchmarks.test_slide_speed import TIMES_FASTER_ALONE, best
from tests.crosscheck.test_slide import G, pyslammer_motion

SAMPLES = 10_000


def bound(benchmark, seconds):
    """Hold the fastest round against a bound, when rounds are timed at all."""
    assert benchmark.stats is None or benchmark.stats.stats.min < seconds


def test_rock_per_sample(benchmark):
    """At most 500 ns per sample while rocking, at round-off accuracy."""
    block = from_slenderness(0.25, 2.14)
    motion = Motion.from_arrays(0.3 * np.sin(0.07 * np.arange(SAMPLES)), 0.01)
    p = parameters(rock_params(block, motion, options=RockOptions(restitution=0.9999)), motion.dt)
    answer = benchmark(integrate, ROCKING, motion, p, (0.15, 0.0), TO_RIGHT, keep_path=False, keep_events=False)
    assert answer.final_mode != REST
    bound(benchmark, 500e-9 * SAMPLES)


def test_rock_simd_per_sample(benchmark):
    """At most 60 ns per sample of each of 64 blocks side by side on one core, impacts included: the same bits as alone."""
    blocks = rectangular_blocks(np.linspace(0.9, 1.1, 64), np.linspace(3.4, 4.4, 64))
    motion = Motion.from_arrays(0.3 * np.sin(0.07 * np.arange(SAMPLES)), 0.01)
    p = parameters(rock_batch_params(blocks, motion, options=RockOptions(restitution=0.9999)), motion.dt)

    def work():
        return integrate_many(ROCKING_SIMD_MODEL, motion, p, [0.15, 0.0], TO_RIGHT, gains=(1.0, 0.0, 0.0))

    answer = benchmark(work)
    assert (answer.final_mode != REST).all() and (answer.n_events > 50).any()
    if benchmark.stats is not None:
        benchmark.extra_info["ns_per_sample"] = benchmark.stats.stats.min / (SAMPLES * 64) * 1e9
    bound(benchmark, 60e-9 * SAMPLES * 64)


def test_rock_rest_per_sample(benchmark):
    """At most 10 ns per sample at rest."""
    motion = Motion.from_arrays(0.3 * np.sin(0.07 * np.arange(10 * SAMPLES)), 0.01)
    verdict = benchmark(rock_verdict, Block(0.3, 1.0), motion)
    assert not verdict.overturned
    bound(benchmark, 10e-9 * 10 * SAMPLES)


def test_solve_rock_per_sample(benchmark):
    """Channels, phases, forces and outcome included: at most 1 microsecond per sample."""
    motion = Motion.from_arrays(0.3 * np.sin(0.07 * np.arange(SAMPLES)), 0.01)
    response = benchmark(solve_rock, from_slenderness(0.25, 2.14), motion, restitution=0.9999, initial=(0.15, 0.0))
    assert response.outcome.impacts > 50
    bound(benchmark, 1e-6 * SAMPLES)


def test_rocking_spectrum_of_100_s(benchmark):
    """10 x 10 blocks under 100 s at 100 Hz take less than a hundredth of the minute that 100 x 100 may take."""
    rng = np.random.default_rng(0)
    t = np.arange(SAMPLES) * 0.01
    a = np.convolve(rng.normal(size=SAMPLES), np.ones(8) / 8, "same") * np.exp(-(((t - 35) / 18) ** 2))
    motion = Motion.from_arrays(5 * a / np.abs(a).max(), 0.01)
    answer = benchmark.pedantic(rocking_spectrum, (default_sizes(10), default_slendernesses(10), motion), rounds=3, warmup_rounds=1)
    assert answer.overturned.any()
    bound(benchmark, 0.6)


def test_solve_rock_overhead(benchmark):
    """A verdict on a record of three samples: at most 100 microseconds, where 0.1.0 took 335 to 460 (H11)."""
    still = Motion.from_arrays(np.zeros(3), 0.01)
    verdict = benchmark(rock_verdict, Block(0.3, 1.0), still)
    assert verdict.max_rotation_ratio == 0.0
    bound(benchmark, 100e-6)


def test_rock_many_overhead_per_run(benchmark):
    """10 000 blocks, made, followed through two samples and judged: at most 5 microseconds each (40 before)."""
    still = Motion.from_arrays(np.zeros(2), 0.01)
    spectrum = benchmark(rocking_spectrum, default_sizes(100), default_slendernesses(100), still)
    assert not spectrum.overturned.any()
    bound(benchmark, 5e-6 * 10_000)


def test_solve_rock_is_faster_than_pyslammer(benchmark):
    """One `solve_rock` of 300 s, with its channels and outcome, takes less than a fifteenth of pySLAMMER's rigid analysis of it."""
    from pyslammer.ground_motion import GroundMotion
    from pyslammer.rigid_analysis import RigidAnalysis

    recorded, dt = pyslammer_motion("Loma_Prieta_1989_HSP-000")
    a = np.concatenate([recorded, np.zeros(round(300.0 / dt) - recorded.size)])
    motion, second, block = Motion.from_arrays(G * a, dt), GroundMotion(a, dt, "300 s"), from_slenderness(0.25, 2.14)
    answer = benchmark(solve_rock, block, motion)
    assert answer.outcome.impacts > 100 and not answer.outcome.overturned
    if benchmark.disabled:
        return
    ratio = best(lambda: RigidAnalysis(0.1, second), repeats=5) / best(lambda: solve_rock(block, motion), repeats=20)
    benchmark.extra_info["times_faster"] = ratio
    print(f"rock: a single answer {ratio:.0f} times faster than pySLAMMER's")
    assert ratio > TIMES_FASTER_ALONE

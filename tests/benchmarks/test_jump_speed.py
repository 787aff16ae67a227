"""Cost of one sample of the jump on one core: rest, rocking and flight."""

import numpy as np
import pytest

from seisblock.bodies.two_layer import TwoLayerBlock, load_contact, load_two_layer
from seisblock.dynamics import integrate
from seisblock.models.jump import flight as flying
from seisblock.models.jump import jump_many, modes, rocking, solve_jump
from seisblock.records import Motion
from tests.benchmarks.test_slide_speed import best
from tests.models.uplift_motions import shaking

N = 50_000
BLOCK = TwoLayerBlock(2.08, 2.50, 1.06, 1.84, 1303.7, 160.0)
QUIET = Motion.from_arrays(np.sin(0.1 * np.arange(N)), 0.01)


def parameters(**changed):
    p = rocking.rocking_parameters(BLOCK, 9.8, "both")
    for index, factor in changed.items():
        p[getattr(rocking, index)] *= factor
    return p


def flight():
    p = modes.flight_parameters(BLOCK, 1e-9, 0.2, 0.2, 0.3, QUIET.dt)
    return integrate(flying.FLIGHT_MODEL, QUIET, p, [0.0, 1e-9, 0.0, 0.0, 1.0, 1.0, *[0.0] * 4], modes.FLIGHT, keep_path=False)


def integrate_at_rest():
    return integrate(rocking.ROCKING_MODEL, QUIET, parameters(), [0.0, 0.0], rocking.REST, keep_path=False)


def rocks():
    # gravity and push scaled down so that one swing lasts the whole record
    return integrate(rocking.ROCKING_MODEL, QUIET, parameters(PUSH=1e-4, WEIGHT=1e-9), [0.2, 0.0], rocking.ROCK, keep_path=False)


MODES = {"rest": (integrate_at_rest, rocking.REST), "rocking": (rocks, rocking.ROCK), "flight": (flight, modes.FLIGHT)}


@pytest.mark.parametrize(("run", "mode"), MODES.values(), ids=MODES)
def test_jump_cost_per_sample(benchmark, run, mode):
    """The whole motion is spent in one mode; the cost per sample is in extra_info."""
    assert run().final_mode == mode
    benchmark(run)
    if benchmark.stats is not None:
        benchmark.extra_info["ns_per_sample"] = benchmark.stats.stats.min / N * 1e9


def test_jump_many_100_factors(benchmark):
    """A hundred factors on 60 s, chain after chain, take a fifth of the time of single answers at the most (a thirtieth, measured)."""
    block, contact = load_two_layer("chozusha"), load_contact("chozusha")
    motion = shaking(60.0, 0.01, peaks=(9.0, 5.0, 3.0), seed=1)
    factors = np.linspace(0.5, 1.5, 100)
    result = benchmark(jump_many, [block], motion, contacts=[contact], factors=factors)
    assert len(result.chains.row) > 2000
    if benchmark.stats is not None:
        benchmark.extra_info["ns_per_sample"] = benchmark.stats.stats.min / (motion.samples * factors.size) * 1e9
        single = best(lambda: solve_jump(block, motion, contact=contact), repeats=3)
        assert benchmark.stats.stats.min / factors.size < single / 5.0

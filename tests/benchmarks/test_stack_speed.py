"""Speed of piles."""

from __future__ import annotations

from dataclasses import replace
from time import process_time

import numpy as np
import pytest

from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import PileStone
from seisblock.bodies.pile.toml import load_pile
from seisblock.models.stack.solve import solve_stack
from seisblock.records import Motion

WIDTH = 0.2424
SECONDS = 10.0
MINIMUM = {1: 2.5, 5: 7.0}
"""How many times as fast as MuJoCo at 1 and at 2 ms rigid stones are at least, by their number. One stone converges 100 times further
than its tolerance, so that its images move alike."""


def shaking(pga):
    return Motion.from_arrays(pga * np.sin(2.0 * np.pi * 2.0 * np.arange(0.0, SECONDS, 0.01)), 0.01)


SHAKING = shaking(3.0)


def one_block(mu):
    return Pile("block", (PileStone("block", WIDTH, WIDTH, 4 * WIDTH),), mu=mu)


def test_stack_of_one_rigid_block(benchmark):
    """One block on its edges, at the default step: 300 simulated seconds per second."""
    response = benchmark(solve_stack, one_block(5.0), SHAKING)
    assert response.outcome.max_tilt_rad["block"] > 0.01
    assert benchmark.stats is None or response.time[-1] / benchmark.stats.stats.min > 300.0


def test_stack_of_five_spring_stones(benchmark):
    """The paper's pile of five stones on springs at 5 x 5 points each: 40 simulated seconds per second."""
    response = benchmark(solve_stack, load_pile("wagata"), SHAKING, law="springs", points=5)
    assert response.outcome.max_tilt_rad["sao"] > 0.005
    assert benchmark.stats is None or response.time[-1] / benchmark.stats.stats.min > 40.0


def speeds(runs, seconds, benchmark):
    """Return simulated seconds per second of processor time and the results, by name: the fastest of six turns, or of one untimed."""
    speed, results = dict.fromkeys(runs, 0.0), {}

    def turn():
        for name, run in runs.items():
            start = process_time()
            results[name] = run()
            speed[name] = max(speed[name], seconds / (process_time() - start))

    benchmark.pedantic(turn, rounds=6)
    benchmark.extra_info |= {f"simulated seconds per second, {name}": rate for name, rate in speed.items()}
    print(", ".join(f"{name} {rate:.1f}" for name, rate in speed.items()), "simulated seconds per second")
    return speed, results


@pytest.mark.parametrize(("stones", "pga"), [(1, 3.5), (5, 4.6), (5, 3.0)], ids=["one rocks", "the top of five rocks", "five stand"])
@pytest.mark.slow
def test_stack_and_mujoco(stones, pga, benchmark):
    """Simulated seconds per second of both, in one run, taken in turns: rigid stones at their default step, MuJoCo at 1 and 2 ms.

    Thresholds of one block stand within 0.1 % of their limit at the one step, within 0.2 % at the others; those of the pile within
    0.1 %, 0.1 % and 0.5 %.
    """
    pytest.importorskip("mujoco", reason="an extra: pip install seisblock[mujoco]")
    from tests.crosscheck.mujoco_pile import any_stone_falls

    pile, motion = one_block(1.0) if stones == 1 else load_pile("wagata", mu=0.8), shaking(pga)
    runs = {
        "seisblock": lambda: solve_stack(pile, motion),
        "MuJoCo 1 ms": lambda: any_stone_falls(pile, motion, timestep=1e-3),
        "MuJoCo 2 ms": lambda: any_stone_falls(pile, motion, timestep=2e-3),
    }
    speed, results = speeds(runs, SECONDS, benchmark)
    assert not results["seisblock"].outcome.overturned_any
    assert not results["MuJoCo 1 ms"]
    if benchmark.enabled:
        assert speed["seisblock"] > MINIMUM[stones] * max(speed["MuJoCo 1 ms"], speed["MuJoCo 2 ms"])


def shaking_along_three_axes(seconds):
    time = np.arange(0.0, seconds, 0.01)
    rows = [5.0 * np.sin(2.0 * np.pi * 2.0 * time), 3.0 * np.sin(2.0 * np.pi * 2.74 * time + 0.3), np.sin(2.0 * np.pi * 4.6 * time)]
    return Motion(np.array(rows), 0.01)


def slabs(count, width=0.6):
    slab = PileStone("s0", width, width, 0.08)
    return Pile("slabs", (slab, *(replace(slab, name=f"s{i}", on=f"s{i - 1}") for i in range(1, count))), mu=0.3)


def wall(mu):
    """Return a wall of 40 stones in five courses, 1 mm apart."""
    lowest = [PileStone(f"s0_{i}", 0.5, 0.3, 0.25, offset=(0.501 * i, 0.0)) for i in range(10)]
    others = [PileStone(f"s{r}_{i}", 0.5, 0.3, 0.25, offset=(0.2505, 0.0), on=f"s{r - 1}_{i}") for r in range(1, 5) for i in range(10 - r)]
    return Pile("wall", (*lowest, *others), mu=mu)


HARD = {
    "10 sliding slabs": (slabs(10), 2.0, 15.0),
    "20 sliding slabs": (slabs(20), 2.0, 4.0),
    "wall of 40": (wall(0.5), 0.4, 0.3),
}
"""Pile, seconds of shaking, and simulated seconds per second that it reaches at least."""


@pytest.mark.parametrize("case", HARD)
def test_hard_piles(case, benchmark):
    """Stones that slide on each other along both axes, the hard case beside the lenient ones above."""
    pile, seconds, minimum = HARD[case]
    response = benchmark.pedantic(solve_stack, (pile, shaking_along_three_axes(seconds)), rounds=2, warmup_rounds=1)
    assert not response.warnings
    assert benchmark.stats is None or response.time[-1] / benchmark.stats.stats.min > minimum


def test_cost_of_sliding_slabs_grows_with_an_exponent_below_one_and_a_half(benchmark):
    """Three and fifty slabs, so wide that none falls."""
    seconds, motion = {}, shaking_along_three_axes(2.0)

    def turn():
        for count in (3, 50):
            start = process_time()
            solve_stack(slabs(count, width=2.5), motion)
            seconds[count] = min(seconds.get(count, np.inf), process_time() - start)

    benchmark.pedantic(turn, rounds=4)
    exponent = np.log(seconds[50] / seconds[3]) / np.log(50 / 3)
    benchmark.extra_info["exponent"] = exponent
    assert not benchmark.enabled or exponent < 1.5


@pytest.mark.parametrize("count", [5, 10, 20])
def test_sliding_slabs_and_mujoco(count, benchmark):
    """Slabs that slide on each other in both directions, the hard case: at least as fast as MuJoCo at 2 ms, in one run, in turns."""
    pytest.importorskip("mujoco", reason="an extra: pip install seisblock[mujoco]")
    from tests.crosscheck.mujoco_pile import any_stone_falls

    seconds = 2.0
    pile, motion = slabs(count), shaking_along_three_axes(seconds)
    runs = {"seisblock": lambda: solve_stack(pile, motion, law="rigid"), "MuJoCo 2 ms": lambda: any_stone_falls(pile, motion, 2e-3)}
    speed, results = speeds(runs, seconds, benchmark)
    assert not results["seisblock"].outcome.overturned_any
    if benchmark.enabled:
        assert speed["seisblock"] > speed["MuJoCo 2 ms"]


def pagoda(storeys):
    """Return a pagoda: a body and a wider roof per storey, both narrower by 5 % from storey to storey."""
    stones, side = [], 1.6
    for i in range(storeys):
        for part, share, height in (("body", 0.6, 0.28 - 0.008 * i), ("roof", 1.0, 0.22 - 0.006 * i)):
            stone = PileStone(f"{part}{i}", share * side, share * side, height)
            stones.append(replace(stone, on=stones[-1].name) if stones else stone)
        side *= 0.95
    return Pile("pagoda", tuple(stones), mu=0.5)


def record_of_a_minute(pga):
    """Return noise about 2.5 Hz under the envelope of an earthquake, 60 s at 100 Hz, along three axes."""
    rng, time = np.random.default_rng(1), np.arange(0.0, 60.0, 0.01)
    envelope, f = np.minimum(time / 5.0, 1.0) * np.exp(-np.maximum(time - 15.0, 0.0) / 12.0), np.fft.rfftfreq(len(time), 0.01)
    response = (f / 0.3) ** 2 / (1.0 + (f / 0.3) ** 2) / (1.0 - (f / 2.5) ** 2 + 1.2j * f / 2.5)
    rows = [envelope * np.fft.irfft(np.fft.rfft(rng.normal(size=len(time))) * response, len(time)) for _ in range(3)]
    return Motion(np.array([share * pga * row / np.abs(row).max() for share, row in zip((1.0, 0.8, 0.5), rows, strict=True)]), 0.01)


@pytest.mark.parametrize(("pile", "pga"), [(pagoda(13), 4.0), (wall(0.5), 3.0)], ids=["pagoda of 13 storeys", "wall of 40"])
@pytest.mark.slow
def test_record_of_a_minute(pile, pga, benchmark):
    """A record of 60 s takes at most 30 s, and every step is solved; where benchmarks are disabled, its first 12 s."""
    motion = record_of_a_minute(pga)
    if benchmark.disabled:
        motion = Motion(motion.acceleration[:, :1200], motion.dt)
    start = process_time()
    response = benchmark.pedantic(solve_stack, (pile, motion), rounds=1)
    assert not response.warnings
    assert benchmark.stats is None or process_time() - start < 30.0


@pytest.mark.slow
def test_sliding_slabs_and_mujoco_at_equal_error(benchmark):
    """Ten slabs with one friction slide as one: error of their places at the end against one slab at fine steps, and time.

    The default step has a smaller error than MuJoCo at 0.2 ms, whose slabs creep on their soft contacts at any step.
    """
    pytest.importorskip("mujoco", reason="an extra: pip install seisblock[mujoco]")
    from tests.crosscheck.mujoco_pile import simulate

    motion, pile = shaking_along_three_axes(1.0), slabs(10)
    at = (motion.samples - 1) * motion.dt

    def places(stones, response):
        return np.array([[np.interp(at, response.time, response[f"{name}_{axis}"]) for axis in "xy"] for name in stones.names])

    exact = places(slabs(1), solve_stack(slabs(1), motion, step=1e-4))[0]
    runs = {
        "seisblock": lambda: places(pile, solve_stack(pile, motion)),
        "MuJoCo 0.2 ms": lambda: [data.xpos[1:, :2].copy() for data in simulate(pile, motion, 2e-4)][-1],
    }
    seconds, errors = {}, {}

    def turn():
        for name, run in runs.items():
            start = process_time()
            errors[name] = np.abs(run() - exact).max()
            seconds[name] = min(seconds.get(name, np.inf), process_time() - start)

    benchmark.pedantic(turn, rounds=2)
    assert errors["seisblock"] < 0.05 * np.abs(exact).max()
    assert errors["seisblock"] < 0.2 * errors["MuJoCo 0.2 ms"]
    assert not benchmark.enabled or seconds["seisblock"] < seconds["MuJoCo 0.2 ms"] / 3.0

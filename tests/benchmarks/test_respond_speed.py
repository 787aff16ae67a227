"""Speed of the five-mode model: a sample of each mode, a probability of 200 samples, MuJoCo for comparison."""

from __future__ import annotations

import json
import resource
import subprocess
import sys
import time

import numpy as np
import pytest

from seisblock.bodies.block import Block, from_slenderness
from seisblock.dynamics import integrate
from seisblock.models.respond import constants, respond_many, respond_params, solve_respond
from seisblock.models.respond.model import RESPOND
from seisblock.models.respond.options import RespondOptions
from seisblock.records import Motion
from tests.benchmarks.test_slide_speed import strong_motion
from tests.models.respond.cases import at_lean

SAMPLES = 10_000
WEAK = Motion.from_arrays(0.3 * np.sin(0.07 * np.arange(SAMPLES)), 0.01, vertical=0.2 * np.sin(0.11 * np.arange(SAMPLES)))


def strong_minute():
    """Return 60 s of shaking at 100 Hz, peak 6 m/s^2: blocks slide, rock, and some fall."""
    motion = strong_motion(6001)
    return Motion(2.0 * motion.acceleration, motion.dt)


def assert_faster_than(benchmark, seconds):
    """Hold the fastest round against a bound, when rounds are timed at all."""
    assert benchmark.stats is None or benchmark.stats.stats.min < seconds


def one_mode(benchmark, block, motion, initial, mode, nanoseconds, **friction):
    """Time a run that stays almost wholly in some modes; hold its time per sample against a bound."""
    setting = respond_params(block, RespondOptions(**friction))
    p, y = setting.parameters(motion.dt), setting.state(initial)

    def work(keep=False):
        return integrate(RESPOND, motion, p, y, constants.START, gains=(1.0, 0.0, 1.0), keep_path=keep, keep_events=keep)

    remaining = work(keep=True)
    samples = remaining.end.sample
    inside = np.isin([constants.MODES[item] for item in remaining.modes[1 : samples + 1]], mode)
    assert samples > 2000
    assert inside.mean() > 0.97
    benchmark(work)
    if benchmark.stats is not None:
        benchmark.extra_info["ns_per_sample"] = benchmark.stats.stats.min / samples * 1e9
    assert_faster_than(benchmark, nanoseconds * 1e-9 * samples)


def test_respond_rocking_per_sample(benchmark):
    """At most 400 ns per sample, with vertical motion, energies and friction's limits."""
    block = from_slenderness(0.25, 2.14)
    one_mode(benchmark, block, WEAK, at_lean(block, 0.15), "rock", 400.0, mu=10.0, rocking_restitution=1.0)


def test_respond_slide_rocking_per_sample(benchmark):
    """At most 400 ns per sample; the block is so large that one swing lasts half a minute."""
    block = Block(240.0, 2400.0)
    one_mode(benchmark, block, WEAK, at_lean(block, 0.08, slip=80.0), "slide-rock", 400.0, mu=0.02)


def test_respond_sliding_per_sample(benchmark):
    """At most 200 ns per sample, energies and path included."""
    motion = Motion.from_arrays(2.0 * np.sin(0.07 * np.arange(SAMPLES)), 0.01)
    one_mode(benchmark, Block(1.0, 1.0), motion, None, "slide", 200.0, mu=0.05)


def test_respond_flight_per_sample(benchmark):
    """At most 400 ns per sample, spinning."""
    one_mode(benchmark, Block(1.0, 1.0), WEAK, (0.0, 60_000.0, 0.0, 0.0, 0.0, 0.01), "flight", 400.0, mu=0.05)


def test_respond_rest_per_sample(benchmark):
    """At most 10 ns per sample, as the other models pass over them."""
    one_mode(benchmark, Block(1.0, 1.0), WEAK, None, "rest", 10.0, mu=0.5)


def versions(block, n=200):
    """Return plausible versions of a block on a floor: size, width, friction, restitution."""
    rng = np.random.default_rng(7)
    size, width = np.exp(rng.normal(0.0, 0.05, (2, n)))
    mu, e = 0.35 * np.exp(rng.normal(0.0, 0.2, n)), rng.uniform(0.0, 0.3, n)
    return [
        respond_params(Block(block.width * w * s, block.height * s), options=RespondOptions(mu=m, restitution=r))
        for w, s, m, r in zip(width, size, mu, e, strict=True)
    ]


def test_respond_probability_of_200_samples(benchmark):
    """200 versions of a cabinet under 60 s of strong motion at 100 Hz, on to their rest: at most 1.5 s on two threads."""
    motion = strong_minute()
    settings = versions(Block(0.45, 1.4))
    shaking = benchmark.pedantic(respond_many, (settings, motion), {"workers": 2}, rounds=3, warmup_rounds=1)
    assert shaking.overturned.size == 200
    assert (shaking.impacts > 10).sum() > 100
    assert (shaking.slip_path_m > 0.0).sum() > 100
    assert_faster_than(benchmark, 1.5)


def test_solve_respond_of_60_s(benchmark):
    """Channels, events, outcome and sensitivity of one block under 60 s of strong motion: at most 0.1 s."""
    motion = strong_minute()
    response = benchmark(solve_respond, Block(0.45, 1.4), motion, mu=0.4)
    assert len(response.outcome.events) > 3
    assert_faster_than(benchmark, 0.1)


def run_command(*words):
    """Run a command in a process of its own; return its answer and the processor time it took, s."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    result = subprocess.run([sys.executable, "-m", "seisblock", *words, "--quiet", "--json"], capture_output=True, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return json.loads(result.stdout), after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


@pytest.mark.slow
def test_respond_command_with_warm_cache(benchmark):
    """From the shell, kernels compiled before, `respond` with 200 versions of two components costs less than twice what `slide` does."""
    words = ("respond", "--width", "45cm", "--height", "180cm", "--mu", "0.3")
    duration = []

    def run():
        answer, took = run_command(*words)
        duration.append(took)
        return answer

    answer = benchmark.pedantic(run, rounds=5, warmup_rounds=1)
    assert [result["probability"]["runs"] for result in answer["results"]] == [200, 200]
    if benchmark.stats is not None:
        base = min(run_command("slide", "--mu", "0.3")[1] for _ in range(5))
        benchmark.extra_info |= {"processor_s": min(duration), "over_slide": min(duration) / base}
        print(f"respond: {min(duration):.2f} s of processor time for a warm command, slide: {base:.2f} s")
        assert min(duration) < 2.0 * base


def test_respond_is_faster_than_mujoco(benchmark):
    """At least 50 times faster than MuJoCo at its 1 ms step, one block, measured in one run."""
    mujoco = pytest.importorskip("mujoco")
    motion = strong_minute()
    xml = """<mujoco><option timestep="0.001"/><worldbody><geom type="plane" size="50 50 1" friction="0.4 0 0"/>
    <body pos="0 0 0.7"><freejoint/><geom type="box" size="0.225 0.3 0.7" friction="0.4 0 0"/></body></worldbody></mujoco>"""
    model = mujoco.MjModel.from_xml_string(xml)
    data = mujoco.MjData(model)
    grid = 0.001 * np.arange(60_000)
    along = np.interp(grid, motion.time, motion.horizontal)

    def theirs():
        """Shake by an inertial force."""
        mujoco.mj_resetData(model, data)
        for push in along:
            data.xfrc_applied[1, 0] = -model.body_mass[1] * push
            mujoco.mj_step(model, data)

    def mine():
        return solve_respond(Block(0.45, 1.4), motion, mu=0.4, vertical=False, sensitivity=False)

    began = time.perf_counter()
    theirs()
    reference = time.perf_counter() - began
    benchmark(mine)
    if benchmark.stats is not None:
        ratio = reference / benchmark.stats.stats.min
        benchmark.extra_info["times_faster"] = ratio
        print(f"respond: {ratio:.0f} times faster than MuJoCo at 1 ms")
        assert ratio > 50.0

"""A block that rocks freely keeps the ratio that it was given, at every impact."""

import math

import numpy as np
import pytest

from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import PileStone
from seisblock.core.units import STANDARD_GRAVITY as G
from seisblock.models.stack.solve import solve_stack
from seisblock.records import Motion


@pytest.mark.parametrize("seed", [1, 2, 7, 15])
@pytest.mark.parametrize("ratio", [0.5, 0.8, 0.95, 1.0])
def test_impacts_of_free_rocking_have_given_restitution(ratio, seed):
    """Twenty blocks of any size: a third stopped dead at one impact or other, held by the corners that had left.

    With a ratio of 1 one impact in 600 was plastic: of two corners that pressed alike, one had done nothing in a step of microseconds.
    """
    rng = np.random.default_rng(seed)
    for _ in range(20):
        width, slender = rng.uniform(0.1, 1.0), rng.uniform(2.0, 8.0)
        alpha, radius = math.atan2(1.0, slender), 0.5 * math.hypot(width, slender * width)
        let_go = alpha * rng.uniform(0.1, 0.7)
        pile = Pile("one", (PileStone("block", width, width, slender * width),), mu=2.0)
        result = solve_stack(pile, Motion.from_arrays(np.zeros(3001), 1e-3), tilts={"block": let_go}, restitution=ratio)
        tilt = result["block_tilt"]
        peaks = np.flatnonzero((tilt[1:-1] >= tilt[:-2]) & (tilt[1:-1] > tilt[2:])) + 1
        leans = [let_go, *tilt[peaks][tilt[peaks] > 0.02 * alpha]]
        speeds = [math.sqrt(1.5 * G / radius * (math.cos(alpha - lean) - math.cos(alpha))) for lean in leans]
        np.testing.assert_allclose(np.array(speeds[1:]) / speeds[:-1], ratio, atol=0.02)
        rocks_on = tilt[result.time > 2.0].max(initial=0.0) > 0.02 * alpha
        assert rocks_on or leans[-1] * ratio**2 < 0.04 * alpha


def test_impacts_at_default_step_have_given_restitution():
    """Two hundred slender blocks: one impact in 300 pressed on one corner alone in the instant before, and left up to 0.25 too much."""
    rng, impacts = np.random.default_rng(5), 0
    for _ in range(200):
        slender, ratio = rng.uniform(4.0, 8.0), rng.uniform(0.1, 0.85)
        alpha = math.atan2(1.0, slender)
        lean = alpha * rng.uniform(0.3, 0.8)
        pile = Pile("one", (PileStone("block", 0.3, 0.42, 0.3 * slender),), mu=rng.uniform(0.5, 2.0))
        result = solve_stack(pile, Motion.from_arrays(np.zeros(600), 0.01), tilts={"block": lean}, restitution=ratio)
        signed = result["block_tilt"] * np.sign(result["block_qy"])
        turns = np.split(np.abs(signed), np.flatnonzero(np.diff(np.sign(signed))) + 1)
        peaks = np.array([part.max() for part in turns if part.max() > 0.02 * alpha])
        risen = np.cos(alpha - peaks) - math.cos(alpha)
        np.testing.assert_allclose(np.sqrt(risen[1:] / risen[:-1]), ratio, atol=0.03)
        impacts += len(peaks) - 1
    assert impacts > 300


def shaking(rng, peak, seconds=20.0, dt=0.01):
    """Return noise about 1.5 Hz along three axes, m/s^2, the vertical half of it."""
    count = round(seconds / dt)
    hertz = np.fft.rfftfreq(count, dt)
    rows = np.fft.irfft(np.fft.rfft(rng.normal(size=(3, count))) * (hertz > 0.3) * np.exp(-((hertz / 2.5) ** 2)), count)
    return Motion(peak * np.array([[1.0], [1.0], [0.5]]) * rows / np.abs(rows).max(axis=1, keepdims=True), dt)


def test_given_restitution_creates_no_energy():
    """Newton's law across a joint and friction may: 1.6e-3 of its weight times its height at any step, for which a pile was refused."""
    rng, fell = np.random.default_rng(6), 0
    for _ in range(24):
        width = rng.uniform(0.3, 0.9)
        depth = width * rng.uniform(0.6, 1.4)
        tall = [width * rng.uniform(0.5, 1.2), width * rng.uniform(1.0, 2.5)]
        stones = (PileStone("low", width, depth, tall[0]), PileStone("high", 0.9 * width, 0.9 * depth, tall[1], on="low"))
        pile, ratio = Pile("two", stones, mu=rng.uniform(0.8, 1.5)), rng.uniform(0.3, 0.9)
        response = solve_stack(pile, shaking(rng, 2.0 * min(width, depth) / sum(tall) * G), restitution=ratio)
        assert not response.warnings
        assert response.outcome.created_j < 1e-4 * sum(stone.mass for stone in stones) * G * sum(tall)
        fell += response.outcome.overturned_any
    assert fell >= 6


def test_given_restitution_keeps_mirror_and_quarter_turn_symmetry():
    """A square column under the mirrored or turned record does the mirrored or the turned: of forty, as chaotic as they are, most do.

    Where what the law asked for hung on the order of the corners five of forty did.
    """

    def lean_and_slip(rows, ratio, back):
        pile = Pile("one", (PileStone("block", 0.45, 0.45, 1.0),), mu=0.6)
        stone = solve_stack(pile, Motion(rows, 0.01), restitution=ratio).outcome.stones[0]
        return np.array([stone.max_tilt_rad, *(back @ (stone.residual_slip_x_m, stone.residual_slip_y_m))])

    alike = 0
    for seed in range(40):
        rows = np.asarray(shaking(np.random.default_rng(seed), 7.5, 4.0).acceleration)
        same = True
        for ratio in (0.0, 0.3, 0.7):
            expected = lean_and_slip(rows, ratio, np.eye(2))
            for image in ([[-1.0, 0.0], [0.0, 1.0]], [[1.0, 0.0], [0.0, -1.0]], [[0.0, -1.0], [1.0, 0.0]]):
                result = lean_and_slip(np.vstack([np.array(image) @ rows[:2], rows[2:]]), ratio, np.array(image).T)
                same = same and np.allclose(result, expected, rtol=[0.02, 0.0, 0.0], atol=[0.0, 0.01, 0.01])
        alike += same
    assert alike >= 20

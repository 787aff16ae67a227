"""Blocks that rock side by side in lanes move, bit by bit, as each does alone."""

import math
from dataclasses import fields

import numpy as np
import pytest

from seisblock.bodies.block_array import rectangular_blocks
from seisblock.dynamics import Ensemble, integrate_many
from seisblock.models.rock.expansion import COSINE, OMEGA, SINE, THETA, expand_series, omega_coefficients, sine_cosine
from seisblock.models.rock.model import REST, ROCKING, TO_LEFT, TO_RIGHT, parameters
from seisblock.models.rock.options import RockOptions
from seisblock.models.rock.params import rock_batch_params
from seisblock.models.rock.simd import ROCKING_SIMD_MODEL
from seisblock.records import Motion

RNG = np.random.default_rng(17)
T = np.arange(900) * 0.01
SHAKING = [size * np.convolve(RNG.normal(size=T.size), np.hanning(width), "same") for size, width in ((0.8, 40), (0.5, 25), (0.6, 15))]
MOTION = Motion(np.array([4.0 * row / np.abs(row).max() for row in SHAKING]), 0.01)
BLOCKS = rectangular_blocks(RNG.uniform(0.08, 0.5, 45), RNG.uniform(0.4, 2.0, 45))
GAINS = np.column_stack([RNG.uniform(0.3, 1.6, 45), RNG.uniform(-0.4, 0.4, 45), RNG.uniform(-0.5, 0.5, 45)])


def assert_same(first: Ensemble, second: Ensemble):
    """Hold every number of the two against each other."""
    for field in fields(Ensemble):
        if field.name != "model":
            np.testing.assert_array_equal(getattr(first, field.name), getattr(second, field.name), err_msg=field.name)


@pytest.mark.parametrize("gains", [GAINS, np.array([[1.0, 0.0, 0.0]])], ids=["turned, with the vertical", "along alone"])
def test_simd_rows_equal_engine_bit_for_bit(gains):
    """Random blocks, more than there are lanes: some rest, some rock, some pass alpha, some fall; states, extrema, times, counts, stays."""
    subset = 20 if len(gains) == 1 else 45
    p = parameters(rock_batch_params(BLOCKS, MOTION), 0.01)[:subset]
    single = integrate_many(ROCKING, MOTION, p, np.zeros(2), REST, gains=gains)
    assert_same(integrate_many(ROCKING_SIMD_MODEL, MOTION, p, np.zeros(2), REST, gains=gains), single)
    assert (single.final_mode == -1).any() and (single.final_mode >= 0).any() and (single.n_events > 30).any()


@pytest.mark.kernel
def test_simd_with_empty_lanes_equals_engine():
    """Two blocks that lean: most lanes stay empty."""
    motion = Motion(MOTION.acceleration[:, 380:460], 0.01)
    p = parameters(rock_batch_params(BLOCKS, motion), 0.01)[[7, 30]]
    single = integrate_many(ROCKING, motion, p, [0.05, 0.0], TO_RIGHT, gains=GAINS[:2])
    assert_same(integrate_many(ROCKING_SIMD_MODEL, motion, p, [0.05, 0.0], TO_RIGHT, gains=GAINS[:2]), single)
    assert (single.n_events > 0).all()


def test_simd_with_initial_state_resumes_bit_for_bit(monkeypatch):
    """From a lean, in slices of a few steps, and through a motion that is given stretch by stretch: the same bits."""
    p = parameters(rock_batch_params(BLOCKS, MOTION, options=RockOptions(restitution=0.97)), 0.01)
    start = np.column_stack([-0.5 * p[:, 4], np.linspace(-0.3, 0.3, len(p))])
    single = integrate_many(ROCKING, MOTION, p, start, TO_LEFT, gains=GAINS)
    monkeypatch.setattr("seisblock.dynamics.ensemble.STEPS_PER_SLICE", 40)
    assert_same(integrate_many(ROCKING_SIMD_MODEL, MOTION, p, start, TO_LEFT, gains=GAINS), single)
    monkeypatch.setattr("seisblock.records.motion.LONG_MOTION_SAMPLES", 10)
    monkeypatch.setattr("seisblock.records.motion.SEGMENT_SAMPLES", 71)
    assert_same(integrate_many(ROCKING_SIMD_MODEL, MOTION, p, start, TO_LEFT, gains=GAINS), single)


def test_linear_equation_uses_engine_bit_for_bit():
    """Slender blocks by the linear equation: the same bits, too."""
    p = parameters(rock_batch_params(BLOCKS, MOTION, options=RockOptions(linear=True)), 0.01)
    assert_same(*(integrate_many(model, MOTION, p, np.zeros(2), REST, gains=GAINS) for model in (ROCKING_SIMD_MODEL, ROCKING)))


@pytest.mark.kernel
def test_simd_sine_and_cosine_match_math_to_one_ulp():
    """Within a right angle either way, as math has them."""
    for x in np.concatenate([np.linspace(-math.pi / 2, math.pi / 2, 401), [0.0, 1e-300, -1e-9]]).tolist():
        sine, cosine = sine_cosine(x)
        assert sine == pytest.approx(math.sin(x), rel=2.3e-16, abs=0.0)
        assert cosine == pytest.approx(math.cos(x), rel=0.0, abs=1.2e-16)


@pytest.mark.kernel
def test_unrolled_coefficients_equal_recurrence():
    """Each coefficient, for leans, rates and ground motions drawn at random."""
    for psi, omega, lever, *ground in RNG.uniform(-1.0, 1.0, (20, 7)) * [1.4, 3.0, 2.0, 12.0, 90.0, 8.0, 200.0]:
        c = np.zeros((4, 21))
        sine, cosine = math.sin(psi), math.cos(psi)
        rate = -lever * (ground[0] * sine + ground[2] * cosine)
        c[THETA, 1], c[OMEGA, 0], c[OMEGA, 1], c[SINE, 0], c[COSINE, 0] = omega, omega, rate, sine, cosine
        # a step so long that no term is small
        expand_series(c, 20, False, 3.0, lever, *ground)
        scale = np.abs(c[OMEGA, :11]).max()
        np.testing.assert_allclose(
            omega_coefficients(sine, cosine, omega, rate, lever, *ground), c[OMEGA, 2:11], rtol=1e-12, atol=1e-14 * scale
        )

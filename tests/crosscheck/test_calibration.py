"""Calibration of the overturning probability: stones solved by an independent planar model overturn at the predicted rate."""

from itertools import pairwise

import numpy as np
import pytest

from seisblock import Block, Motion, motion_of, read
from seisblock.models.rock.options import RockOptions
from seisblock.studies.sampling import sample

G = 9.80665
STONES = 300
SUBSTEPS = 10


def fixed_step_rocker(acceleration, dt, width, height, share, factor):
    """Return which of many rectangles overturn: Heun's method with ten steps per sample, Housner's impact times `share` at each zero.

    Written for this test: arrays (m,) of all stones, one motion, no event location, no code of the package.
    """
    alpha, radius = np.arctan2(width, height), 0.5 * np.hypot(width, height)
    stiffness = 3.0 * G / (4.0 * radius)
    loss = np.minimum(share * (1.0 - 1.5 * np.sin(alpha) ** 2), 1.0)
    theta, omega, fallen = np.zeros(width.size), np.zeros(width.size), np.zeros(width.size, dtype=bool)

    def rate(theta, side, pull):
        return -stiffness * (np.sin(side * alpha - theta) + pull / G * np.cos(side * alpha - theta))

    step = dt / SUBSTEPS
    samples = np.append(acceleration, np.zeros(int(8.0 / dt)))
    for first, last in pairwise(samples):
        for part in range(SUBSTEPS):
            pull, after = (factor * (first + (last - first) * (part + shift) / SUBSTEPS) for shift in (0.0, 1.0))
            lifts = np.abs(pull) > G * np.tan(alpha)
            rests = (theta == 0.0) & (omega == 0.0)
            side = np.where(rests, -np.sign(pull), np.where(theta == 0.0, np.sign(omega), np.sign(theta)))
            first_rate = rate(theta, side, pull)
            guess = theta + step * omega
            second_rate = rate(guess, side, after)
            new_omega = omega + 0.5 * step * (first_rate + second_rate)
            new_theta = theta + 0.5 * step * (omega + new_omega)
            moving = ~fallen & (~rests | lifts)
            struck = moving & (new_theta * side < 0.0)
            new_omega = np.where(struck, loss * new_omega, new_omega)
            still = struck & (np.abs(new_omega) < 1e-4)
            new_theta, new_omega = np.where(struck, 0.0, new_theta), np.where(still, 0.0, new_omega)
            theta, omega = np.where(moving, new_theta, theta), np.where(moving, new_omega, omega)
            fallen |= np.abs(theta) > 1.5
    return fallen


@pytest.mark.slow
def test_said_probability_equals_share_that_falls():
    """Nine hundred stones in five bins of predicted probability: observed shares agree within 0.1."""
    rng = np.random.default_rng(38)
    message, fell = [], []
    for name, code in (("shafter_1989", "NS"), ("synthetic_jma.csv", "EW"), ("elcentro_1940_ns.csv", "NS")):
        motion = motion_of(read(name), code)
        peak = float(np.abs(motion.horizontal).max())
        width, slenderness, level = rng.uniform(0.15, 0.5, STONES), rng.uniform(2.0, 4.5, STONES), rng.uniform(1.0, 2.5, STONES)
        height, factor = width * slenderness, level * G / slenderness / peak
        for w, h, f in zip(width.tolist(), height.tolist(), factor.tolist(), strict=True):
            scaled = Motion.from_arrays(f * motion.horizontal, motion.dt)
            message.append(sample("rock", Block(w, h), scaled, RockOptions(), 100, seed=1).probability)
        # one true stone and shaking of each, varied as the samples are, but drawn and solved without them
        wide, tall, share, amplitude = (1.0 + half * rng.uniform(-1.0, 1.0, STONES) for half in (0.05, 0.05, 0.1, 0.1))
        fell.append(fixed_step_rocker(motion.horizontal, motion.dt, width * wide, height * tall, share, factor * amplitude))
    message, fell = np.array(message), np.concatenate(fell)
    for low, high in pairwise(np.linspace(0.0, 1.0, 6)):
        members = (message >= low) & ((message < high) | (high == 1.0))
        assert members.sum() >= 25
        assert fell[members].mean() == pytest.approx(message[members].mean(), abs=0.1)

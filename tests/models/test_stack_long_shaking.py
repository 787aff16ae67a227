"""Stones that have fallen, and drums that stand and wobble, are shaken on for minutes and stay where energy lets them."""

import numpy as np
import pytest

from seisblock.bodies.pile.toml import load_pile
from seisblock.models.stack.solve import solve_stack
from seisblock.records import Motion

SECONDS, DT = 150.0, 0.01


def noise(seed, factor=1.0, seconds=SECONDS):
    """Return minutes of noise between 0.3 and 8 Hz along three axes, m/s^2, or the first seconds of it."""
    rng, count = np.random.default_rng(seed), round(SECONDS / DT)
    spectrum = np.fft.rfft(rng.normal(size=(3, count)))
    hertz = np.fft.rfftfreq(count, DT)
    rows = np.fft.irfft(spectrum * ((hertz > 0.3) & (hertz < 8.0)), count)
    rows = factor * np.array([[6.0], [5.0], [2.4]]) * rows / np.abs(rows).max(axis=1, keepdims=True)
    return Motion(rows[:, : round(seconds / DT)], DT)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize(("name", "factor"), [("lantern", 1.0), ("wagata", 2.0)])
def test_fallen_stones_under_long_shaking_create_no_energy(name, factor, seed):
    """Friction split within the step, asked of stones that lie on each other, once pressed without end (1e22 J)."""
    outcome = solve_stack(load_pile(name), noise(seed, factor), law="rigid").outcome
    assert outcome.overturned_any
    assert outcome.created_j < 5e-4 * outcome.lost_j


@pytest.mark.slow
@pytest.mark.parametrize("seed", (1, 3))
def test_drums_under_long_shaking_create_no_energy(seed):
    """Drums wobble on each other for minutes; such friction then gave up to 1e10 J in a step, and 2e-3 of what was lost in all."""
    outcome = solve_stack(load_pile("column"), noise(seed), law="rigid").outcome
    assert outcome.overturned_any
    assert outcome.created_j < 1e-3 * outcome.lost_j

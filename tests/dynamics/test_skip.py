"""A model at rest may pass over samples; nothing else changes."""

from dataclasses import replace

import numpy as np
import pytest

from seisblock._jit import kernel
from seisblock.dynamics import integrate
from seisblock.dynamics.model_api import SKIP
from seisblock.records import Motion
from tests.dynamics.toy_models import SLED, STICK

pytestmark = pytest.mark.kernel


@kernel(SKIP)
def sled_skip(mode, acceleration, gains, sample, p):
    """Pass over the samples at which the sled holds."""
    if mode != STICK:
        return sample
    k = sample
    while k < acceleration.shape[1] and abs(gains[0] * acceleration[0, k]) < p[0]:
        k += 1
    return max(k - 1, sample)


def test_skip_changes_nothing():
    """Path, modes, events and extrema are the same, bit by bit, with and without the short cut."""
    rng = np.random.default_rng(3)
    motion = Motion.from_arrays(np.concatenate([np.zeros(40), rng.normal(size=100)]), 0.02)
    plain = integrate(SLED, motion, [1.5], [0.0, 0.0], STICK)
    quick = integrate(replace(SLED, skip=sled_skip), motion, [1.5], [0.0, 0.0], STICK)
    assert quick.n_events == plain.n_events == 1
    np.testing.assert_array_equal(quick.states, plain.states)
    np.testing.assert_array_equal(quick.modes, plain.modes)
    np.testing.assert_array_equal(quick.extrema, plain.extrema)
    assert quick.end == plain.end


def test_skip_ends_at_last_sample():
    """The short cut stops at the end of the record."""
    quiet = Motion.from_arrays(np.full(30, 0.1), 0.02)
    answer = integrate(replace(SLED, skip=sled_skip), quiet, [1.5], [0.0, 0.0], STICK)
    assert answer.end.sample == 29
    assert answer.n_events == 0
    np.testing.assert_array_equal(answer.modes, STICK)

"""Experiments that the tests of fits share: pulses, and what a block that is known did under them."""

import numpy as np
import pytest

from seisblock import Motion
from seisblock.bodies import from_slenderness
from seisblock.models import rock_verdict
from seisblock.models.rock.options import RockOptions
from seisblock.studies import Observation
from seisblock.studies.fit.fit import fit_block

TRUTH = from_slenderness(0.25, 4.0)
KNOWN = {"block": TRUTH, "scatter": 0.05, "lapse": 0.02, "runs": 4}
"""Arguments of a quick fit, apart from the free parameters."""


def pulse(peak, frequency, dt=0.01):
    """Return one cycle of a sine, m/s^2 and Hz."""
    count = round(1.0 / frequency / dt)
    return Motion.from_arrays(peak * np.sin(2.0 * np.pi * np.arange(count + 1) / count), dt)


def shaken(count, seed, block=TRUTH, scatter=0.05):
    """Return what versions of a block do under so many pulses, each its own record."""
    rng = np.random.default_rng(seed)
    collected = []
    for k in range(count):
        motion = pulse(float(np.exp(rng.uniform(np.log(2.0), np.log(12.0)))), float(np.exp(rng.uniform(np.log(0.5), np.log(4.0)))))
        size, slenderness, bounce, amplitude = 1.0 + scatter * rng.uniform(-1.0, 1.0, 4)
        version = from_slenderness(np.arctan(np.tan(block.slenderness) * slenderness), block.frequency_parameter() / np.sqrt(size))
        verdict = rock_verdict(version, motion, scale=amplitude, options=RockOptions(restitution=min(version.restitution * bounce, 1.0)))
        collected.append(Observation(motion, verdict.overturned, record=f"pulse {k}"))
    return collected


@pytest.fixture(scope="session")
def experiment():
    """Return forty outcomes of the block."""
    return shaken(40, 7)


@pytest.fixture(scope="session")
def slender(experiment):
    """Return a fit of the slenderness alone."""
    return fit_block(experiment, free=["alpha"], **KNOWN)

"""The overturning probability is continuous in every parameter of body, contact and variation."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from seisblock import Block, Motion, motion_of, read
from seisblock.bodies.kinds import of_kind
from seisblock.models.respond.options import RespondOptions
from seisblock.models.rock.options import RockOptions
from seisblock.studies.sampling import ParameterVariation, sample

RUNS, STEP, LARGEST = 60, 1e-7, 0.04
"""Samples, change of a parameter, and the largest change of the probability: chaos moves one or two of 60 samples, a step many."""

BODY = Block(0.3, 0.9, centroid_offset=0.01, inset=0.012)
SLENDERNESS = (0.15 - 0.012 - 0.01) / 0.45
"""Friction at which the narrower side slides instead of rocking."""

VARIATIONS = {
    "size": (0.0, 0.05, 0.3),
    "inset": (0.0, 0.1, 0.6),
    "mu": (0.0, 0.2, 0.6),
    "restitution": (0.0, 0.1, 0.6),
    "amplitude": (0.0, 0.1, 0.6),
    "azimuth_deg": (0.0, 10.0, 170.0),
    "slenderness": (0.0, 0.1),
}


@cache
def shaking(level):
    """Return 10 s of El Centro with a PGA of `level`, m/s^2, as along and across."""
    motion = motion_of(read("elcentro_1940_ns.csv"), "NS")
    along = motion.horizontal[: round(10.0 / motion.dt)]
    along = along * level / np.abs(along).max()
    return Motion(np.array([along, np.roll(along, 40), 0.3 * np.roll(along, 11)]), motion.dt)


def respond_share(body=BODY, variation=ParameterVariation(), **options):
    """Return the probability of the full response near the threshold."""
    return sample("respond", body, shaking(4.2), RespondOptions(**{"mu": 0.6, **options}), RUNS, variation, seed=3).probability


def rock_share(body=BODY, variation=ParameterVariation(), **options):
    """Return the probability of the rocking block near the threshold."""
    return sample("rock", body, shaking(4.0), RockOptions(**options), RUNS, variation, seed=3).probability


def assert_continuous(share, values, step=STEP):
    """Assert that the probability at each value is that a step further on, and that it is neither 0 nor 1 throughout."""
    pairs = [(share(value), share(value + step)) for value in values]
    assert any(0.1 < one < 0.9 for one, _ in pairs), pairs
    assert all(abs(one - other) <= LARGEST for one, other in pairs), pairs


@pytest.mark.parametrize("share", [respond_share, rock_share])
@pytest.mark.parametrize(
    ("name", "values"),
    [("width", (0.28, 0.3)), ("height", (0.9, 1.0)), ("inset", (0.0, 0.012, 0.03)), ("centroid_offset", (-STEP, 0.0, 0.01))],
)
def test_probability_is_continuous_in_sizes(share, name, values):
    """Also where an edge begins to be worn, and where a body changes its heavier side."""
    assert_continuous(lambda value: share(replace(BODY, **{name: value})), values)


@pytest.mark.parametrize(
    ("name", "values"),
    [
        ("mu", (0.25, SLENDERNESS - STEP, SLENDERNESS, 0.6)),
        ("restitution", (0.0, 0.1 - STEP, 0.1, 0.3)),
        ("rocking_restitution", (0.85, 1.0 - STEP)),
    ],
)
def test_probability_of_respond_is_continuous_in_contact(name, values):
    """Also where sliding replaces rocking, where samples of the restitution reach 0, and at an elastic impact."""
    assert_continuous(lambda value: respond_share(**{name: value}), values)


def test_probability_of_rock_is_continuous_in_restitution():
    assert_continuous(lambda value: rock_share(restitution=value), (0.85, 0.9, 1.0 - STEP))


@pytest.mark.parametrize("name", VARIATIONS)
def test_probability_is_continuous_in_each_variation(name):
    """From no variation on."""
    step = 1e-5 if name == "azimuth_deg" else STEP
    assert_continuous(lambda value: respond_share(variation=ParameterVariation(**{name: value})), VARIATIONS[name], step)


@pytest.mark.parametrize("tolerance", [STEP, 0.1])
def test_prior_of_edge_wear_ignores_tolerance_of_known_inset(tolerance):
    """Unmeasured edges have the prior of the kind; only 0 takes them as known."""
    stone = of_kind(Block(0.3, 0.9), "gravestone")
    varied = respond_share(stone, ParameterVariation(inset=tolerance))
    assert varied == respond_share(stone) != respond_share(stone, ParameterVariation(inset=0.0))

"""[Tsutsui]_: the overturning velocity of a rectangular block."""

import math

import numpy as np
import pytest

from seisblock.bodies.block import Block
from seisblock.core.errors import ParameterError
from seisblock.criteria.overturning import ishiyama_velocity, tsutsui_sine_velocity, tsutsui_velocity, velocity_step
from seisblock.models.rock.verdicts import rock_verdict
from seisblock.records import Motion
from seisblock.validation.tsutsui import CASES


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.key)
def test_cases(case):
    """Every statement of the paper has the verdict it claims."""
    assert case.run().verdict == case.status


@pytest.mark.parametrize(("width", "height"), [(1.0, 4.0), (2.5, 10.0), (0.242, 0.726), (1.0, 2.5)])
def test_velocity_step_is_the_threshold_of_the_solver(width, height):
    """An acceleration that lasts a ten-thousandth of 1/p overturns when its impulse exceeds the exact velocity."""
    block = Block(width, height)
    p = block.frequency_parameter()
    exact = velocity_step(block.slenderness, p)
    dt = 1e-6 / p
    k = np.arange(103)
    pulse = Motion.from_arrays(np.where(k < 101, exact / (100.5 * dt), 0.0), dt)
    assert not rock_verdict(block, pulse, scale=0.9999).overturned
    assert rock_verdict(block, pulse, scale=1.0001).overturned


def test_equation_4_lies_4_to_8_percent_below_the_exact_step():
    """For slendernesses from 1/2.5 to 1/4 of table 1, whatever the size."""
    for ratio in (2.5, 3.0, 4.0):
        for width in (0.242, 1.0, 5.0):
            block = Block(width, ratio * width)
            exact = velocity_step(block.slenderness, block.frequency_parameter(9.8), 9.8)
            assert 0.92 < tsutsui_velocity(width, ratio * width, 9.8, cosine=True) / exact < 0.96


def test_equation_3_is_half_a_sine():
    """The area under half a sine of amplitude a and frequency f is a/(pi f)."""
    t = np.linspace(0, 0.25, 20001)
    assert tsutsui_sine_velocity(4.7, 2.0) == pytest.approx(np.trapezoid(4.7 * np.sin(2 * math.pi * 2.0 * t), t), rel=1e-8)


def test_ishiyama_velocity_in_centimetres():
    """10 B/sqrt(H) cm/s, B and H in cm: 24 x 81 cm give 26.67 cm/s."""
    assert ishiyama_velocity(0.24, 0.81) * 100 == pytest.approx(10 * 24 / 9, rel=1e-14)


@pytest.mark.parametrize("sizes", [(0.0, 1.0), (1.0, -1.0), (math.nan, 1.0)])
def test_tsutsui_criteria_reject_invalid_sizes(sizes):
    """Sizes must be positive."""
    with pytest.raises(ParameterError, match="positive"):
        tsutsui_velocity(*sizes)

"""Every factor that gives an observed displacement is found; a jump of the function is no solution."""

from __future__ import annotations

import numpy as np
import pytest

from seisblock.bodies.sliding_base import SlidingBase
from seisblock.cli.bodies.two_layer import two_layer_choice
from seisblock.core.errors import ComponentError, ParameterError
from seisblock.models.jump.options import JumpOptions
from seisblock.models.jump.solve import solve_jump
from seisblock.models.slide.options import SlideOptions
from seisblock.models.slide.solve import solve_slide
from seisblock.readers import read
from seisblock.records import Motion, Record, motion_of
from seisblock.studies.survey.scale_search import jump_displacement, scale_factors, scale_motion, slide_displacement

MOTION = motion_of(read("synthetic_jma.csv"), "EW")
PULSE = Motion.from_arrays(np.concatenate([np.full(101, 4.0), np.zeros(300)]), 0.01, name="pulse")


def test_scale_factor_of_rectangular_pulse_has_closed_form():
    """A pulse a for T moves an object by (a - mu g) a T^2 / (2 mu g): the factor is the root of a quadratic."""
    mu, g, observed = 0.2, 9.80665, 1.0
    # the last sample's fall from a to zero takes one interval more: its impulse is that of half an interval
    a, T = 4.0, 1.0
    factors = scale_factors(slide_displacement(mu, PULSE), observed, PULSE, limit=2.0).scale_factors
    root = (mu * g + np.sqrt((mu * g) ** 2 + 8.0 * mu * g * observed / T**2)) / (2.0 * a)
    assert len(factors) == 1
    assert factors[0].scale == pytest.approx(root, rel=0.01)
    assert factors[0].displacement_m == pytest.approx(observed, rel=1e-8)
    assert factors[0].pga_m_s2 == pytest.approx(4.0 * factors[0].scale)


@pytest.mark.parametrize("largest", [False, True])
def test_scale_factors_recover_factor_of_slip(largest):
    """The displacement of a scaled record is found at that factor, residual and maximum."""
    outcome = solve_slide(0.3, scale_motion(MOTION, 0.8)).outcome
    observed = outcome.max_slip_m if largest else abs(outcome.residual_slip_m)
    factors = scale_factors(slide_displacement(0.3, MOTION, largest=largest), observed, MOTION, limit=2.0, steps=100)
    assert any(f.scale == pytest.approx(0.8, abs=1e-6) for f in factors.scale_factors)
    for factor in factors.scale_factors:
        repeat = solve_slide(0.3, scale_motion(MOTION, factor.scale)).outcome
        assert (repeat.max_slip_m if largest else abs(repeat.residual_slip_m)) == pytest.approx(observed, rel=1e-6)


@pytest.mark.parametrize("first", [False, True])
def test_scale_factors_recover_factor_of_jump(first):
    """The displacement of the Chozu-sha under the record as it is has 1 among its factors."""
    selection = two_layer_choice({})
    chains = solve_jump(selection.block, MOTION, contact=selection.contact, first=first).outcome.chains
    observed = abs(sum(chain.total_displacement_m or 0.0 for chain in chains))
    factors = scale_factors(
        jump_displacement(selection.block, MOTION, options=JumpOptions(contact=selection.contact, first=first)),
        observed,
        MOTION,
        limit=1.5,
        steps=60,
    )
    assert any(f.scale == pytest.approx(1.0, abs=1e-6) and not f.leaps for f in factors.scale_factors)
    assert factors.displacement_at_1_m == pytest.approx(observed)


def test_scale_factors_find_solutions_and_discontinuities():
    """A displacement that rises, falls and leaps has three factors, one of them met by none."""

    def displacement(s: float) -> float:
        return s * (2.0 - s) if s < 2.0 else 1.0

    factors = scale_factors(displacement, 0.75, PULSE).scale_factors
    assert [(round(f.scale, 8), f.leaps) for f in factors] == [(0.5, False), (1.5, False), (2.0, True)]


def test_unreachable_displacement_has_no_factor():
    """The largest displacement of the scan is reported instead."""
    factors = scale_factors(slide_displacement(0.2, PULSE), 1e3, PULSE)
    assert factors.scale_factors == ()
    assert factors.largest_at_scale == 3.0
    assert factors.largest_displacement_m == pytest.approx(solve_slide(0.2, scale_motion(PULSE, 3.0)).outcome.residual_slip_m * -1.0)


def test_scale_factors_reject_invalid_input():
    """A displacement, limit or number of steps that is not positive, friction that is none, a vertical that is not there."""
    for words, message in (
        ((0.0, 3.0, 10), "observed displacement must be positive"),
        ((0.1, -1.0, 10), "largest factor must be positive"),
        ((0.1, 3.0, 0), "number of steps must be an integer of at least 1"),
    ):
        with pytest.raises(ParameterError, match=message):
            scale_factors(lambda s: s, words[0], PULSE, limit=words[1], steps=words[2])
    with pytest.raises(ParameterError):
        slide_displacement(-0.1, PULSE)
    north = read("synthetic_jma.csv").component("NS")
    with pytest.raises(ComponentError, match="no vertical component"):
        slide_displacement(0.3, motion_of(Record((north,), 0.01), "NS"), options=SlideOptions(vertical=1.0))


@pytest.mark.parametrize("factor", [0.3, 1.0, 1.7])
def test_slip_at_factor_equals_scaled_record(factor):
    """Only the end is followed, with the vertical motion scaled alike: the numbers of `solve_slide` on the record times the factor."""
    base = SlidingBase(0.15, 0.1, 4.0)
    outcome = solve_slide(base, scale_motion(MOTION, factor), vertical=0.5).outcome
    assert outcome.max_slip_m > 0.0
    assert slide_displacement(base, MOTION, options=SlideOptions(vertical=0.5))(factor) == pytest.approx(
        abs(outcome.residual_slip_m), rel=1e-10
    )
    assert slide_displacement(base, MOTION, largest=True, options=SlideOptions(vertical=0.5))(factor) == pytest.approx(
        outcome.max_slip_m, rel=1e-10
    )

"""Properties of a block on corner springs that hold whatever its sizes, springs and damping."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from seisblock.bodies.spring_block import SpringBlock
from seisblock.criteria.uplift import harmonic_uplift_ratio, square_base_modes
from seisblock.models.uplift.harmonic import corner_response, corner_response_direct, shaking_direction, uplift_thresholds
from seisblock.models.uplift.minima import uplift_minima
from seisblock.models.uplift.modes import natural_modes
from seisblock.models.uplift.solve import solve_uplift
from seisblock.records.motion import Motion
from tests.models.uplift_motions import shaking

RATIO = st.floats(0.2, 5.0)
DAMPING = st.floats(0.005, 0.5)
ANGLE = st.floats(-180.0, 180.0)


def blocks():
    """Return blocks of any base, kx and ky unequal."""
    return st.builds(
        lambda a, b, h, f, x, y, zeta: SpringBlock(a, b, h, 1000.0, tuple(250.0 * (2 * np.pi * f * r) ** 2 for r in (x, y, 1.0)), zeta),
        st.floats(0.3, 3.0),
        st.floats(0.3, 3.0),
        st.floats(0.3, 5.0),
        st.floats(2.0, 15.0),
        RATIO,
        RATIO,
        DAMPING,
    )


@given(RATIO, RATIO)
def test_natural_frequencies_equal_eigenvalues(alpha, beta):
    """The paper's frequencies of a square base are scipy's, to 1e-12."""
    closed = np.sort(square_base_modes(alpha, beta).frequency_ratios)
    np.testing.assert_allclose(natural_modes(SpringBlock.from_ratios(alpha, beta)).frequencies_hz, closed, rtol=1e-12)


@given(RATIO, RATIO, DAMPING, ANGLE, ANGLE, st.floats(0.05, 8.0), st.integers(1, 4))
def test_eq_27_equals_modal_superposition(alpha, beta, damping, phi, rho, ratio, corner):
    """The corrected closed form gives the threshold of each corner, to 1e-10 of the largest response."""
    closed = harmonic_uplift_ratio([ratio], alpha=alpha, beta=beta, damping=damping, phi_deg=phi, rho_deg=rho, corner=corner)
    all_cases = uplift_thresholds(SpringBlock.from_ratios(alpha, beta, damping=damping), [ratio], phi_deg=phi, rho_deg=rho)[:, 0]
    # where the parts of a corner's motion cancel, their round-off is all that is left
    assert abs(1.0 / closed[0] ** 2 - 1.0 / all_cases[corner - 1] ** 2) <= 1e-10 / all_cases.min() ** 2


@given(blocks(), ANGLE, ANGLE, st.floats(0.1, 100.0))
def test_modal_superposition_equals_direct_solution(body, phi, rho, omega):
    """For any base the sum over modes is the solution of the complex linear system."""
    direction = shaking_direction(phi, rho)
    direct = corner_response_direct(body, [omega], direction)
    np.testing.assert_allclose(corner_response(body, [omega], direction), direct, rtol=0, atol=1e-10 * np.abs(direct).max())


@given(blocks(), ANGLE, ANGLE)
@settings(max_examples=30)
def test_minima_bound_the_uplift_curve(body, phi, rho):
    """The exact minima bound the curve from below, with its values at zero and at the end of the search."""
    minima = uplift_minima(body, phi_deg=phi, rho_deg=rho, frequency_range=(0.0, 10.0))
    curve = uplift_thresholds(body, np.linspace(0.0, 10.0, 2001), phi_deg=phi, rho_deg=rho).min(axis=0)
    lowest = min([curve[0], curve[-1], *(m.acceleration_ratio for m in minima)])
    assert curve.min() >= lowest * (1.0 - 1e-9)


@given(blocks(), st.integers(0, 1000))
@settings(max_examples=15, deadline=None)
def test_uplifted_corners_carry_no_force(body, seed):
    """Whatever the shaking did, the base stays flat and no corner in the air is pulled."""
    pulse = shaking(1.0, 0.01, seed=seed).acceleration
    response = solve_uplift(body, Motion(np.hstack([pulse, np.zeros((3, 200))]), 0.01))
    u = np.column_stack([response[f"uplift_{i}"] for i in (1, 2, 3, 4)])
    force = np.column_stack([response[f"contact_force_{i}"] for i in (1, 2, 3, 4)])
    assert np.abs(force[u > 1e-9]).max(initial=0.0) == 0.0
    assert np.abs(u[:, 0] - u[:, 1] - u[:, 2] + u[:, 3]).max() < 1e-10


@given(blocks(), st.integers(0, 1000))
@settings(max_examples=15, deadline=None)
def test_uplift_scale_separates_contact_from_uplift(body, seed):
    """A little below the scale that the answer names nothing lifts, a little above something does."""
    motion = shaking(2.0, 0.01, seed=seed)
    scale = solve_uplift(body, motion).outcome.uplift_scale
    for factor, lifts in ((0.999, False), (1.001, True)):
        assert solve_uplift(body, Motion(motion.acceleration * (scale * factor), motion.dt)).outcome.uplifts is lifts

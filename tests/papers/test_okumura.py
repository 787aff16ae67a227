"""Okumura et al. (1987): natural modes and harmonic uplift of a block on corner springs."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import eigh

from seisblock.bodies.spring_block import SpringBlock, corner_jacobian, mass_matrix, stiffness_matrix
from seisblock.core.errors import BodyError, ParameterError
from seisblock.criteria.uplift import harmonic_uplift_ratio, square_base_modes
from seisblock.models.uplift.harmonic import shaking_direction, uplift_thresholds
from seisblock.models.uplift.minima import lowest_uplift_threshold, uplift_minima
from seisblock.models.uplift.modes import natural_modes
from seisblock.validation.case import EXACT, Case
from seisblock.validation.okumura import CASES

OBLIQUE = [(0.0, 90.0), (45.0, 45.0), (30.0, 60.0), (200.0, 130.0), (0.0, 0.0)]


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.key)
def test_statement_of_the_paper(case: Case):
    """Every statement of sections 3, 5 and 6 holds, or differs as explained."""
    result = case.run()
    assert result.verdict == case.status, f"{case.quantity}: expected {result.expected}, computed {result.computed}"


def test_eq_4_couplings_are_alpha_over_two():
    """The stiffness matrix summed over corners is (4) with couplings alpha/2, which the print halves."""
    body = SpringBlock.from_ratios(1.3, 0.6, gamma=1.4)
    alpha, gamma = body.alpha, body.gamma
    wx2, wy2, wz2 = (w * w for w in body.omega)
    expected = np.diag([wx2, wy2, wz2, (wy2 * alpha**2 + wz2) / 4, (wx2 * alpha**2 + wz2 * gamma**2) / 4, (wx2 + wy2 * gamma**2) / 4])
    expected[0, 4] = expected[4, 0] = -alpha / 2 * wx2
    expected[1, 3] = expected[3, 1] = alpha / 2 * wy2
    np.testing.assert_allclose(stiffness_matrix(body), expected, rtol=EXACT, atol=1e-12)


def test_eq_23_corner_4():
    """Corner 4 moves up by z + b theta_y / 2 - b theta_x / 2 on a square base."""
    np.testing.assert_array_equal(corner_jacobian(SpringBlock.from_ratios(1.0, 1.0))[3, 2], [0, 0, 1, -0.5, 0.5, 0])


def test_eq_9_modal_matrix():
    """Modes 1 and 5 of (9), with D1 and D2 of (9b, c), are eigenvectors, and (22) their modal masses."""
    body = SpringBlock.from_ratios(1.7, 0.9)
    square = square_base_modes(1.7, 0.9)
    mass, stiffness = mass_matrix(body), stiffness_matrix(body)
    for shape, ratio, modal_mass in (
        ([1, 0, 0, 0, -square.d2, 0], square.c1, square.m1),
        ([0, 1, 0, square.d2, 0, 0], square.c1, square.m1),
        ([-square.d1, 0, 0, 0, 1, 0], square.c2, square.m5),
        ([0, square.d1, 0, 1, 0, 0], square.c2, square.m5),
    ):
        q = np.array(shape)
        np.testing.assert_allclose(stiffness @ q, (ratio * body.omega[2]) ** 2 * (mass @ q), rtol=1e-11, atol=1e-11)
        assert q @ mass @ q == pytest.approx(modal_mass, rel=EXACT)


def test_modes_of_any_base_are_those_of_the_whole_matrix():
    """Solving the four uncoupled groups gives what one eigenvalue problem of order six gives."""
    body = SpringBlock(1.2, 0.8, 2.0, 500.0, (2e4, 3e4, 5e4))
    modes = natural_modes(body)
    full = np.sqrt(eigh(stiffness_matrix(body), mass_matrix(body), eigvals_only=True))
    np.testing.assert_allclose(modes.omega, full, rtol=1e-12)
    np.testing.assert_allclose(modes.shapes.T @ mass_matrix(body) @ modes.shapes, np.eye(6), atol=1e-12)


def test_static_settlement():
    """At rest the block sinks by m g / 4 kz."""
    body = SpringBlock(1.0, 1.0, 1.0, 800.0, (1e4, 1e4, 2e4))
    assert body.static_settlement(9.8) == pytest.approx(800.0 * 9.8 / 8e4, rel=EXACT)
    assert body.static_settlement(9.8) == pytest.approx(9.8 / body.omega[2] ** 2, rel=EXACT)


@pytest.mark.parametrize(("phi", "rho"), OBLIQUE)
def test_minima_are_exact(phi, rho):
    """No frequency of a fine grid near a minimum lifts the block more easily, and each minimum is one."""
    body = SpringBlock.from_ratios(1.0, 0.707)
    minima = uplift_minima(body, phi_deg=phi, rho_deg=rho)
    assert minima
    for minimum in minima:
        nearby = minimum.frequency_ratio * (1.0 + np.linspace(-1e-3, 1e-3, 401))
        smallest = uplift_thresholds(body, nearby, phi_deg=phi, rho_deg=rho).min(axis=0)
        assert minimum.acceleration_ratio <= smallest.min() * (1.0 + 1e-12)


@pytest.mark.parametrize(("phi", "rho"), OBLIQUE)
def test_no_minimum_is_missed(phi, rho):
    """A grid of 40 000 frequencies has as many local minima as are reported."""
    body = SpringBlock.from_ratios(1.0, 0.707)
    ratio = np.linspace(0.01, 5.0, 40_000)
    curve = uplift_thresholds(body, ratio, phi_deg=phi, rho_deg=rho).min(axis=0)
    on_grid = np.flatnonzero((curve[1:-1] < curve[:-2]) & (curve[1:-1] < curve[2:])) + 1
    reported = [m for m in uplift_minima(body, phi_deg=phi, rho_deg=rho) if m.frequency_ratio < 5.0]
    np.testing.assert_allclose([m.frequency_ratio for m in reported], ratio[on_grid], atol=2e-4)


def test_undamped_resonance_lifts_at_any_amplitude():
    """Without damping the minima are the natural frequencies, at zero; (27) and modal superposition agree on them."""
    body = SpringBlock.from_ratios(1.0, 0.5, damping=0.0)
    modes = natural_modes(body)
    minima = uplift_minima(body)
    assert [m.acceleration_ratio for m in minima] == [0.0, 0.0]
    np.testing.assert_allclose([m.frequency_ratio for m in minima], [1.0, modes.omega[-1] / modes.omega_1], rtol=1e-12)
    assert uplift_thresholds(body, [1.0]).min() < 1e-12
    assert harmonic_uplift_ratio([1.0], alpha=1.0, beta=0.5, damping=0.0)[0] < 1e-12


def test_least_uplift_keeps_to_its_range():
    """Within a range that holds no minimum the least A/g is at one of its ends."""
    body = SpringBlock.from_ratios(1.0, 0.707)
    inside = lowest_uplift_threshold(body, frequency_range=(2.0, 4.0))
    assert inside.acceleration_ratio == pytest.approx(0.6850556, abs=1e-6)
    at_end = lowest_uplift_threshold(body, frequency_range=(1.2, 1.5))
    assert at_end.frequency_ratio == pytest.approx(1.2)
    assert at_end.mode == ""


def test_rotating_a_square_base_by_a_right_angle_renames_its_corners():
    """Shaking towards y instead of x lifts the corners of a square base in turned order."""
    body = SpringBlock.from_ratios(1.5, 0.8)
    ratio = np.linspace(0.1, 5.0, 50)
    along = uplift_thresholds(body, ratio, phi_deg=20.0, rho_deg=70.0)
    rotated = uplift_thresholds(body, ratio, phi_deg=110.0, rho_deg=70.0)
    # (x, y) -> (-y, x): corner (+,+) goes to (-,+), (+,-) to (+,+), (-,+) to (-,-), (-,-) to (+,-)
    np.testing.assert_allclose(rotated[[2, 0, 3, 1]], along, rtol=1e-10)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ({"width": 0.0}, "width of the block must be positive"),
        ({"height": float("nan")}, "height of the block must be positive"),
        ({"mass": -1.0}, "mass of the block must be positive"),
        ({"stiffness": (1e4, 0.0, 1e4)}, "stiffness ky of a corner must be positive"),
        ({"stiffness": (1e4, 1e4)}, "three numbers"),
        ({"damping": 1.0}, r"damping ratio must lie in \[0, 1\)"),
        ({"damping": -0.1}, r"damping ratio must lie in \[0, 1\)"),
    ],
)
def test_spring_block_rejects_invalid_body(words, message):
    """A size, mass or stiffness that is not positive, or a damping outside [0, 1), is one sentence."""
    good = {"width": 1.0, "depth": 1.0, "height": 1.0, "mass": 100.0, "stiffness": (1e4, 1e4, 1e4), "damping": 0.05}
    with pytest.raises(BodyError, match=message):
        SpringBlock(**{**good, **words})


def test_uplift_rejects_invalid_direction_and_corner():
    """An angle that is not a number and a fifth corner are one sentence each."""
    with pytest.raises(ParameterError, match="rho must be a finite number, found nan degrees"):
        shaking_direction(0.0, float("nan"))
    with pytest.raises(ParameterError, match="`corner` must be 1, 2, 3 or 4, found 5"):
        uplift_minima(SpringBlock.from_ratios(1.0, 1.0), corner=5)
    with pytest.raises(ParameterError, match="`corner` must be 1, 2, 3 or 4, found 0"):
        harmonic_uplift_ratio([1.0], alpha=1.0, beta=1.0, damping=0.05, corner=0)
    with pytest.raises(ParameterError, match="alpha must be positive"):
        square_base_modes(0.0, 1.0)
    with pytest.raises(ParameterError, match="must be finite and zero or more"):
        uplift_thresholds(SpringBlock.from_ratios(1.0, 1.0), [-1.0])

"""Validation of natural modes: section 3 of Okumura et al. (1987)."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from seisblock.bodies.spring_block import SpringBlock
from seisblock.core.typing import FloatArray
from seisblock.criteria.uplift import square_base_modes
from seisblock.models.uplift.modes import natural_modes
from seisblock.validation.case import EXACT, Case

ALPHAS = np.geomspace(0.05, 10.0, 41)
BETAS = np.geomspace(0.05, 5.0, 41)
ROOT3 = math.sqrt(3.0)
NEAR_ZERO = 1e-7
"""Substitute for zero in a limit; the error is of second order."""

COUNT_TOLERANCE = 0.0
"""Tolerance of a number of violations: exact."""


def dimensionless(
    key: str, locator: str, quantity: str, expected: float, tolerance: float, compute: Callable[[], float], **kwargs: Any
) -> Case:
    """Return a dimensionless case of this paper; `kwargs` are keywords of :class:`Case`."""
    return Case(f"okumura-{key}", f"[Okumura1987]_ {locator}", quantity, "1", expected, tolerance, compute, **kwargs)


def steps_not_rising(values: FloatArray) -> float:
    """Return the number of steps along the last axis that do not rise."""
    return float(np.count_nonzero(np.diff(values) <= 0.0))


def _frequencies(index: int) -> FloatArray:
    """Return omega_i / omega_V over the grid of alphas (rows) and betas (columns)."""
    return np.array([[square_base_modes(a, b).frequency_ratios[index - 1] for b in BETAS] for a in ALPHAS])


def _second_against_alpha() -> float:
    """Return how many betas violate statement 7: omega_5 falls with alpha below beta = sqrt(3)/2 and rises above ([Okumura1987]_)."""
    omega_5 = _frequencies(5)
    expected_sign = np.where(BETAS < ROOT3 / 2.0, -1.0, 1.0)
    return float(np.count_nonzero((np.diff(omega_5, axis=0) * expected_sign).min(axis=0) <= 0.0))


def _spread_against_alpha() -> float:
    """Return how many steps in alpha do not reduce the range of omega_1 over beta."""
    omega_1 = _frequencies(1)
    return steps_not_rising(-(omega_1[:, -1] - omega_1[:, 0]))


def _eigen_against_closed_form() -> float:
    """Return the largest relative difference between [Okumura1987]_ eqs. (7), (8) and numerical eigenvalues."""
    worst = 0.0
    for alpha in (0.2, 0.5, 1.0, 2.0, 5.0):
        for beta in (0.1, 0.5, 0.707, 1.0, 1.8, 3.0):
            eigenvalues = np.array(natural_modes(SpringBlock.from_ratios(alpha, beta)).frequencies_hz)
            closed = np.sort(square_base_modes(alpha, beta).frequency_ratios)
            worst = max(worst, float(np.abs(eigenvalues / closed - 1.0).max()))
    return worst


MODES = (
    dimensionless("7-8", "eqs. (7), (8)", "closed-form frequencies against numerical eigenvalues", 0.0, EXACT, _eigen_against_closed_form),
    dimensionless(
        "modes-1a",
        "section 3, statement 1",
        "omega_1/omega_V at beta = 0",
        0.0,
        2 * NEAR_ZERO,
        lambda: square_base_modes(1.0, NEAR_ZERO).c1,
    ),
    dimensionless(
        "modes-1b",
        "section 3, statement 1",
        "number of steps in beta at which omega_1 does not rise",
        0.0,
        COUNT_TOLERANCE,
        lambda: steps_not_rising(_frequencies(1)),
    ),
    dimensionless(
        "modes-2a",
        "section 3, statement 2",
        "number of steps in beta at which omega_5 does not rise",
        0.0,
        COUNT_TOLERANCE,
        lambda: steps_not_rising(_frequencies(5)),
    ),
    dimensionless(
        "modes-2b",
        "section 3, statement 2",
        "largest deviation of omega_5/omega_V from sqrt(3) at beta = sqrt(3)/2, all alpha",
        0.0,
        EXACT,
        lambda: max(abs(square_base_modes(float(a), ROOT3 / 2.0).c2 - ROOT3) for a in ALPHAS),
    ),
    dimensionless(
        "modes-3", "section 3, statement 3", "omega_4/(beta omega_V)", ROOT3, EXACT, lambda: square_base_modes(1.7, 0.4).torsion / 0.4
    ),
    dimensionless(
        "modes-4a",
        "section 3, statement 4",
        "omega_1/omega_V, alpha to 0, beta = 2.5",
        ROOT3,
        EXACT,
        lambda: square_base_modes(NEAR_ZERO, 2.5).c1,
    ),
    dimensionless(
        "modes-4b",
        "section 3, statement 4",
        "omega_1/omega_V, alpha to 0, beta = 0.8",
        0.8,
        EXACT,
        lambda: square_base_modes(NEAR_ZERO, 0.8).c1,
    ),
    dimensionless(
        "modes-5a",
        "section 3, statement 5",
        "number of steps in alpha at which omega_1 does not fall",
        0.0,
        COUNT_TOLERANCE,
        lambda: steps_not_rising(-_frequencies(1).T),
    ),
    dimensionless(
        "modes-5b",
        "section 3, statement 5",
        "number of steps in alpha at which the range of omega_1 over beta does not decrease",
        0.0,
        COUNT_TOLERANCE,
        _spread_against_alpha,
    ),
    dimensionless(
        "modes-6a",
        "section 3, statement 6",
        "omega_5/omega_V, alpha to 0, beta = 0.8",
        ROOT3,
        EXACT,
        lambda: square_base_modes(NEAR_ZERO, 0.8).c2,
        note="3 in the scan, to be read as sqrt(3)",
    ),
    dimensionless(
        "modes-6b",
        "section 3, statement 6",
        "omega_5/omega_V, alpha to 0, beta = 2.5",
        2.5,
        EXACT,
        lambda: square_base_modes(NEAR_ZERO, 2.5).c2,
    ),
    dimensionless(
        "modes-7",
        "section 3, statement 7",
        "number of betas at which omega_5 does not vary with alpha as stated",
        0.0,
        COUNT_TOLERANCE,
        _second_against_alpha,
    ),
)
"""Cases of section 3."""

"""Uplift of a block on corner springs under harmonic shaking: closed forms of [Okumura1987]_ for a square base.

Square base (gamma = 1), equal horizontal springs, equal modal damping, small rotations, steady state. Bases of any
shape are solved by :mod:`seisblock.models.uplift.harmonic`; the two are verified against each other.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seisblock.bodies.spring_block import CORNER_SIGNS
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import ParameterError
from seisblock.core.typing import ArrayLike, FloatArray

UNDAMPED_RESONANCE = 1e-150
"""Replacement of zero in the denominator of an undamped resonance, so that a mode that is not excited contributes nothing."""


@dataclass(frozen=True, repr=False)
class SquareBaseModes(DisplayMixin):
    """Natural modes of a block on a square base, frequencies over omega_V ([Okumura1987]_ eqs. (7)-(9), (22)).

    Parameters
    ----------
    c1, c2 : float
        Ratios of the rocking frequencies omega_1 = omega_2 and omega_5 = omega_6 over omega_V.
    torsion : float
        Ratio of the frequency omega_4 to omega_V.
    d1, d2 : float
        Entries of the modal matrix, ratios of displacements: mode 1 is x = 1, b theta_y = -d2; mode 5 is x = -d1, b theta_y = 1.
    m1, m5 : float
        Ratios of the modal masses of modes 1 and 5 to the mass.
    """

    c1: float
    c2: float
    torsion: float
    d1: float
    d2: float
    m1: float
    m5: float

    @property
    def frequency_ratios(self) -> tuple[float, float, float, float, float, float]:
        """Frequencies omega_1 to omega_6 over omega_V, in the order of [Okumura1987]_ eqs. (7)-(9)."""
        return self.c1, self.c1, 1.0, self.torsion, self.c2, self.c2


def square_base_modes(alpha: float, beta: float) -> SquareBaseModes:
    """Return the natural modes of a block on a square base.

    Parameters
    ----------
    alpha : float
        Ratio of height to side length, H/b, positive.
    beta : float
        Ratio of the horizontal to the vertical circular frequency, positive.

    Returns
    -------
    SquareBaseModes

    Raises
    ------
    ParameterError
        If a ratio is not positive.

    Notes
    -----
    [Okumura1987]_ eqs. (7), (8), (9) and (22). Differs: (22a) contains D2 squared; (22b) is M3 = 1. The smaller root of (8) and D2 are
    computed without the cancellation of the printed forms: C1^2 C2^2 = 3 beta^2 / (1 + alpha^2), and
    the orthogonality of modes 1 and 5 gives D2 = -12 D1 / (1 + alpha^2).

    Examples
    --------
    >>> from seisblock.criteria import square_base_modes
    >>> round(square_base_modes(2.0, 3**0.5 / 2).c2, 12)
    1.732050807569
    """
    checks.positive("alpha", alpha)
    checks.positive("beta", beta)
    a2, b2 = alpha**2, beta**2
    s = 4.0 * a2 * b2 + b2 + 3.0
    root = math.sqrt(16.0 * a2**2 * b2**2 + b2**2 + 8.0 * a2 * b2**2 + 12.0 * a2 * b2 - 6.0 * b2 + 9.0)
    # c1 from the product of the roots: their printed difference cancels
    c2_squared = (s + root) / (2.0 * (1.0 + a2))
    c1_squared = 6.0 * b2 / (s + root)
    d1 = -alpha * b2 / (2.0 * (b2 - c2_squared))
    d2 = -12.0 * d1 / (1.0 + a2)
    inertia = (1.0 + a2) / 12.0
    return SquareBaseModes(
        math.sqrt(c1_squared), math.sqrt(c2_squared), math.sqrt(3.0) * beta, d1, d2, 1.0 + inertia * d2**2, d1**2 + inertia
    )


def harmonic_uplift_ratio(
    frequency_ratio: ArrayLike,
    *,
    alpha: float,
    beta: float,
    damping: float,
    phi_deg: float = 0.0,
    rho_deg: float = 90.0,
    corner: int | None = None,
) -> FloatArray:
    """Return the minimum A/g that lifts a corner of a square base in the steady state.

    Parameters
    ----------
    frequency_ratio : (n,) array
        Frequency of the shaking over the first rocking frequency, theta/omega_1.
    alpha, beta : float
        Ratios of height to side length and of horizontal to vertical circular frequency.
    damping : float
        Modal damping ratio h, the same in each mode.
    phi_deg, rho_deg : float, degrees
        Direction of the shaking: azimuth from x towards y, and angle from the vertical.
    corner : int or None
        Corner 1 to 4; None for the minimum over all corners. The paper uses corner 4 only, which under a vertical component
        (0 < rho < 90) gives up to 3.6 times the minimum inside its figures (A/g up to 1).

    Returns
    -------
    (n,) array
        A/g; infinite if no amplitude lifts the corner.

    Raises
    ------
    ParameterError
        If a ratio is not positive, or the corner does not exist.

    Notes
    -----
    [Okumura1987]_ eq. (27), derived again from (23), (25) and (26). With s = sin(rho) (-/+ cos(phi) -/+ sin(phi)) with the signs of the
    corner, e_j = C_j^2 - (C_1 r)^2, d_j = 2 h C_j C_1 r and P_jk = (e_j e_k + d_j d_k) / (N_j N_k), N_j = e_j^2 + d_j^2:

    (g/A)^2 = s^2/4 [(D2/M1)^2 P_11 + 2 D1 D2/(M1 M5) P_15 + (D1/M5)^2 P_55]
    - s cos(rho) [D2/M1 P_13 + D1/M5 P_53] + cos(rho)^2 P_33

    Differs from the printed (27), which lacks the square root, the plus before the product of modes 1 and 5, a square in its
    denominators, squares M1 and M5 and subtracts mode 5 in the middle bracket, and ends in -cos(rho) instead of cos(rho)^2 / N_3.

    Examples
    --------
    >>> from seisblock.criteria import harmonic_uplift_ratio
    >>> harmonic_uplift_ratio([2.78225], alpha=1.0, beta=0.6**0.5, damping=0.05).round(6)
    array([0.676683])
    """
    from scipy.special import cosdg, sindg

    modes = square_base_modes(alpha, beta)
    forcing_squared = (modes.c1 * np.asarray(frequency_ratio, dtype=np.float64)) ** 2
    # modes 1, 5 and 3, in the order of the weights below
    c = np.array([modes.c1, modes.c2, 1.0])[:, None]
    e = c**2 - forcing_squared
    d = 2.0 * damping * c * np.sqrt(forcing_squared)
    e = np.where((e == 0.0) & (d == 0.0), UNDAMPED_RESONANCE, e)
    # normalised transfer functions: products of u and v stay finite near an undamped resonance
    with np.errstate(divide="ignore"):
        scale = 1.0 / np.hypot(e, d)
        u, v = e * scale, d * scale
        w1, w5, w3 = scale
        p15, p13, p53 = (u[j] * u[k] + v[j] * v[k] for j, k in ((0, 1), (0, 2), (1, 2)))
        w1, w5 = w1 * modes.d2 / modes.m1, w5 * modes.d1 / modes.m5
        vertical = cosdg(rho_deg)
        thresholds = []
        for sx, sy in _corner_signs(corner):
            s = -sindg(rho_deg) * (sx * cosdg(phi_deg) + sy * sindg(phi_deg))
            gain_squared = 0.25 * s**2 * (w1**2 + 2.0 * w1 * w5 * p15 + w5**2)
            # horizontal shaking: skip the vertical terms, which may be infinite times zero
            if vertical != 0.0:
                gain_squared = gain_squared - s * vertical * w3 * (w1 * p13 + w5 * p53) + (vertical * w3) ** 2
            thresholds.append(np.where(gain_squared > 1.0 / UNDAMPED_RESONANCE, 0.0, 1.0 / np.sqrt(np.maximum(gain_squared, 0.0))))
    minimum: FloatArray = np.min(thresholds, axis=0)
    return minimum


def _corner_signs(corner: int | None) -> tuple[tuple[int, int], ...]:
    """Return the signs of the coordinates of one corner, or of all."""
    if corner is None:
        return CORNER_SIGNS
    if corner not in (1, 2, 3, 4):
        raise ParameterError("`corner` must be 1, 2, 3 or 4, found {corner}", corner=corner)
    return (CORNER_SIGNS[corner - 1],)

"""Harmonic uplift thresholds: amplitude of steady-state harmonic shaking that lifts a corner of a block on corner springs.

Linear model: small rotations and all corners in contact up to the instant of uplift. The threshold is exact; the motion after uplift is
not covered.
"""

from __future__ import annotations

from typing import Literal, get_args

import numpy as np

from seisblock.bodies.spring_block import SpringBlock, corner_jacobian, dashpot_matrix, mass_matrix, stiffness_matrix
from seisblock.core import checks
from seisblock.core.errors import ParameterError
from seisblock.core.typing import ArrayLike, ComplexArray, FloatArray
from seisblock.models.uplift.modes import Modes, natural_modes

Damping = Literal["modal", "dashpots"]
"""Equal modal damping ratio h, as in the paper, or corner dashpots, as in the response to records."""

DAMPINGS: tuple[Damping, ...] = get_args(Damping)

UNDAMPED_RESONANCE = 1e-150
"""Replacement for zero in the denominator at an undamped resonance: a mode without participation contributes 0 instead of NaN."""


def shaking_direction(phi_deg: float, rho_deg: float) -> FloatArray:
    """Return the unit vector of the shaking, (3,), for azimuth phi from x to y and angle rho from z ([Okumura1987]_ eq. (10)).

    Raises
    ------
    ParameterError
        If an angle is not a finite number.
    """
    from scipy.special import cosdg, sindg

    checks.finite("phi", phi_deg, "degrees")
    checks.finite("rho", rho_deg, "degrees")
    return np.array([cosdg(phi_deg) * sindg(rho_deg), sindg(phi_deg) * sindg(rho_deg), cosdg(rho_deg)])


def participation(body: SpringBlock, modes: Modes, direction: ArrayLike) -> FloatArray:
    """Return the participation of each mode in the uplift of each corner, (4, 6), rad^2/s^2: numerators of [Okumura1987]_ eq. (15)."""
    corner_lifts = corner_jacobian(body)[:, 2] @ modes.shapes
    forcing = modes.shapes[:3].T @ np.asarray(direction, dtype=np.float64)
    parts: FloatArray = -(body.omega[2] ** 2) * corner_lifts * forcing
    return parts


def transfer(modes: Modes, damping: float, omega: FloatArray) -> ComplexArray:
    """Return 1 / (omega_j^2 - theta^2 + 2 i h omega_j theta), (6, n), s^2: denominators of [Okumura1987]_ eq. (15)."""
    w = modes.omega[:, None]
    # factored difference of squares: no cancellation near resonance
    real = (w - omega) * (w + omega)
    imaginary = 2.0 * damping * w * omega
    real = np.where((real == 0.0) & (imaginary == 0.0), UNDAMPED_RESONANCE, real)
    return np.reciprocal(real + 1j * imaginary)


def corner_response(body: SpringBlock, omega: ArrayLike, direction: ArrayLike) -> ComplexArray:
    """Return the complex vertical displacement of the corners by modal superposition, over g / omega_z^2 and per A/g.

    Parameters
    ----------
    body : SpringBlock
        Its damping is the modal damping ratio h.
    omega : (n,) array, rad/s
        Circular frequency theta of the shaking.
    direction : (3,) array
        Unit vector of the shaking.

    Returns
    -------
    (4, n) complex array
        [Okumura1987]_ eqs. (11) to (15) inserted into (23). A corner lifts where A/g times the modulus exceeds 1.
    """
    modes = natural_modes(body)
    response: ComplexArray = participation(body, modes, direction) @ transfer(modes, body.damping, np.asarray(omega, dtype=np.float64))
    return response


def corner_response_direct(body: SpringBlock, omega: ArrayLike, direction: ArrayLike, *, damping: Damping = "modal") -> ComplexArray:
    """Return the complex corner response of :func:`corner_response` from one linear system per frequency.

    (K - theta^2 M + i theta C) q = -f of [Okumura1987]_ eqs. (3), (10), with C for equal modal damping ratios or for corner dashpots.
    """
    theta = np.asarray(omega, dtype=np.float64)[:, None, None]
    mass, stiffness = mass_matrix(body), stiffness_matrix(body)
    if damping == "modal":
        modes = natural_modes(body)
        weighted = mass @ modes.shapes
        dashpots = weighted @ np.diag(2.0 * body.damping * modes.omega) @ weighted.T
    else:
        dashpots = dashpot_matrix(body)
    load = np.zeros((theta.size, 6, 1))
    load[:, :3, 0] = direction
    q = np.linalg.solve(stiffness - theta**2 * mass + 1j * theta * dashpots, -load)
    return np.asarray(body.omega[2] ** 2 * (corner_jacobian(body)[:, 2] @ q[:, :, 0].T), dtype=np.complex128)


def lifting_amplitude(response: ComplexArray) -> FloatArray:
    """Return A/g at uplift for a corner response ([Okumura1987]_): infinite without response, 0 at an undamped resonance."""
    amplitude = np.abs(response)
    with np.errstate(divide="ignore"):
        return np.where(amplitude > 1.0 / UNDAMPED_RESONANCE**0.5, 0.0, 1.0 / amplitude)


def uplift_thresholds(
    body: SpringBlock,
    frequency_ratio: ArrayLike,
    *,
    phi_deg: float = 0.0,
    rho_deg: float = 90.0,
    damping: Damping = "modal",
) -> FloatArray:
    """Return the smallest A/g that lifts each corner in the steady state ([Okumura1987]_).

    Parameters
    ----------
    body : SpringBlock
        With a square or rectangular base.
    frequency_ratio : (n,) array
        Frequency of the shaking over the first rocking frequency, theta/omega_1.
    phi_deg, rho_deg : float, degrees
        Direction of the shaking: azimuth from x towards y, angle from the vertical.
    damping : "modal" or "dashpots"
        Damping ratio of the body as modal damping ratio h of the paper, or as ratio of the corner dashpots.

    Returns
    -------
    (4, n) array
        A/g of corners 1 to 4; infinite where no amplitude lifts the corner. The block lifts at the smallest of the four, not
        always at corner 4 of the paper ([Okumura1987]_ eq. (26)).

    Raises
    ------
    ParameterError
        If a frequency ratio is negative or an angle is not a number.

    Examples
    --------
    >>> from seisblock.models import uplift_thresholds
    >>> block = SpringBlock.from_ratios(alpha=1.0, beta=0.6**0.5, damping=0.05)
    >>> uplift_thresholds(block, [2.78225]).min(axis=0).round(6)
    array([0.676683])
    """
    ratio = np.atleast_1d(checks.float_array("`frequency_ratio`", frequency_ratio))
    if not (np.isfinite(ratio).all() and (ratio >= 0.0).all()):
        raise ParameterError("`frequency_ratio` (theta/omega_1) must be finite and zero or more")
    if damping not in DAMPINGS:
        raise ParameterError("`damping` must be one of {known}, found {found}", known=DAMPINGS, found=repr(damping))
    omega = ratio * natural_modes(body).omega_1
    direction = shaking_direction(phi_deg, rho_deg)
    if damping == "modal":
        response = corner_response(body, omega, direction)
    else:
        response = corner_response_direct(body, omega, direction, damping=damping)
    return lifting_amplitude(response)

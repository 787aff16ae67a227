"""Rigid block on springs at its four corners."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import BodyError
from seisblock.core.i18n import lazy_gettext
from seisblock.core.typing import FloatArray
from seisblock.core.units import STANDARD_GRAVITY, warn_large_lengths

CORNER_SIGNS = ((1, 1), (1, -1), (-1, 1), (-1, -1))
"""Signs of x and y of corners 1 to 4 of the base; corner 4 is the paper's ([Okumura1987]_ eq. (23))."""

REFERENCE_MASS = 1000.0
"""Mass, kg, of a block given by its frequencies: without effect on motions, proportional to forces."""

COORDINATES = ("x", "y", "z", "theta_x", "theta_y", "theta_z")
"""Order of the generalised coordinates; rotations are right-handed and multiplied by the depth b ([Okumura1987]_ eq. (3))."""


@dataclass(frozen=True, repr=False)
class SpringBlock(DisplayMixin):
    """A rigid cuboid on four corner springs, three directions each ([Okumura1987]_ fig. 1).

    Parameters
    ----------
    width : float, m
        Side a of the base, along x.
    depth : float, m
        Side b of the base, along y.
    height : float, m
        Height H; centre of gravity at half of it.
    mass : float, kg
        Total mass m, homogeneous.
    stiffness : (kx, ky, kz), N/m
        Stiffness of the springs at each corner.
    damping : float
        Damping ratio, in [0, 1). Harmonic motion: the paper's modal h, equal in all modes; records: zeta of each corner dashpot,
        c = 2 zeta k / omega of its direction (derived here).

    Raises
    ------
    BodyError
        If a size, the mass or a stiffness is not positive, or the damping is outside [0, 1).

    Warns
    -----
    UserWarning
        If a length exceeds 20 m, which was probably meant in cm or mm.

    Examples
    --------
    >>> block = SpringBlock.from_frequency(1.0, 1.0, 1.0, frequency_vertical=1.0, beta=0.5)
    >>> block.alpha, block.gamma, round(block.beta, 12)
    (1.0, 1.0, 0.5)
    """

    width: float
    depth: float
    height: float
    mass: float
    stiffness: tuple[float, float, float]
    damping: float = 0.05

    def __post_init__(self) -> None:
        checks.positive("width of the block", self.width, "m", error=BodyError)
        checks.positive("depth of the block", self.depth, "m", error=BodyError)
        checks.positive("height of the block", self.height, "m", error=BodyError)
        checks.positive("mass of the block", self.mass, "kg", error=BodyError)
        warn_large_lengths(lazy_gettext("block"), width=self.width, depth=self.depth, height=self.height)
        if len(self.stiffness) != 3:
            raise BodyError("stiffness requires three numbers, kx, ky and kz in N/m per corner; found {count}", count=len(self.stiffness))
        for axis, value in zip("xyz", self.stiffness, strict=True):
            checks.positive("stiffness k{axis} of a corner", value, "N/m", error=BodyError, axis=axis)
        object.__setattr__(self, "stiffness", tuple(float(k) for k in self.stiffness))
        if not 0.0 <= self.damping < 1.0:
            raise BodyError(
                "the damping ratio must lie in [0, 1), found {found}: give a fraction, for example 0.05 for 5 %", found=self.damping
            )

    @classmethod
    def from_frequency(
        cls,
        width: float,
        depth: float,
        height: float,
        *,
        frequency_vertical: float,
        beta: float,
        mass: float = REFERENCE_MASS,
        damping: float = 0.05,
    ) -> SpringBlock:
        """Return the block whose vertical frequency is omega_V / 2 pi, Hz, and whose horizontal one is beta times that."""
        checks.positive("vertical frequency", frequency_vertical, "Hz", error=BodyError)
        checks.positive("beta, the ratio of horizontal to vertical frequency,", beta, error=BodyError)
        checks.positive("mass of the block", mass, "kg", error=BodyError)
        warn_large_lengths(lazy_gettext("block"), 2, width=width, depth=depth, height=height)
        vertical = mass * (2.0 * math.pi * frequency_vertical) ** 2 / 4.0
        return cls(width, depth, height, mass, (beta**2 * vertical, beta**2 * vertical, vertical), damping)

    @classmethod
    def from_ratios(
        cls,
        alpha: float,
        beta: float,
        *,
        gamma: float = 1.0,
        frequency_vertical: float = 1.0,
        depth: float = 1.0,
        mass: float = REFERENCE_MASS,
        damping: float = 0.05,
    ) -> SpringBlock:
        """Return the block of the paper's ratios alpha = H/b, gamma = a/b and beta ([Okumura1987]_ section 2)."""
        checks.positive("alpha, height over depth,", alpha, error=BodyError)
        checks.positive("gamma, width over depth,", gamma, error=BodyError)
        return cls.from_frequency(
            gamma * depth, depth, alpha * depth, frequency_vertical=frequency_vertical, beta=beta, mass=mass, damping=damping
        )

    @property
    def alpha(self) -> float:
        """Height over depth, H/b ([Okumura1987]_ section 2)."""
        return self.height / self.depth

    @property
    def gamma(self) -> float:
        """Width over depth, a/b ([Okumura1987]_ section 2)."""
        return self.width / self.depth

    @property
    def beta(self) -> float:
        """Square root of kx/kz ([Okumura1987]_ section 3)."""
        return math.sqrt(self.stiffness[0] / self.stiffness[2])

    @property
    def omega(self) -> tuple[float, float, float]:
        """Circular frequencies sqrt(4 k / m) of x, y and z, rad/s ([Okumura1987]_ section 2)."""
        wx, wy, wz = (math.sqrt(4.0 * k / self.mass) for k in self.stiffness)
        return wx, wy, wz

    @property
    def inertia(self) -> tuple[float, float, float]:
        """Moments of inertia about the centre of gravity, over m b^2 ([Okumura1987]_ eq. (2))."""
        a2, g2 = self.alpha**2, self.gamma**2
        return (1.0 + a2) / 12.0, (a2 + g2) / 12.0, (1.0 + g2) / 12.0

    def static_settlement(self, gravity: float = STANDARD_GRAVITY) -> float:
        """Return the static settlement m g / 4 kz, m ([Okumura1987]_ section 2)."""
        return self.mass * gravity / (4.0 * self.stiffness[2])

    def static_corner_force(self, gravity: float = STANDARD_GRAVITY) -> float:
        """Return the static force at each corner, N."""
        return self.mass * gravity / 4.0


def corner_jacobian(body: SpringBlock) -> FloatArray:
    """Return the displacements of the corners per unit of each generalised coordinate.

    Returns
    -------
    (4, 3, 6) array
        Corner, direction x, y, z, coordinate of ``COORDINATES``: u = q[:3] + theta x r with r the corner seen from
        the centre of gravity ([Okumura1987]_ eqs. (1), (23)).
    """
    rows = np.zeros((4, 3, 6))
    rows[:, (0, 1, 2), (0, 1, 2)] = 1.0
    for i, (sx, sy) in enumerate(CORNER_SIGNS):
        rx, ry, rz = 0.5 * sx * body.gamma, 0.5 * sy, -0.5 * body.alpha
        rows[i, 0, 4], rows[i, 0, 5] = rz, -ry
        rows[i, 1, 3], rows[i, 1, 5] = -rz, rx
        rows[i, 2, 3], rows[i, 2, 4] = ry, -rx
    return rows


def mass_matrix(body: SpringBlock) -> FloatArray:
    """Return M of [Okumura1987]_ eqs. (3), (4), per unit of mass: (6, 6) array."""
    return np.diag([1.0, 1.0, 1.0, *body.inertia])


def stiffness_matrix(body: SpringBlock) -> FloatArray:
    """Return K of [Okumura1987]_ eq. (4) from the geometry of the corners: (6, 6) array, 1/s^2.

    Differs from the printed matrix, whose couplings alpha/4 must be alpha/2 and whose K21 is zero.
    """
    return _sum_over_corners(body, [w * w for w in body.omega])


def dashpot_matrix(body: SpringBlock) -> FloatArray:
    """Return the damping matrix of corner dashpots c = 2 zeta k / omega, (6, 6), 1/s (derived here)."""
    return _sum_over_corners(body, [2.0 * body.damping * w for w in body.omega])


def _sum_over_corners(body: SpringBlock, coefficients: list[float]) -> FloatArray:
    """Return the matrix of equal corner elements with given sums in x, y and z."""
    rows = corner_jacobian(body)
    total: FloatArray = np.einsum("ndi,d,ndj->ij", rows, np.array(coefficients) / 4.0, rows)
    return total

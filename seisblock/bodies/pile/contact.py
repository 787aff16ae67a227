"""Contact law of a pile: springs, dashpots and sliders."""

from __future__ import annotations

import math
from dataclasses import dataclass

from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import ParameterError


@dataclass(frozen=True, repr=False)
class PileContact(DisplayMixin):
    """Spring, dashpot and slider at each contact point.

    Two descriptions: per unit mass of the upper stone and per point, as [Furukawa2009]_ table 2 must be read (3947.8 = (2 pi 10)^2
    is 10 Hz, 125.66 = 2 (2 pi 10) critical damping; as N/m the stones would sink by centimetres); or physical, by the stones'
    Young's modulus or the stiffness of the joint per area.

    Parameters
    ----------
    normal, shear : float, 1/s^2
        Stiffness per point over the upper stone's mass.
    normal_damping, shear_damping : float, 1/s
        Dashpots per point over the upper stone's mass.
    young : float, Pa, or None
        Young's modulus: each joint has the stiffness of the half heights of its two stones, damped by ``damping_ratio``; replaces the
        four above.
    stiffness : float, N/m^3, or None
        Stiffness of the joints per area; replaces the four above.
    damping_ratio : float
        Damping ratio of the upper stone on its whole joint, for the physical descriptions.
    shear_ratio : float
        Shear over normal stiffness, for the physical descriptions; 0.4 as in [Furukawa2009]_ table 2.
    """

    normal: float = 3947.8
    shear: float = 1579.1
    normal_damping: float = 125.66
    shear_damping: float = 50.265
    young: float | None = None
    stiffness: float | None = None
    damping_ratio: float = 1.0
    shear_ratio: float = 0.4

    def __post_init__(self) -> None:
        for name in ("normal", "shear", "shear_ratio", "young", "stiffness"):
            value = getattr(self, name)
            if value is not None:
                checks.positive("{name} of the contact", value, name=name)
        for name in ("normal_damping", "shear_damping", "damping_ratio"):
            checks.non_negative("{name} of the contact", getattr(self, name), name=name)
        if self.young is not None and self.stiffness is not None:
            raise ParameterError("Young's modulus and the stiffness per area exclude each other: give only one of them")

    def point_coefficients(self, mass: float, area: float, length: float, points: int) -> tuple[float, float, float, float]:
        """Return normal spring and dashpot, shear spring and dashpot of one contact point, N/m and N s/m.

        Parameters
        ----------
        mass : float, kg
            Mass of the upper stone.
        area, length_ : float, m^2, m
            Area of the joint, and half the sum of the heights of both stones.
        points : int
            Number of points of the joint.

        Returns
        -------
        four floats, N/m, N s/m, N/m, N s/m
        """
        per_area = self.stiffness if self.young is None else self.young / length
        if per_area is None:
            return mass * self.normal, mass * self.normal_damping, mass * self.shear, mass * self.shear_damping
        stiffness = per_area * area
        dashpot = 2.0 * self.damping_ratio * math.sqrt(stiffness * mass)
        return stiffness / points, dashpot / points, self.shear_ratio * stiffness / points, self.shear_ratio * dashpot / points

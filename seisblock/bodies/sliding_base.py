"""Sliding base: static and kinetic friction, slope."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_
from seisblock.core.options import option


@dataclass(frozen=True, repr=False)
class SlidingBase(DisplayMixin):
    """Rigid base with Coulomb friction, level or sloping.

    Parameters
    ----------
    mu : float
        Static friction coefficient, positive.
    mu_kinetic : float or None
        Kinetic friction coefficient, 0 to `mu`; default `mu`.
    slope_deg : float, degrees
        Angle by which the base falls towards the component's positive direction, -90 to 90 exclusive; negative falls the other way.
    slope_length : float or None, m
        Distance along the slope from the object to the foot, beyond which the ground is level; None is a slope without end.
    one_way : bool
        Whether the object can slide in the positive direction (downhill) only, as in [Newmark1965]_.

    Raises
    ------
    ParameterError
        If a number lies outside its range, or the object slides without ground motion.
    """

    mu: float = field(metadata=option(N_("Static friction coefficient."), unit="1"))
    mu_kinetic: float | None = field(
        default=None, metadata=option(N_("Kinetic friction coefficient. [default: as --mu]"), unit="1", document=float)
    )
    slope_deg: float = field(
        default=0.0,
        metadata=option(N_("Slope of the base, degrees; the component's positive direction is downhill. [default: 0]"), unit="deg"),
    )
    slope_length: float | None = field(
        default=None,
        metadata=option(
            N_("Distance to the foot of the slope, m or with a unit; level ground beyond. [default: infinite slope]"), unit="m"
        ),
    )
    one_way: bool = field(
        default=False,
        metadata=option(N_("Slide only downhill (on level ground: in the positive direction), as Newmark assumed.")),
    )

    def __post_init__(self) -> None:
        checks.positive("the static friction coefficient `mu`", self.mu)
        checks.finite("the kinetic friction coefficient", self.kinetic)
        checks.in_interval("the slope", self.slope_deg, "(-90, 90)", "degrees")
        if not 0.0 <= self.kinetic <= self.mu:
            raise ParameterError(
                "the kinetic friction coefficient must lie between 0 and mu = {mu:g} (kappa between 0 and 1), found {found:g}",
                mu=self.mu,
                found=self.kinetic,
            )
        if not holds_at_rest(self.mu, self.slope_deg):
            raise ParameterError(
                "a slope of {slope:g} degrees exceeds the friction angle of mu = {mu:g}, {steepest:.2f} degrees: the object slides "
                "without any ground motion",
                slope=self.slope_deg,
                mu=self.mu,
                steepest=math.degrees(math.atan(self.mu)),
            )
        if self.slope_length is not None:
            checks.positive("the length of the slope", self.slope_length, "m")
            if self.slope_deg == 0.0:
                raise ParameterError("a length of the slope requires a slope above 0 degrees: give its angle")
        if self.one_way and self.slope_deg < 0.0:
            raise ParameterError("one-way sliding is downhill, the component's positive direction: the slope must not be negative")

    @property
    def kinetic(self) -> float:
        """Kinetic friction coefficient, given or the static one."""
        return self.mu if self.mu_kinetic is None else self.mu_kinetic

    @property
    def kappa(self) -> float:
        """Kinetic over static friction."""
        # 0.2 * 0.2 / 0.2 differs from 0.2 by round-off
        return float(f"{self.kinetic / self.mu:.15g}")

    @property
    def angle(self) -> float:
        """Slope, rad."""
        return math.radians(self.slope_deg)


def holds_at_rest(mu: float, slope_deg: float) -> bool:
    """Return whether static friction holds an object on a slope at rest ([Fujino1978]_ eq. (10)); equality holds."""
    return mu >= abs(math.tan(math.radians(slope_deg))) * (1.0 - 1e-15)


def sliding_base(
    mu: float,
    *,
    mu_kinetic: float | None = None,
    kappa: float | None = None,
    slope_deg: float = 0.0,
    slope_length: float | None = None,
    one_way: bool = False,
) -> SlidingBase:
    """Return a base whose kinetic friction is given, `kappa` times the static one, or equal to it.

    Raises
    ------
    ParameterError
        If both `mu_kinetic` and `kappa` are given, `kappa` is not in (0, 1], or a number lies outside its range.
    """
    if mu_kinetic is not None and kappa is not None:
        raise ParameterError(
            "the kinetic friction coefficient and its ratio `kappa` to the static one exclude each other: give only one of them"
        )
    if kappa is not None:
        mu_kinetic = checks.in_interval("`kappa` (ratio of kinetic to static friction)", kappa, "(0, 1]") * mu
    return SlidingBase(mu, mu_kinetic, slope_deg, slope_length, one_way)

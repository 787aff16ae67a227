"""Point-source model: Fourier amplitude spectrum and duration of ground acceleration on rock."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seisblock.core import checks
from seisblock.core.typing import FloatArray

SHEAR_VELOCITY, DENSITY = 3500.0, 2800.0
"""Shear-wave velocity, m/s, and density, kg/m^3, of the rock at the source."""

STRESS_DROP = 1e7
"""Stress drop, Pa (100 bar)."""

RADIATION, FREE_SURFACE, PARTITION = 0.55, 2.0, 1.0 / math.sqrt(2.0)
"""Average radiation coefficient of shear waves, free-surface factor, and partition onto one horizontal component."""

QUALITY, QUALITY_POWER = 180.0, 0.45
"""Path attenuation Q = 180 f^0.45."""

KAPPA = 0.04
"""Near-surface attenuation kappa, s."""

SPREADING_CROSSOVER = 40e3
"""Distance beyond which geometrical spreading is that of surface waves, m."""

DURATION_PER_METRE = 0.05e-3
"""Increase of duration with distance, s/m."""

AMPLIFICATION_HZ = np.array([0.01, 0.09, 0.16, 0.51, 0.84, 1.25, 2.26, 3.17, 6.05, 16.60, 61.20])
AMPLIFICATION = np.array([1.00, 1.10, 1.18, 1.42, 1.58, 1.74, 2.06, 2.25, 2.58, 3.13, 4.00])
"""Amplification of generic rock at the frequencies AMPLIFICATION_HZ, Hz; linear in log frequency in between."""


@dataclass(frozen=True)
class PointSource:
    """Point source with Brune's single-corner spectrum and a site on generic rock, western North America.

    Parameters
    ----------
    magnitude : float, 1
        Moment magnitude.
    distance_m : float, m
        Shortest distance to the fault rupture.

    Raises
    ------
    ParameterError
        If the magnitude is not between 4 and 8.5, or the distance not between 1 and 300 km.

    Notes
    -----
    The parameters are those of western North America ([Campbell2003]_ table of source models), the amplification that of generic rock
    ([BooreJoyner1997]_ table of amplifications). ``effective_distance_m`` replaces the distance and limits the motion near
    large faults.

    Examples
    --------
    >>> source = PointSource(7.0, 20e3)
    >>> round(source.corner_hz, 4), round(source.duration_s, 1)
    (0.1124, 10.0)
    """

    magnitude: float
    distance_m: float

    def __post_init__(self) -> None:
        checks.in_interval("the magnitude", self.magnitude, "[4, 8.5]")
        checks.in_interval("the distance", self.distance_m, "[1e3, 3e5]", "m")

    @property
    def moment(self) -> float:
        """Seismic moment M0 = 10^(1.5 M + 9.05), N m ([HanksKanamori1979]_ definition of the moment magnitude)."""
        return float(10.0 ** (1.5 * self.magnitude + 9.05))

    @property
    def corner_hz(self) -> float:
        """Corner frequency 0.49 beta (stress drop/M0)^(1/3), Hz ([Boore2003]_ relation of Brune's model, in SI)."""
        return float(0.49 * SHEAR_VELOCITY * (STRESS_DROP / self.moment) ** (1.0 / 3.0))

    @property
    def effective_distance_m(self) -> float:
        """Distance of the point, sqrt(D^2 + h^2) with log10 h = -0.05 + 0.15 M, h in km, m ([AtkinsonSilva2000]_ relation)."""
        return math.hypot(self.distance_m, 1e3 * 10.0 ** (0.15 * self.magnitude - 0.05))

    @property
    def duration_s(self) -> float:
        """Duration of shaking, s: 1/corner at the source, plus 0.05 s per km ([Boore2003]_ method)."""
        return 1.0 / self.corner_hz + DURATION_PER_METRE * self.effective_distance_m

    def spectrum(self, frequency: FloatArray) -> FloatArray:
        """Return the Fourier amplitude of the acceleration of one horizontal component, (n,), m/s.

        Parameters
        ----------
        frequency : (n,) array, Hz
            Zero or more.

        Notes
        -----
        C M0 (2 pi f)^2/(1 + (f/fc)^2) G(R) exp(-pi f R/(Q beta)) A(f) exp(-pi kappa f) with C = 0.55 * 2 * 0.707/(4 pi rho beta^3)
        ([Boore2003]_ method: source, path, site). Proportional to f^2 at low frequency: the ground comes to rest.
        """
        f = np.asarray(frequency, dtype=np.float64)
        distance = self.effective_distance_m
        constant = RADIATION * FREE_SURFACE * PARTITION / (4.0 * math.pi * DENSITY * SHEAR_VELOCITY**3)
        source = constant * self.moment * (2.0 * math.pi * f) ** 2 / (1.0 + (f / self.corner_hz) ** 2)
        # body waves decay as 1/R, surface waves as 1/sqrt(R), continuous at the crossover
        spreading = 1.0 / distance if distance <= SPREADING_CROSSOVER else 1.0 / math.sqrt(SPREADING_CROSSOVER * distance)
        # pi f R/(Q beta) with Q = 180 f^0.45, and kappa
        attenuation = math.pi * distance / (QUALITY * SHEAR_VELOCITY) * f ** (1.0 - QUALITY_POWER) + math.pi * KAPPA * f
        amplification = np.interp(np.log(np.maximum(f, AMPLIFICATION_HZ[0])), np.log(AMPLIFICATION_HZ), AMPLIFICATION)
        return np.asarray(source * spreading * np.exp(-attenuation) * amplification)

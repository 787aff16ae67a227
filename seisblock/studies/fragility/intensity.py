"""Intensity measures of a fragility: one number per motion, along the direction of the solution."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from seisblock.bodies.block import Block
from seisblock.core import checks
from seisblock.core.errors import ParameterError
from seisblock.core.typing import FloatArray
from seisblock.core.units import GAL, KINE
from seisblock.measures.baseline import ground_history
from seisblock.measures.intensity import arias_intensity
from seisblock.measures.peaks import peak_acceleration, peak_displacement, peak_velocity
from seisblock.measures.spectra import response_spectrum
from seisblock.records import Motion

PGA, PGV, PGD, SA, ARIAS, P_PGV = "pga", "pgv", "pgd", "sa", "arias", "p*pgv"

_UNITS = {PGA: "m/s^2", PGV: "m/s", PGD: "m", SA: "m/s^2", ARIAS: "m/s", P_PGV: "1"}
_DISPLAY_UNITS = {PGA: (GAL, "gal"), PGV: (KINE, "kine"), PGD: (0.01, "cm"), SA: (GAL, "gal"), ARIAS: (1.0, "m/s"), P_PGV: (1.0, "")}
_DISPLAY_UNITS_SI = {PGA: "m/s²", PGV: "m/s", PGD: "m", SA: "m/s²", ARIAS: "m/s", P_PGV: ""}
_AXIS_LABELS = {PGA: "PGA", PGV: "PGV", PGD: "PGD", ARIAS: "Arias", P_PGV: "p PGV/g"}


@dataclass(frozen=True)
class IntensityMeasure:
    """Intensity measure of a motion.

    Parameters
    ----------
    kind : str
        ``pga``, ``pgv``, ``pgd``, ``sa`` (at 5 % damping), ``arias``, or ``p*pgv``: p PGV/g, dimensionless, with the frequency
        parameter p of the body.
    period_s : float or None, s
        Period of ``sa``.

    Raises
    ------
    ParameterError
        If the measure is unknown, or a period is missing, superfluous or out of range.
    """

    kind: str
    period_s: float | None = None

    def __post_init__(self) -> None:
        if self.kind not in _UNITS:
            raise ParameterError(
                "unknown intensity measure {name!r}; available: {known}", name=str(self.kind)[:100], known=[*_NAMES, "sa=0.5"]
            )
        if (self.kind == SA) != (self.period_s is not None):
            raise ParameterError("sa requires a period in s (sa=0.5); other measures take none")
        if self.period_s is not None:
            checks.positive("the period of a spectral acceleration", self.period_s, "s")

    @property
    def name(self) -> str:
        """Name in option syntax: ``pgv``, ``sa=0.5``."""
        return self.kind if self.period_s is None else f"{SA}={self.period_s:g}"

    @property
    def label(self) -> str:
        """Label of an axis: ``PGV``, ``Sa(0.5 s)``."""
        return _AXIS_LABELS[self.kind] if self.period_s is None else f"Sa({self.period_s:g} s)"

    @property
    def unit(self) -> str:
        """Unit of its values: ``m/s^2``, ``m/s``, ``m``, or ``1`` for none."""
        return _UNITS[self.kind]

    @property
    def power(self) -> int:
        """Power of the scale factor in the measure: 2 for the Arias intensity, else 1."""
        return 2 if self.kind == ARIAS else 1

    def display_unit(self, *, gal: bool = True) -> tuple[float, str]:
        """Return the display unit, SI, and its name: gal, kine and cm, or SI."""
        return _DISPLAY_UNITS[self.kind] if gal else (1.0, _DISPLAY_UNITS_SI[self.kind])

    def of(self, motion: Motion) -> float:
        """Return the value for a motion, SI; of ``p*pgv`` the velocity alone, to be multiplied by :meth:`share`.

        Parameters
        ----------
        motion : Motion
            Its row along +x is measured.
        """
        a, dt = motion.horizontal, motion.dt
        if self.kind == PGA:
            return peak_acceleration(a)[0]
        if self.kind == SA:
            return float(response_spectrum(a, dt, [self.period_s or 0.0]).sa_m_s2[0])
        if self.kind == ARIAS:
            return arias_intensity(a, dt)
        history = ground_history(a, dt)
        return peak_displacement(history) if self.kind == PGD else peak_velocity(history, dt)

    def share(self, body: object, gravity: float) -> float:
        """Return the factor of the body: p/g of ``p*pgv`` ([DimitrakopoulosParaskeva2015]_ section 3), else 1.

        Parameters
        ----------
        body : Block or other
        gravity : float, m/s^2

        Raises
        ------
        ParameterError
            If the body has no frequency parameter.
        """
        if self.kind != P_PGV:
            return 1.0
        if not isinstance(body, Block):
            raise ParameterError("p*pgv requires a body with a frequency parameter (a block); use pgv")
        return body.frequency_parameter(gravity) / gravity


_NAMES = (PGA, PGV, PGD, ARIAS, P_PGV)


def intensity_measure(text: str | IntensityMeasure) -> IntensityMeasure:
    """Return the intensity measure of a text.

    Parameters
    ----------
    text : str
        ``pga``, ``pgv``, ``pgd``, ``sa=0.5`` (the period in s), ``arias`` or ``p*pgv``.

    Raises
    ------
    ParameterError
        If the text names no measure.

    Examples
    --------
    >>> intensity_measure("sa=0.5").label
    'Sa(0.5 s)'
    """
    if isinstance(text, IntensityMeasure):
        return text
    kind, equals, period = str(text).strip().lower().replace(" ", "").partition("=")
    if not equals:
        return IntensityMeasure(kind)
    try:
        return IntensityMeasure(kind, float(period.removesuffix("s")))
    except ValueError:
        raise ParameterError("the period of {text!r} is not a number; expected sa=0.5, in s", text=str(text)[:100]) from None


def factors_for(levels: FloatArray, value: float | FloatArray, measure: IntensityMeasure) -> FloatArray:
    """Return the factors that scale a motion to given levels of a measure (derived here: level = value factor^power)."""
    return np.asarray((levels / value) ** (1.0 / measure.power))

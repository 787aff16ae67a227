"""Intensity measures of a fragility: one number per motion, along the direction of the solution."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seisblock.bodies.block import Block
from seisblock.core import checks
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.typing import FloatArray
from seisblock.core.units import GAL, KINE
from seisblock.measures.intensity import arias_intensity, cumulative_absolute_velocity
from seisblock.measures.peaks import peak_acceleration, peak_displacement, peak_velocity
from seisblock.measures.rotd import rotated_spectrum
from seisblock.measures.spectra import response_spectrum
from seisblock.measures.summary import conventions_of, velocity_history
from seisblock.records import Motion
from seisblock.records.seismic_intensity import jma_intensity, missing_intensity_reason

PGA, PGV, PGD, SA, ARIAS, P_PGV, JMA = "pga", "pgv", "pgd", "sa", "arias", "p*pgv", "jma"
CAV, ROTD50, ROTD100 = "cav", "rotd50", "rotd100"

SPECTRAL = (SA, ROTD50, ROTD100)
"""Measures with a period."""

_UNITS = {
    PGA: "m/s^2",
    PGV: "m/s",
    PGD: "m",
    SA: "m/s^2",
    ROTD50: "m/s^2",
    ROTD100: "m/s^2",
    ARIAS: "m/s",
    CAV: "m/s",
    P_PGV: "1",
    JMA: "1",
}
_DISPLAY_UNITS = {
    PGA: (GAL, "gal"),
    PGV: (KINE, "kine"),
    PGD: (0.01, "cm"),
    SA: (GAL, "gal"),
    ROTD50: (GAL, "gal"),
    ROTD100: (GAL, "gal"),
    ARIAS: (1.0, "m/s"),
    CAV: (1.0, "m/s"),
    P_PGV: (1.0, ""),
    JMA: (1.0, ""),
}
_DISPLAY_UNITS_SI = {kind: {"m/s^2": "m/s²", "1": ""}.get(unit, unit) for kind, unit in _UNITS.items()}
_AXIS_LABELS = {PGA: "PGA", PGV: "PGV", PGD: "PGD", ARIAS: "Arias", CAV: "CAV", P_PGV: "p PGV/g", JMA: N_("JMA intensity")}
_SPECTRAL_LABELS = {SA: "Sa", ROTD50: "RotD50", ROTD100: "RotD100"}

JMA_PER_LOG_FACTOR = 2.0 / math.log(10.0)
"""Change of the JMA intensity with the logarithm of the scale factor ([JMA1996]_: I = 2 log10 a0 + 0.94)."""


@dataclass(frozen=True)
class IntensityMeasure:
    """Intensity measure of a motion.

    Parameters
    ----------
    kind : str
        ``pga``, ``pgv``, ``pgd``, ``sa`` (at 5 % damping), ``arias``, ``cav``, ``p*pgv``: p PGV/g, dimensionless, with the frequency
        parameter p of the body; of the whole record: ``jma``, JMA intensity of three components, ``rotd50`` and ``rotd100``, median and
        maximum over all directions of the pseudo-spectral acceleration.
    period_s : float or None, s
        Period of ``sa``, ``rotd50`` and ``rotd100``.

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
                "unknown intensity measure {name!r}; available: {known}", name=str(self.kind)[:100], known=[*_NAMES, *_SPECTRAL_NAMES]
            )
        if (self.kind in SPECTRAL) != (self.period_s is not None):
            raise ParameterError("sa, rotd50 and rotd100 require a period in s (sa=0.5, rotd50:0.5); other measures take none")
        if self.period_s is not None:
            checks.positive("the period of a spectral acceleration", self.period_s, "s")

    @property
    def name(self) -> str:
        """Name in option syntax: ``pgv``, ``sa=0.5``, ``rotd50:0.5``."""
        return self.kind if self.period_s is None else f"{self.kind}{'=' if self.kind == SA else ':'}{self.period_s:g}"

    @property
    def label(self) -> str:
        """Label of an axis: ``PGV``, ``Sa(0.5 s)``."""
        return _AXIS_LABELS[self.kind] if self.period_s is None else f"{_SPECTRAL_LABELS[self.kind]}({self.period_s:g} s)"

    @property
    def unit(self) -> str:
        """Unit of its values: ``m/s^2``, ``m/s``, ``m``, or ``1`` for none."""
        return _UNITS[self.kind]

    def is_comparable(self, other: IntensityMeasure) -> bool:
        """Return whether another measure is a spectral acceleration of the same period, whatever its definition of direction."""
        return self.period_s is not None and self.period_s == other.period_s

    @property
    def power(self) -> int:
        """Power of the scale factor in the measure: 2 for the Arias intensity, else 1; without meaning for the JMA intensity."""
        return 2 if self.kind == ARIAS else 1

    @property
    def search_step(self) -> float:
        """Ratio of successive levels in the search for the range of levels: 2, or 1.1 for the logarithmic JMA intensity."""
        return 1.1 if self.kind == JMA else 2.0

    def log_scaled(self, value: FloatArray, log_factor: FloatArray) -> FloatArray:
        """Return the logarithm of a measure of scaled motions, from the logarithm of the factor; infinite and NaN factors remain."""
        if self.kind == JMA:
            return np.log(np.maximum(value + JMA_PER_LOG_FACTOR * log_factor, np.finfo(float).tiny))
        return np.asarray(np.log(value) + self.power * log_factor)

    def log_factors(self, log_level: FloatArray, value: FloatArray) -> FloatArray:
        """Return the logarithms of the factors that scale motions to levels given by their logarithm."""
        if self.kind == JMA:
            return np.asarray((np.exp(log_level) - value) / JMA_PER_LOG_FACTOR)
        return np.asarray((log_level - np.log(value)) / self.power)

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
        if self.kind == CAV:
            return cumulative_absolute_velocity(a, dt)
        if self.kind == JMA:
            return _positive_intensity(motion)
        if self.kind in (ROTD50, ROTD100):
            return _rotated_acceleration(motion, self)
        history = velocity_history(a, dt, conventions_of(motion.record))
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


_NAMES = (PGA, PGV, PGD, ARIAS, CAV, P_PGV, JMA)
_SPECTRAL_NAMES = ("sa=0.5", "rotd50:0.5", "rotd100:0.5")


def intensity_measure(text: str | IntensityMeasure) -> IntensityMeasure:
    """Return the intensity measure of a text.

    Parameters
    ----------
    text : str
        ``pga``, ``pgv``, ``pgd``, ``arias``, ``cav``, ``p*pgv``, ``jma``, or ``sa=0.5``, ``rotd50:0.5``, ``rotd100:0.5`` (period in s;
        a colon and an equals sign are equivalent).

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
    kind, equals, period = str(text).strip().lower().replace(" ", "").replace(":", "=").partition("=")
    if not equals:
        return IntensityMeasure(kind)
    try:
        return IntensityMeasure(kind, float(period.removesuffix("s")))
    except ValueError:
        raise ParameterError("the period of {text!r} is not a number; expected sa=0.5, in s", text=str(text)[:100]) from None


def factors_for(levels: FloatArray, value: float | FloatArray, measure: IntensityMeasure) -> FloatArray:
    """Return the factors that scale a motion to given levels of a measure.

    Derived here: level = value factor^power; the JMA intensity grows by 2 log10 of the factor.
    """
    if measure.kind == JMA:
        return np.asarray(10.0 ** ((levels - value) / 2.0))
    return np.asarray((levels / value) ** (1.0 / measure.power))


def _rotated_acceleration(motion: Motion, measure: IntensityMeasure) -> float:
    """Return RotD50 or RotD100 of the record of a motion, m/s^2."""
    record = motion.record
    if record is None or len(record.horizontals) != 2:
        raise ParameterError(
            "{record}: no {measure} for the curve: a record with two horizontal components is required; omit this record",
            record=motion.name if record is None else record.source or record.station or motion.name,
            measure=measure.name,
        )
    spectrum = rotated_spectrum(record, [measure.period_s or 0.0])
    return float((spectrum.rotd50_m_s2 if measure.kind == ROTD50 else spectrum.rotd100_m_s2)[0])


def _positive_intensity(motion: Motion) -> float:
    """Return the JMA intensity of the record of a motion."""
    record = motion.record
    intensity = None if record is None else jma_intensity(record)
    if record is None or intensity is None or intensity <= 0.0:
        reason: str = lazy_gettext("the motion has no record with three components")
        if record is not None:
            reason = missing_intensity_reason(record) if intensity is None else lazy_gettext("it is {value:.2g}, below 0", value=intensity)
        raise ParameterError(
            "{record}: no JMA intensity for the curve: {reason}; omit this record",
            record=motion.name if record is None else record.source or record.station or motion.name,
            reason=reason,
        )
    return intensity

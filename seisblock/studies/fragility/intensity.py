"""How strong a motion is, in the one number that a fragility is drawn over: as the solver feels it, along the direction solved."""

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
    """One measure of a motion's strength.

    Parameters
    ----------
    kind : str
        ``pga``, ``pgv``, ``pgd``, ``sa`` (at 5 % damping), ``arias``, or ``p*pgv``: p PGV/g, without unit, with the frequency parameter p
        of the body.
    period_s : float or None, s
        Of ``sa``.

    Raises
    ------
    ParameterError
        If there is no such measure, or a period is missing or of no use.
    """

    kind: str
    period_s: float | None = None

    def __post_init__(self) -> None:
        if self.kind not in _UNITS:
            raise ParameterError(
                "there is no intensity measure {name!r}; there are {known}", name=str(self.kind)[:100], known=[*_NAMES, "sa=0.5"]
            )
        if (self.kind == SA) != (self.period_s is not None):
            raise ParameterError("a spectral acceleration needs its period, sa=0.5 (s), and no other measure has one")
        if self.period_s is not None:
            checks.positive("the period of a spectral acceleration", self.period_s, "s")

    @property
    def name(self) -> str:
        """As it is asked for: ``pgv``, ``sa=0.5``."""
        return self.kind if self.period_s is None else f"{SA}={self.period_s:g}"

    @property
    def label(self) -> str:
        """As it stands on an axis: ``PGV``, ``Sa(0.5 s)``."""
        return _AXIS_LABELS[self.kind] if self.period_s is None else f"Sa({self.period_s:g} s)"

    @property
    def unit(self) -> str:
        """Of its values: ``m/s^2``, ``m/s``, ``m``, or ``1`` for none."""
        return _UNITS[self.kind]

    @property
    def power(self) -> int:
        """How it grows with the motion: twice as strong is so many times a factor of two (the Arias intensity: twice)."""
        return 2 if self.kind == ARIAS else 1

    def display_unit(self, *, gal: bool = True) -> tuple[float, str]:
        """Return the unit in which it is told, SI, and its name: gal, kine and cm, or SI."""
        return _DISPLAY_UNITS[self.kind] if gal else (1.0, _DISPLAY_UNITS_SI[self.kind])

    def of(self, motion: Motion) -> float:
        """Return its value for a motion, SI; of ``p*pgv`` the velocity alone, to be multiplied by :meth:`share`.

        Parameters
        ----------
        motion : Motion
            Its row along +x is what is measured.
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
        """Return the factor that a body has in it: p/g of ``p*pgv`` ([DimitrakopoulosParaskeva2015]_ section 3), else 1.

        Parameters
        ----------
        body : Block, or anything
        gravity : float, m/s^2

        Raises
        ------
        ParameterError
            If a body without a frequency parameter is asked for its share.
        """
        if self.kind != P_PGV:
            return 1.0
        if not isinstance(body, Block):
            raise ParameterError("p*pgv needs a body with a frequency parameter, a block: take pgv")
        return body.frequency_parameter(gravity) / gravity


_NAMES = (PGA, PGV, PGD, ARIAS, P_PGV)


def intensity_measure(text: str | IntensityMeasure) -> IntensityMeasure:
    """Return the measure that a text names.

    Parameters
    ----------
    text : str
        ``pga``, ``pgv``, ``pgd``, ``sa=0.5`` (the period in s), ``arias`` or ``p*pgv``.

    Raises
    ------
    ParameterError
        If it names none.

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
        raise ParameterError("the period of {text!r} is no number: write sa=0.5, in s", text=str(text)[:100]) from None


def factors_for(levels: FloatArray, value: float | FloatArray, measure: IntensityMeasure) -> FloatArray:
    """Return the factors on a motion of some intensity that bring it to each of some levels (derived here: level = value factor^power)."""
    return np.asarray((levels / value) ** (1.0 / measure.power))

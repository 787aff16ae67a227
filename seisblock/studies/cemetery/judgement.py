"""What a shaking does to a cemetery: rate, interval, curve, and what dowels would save, by the criterion that is asked for."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from seisblock.bodies.cemetery.cemetery import PAPER_WIDTH, Cemetery
from seisblock.bodies.inset import WORN, Inset
from seisblock.criteria.gravestones import DOWELLED, DOWELLED_REMARK, PLAIN, GravestoneFit, outside_fit
from seisblock.errors import ParameterError
from seisblock.measures import Conventions, measure
from seisblock.records import Motion, Record, motion_of
from seisblock.studies.cemetery.limits import fitted_limits, rigid_limits
from seisblock.studies.cemetery.rate import CONFIDENCE, CURVE_PGA, FREQUENCIES, CurvePoint, rate_curve, rate_of, remarks, threshold_ratio
from seisblock.studies.runs import Progress
from seisblock.typing import BoolArray, FloatArray
from seisblock.units import STANDARD_GRAVITY

Criterion = Literal["furukawa", "rigid", "simulate"]
FrequencyKind = Literal["pga_pgv", "fourier", "pulse_width"]

LARGER = "larger"
"""Name of the result of the horizontal that overturns more stones."""


@dataclass(frozen=True)
class Method:
    """How a stone is judged.

    Parameters
    ----------
    criterion : "furukawa", "rigid" or "simulate"
        [Furukawa2009]_ eqs. (9), (10); one rigid block under a half-sine pulse; one rigid block that rocks under the motion itself.
    fits : two GravestoneFit
        For stones without and with a dowel; furukawa only.
    inset : Inset
        How far the edges of the stones are worn; rigid and simulate only: the fits have it in them.
    width : float, m
        Of stones whose width is not known; furukawa needs none.
    gravity : float, m/s^2
    confidence : float
        Level of the interval of a rate.
    """

    criterion: Criterion = "furukawa"
    fits: tuple[GravestoneFit, GravestoneFit] = (PLAIN, DOWELLED)
    inset: Inset = WORN
    width: float = PAPER_WIDTH
    gravity: float = STANDARD_GRAVITY
    confidence: float = CONFIDENCE

    def limits(self, cemetery: Cemetery, frequency: float) -> FloatArray:
        """Return the PGA beyond which each stone falls, (size,), m/s^2, for the criteria that have one."""
        if self.criterion == "furukawa":
            return fitted_limits(cemetery, frequency, fits=self.fits)
        return rigid_limits(cemetery, frequency, inset=self.inset, width=self.width, gravity=self.gravity)

    @property
    def citations(self) -> tuple[str, ...]:
        """Keys of the papers relied on."""
        return ("Furukawa2009",) if self.criterion == "furukawa" else ("Furukawa2009", "Housner1963")


@dataclass(frozen=True, eq=False)
class Shaking:
    """What shakes a cemetery: the numbers of a criterion, and the motion behind them where there is one.

    Parameters
    ----------
    pga, frequency : float, m/s^2 and Hz
    component : str or None
        Direction of a record; None for bare numbers.
    motion : Motion or None
    """

    pga: float
    frequency: float
    component: str | None = None
    motion: Motion | None = None


@dataclass(frozen=True)
class Reinforcement:
    """What becomes of the same cemetery when stones get dowels; keys as in :class:`CemeteryRate`."""

    reinforced_stones: int
    threshold_ratio: float | None
    rate: float
    rate_interval: tuple[float, float]
    fallen: int
    stones_saved: int
    curve: tuple[CurvePoint, ...]


@dataclass(frozen=True)
class CemeteryRate:
    """What one shaking does to a cemetery; the fields are the keys of one result of ``seisblock overturn-rate --json``.

    Parameters
    ----------
    component : str or None
        Direction of the record, ``larger`` for the horizontal that overturns more stones, None for bare numbers.
    pga_m_s2, equivalent_frequency_hz : float
    threshold_ratio : float or None
        Least H/B that falls without a dowel (with one where all stones have one); None where it is simulated.
    threshold_ratio_reinforced : float or None
        Least H/B that falls with a dowel; None where the criterion knows none.
    rate : float
    rate_interval : two floats
        Clopper-Pearson.
    fallen, stones : int
    least_overturned_ratio, largest_standing_ratio : float or None
        H/B of the stoutest stone that fell and of the most slender that stands.
    reinforced : Reinforcement or None
        The comparison with dowels, where it was asked for.
    curve : tuple of CurvePoint
        The rate against PGA, at this frequency and at the standard ones.
    outside_fit : tuple of str
        What lies outside the range of (9), (10), a sentence each; none where they are not used.
    of : str or None
        Which component ``larger`` is.
    """

    component: str | None
    pga_m_s2: float
    equivalent_frequency_hz: float
    threshold_ratio: float | None
    threshold_ratio_reinforced: float | None
    rate: float
    rate_interval: tuple[float, float]
    fallen: int
    stones: int
    least_overturned_ratio: float | None
    largest_standing_ratio: float | None
    reinforced: Reinforcement | None
    curve: tuple[CurvePoint, ...]
    outside_fit: tuple[str, ...] = ()
    of: str | None = None


def shakings_of(
    record: Record,
    components: Sequence[str],
    *,
    kind: FrequencyKind = "pga_pgv",
    frequency: float | None = None,
    conventions: Conventions | None = None,
) -> list[Shaking]:
    """Return PGA and equivalent frequency of each component of a record ([Furukawa2009]_ section 3(5)e).

    Parameters
    ----------
    record : Record
        Prepared as it shall be judged.
    components : sequence of str
        Horizontal codes, or azimuths.
    kind : "pga_pgv", "fourier" or "pulse_width"
        Definition of the equivalent frequency; the paper's choice is PGA/(2 pi PGV), both of one component.
    frequency : float, Hz
        Overrides it.
    conventions : Conventions
        Filter behind the PGV.

    Raises
    ------
    ParameterError
        If a component has no such frequency.
    """
    found = []
    for m in measure(record, components, conventions=conventions).components:
        f = getattr(m.equivalent_frequency_hz, kind) if frequency is None else frequency
        if f is None or not m.pga_m_s2 > 0.0:
            raise ParameterError(f"component {m.component} has no equivalent frequency {kind}: choose another kind, or give a frequency")
        found.append(Shaking(m.pga_m_s2, f, m.component, motion_of(record, m.component)))
    return found


def overturned(cemetery: Cemetery, shaking: Shaking, method: Method) -> BoolArray:
    """Return which stones fall, (size,), by the criterion asked for ([Furukawa2009]_, [Housner1963]_)."""
    if method.criterion == "simulate":
        from seisblock.studies.cemetery.simulated import simulated_overturns, sine_motion

        motion = shaking.motion or sine_motion(shaking.pga, shaking.frequency)
        return simulated_overturns(cemetery, motion, inset=method.inset, width=method.width, gravity=method.gravity)
    if not shaking.pga > 0.0:
        raise ParameterError(f"the peak ground acceleration must be positive, found {shaking.pga} m/s^2")
    falls: BoolArray = shaking.pga > method.limits(cemetery, shaking.frequency)
    return falls


def curve_of(
    cemetery: Cemetery,
    method: Method,
    shaking: Shaking | None = None,
    frequencies: Sequence[float] = FREQUENCIES,
    *,
    progress: Progress | None = None,
) -> tuple[CurvePoint, ...]:
    """Return the rate against PGA, at a shaking's frequency first and at others ([Furukawa2009]_ figs. 16, 17).

    Simulated curves scale the shaking's own motion, or sines of 20 s where there is none, to 100, 200, ... 1300 gal.
    """
    if method.criterion == "simulate":
        from seisblock.studies.cemetery.simulated import SIMULATED_PGA, simulated_curve, sine_motion

        own = [(shaking.motion, shaking.frequency)] if shaking is not None and shaking.motion is not None else []
        asked = [] if own else list(frequencies) if shaking is None else [shaking.frequency]
        motions = own or [(sine_motion(1.0, f), f) for f in asked]
        return simulated_curve(
            cemetery, motions, SIMULATED_PGA, inset=method.inset, width=method.width, gravity=method.gravity, progress=progress
        )
    first = [] if shaking is None else [shaking.frequency]
    wanted = list(dict.fromkeys([*first, *frequencies]))
    return rate_curve(cemetery, CURVE_PGA, wanted, limits=method.limits)


def judge_cemetery(
    cemetery: Cemetery, shaking: Shaking, method: Method, *, after: Cemetery | None = None, progress: Progress | None = None
) -> CemeteryRate:
    """Return what a shaking does to a cemetery, and to the same one with more dowels ([Furukawa2009]_ section 4).

    Parameters
    ----------
    cemetery : Cemetery
    shaking : Shaking
    method : Method
    after : Cemetery or None
        The cemetery reinforced, see :meth:`Cemetery.dowelled`; None for no comparison.
    progress : callable
        Told how many points of a simulated curve are done, and how many there are.
    """
    falls = overturned(cemetery, shaking, method)
    found, ratios = rate_of(falls, method.confidence), cemetery.ratios
    return CemeteryRate(
        shaking.component,
        shaking.pga,
        shaking.frequency,
        _threshold(cemetery, shaking, method),
        _threshold(cemetery.dowelled(), shaking, method) if method.criterion == "furukawa" else None,
        found.rate,
        found.rate_interval,
        found.fallen,
        found.stones,
        float(ratios[falls].min()) if falls.any() else None,
        None if falls.all() else float(ratios[~falls].max()),
        None if after is None else _reinforcement(after, shaking, method, found.fallen),
        curve_of(cemetery, method, shaking, progress=progress),
        outside_fit(shaking.pga, shaking.frequency, ratios) if method.criterion == "furukawa" else (),
    )


def larger_of(rates: Sequence[CemeteryRate]) -> CemeteryRate:
    """Return the result that overturns most stones, the larger PGA deciding a tie, under the name ``larger``."""
    chosen = max(rates, key=lambda each: (each.rate, each.pga_m_s2))
    return replace(chosen, component=LARGER, of=chosen.component)


def warnings_of(cemetery: Cemetery, shakings: Sequence[Shaking], method: Method, *, after: Cemetery | None = None) -> list[str]:
    """Return what should be known before believing rates, a sentence each, with the component they belong to ([Furukawa2009]_)."""
    fitted = method.criterion == "furukawa"
    found = [
        (f"{shaking.component}: " if shaking.component else "") + text
        for shaking in shakings
        for text in remarks(cemetery, shaking.pga, shaking.frequency, fitted=fitted)
    ]
    if fitted and method.fits[1] == DOWELLED and (cemetery.reinforced.any() or after is not None):
        found.append(DOWELLED_REMARK)
    return list(dict.fromkeys(found))


def _threshold(cemetery: Cemetery, shaking: Shaking, method: Method) -> float | None:
    """Return the least H/B that falls, None where it is simulated."""
    if method.criterion == "simulate":
        return None
    return threshold_ratio(shaking.pga, shaking.frequency, reinforced=bool(cemetery.reinforced.all()), limits=method.limits)


def _reinforcement(after: Cemetery, shaking: Shaking, method: Method, fallen: int) -> Reinforcement:
    """Return what becomes of the reinforced cemetery."""
    found = rate_of(overturned(after, shaking, method), method.confidence)
    return Reinforcement(
        int(np.count_nonzero(after.reinforced)),
        threshold_ratio(shaking.pga, shaking.frequency, reinforced=True, limits=method.limits),
        found.rate,
        found.rate_interval,
        found.fallen,
        fallen - found.fallen,
        curve_of(after, method, shaking),
    )

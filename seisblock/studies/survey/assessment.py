"""Assessment of a cemetery under one shaking: overturning rate, interval, curve, and stones saved by dowels."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np

from seisblock.bodies.cemetery.cemetery import Cemetery
from seisblock.bodies.edge_wear import DEFAULT_WEAR, EdgeWear
from seisblock.bodies.table import PAPER_WIDTH
from seisblock.core import checks
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.typing import BoolArray, FloatArray, Progress
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.criteria.gravestones import DOWELLED, DOWELLED_NOTE, PLAIN, GravestoneFit, fit_range_warnings
from seisblock.measures import FilterRange
from seisblock.records import Motion
from seisblock.records._validation import Gain
from seisblock.references import papers
from seisblock.studies.intervals import CONFIDENCE
from seisblock.studies.survey.likelihood import COMMON_ERROR, STONE_ERROR
from seisblock.studies.survey.limits import fitted_limits, rigid_limits
from seisblock.studies.survey.model_rates import ModelRate, rates_by_model
from seisblock.studies.survey.overturning_rate import (
    CURVE_PGA,
    FREQUENCIES,
    CurvePoint,
    rate_curve,
    rate_from_stones,
    rate_warnings,
    threshold_ratio,
)
from seisblock.studies.survey.shaking import Shaking
from seisblock.studies.survey.simulation import (
    rocking_thresholds,
    sampled_overturns,
    simulated_curve,
    simulated_overturns,
    sine_motion,
)
from seisblock.studies.survey.stones import Contingency, StoneResult, count_agreement, either, stone_results

Criterion = Literal["furukawa", "rigid", "simulate"]

LARGER_COMPONENT, EITHER_COMPONENT = N_("larger"), N_("either")
"""Names of the results of the horizontal that overturns more stones, and of both: a stone counts if either overturns it."""

CRITERION_SCATTER = math.hypot(COMMON_ERROR, STONE_ERROR)
"""Standard deviation of ln PGA at which a stone overturns about a criterion in closed form."""

MAX_SAMPLES, MIN_RUNS = 40_000, 8
"""Samples of all simulated stones together, and least number of samples of a stone."""


@dataclass(frozen=True)
class AssessmentMethod:
    """Criterion and parameters of an assessment.

    Parameters
    ----------
    criterion : "furukawa", "rigid" or "simulate"
        [Furukawa2009]_ eqs. (9), (10); one rigid block under a half-sine pulse; one rigid block that rocks under the motion itself.
    fits : two GravestoneFit
        Criteria of stones without and with a dowel; furukawa only.
    inset : EdgeWear or None
        Edge wear of the stones; rigid and simulate only: the fits include it. None: the prior of gravestones.
    width : float, m
        Width of stones of unknown width; unused by furukawa.
    gravity : float, m/s^2
    confidence : float
        Level of the interval of a rate.
    vertical : bool, float or None
        True or a factor to apply the vertical component to simulated stones; None: where the record has one.
    runs : int
        Number of samples of each simulated stone; fewer for more than :data:`MAX_SAMPLES` in all.
    seed : int
    """

    criterion: Criterion = "furukawa"
    fits: tuple[GravestoneFit, GravestoneFit] = (PLAIN, DOWELLED)
    inset: EdgeWear | None = None
    width: float = PAPER_WIDTH
    gravity: float = STANDARD_GRAVITY
    confidence: float = CONFIDENCE
    vertical: Gain | None = None
    runs: int = 40
    seed: int = 0

    def limits(self, cemetery: Cemetery, frequency: float) -> FloatArray:
        """Return the overturning PGA of each stone, (size,), m/s^2; furukawa and rigid only."""
        if self.criterion == "furukawa":
            return fitted_limits(cemetery, frequency, fits=self.fits)
        return rigid_limits(cemetery, frequency, inset=self.inset or DEFAULT_WEAR, width=self.width, gravity=self.gravity)

    @property
    def citations(self) -> tuple[str, ...]:
        """Keys of the papers of the criterion."""
        return papers("gravestones as fitted" if self.criterion == "furukawa" else "gravestones as blocks")


@dataclass(frozen=True)
class Reinforcement:
    """Result for the same cemetery with dowels; keys as in :class:`CemeteryRate`."""

    reinforced_stones: int
    threshold_ratio: float | None
    rate: float
    rate_interval: tuple[float, float]
    fallen: int
    stones_saved: int
    curve: tuple[CurvePoint, ...]


@dataclass(frozen=True)
class CemeteryRate:
    """Assessment of a cemetery under one shaking; the fields are the keys of one result in the document of ``overturn-rate``.

    Parameters
    ----------
    component : str or None
        Direction of the record, ``larger`` for the horizontal that overturns more stones, None for bare numbers.
    pga_m_s2, equivalent_frequency_hz : float
    threshold_ratio : float or None
        Smallest overturning H/B without a dowel (with one if all stones have one); None if simulated.
    threshold_ratio_reinforced : float or None
        Smallest overturning H/B with a dowel; None without a criterion for dowels.
    rate : float
    rate_interval : two floats
        Clopper-Pearson.
    fallen, stones : int
    least_overturned_ratio, largest_standing_ratio : float or None
        H/B of the stoutest fallen stone and of the most slender standing one.
    reinforced : Reinforcement or None
        The comparison with dowels, if required.
    curve : tuple of CurvePoint
        The rate against PGA, at this frequency and at the standard ones.
    outside_fit : tuple of str
        Warnings about values outside the range of (9), (10), a sentence each; none if these are unused.
    of : str or None
        Component named ``larger``.
    usual_highpass : FilterRange or None
        Change of PGV and frequency with the usual filters; None up to 5 %, or if the rate does not depend on a PGV.
    rate_range : two floats or None
        Smallest and largest rate at those frequencies.
    models : tuple of ModelRate
        The rate by each model of the stones, independent of the criterion.
    mean_probability : float or None
        Mean overturning probability of the stones: the expected rate.
    each_stone : tuple of StoneResult
        Computed and observed outcome of each row of the cemetery.
    contingency : Contingency or None
        Numbers of surveyed stones by computed and observed outcome; None without observed ones.
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
    usual_highpass: FilterRange | None = None
    rate_range: tuple[float, float] | None = None
    models: tuple[ModelRate, ...] = ()
    mean_probability: float | None = None
    each_stone: tuple[StoneResult, ...] = ()
    contingency: Contingency | None = None


@dataclass(frozen=True, eq=False)
class StoneOutcomes:
    """Computed outcomes of the rows of a cemetery under one shaking.

    Parameters
    ----------
    falls : (rows,) array of bool
    thresholds : (rows,) array, m/s^2
        See :class:`~seisblock.studies.survey.stones.StoneResult`.
    probabilities : (rows,) array
    samples : (rows, runs) array of bool or None
        Falls of the samples of simulated stones.
    """

    falls: BoolArray
    thresholds: FloatArray
    probabilities: FloatArray
    samples: BoolArray | None = None


def assess_stones(cemetery: Cemetery, shaking: Shaking, method: AssessmentMethod) -> BoolArray:
    """Return the stones that overturn, (size,), by the criterion of a method ([Furukawa2009]_, [Housner1963]_)."""
    if method.criterion == "simulate":
        motion = _simulated_motion(shaking)
        return simulated_overturns(
            cemetery, motion, inset=method.inset, width=method.width, vertical=method.vertical, gravity=method.gravity
        )
    checks.positive("the peak ground acceleration", shaking.pga, "m/s^2")
    falls: BoolArray = shaking.pga > method.limits(cemetery, shaking.frequency)
    return falls


def stone_outcomes(cemetery: Cemetery, shaking: Shaking, method: AssessmentMethod, *, progress: Progress | None = None) -> StoneOutcomes:
    """Return outcome, threshold and overturning probability of each row of a cemetery ([Furukawa2009]_, [Housner1963]_).

    The probability of a closed-form criterion follows from its scatter, :data:`CRITERION_SCATTER`; that of a simulated stone is the share
    of its samples.
    """
    rows = cemetery.rows()
    falls = assess_stones(rows, shaking, method)
    if method.criterion != "simulate":
        from scipy.special import ndtr

        thresholds = method.limits(rows, shaking.frequency)
        return StoneOutcomes(falls, thresholds, ndtr(np.log(shaking.pga / thresholds) / CRITERION_SCATTER))
    thresholds = rocking_thresholds(rows, inset=method.inset, width=method.width, gravity=method.gravity)
    samples = sampled_overturns(
        rows,
        _simulated_motion(shaking),
        max(MIN_RUNS, min(method.runs, MAX_SAMPLES // falls.size)),
        seed=method.seed,
        inset=method.inset,
        width=method.width,
        vertical=method.vertical,
        gravity=method.gravity,
        progress=progress,
    )
    return StoneOutcomes(falls, thresholds, samples.mean(axis=1), samples)


def _simulated_motion(shaking: Shaking) -> Motion:
    """Return the motion of a shaking; without a record a sine of its PGA and frequency."""
    return shaking.motion or sine_motion(shaking.pga, shaking.frequency)


def overturning_curve(
    cemetery: Cemetery,
    method: AssessmentMethod,
    shaking: Shaking | None = None,
    frequencies: Sequence[float] = FREQUENCIES,
    *,
    progress: Progress | None = None,
) -> tuple[CurvePoint, ...]:
    """Return the overturning rate against PGA, at the frequency of a shaking first and at others ([Furukawa2009]_ figs. 16, 17).

    Simulated curves scale the motion of the shaking, or sines of 20 s without one, to 100, 150, ... 1300 gal.
    """
    if method.criterion == "simulate":
        recorded_motions = [([shaking.motion], shaking.frequency)] if shaking is not None and shaking.motion is not None else []
        sine_frequencies = [] if recorded_motions else list(frequencies) if shaking is None else [shaking.frequency]
        motions = recorded_motions or [([sine_motion(1.0, f)], f) for f in sine_frequencies]
        return _simulated_curve(cemetery, motions, method, progress)
    first = [] if shaking is None else [shaking.frequency]
    curve_frequencies = list(dict.fromkeys([*first, *frequencies]))
    return rate_curve(cemetery, CURVE_PGA, curve_frequencies, limits=method.limits)


def _simulated_curve(
    cemetery: Cemetery, motions: Sequence[tuple[Sequence[Motion], float]], method: AssessmentMethod, progress: Progress | None
) -> tuple[CurvePoint, ...]:
    return simulated_curve(
        cemetery,
        motions,
        inset=method.inset,
        width=method.width,
        vertical=method.vertical,
        gravity=method.gravity,
        progress=progress,
    )


def assess_cemetery(
    cemetery: Cemetery,
    shaking: Shaking,
    method: AssessmentMethod,
    *,
    reinforced_cemetery: Cemetery | None = None,
    outcomes: StoneOutcomes | None = None,
    progress: Progress | None = None,
) -> CemeteryRate:
    """Return the assessment of a cemetery under a shaking, and of the same cemetery with more dowels ([Furukawa2009]_ section 4).

    Parameters
    ----------
    cemetery : Cemetery
    shaking : Shaking
    method : AssessmentMethod
    reinforced_cemetery : Cemetery or None
        The reinforced cemetery, see :meth:`Cemetery.with_dowels`; None for no comparison.
    outcomes : StoneOutcomes or None
        Of each row, if they were computed before.
    progress : callable
        Called with the number of finished points of a simulated curve and the total.
    """
    outcomes = stone_outcomes(cemetery, shaking, method) if outcomes is None else outcomes
    stones = stone_results(cemetery, outcomes.thresholds, outcomes.falls, outcomes.probabilities, width=method.width)
    falls = _repeat_counts(cemetery, outcomes.falls)
    # simulated stones use no PGV, so that its filter does not matter
    highpass_range = None if method.criterion == "simulate" else shaking.usual_highpass
    rate, ratios = rate_from_stones(falls, method.confidence), cemetery.ratios
    return CemeteryRate(
        shaking.component,
        shaking.pga,
        shaking.frequency,
        _threshold(cemetery, shaking, method),
        # only the fitted criterion distinguishes stones with a dowel
        _threshold(cemetery.with_dowels(), shaking, method) if method.criterion == "furukawa" else None,
        rate.rate,
        rate.rate_interval,
        rate.fallen,
        rate.stones,
        float(ratios[falls].min()) if falls.any() else None,
        None if falls.all() else float(ratios[~falls].max()),
        None if reinforced_cemetery is None else _reinforcement(reinforced_cemetery, shaking, method, rate.fallen),
        overturning_curve(cemetery, method, shaking, progress=progress),
        fit_range_warnings(shaking.pga, shaking.frequency, ratios) if method.criterion == "furukawa" else (),
        usual_highpass=highpass_range,
        rate_range=None if highpass_range is None else _rate_range(cemetery, shaking, method, highpass_range.pga_pgv_hz),
        models=rates_by_model(
            cemetery,
            shaking.pga,
            shaking.frequency,
            shaking.motion,
            width=method.width,
            vertical=method.vertical,
            gravity=method.gravity,
        ),
        mean_probability=float(_repeat_counts(cemetery, outcomes.probabilities).mean()),
        each_stone=stones,
        contingency=count_agreement(stones),
    )


def assess_record(
    cemetery: Cemetery,
    shakings: Sequence[Shaking],
    method: AssessmentMethod,
    *,
    reinforced_cemetery: Cemetery | None = None,
    progress: Progress | None = None,
) -> list[CemeteryRate]:
    """Return the assessment of a cemetery under each component of a record, and under both horizontals where there are two.

    The last result counts stones, not components: a simulated stone falls if either component overturns it (``either``). A criterion in
    closed form orders the stones by H/B, so that the component with most falls counts the same stones (``larger``).

    Parameters
    ----------
    cemetery, method, reinforced_cemetery, progress
        As for :func:`assess_cemetery`.
    shakings : sequence of Shaking
        Of one record.
    """
    outcomes = [stone_outcomes(cemetery, shaking, method, progress=progress) for shaking in shakings]
    rates = [
        assess_cemetery(cemetery, shaking, method, reinforced_cemetery=reinforced_cemetery, outcomes=outcome, progress=progress)
        for shaking, outcome in zip(shakings, outcomes, strict=True)
    ]
    if len(rates) < 2:
        return rates
    if method.criterion != "simulate":
        return [*rates, larger_component(rates)]
    return [*rates, _either_component(cemetery, shakings, method, rates, outcomes, progress)]


def _either_component(
    cemetery: Cemetery,
    shakings: Sequence[Shaking],
    method: AssessmentMethod,
    rates: Sequence[CemeteryRate],
    outcomes: Sequence[StoneOutcomes],
    progress: Progress | None,
) -> CemeteryRate:
    """Return the assessment of simulated stones, each of which falls if any component overturns it."""
    row_falls = either([outcome.falls for outcome in outcomes])
    # the same seed draws the same samples under each component
    probabilities = either([outcome.samples for outcome in outcomes if outcome.samples is not None]).mean(axis=1)
    stones = stone_results(cemetery, outcomes[0].thresholds, row_falls, probabilities, width=method.width)
    falls, ratios = _repeat_counts(cemetery, row_falls), cemetery.ratios
    rate = rate_from_stones(falls, method.confidence)
    motions = [_simulated_motion(shaking) for shaking in shakings]
    largest = larger_component(rates)
    # PGA and frequency remain those of the component with most falls; rates by model refer to one component
    return replace(
        largest,
        component=EITHER_COMPONENT,
        rate=rate.rate,
        rate_interval=rate.rate_interval,
        fallen=rate.fallen,
        least_overturned_ratio=float(ratios[falls].min()) if falls.any() else None,
        largest_standing_ratio=None if falls.all() else float(ratios[~falls].max()),
        curve=_simulated_curve(cemetery, [(motions, largest.equivalent_frequency_hz)], method, progress),
        models=(),
        mean_probability=float(_repeat_counts(cemetery, probabilities).mean()),
        each_stone=stones,
        contingency=count_agreement(stones),
    )


def larger_component(rates: Sequence[CemeteryRate]) -> CemeteryRate:
    """Return the result that overturns most stones, the larger PGA breaking a tie, under the name ``larger``."""
    largest = max(rates, key=lambda rate: (rate.rate, rate.pga_m_s2))
    return replace(largest, component=LARGER_COMPONENT, of=largest.component)


def cemetery_warnings(
    cemetery: Cemetery, shakings: Sequence[Shaking], method: AssessmentMethod, *, reinforced_cemetery: Cemetery | None = None
) -> list[str]:
    """Return warnings about rates, a sentence each, with the component of each ([Furukawa2009]_)."""
    uses_fit = method.criterion == "furukawa"
    messages = [
        lazy_gettext("{name}: {text}", name=shaking.component, text=text) if shaking.component else text
        for shaking in shakings
        for text in rate_warnings(cemetery, shaking.pga, shaking.frequency, uses_fit=uses_fit)
    ]
    if uses_fit and method.fits[1] == DOWELLED and (cemetery.reinforced.any() or reinforced_cemetery is not None):
        messages.append(DOWELLED_NOTE)
    # without duplicates, in order
    return list(dict.fromkeys(messages))


def _repeat_counts(cemetery: Cemetery, values: Any) -> Any:
    """Return values of rows as values of stones, (size,)."""
    return np.repeat(values, [stone.count for stone in cemetery.stones])


def _rate_range(cemetery: Cemetery, shaking: Shaking, method: AssessmentMethod, frequencies: Sequence[float]) -> tuple[float, float]:
    """Return the smallest and the largest rate over some frequencies and that of the shaking itself."""
    rates = [float(assess_stones(cemetery, replace(shaking, frequency=f), method).mean()) for f in (shaking.frequency, *frequencies)]
    return min(rates), max(rates)


def _threshold(cemetery: Cemetery, shaking: Shaking, method: AssessmentMethod) -> float | None:
    """Return the smallest overturning H/B, None if simulated."""
    if method.criterion == "simulate":
        return None
    return threshold_ratio(shaking.pga, shaking.frequency, reinforced=bool(cemetery.reinforced.all()), limits=method.limits)


def _reinforcement(reinforced_cemetery: Cemetery, shaking: Shaking, method: AssessmentMethod, fallen: int) -> Reinforcement:
    rate = rate_from_stones(assess_stones(reinforced_cemetery, shaking, method), method.confidence)
    return Reinforcement(
        int(np.count_nonzero(reinforced_cemetery.reinforced)),
        threshold_ratio(shaking.pga, shaking.frequency, reinforced=True, limits=method.limits),
        rate.rate,
        rate.rate_interval,
        rate.fallen,
        fallen - rate.fallen,
        overturning_curve(reinforced_cemetery, method, shaking),
    )

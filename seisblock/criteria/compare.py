"""Comparison of all overturning criteria for one block and one motion."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from seisblock.bodies.block import Block
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.i18n import N_
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.criteria.gravestones import DOWELLED, PLAIN, GravestoneFit, overturning_pga
from seisblock.criteria.overturning import (
    housner_acceleration,
    housner_acceleration_as_printed,
    ishiyama_acceleration,
    ishiyama_velocity,
    static_acceleration,
    tsutsui_velocity,
    velocity_step,
)
from seisblock.criteria.pulses import half_sine_acceleration, half_sine_ratio, one_sine_ratio, rectangular_ratio

ACCELERATION, VELOCITY = "m/s^2", "m/s"

PREFERRED_FREQUENCY = "pga_pgv"
"""Equivalent frequency for which the gravestone criterion was verified with records ([Furukawa2009]_ section 3(5)e)."""


@dataclass(frozen=True, repr=False)
class CriterionResult(DisplayMixin):
    """Threshold of one criterion and demand of the motion.

    Parameters
    ----------
    criterion : str
        Name of the criterion.
    where : str
        Paper and equation.
    unit : str
        Unit of threshold and demand, ``m/s^2`` or ``m/s``.
    frequency : str or None
        Name of the equivalent frequency used; None if the criterion does not depend on frequency.
    frequency_hz : float or None
    threshold, demand : float, in `unit`
        The criterion predicts overturning if the demand exceeds the threshold.
    overturns : bool
    """

    criterion: str
    where: str
    unit: str
    frequency: str | None
    frequency_hz: float | None
    threshold: float
    demand: float
    overturns: bool


def overturning_card(
    block: Block, pga: float, pgv: float, frequencies: Mapping[str, float | None], gravity: float = STANDARD_GRAVITY
) -> tuple[CriterionResult, ...]:
    """Return the results of all criteria for a block and the peaks of a motion.

    B and H of the formulas are twice the lever arm and twice the height of the centre of gravity (gravestone fits: overall width and
    height). The rectangular pulse has the impulse of a half sine of the equivalent frequency, t = 1/(pi f)
    ([Tsutsui]_ eq. (3)). [Ishiyama1982]_ requires both its acceleration and its velocity to be exceeded. The overturning ratios of
    Kaneko and Hayashi (2000) are not included, because the paper was not available.

    Parameters
    ----------
    block : Block
    pga, pgv : float, m/s^2 and m/s
        Peak ground acceleration and velocity in the direction of rocking.
    frequencies : mapping of name to Hz
        Equivalent frequencies; None if undefined.
    gravity : float, m/s^2

    Returns
    -------
    tuple of CriterionResult
        One per criterion, in the order of the printed table.

    Raises
    ------
    ParameterError
        If a peak is negative or NaN.

    Examples
    --------
    >>> from seisblock.criteria import overturning_card
    >>> first = overturning_card(Block(0.24, 0.8), 4.0, 0.5, {"pga_pgv": 1.3})[0]
    >>> first.criterion, round(first.threshold, 2), first.overturns
    ('West, static', 2.94, True)
    """
    checks.instance(block, Block)
    checks.non_negative("the PGA", pga, "m/s^2")
    checks.non_negative("the PGV", pgv, "m/s")
    # the shorter arm governs for an asymmetric block
    width, height = 2 * min(block.arms), 2 * block.centre
    alpha, p = block.slenderness, block.frequency_parameter(gravity)
    rows = [
        _make_result(N_("West, static"), "[Furukawa2009]_ eq. (2)", ACCELERATION, static_acceleration(width, height, gravity), pga),
        _make_result(N_("Ishiyama, acceleration"), "[Ishiyama1982]_", ACCELERATION, ishiyama_acceleration(width, height, gravity), pga),
        _make_result(N_("Ishiyama, velocity"), "[Ishiyama1982]_", VELOCITY, ishiyama_velocity(width, height), pgv),
        _make_result(N_("Tsutsui, constant force"), "[Tsutsui]_ eq. (2)", VELOCITY, tsutsui_velocity(width, height, gravity), pgv),
        _make_result(N_("Tsutsui, cosine"), "[Tsutsui]_ eq. (4)", VELOCITY, tsutsui_velocity(width, height, gravity, cosine=True), pgv),
        _make_result(N_("velocity step, exact"), "[Tsutsui]_ eq. (2), exact", VELOCITY, velocity_step(alpha, p, gravity), pgv),
    ]
    ratio = block.height / block.width

    def gravestone(fit: GravestoneFit) -> Callable[[float], float]:
        return lambda f: float(overturning_pga(ratio, f, fit))

    by_frequency: tuple[tuple[str, str, Callable[[float], float]], ...] = (
        (N_("Housner, first form"), "[Furukawa2009]_ eq. (6)", lambda f: housner_acceleration(alpha, p, f, gravity)),
        (N_("Housner, as printed"), "[Furukawa2009]_ eq. (6)", lambda f: housner_acceleration_as_printed(width, height, f, gravity)),
        (N_("half sine, linear"), "[Housner1963]_", lambda f: gravity * alpha * half_sine_ratio(2 * math.pi * f / p)),
        (N_("half sine, nonlinear"), "[Housner1963]_", lambda f: half_sine_acceleration(alpha, p, f, gravity)),
        (N_("one sine, no impact"), "[Zhang2001]_", lambda f: gravity * alpha * one_sine_ratio(2 * math.pi * f / p)),
        (N_("rectangular pulse"), "[Housner1963]_", lambda f: gravity * alpha * rectangular_ratio(1 / (math.pi * f), p)),
        (N_("gravestone"), "[Furukawa2009]_ eq. (9)", gravestone(PLAIN)),
        (N_("gravestone, dowelled"), "[Furukawa2009]_ eq. (10)", gravestone(DOWELLED)),
    )
    for criterion, reference, threshold in by_frequency:
        for name, f in frequencies.items():
            if f is not None:
                rows.append(_make_result(criterion, reference, ACCELERATION, threshold(f), pga, name, f))
    return tuple(rows)


def unique_criteria(rows: Sequence[CriterionResult], frequency: str = PREFERRED_FREQUENCY) -> tuple[CriterionResult, ...]:
    """Return one row per criterion: that of the preferred equivalent frequency, or the first.

    Parameters
    ----------
    rows : sequence of CriterionResult
        Result of :func:`overturning_card`.
    frequency : str
        Preferred equivalent frequency; PGA/(2 pi PGV) by default, as in [Furukawa2009]_ section 3(5)e.
    """
    by_criterion: dict[str, CriterionResult] = {}
    for row in rows:
        if row.criterion not in by_criterion or row.frequency == frequency:
            by_criterion[row.criterion] = row
    return tuple(by_criterion.values())


def count_agreeing(rows: Sequence[CriterionResult], overturned: bool) -> tuple[int, int]:
    """Return how many criteria, each counted once, predict the outcome, and their total."""
    unique = unique_criteria(rows)
    return sum(row.overturns == overturned for row in unique), len(unique)


def _make_result(
    criterion: str, reference: str, unit: str, threshold: float, demand: float, frequency: str | None = None, hz: float | None = None
) -> CriterionResult:
    return CriterionResult(criterion, reference, unit, frequency, hz, threshold, demand, demand > threshold)

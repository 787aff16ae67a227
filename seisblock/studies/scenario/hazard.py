"""Records of a site hazard: suites scaled to several intensities, each record with its annual frequency."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from seisblock.core import checks
from seisblock.core.errors import HazardError
from seisblock.core.i18n import Message, lazy_gettext
from seisblock.core.typing import FloatArray
from seisblock.records.record import Record
from seisblock.studies.hazard.curve import Hazard
from seisblock.studies.scenario.motions import ScenarioTarget, scale_to_target, unscaled_suite

LEVELS = 8
"""Intensities of a hazard that are analysed."""

RECORDS_PER_LEVEL = 10
"""Records of each intensity."""

MIN_RATE_SHARE = 1e-3
"""Frequency of the highest intensity, as a share of that which the target probability allows."""


@dataclass(frozen=True, eq=False)
class RecordFrequencies:
    """Weights of the records of a scenario or of a hazard.

    Parameters
    ----------
    rates : (records,) array, 1 or 1/year
        Shares of the records of a scenario, or their annual frequencies.
    years : float or None
        Period of a probability under the hazard; None for a scenario.
    """

    rates: FloatArray
    years: float | None

    def probability(self, shares: FloatArray) -> float:
        """Return the probability of an event from its share under each record: in the scenario, or in the period.

        Parameters
        ----------
        shares : (records,) array, 1

        Examples
        --------
        >>> frequencies = RecordFrequencies(np.array([0.01, 0.001]), 50.0)
        >>> round(frequencies.probability(np.array([0.0, 0.5])), 4)
        0.0247
        """
        rate = float(self.rates @ shares)
        return rate if self.years is None else -math.expm1(-self.years * rate)


def hazard_suite(
    hazard: Hazard, *, years: float, target: float, seed: int = 0
) -> tuple[list[Record], RecordFrequencies, tuple[Message, ...]]:
    """Return records that stand for a site hazard, their annual frequencies, and notes.

    The same suite is scaled to intensities in equal logarithmic steps over the levels of the table, and beyond them as far as rarer ones
    matter for the target; each stands for the frequency between the geometric means with its neighbours. Weaker motions than the first
    level count as harmless.

    Parameters
    ----------
    hazard : Hazard
        In ``pga``, ``pgv`` or ``sa``.
    years : float
        Period of the target probability.
    target : float, 1
        Probability in that period.
    seed : int

    Raises
    ------
    HazardError
        If the records cannot be scaled to the intensity measure of the hazard.
    """
    checks.positive("the period", years, "years")
    checks.in_interval("the target probability", target, "(0, 1)")
    kind, _, period = hazard.im.partition("=")
    if kind not in ("pga", "pgv", "sa"):
        raise HazardError("the hazard must be one of pga, pgv or sa, found {im}: give a curve in one of these", im=hazard.im)
    first = max(float(np.asarray(branch.levels)[0]) for branch in hazard.branches)
    last = max(float(np.asarray(branch.levels)[-1]) for branch in hazard.branches)
    # rates of the tail below a small part of the allowed one do not matter
    allowed = -math.log1p(-target) / years * MIN_RATE_SHARE
    grid = np.geomspace(first, last, 200)
    relevant = grid[hazard.rate(grid) >= allowed]
    last = float(relevant[-1]) if relevant.size else last
    if not last > first:
        raise HazardError("the hazard has no level that is frequent enough for the target: give more frequent levels")
    edges = np.geomspace(first, last, LEVELS + 1)
    rates = hazard.rate(edges)
    # the last interval also stands for everything above it
    frequencies = np.append(rates[:-2] - rates[1:-1], rates[-2])
    targets = [_target(kind, period, math.sqrt(low * high)) for low, high in pairwise(edges.tolist())]
    suite = unscaled_suite(RECORDS_PER_LEVEL, seed=seed)
    records = [scale_to_target(record, item) for item in targets for record in suite]
    note = lazy_gettext(
        "{count} records at {levels} intensities, {im} {first:.3g} to {last:.3g} in the unit of the hazard table, each with its annual "
        "frequency",
        count=len(records),
        levels=LEVELS,
        im=hazard.im,
        first=first / hazard.table_unit,
        last=last / hazard.table_unit,
    )
    return (
        records,
        RecordFrequencies(np.repeat(frequencies / RECORDS_PER_LEVEL, RECORDS_PER_LEVEL), years),
        (note, *map(lazy_gettext, hazard.notes)),
    )


def _target(kind: str, period: str, level: float) -> ScenarioTarget:
    if kind == "sa":
        return ScenarioTarget(sa_m_s2=level, period_s=float(period))
    return ScenarioTarget(pga_m_s2=level) if kind == "pga" else ScenarioTarget(pgv_m_s=level)

"""Overturning of a block from the peaks of a motion alone: closed forms, and rocking under records scaled to both peaks."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from seisblock.bodies.block import Block
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import ParameterError
from seisblock.core.typing import Progress
from seisblock.criteria.compare import PREFERRED_FREQUENCY, CriterionResult, overturning_card
from seisblock.models.rock.options import RockOptions
from seisblock.records.record import Record
from seisblock.studies.rocking.verdicts import parallel_verdicts
from seisblock.studies.sampling import sample_gains, sample_rock_params
from seisblock.studies.scenario.assess import overturning_interval, versions_for
from seisblock.studies.scenario.motions import motion_pairs
from seisblock.studies.scenario.runs import VERSIONS, draw_cases


@dataclass(frozen=True, repr=False)
class SuiteProbability(DisplayMixin):
    """Overturning probability of a rocking block under the records of a suite.

    Parameters
    ----------
    records, runs : int
        Number of records, and of runs with a result.
    overturning_probability : float, 1
        Share of the runs in which the block overturns under either horizontal component.
    interval : (float, float), 1
        95 % interval over the records: model error not included.
    """

    records: int
    runs: int
    overturning_probability: float
    interval: tuple[float, float]


@dataclass(frozen=True, repr=False)
class PeakAssessment(DisplayMixin):
    """Criteria of a block for the peaks of a motion without a record.

    Parameters
    ----------
    block : Block
    pga_m_s2, pgv_m_s : float
    frequency_hz : float
        Equivalent frequency, PGA/(2 pi PGV).
    rows : tuple of CriterionResult
    suite : SuiteProbability or None
        Runs under records scaled to both peaks; None if not computed.
    """

    block: Block
    pga_m_s2: float
    pgv_m_s: float
    frequency_hz: float
    rows: tuple[CriterionResult, ...]
    suite: SuiteProbability | None = None


def assess_peaks(
    block: Block,
    pga_m_s2: float,
    pgv_m_s: float,
    *,
    records: Sequence[Record] = (),
    options: RockOptions = RockOptions(),
    seed: int = 0,
    progress: Progress | None = None,
) -> PeakAssessment:
    """Return the criteria of a block for the peaks of a motion, and its overturning probability under records scaled to them.

    Parameters
    ----------
    block : Block
    pga_m_s2, pgv_m_s : float
    records : sequence of Record
        Scaled to both peaks, see :func:`~seisblock.studies.scenario.motions.scenario_suite`; none: closed forms only.
    options : RockOptions
    seed : int
    progress : callable
        Called with the number of finished motions and their total.

    Raises
    ------
    ParameterError
        If a peak is not positive, or no run has a result.
    """
    checks.positive("PGA", pga_m_s2, "m/s^2")
    checks.positive("PGV", pgv_m_s, "m/s")
    frequency_hz = pga_m_s2 / (2.0 * math.pi * pgv_m_s)
    rows = overturning_card(block, pga_m_s2, pgv_m_s, {PREFERRED_FREQUENCY: frequency_hz}, options.gravity)
    suite = _suite_probability(block, records, options, seed, progress) if records else None
    return PeakAssessment(block, pga_m_s2, pgv_m_s, frequency_hz, rows, suite)


def _suite_probability(
    block: Block, records: Sequence[Record], options: RockOptions, seed: int, progress: Progress | None
) -> SuiteProbability:
    """Return the share of versions and records under which a block rocks over its edge in either horizontal direction."""
    pairs = motion_pairs(records)
    draws = draw_cases(len(pairs), seed, versions=versions_for(len(pairs)))
    fell, complete = np.zeros(draws.shape[:2], bool), np.ones(draws.shape[:2], bool)
    for index, pair in enumerate(pairs):
        for motion in pair:
            params = sample_rock_params(block, motion, VERSIONS, draws[index], options)
            verdicts = parallel_verdicts(params, motion, sample_gains(motion, VERSIONS, draws[index], params.vertical))
            fell[index] |= verdicts.overturned
            complete[index] &= ~verdicts.gave_up
        if progress is not None:
            progress(index + 1, len(pairs))
    complete |= fell
    if not complete.any():
        raise ParameterError("all runs were stopped: use a smaller `restitution`")
    counts, runs = (fell & complete).sum(axis=1), complete.sum(axis=1)
    return SuiteProbability(len(pairs), int(runs.sum()), float(fell[complete].mean()), overturning_interval(counts, runs))

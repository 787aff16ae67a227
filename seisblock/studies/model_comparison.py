"""Comparison of the models of one object: overturning verdict and scale factor to overturning by each.

Rigid block with sharp or worn edges, criterion fitted to gravestones, half-sine pulse of the record's equivalent frequency, lower
limits from experiments. The difference between models exceeds the parameter variation of each, and no single model shows it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from seisblock.bodies.block import Block
from seisblock.bodies.block_array import wear_within
from seisblock.bodies.edge_wear import DEFAULT_WEAR, SHARP_EDGES
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.top_block import rigid_top
from seisblock.bodies.table import PAPER_WIDTH
from seisblock.core.i18n import N_
from seisblock.core.results import Response
from seisblock.criteria.gravestones import DOWELLED, FITTED_RATIO, PLAIN, GravestoneFit, overturning_pga
from seisblock.criteria.initiation import onset_factor
from seisblock.criteria.overturning import ishiyama_acceleration, ishiyama_velocity
from seisblock.criteria.pulses import half_sine_acceleration
from seisblock.measures.frequency import pga_pgv_frequency
from seisblock.measures.peaks import peak_acceleration
from seisblock.measures.summary import conventions_of, motion_peaks
from seisblock.models.rock.options import RockOptions
from seisblock.models.rock.verdicts import rock_verdict
from seisblock.records import Motion
from seisblock.records._validation import vertical_gain

if TYPE_CHECKING:
    from seisblock.models.stack.outcome import StackOutcome

SHARP_BLOCK = N_("rigid block with sharp edges")
WORN_BLOCK = N_("rigid block with worn edges")
GRAVESTONES = N_("gravestone criterion")
PULSE = N_("half-sine pulse")
PILE = N_("pile of stones")
ISHIYAMA = N_("Ishiyama's limits of acceleration and velocity")

SAO = "sao"
"""Name of the upper stone of a grave in a pile."""

MAX_FACTOR, FACTOR_STEP = 4.0, 1.05
"""Largest factor of the search for the first overturning, and ratio of consecutive factors."""

GRAVESTONE_WIDTH_RANGE = (0.5, 2.0)
"""Range of widths, over the 8 sun of the criterion, of blocks treated as gravestones ([Furukawa2009]_ table 1)."""


@dataclass(frozen=True)
class ModelResult:
    """Verdict and scale factor to overturning by one model.

    Parameters
    ----------
    model : str
    falls : bool
        Under the unscaled motion.
    factor : float or None
        Scale factor to overturning: the first one of the search, for a simulated block. None up to a factor of 4, or without a
        search.
    made_for_it : bool
        True for a model fitted to objects like this one.
    frequency_hz : float or None
        Of the half sine: PGA/(2 pi PGV) of the motion.
    worn : bool or None
        For a closed form for blocks: True with worn edges, False with sharp ones.
    """

    model: str
    falls: bool
    factor: float | None
    made_for_it: bool = False
    frequency_hz: float | None = None
    worn: bool | None = None


@dataclass(frozen=True)
class ModelComparison:
    """Results of all models of one object.

    Parameters
    ----------
    opinions : tuple of ModelResult
    falls, models : int
        Models that predict overturning, and all models.
    spread : float or None
        Ratio of the largest to the smallest scale factor; None with fewer than two.
    """

    opinions: tuple[ModelResult, ...]
    falls: int
    models: int
    spread: float | None

    @property
    def unanimous(self) -> bool:
        """True if all models agree on the unscaled motion."""
        return self.falls in (0, self.models)


def compare_models(
    block: Block,
    motion: Motion,
    *,
    stone: Block | None = None,
    fit: GravestoneFit | None = PLAIN,
    extra_results: Sequence[ModelResult] = (),
    options: RockOptions = RockOptions(),
) -> ModelComparison:
    """Return the results of the models of a block under a motion, and the spread of their scale factors.

    Parameters
    ----------
    block : Block
        With its own edge wear; 0.05 of the width if it has none.
    motion : Motion
    stone : Block
        The upper stone alone, for a block of several stones: the gravestone criterion uses its proportions.
    fit : GravestoneFit or None
        Gravestone criterion, applied to stones of its range of width and proportions ([Furukawa2009]_ eqs. (9), (10)); None: not
        applied.
    extra_results : sequence of ModelResult
        Results of other models.
    options : RockOptions

    Examples
    --------
    >>> import numpy as np
    >>> sine = Motion.from_arrays(4.0 * np.sin(2 * np.pi * 0.01 * np.arange(1001)), 0.01)
    >>> comparison = compare_models(Block(0.2424, 0.63), sine)
    >>> comparison.falls, comparison.models
    (3, 5)
    """
    pga = peak_acceleration(motion.horizontal)[0]
    # no scale factor exists for a zero motion
    if pga == 0.0:
        return ModelComparison(tuple(extra_results), 0, len(extra_results), None)
    worn_block = block if block.inset else block.with_wear(wear_within(block, DEFAULT_WEAR.share))
    results = [
        _simulate(SHARP_BLOCK, block.with_wear(SHARP_EDGES), motion, pga, options),
        _simulate(WORN_BLOCK, worn_block, motion, pga, options),
        *_closed_forms(block, stone or block, motion, pga, fit, options.gravity),
        *extra_results,
    ]
    factors = [result.factor for result in results if result.factor is not None]
    spread = max(factors) / min(factors) if len(factors) > 1 else None
    return ModelComparison(tuple(results), sum(result.falls for result in results), len(results), spread)


def _simulate(model: str, block: Block, motion: Motion, pga: float, options: RockOptions) -> ModelResult:
    """Return the verdict of a rocking block, and the first overturning factor of a geometric search."""

    def falls(factor: float) -> bool:
        return rock_verdict(block, motion, scale=factor, options=options).overturned

    # no overturning without rocking; the vertical motion changes the effective gravity and with it the threshold
    factor = min(block.rocking_threshold(options.gravity) / pga, MAX_FACTOR)
    if vertical := vertical_gain(motion, options.vertical):
        towards = math.tan(block.slendernesses[0]), math.tan(block.slendernesses[1])
        factor = min(onset_factor(towards, motion, gravity=options.gravity, vertical=vertical), MAX_FACTOR)
    while factor <= MAX_FACTOR and not falls(factor):
        factor *= FACTOR_STEP
    if factor > MAX_FACTOR:
        return ModelResult(model, falls(1.0), None)
    low, high = factor / FACTOR_STEP, factor
    # six halvings of a step of 5 % locate the factor to 0.1 %
    for _ in range(6):
        middle = (low * high) ** 0.5
        low, high = (low, middle) if falls(middle) else (middle, high)
    return ModelResult(model, falls(1.0), high)


def _closed_forms(block: Block, stone: Block, motion: Motion, pga: float, fit: GravestoneFit | None, gravity: float) -> list[ModelResult]:
    """Return the results of the closed forms: threshold over the motion's peak."""
    pgv = motion_peaks(motion.horizontal, motion.dt, conventions_of(motion.record)).pgv_m_s
    frequency = pga_pgv_frequency(pga, pgv)
    # equivalent rectangle on the weaker side
    width, height = 2 * min(block.arms), 2 * block.centre
    results = []
    ratio, (low, high) = stone.height / stone.width, FITTED_RATIO
    is_gravestone_like = GRAVESTONE_WIDTH_RANGE[0] <= stone.width / PAPER_WIDTH <= GRAVESTONE_WIDTH_RANGE[1] and low <= ratio <= high
    if frequency is not None and fit is not None and is_gravestone_like:
        factor = float(overturning_pga(ratio, frequency, fit)) / pga
        results.append(ModelResult(GRAVESTONES, factor < 1.0, factor, made_for_it=True))
    if frequency is not None:
        level = half_sine_acceleration(block.slenderness, block.frequency_parameter(gravity), frequency, gravity)
        results.append(ModelResult(PULSE, level < pga, level / pga, frequency_hz=frequency, worn=block.inset > 0.0))
    if pgv > 0.0:
        limits = ishiyama_acceleration(width, height, gravity) / pga, ishiyama_velocity(width, height) / pgv
        results.append(ModelResult(ISHIYAMA, max(limits) < 1.0, max(limits), worn=block.inset > 0.0))
    return results


def compare_pile_models(response: Response[StackOutcome], own: ModelResult | None = None) -> ModelComparison | None:
    """Return the results of the models of a pile's top stone beside the pile itself, None for a fixed top stone ([Furukawa2009]_).

    `own` is the result of the pile; by default its verdict on the top stone, without a factor.

    The top stone, with those dowelled to it, is one block with its nominal edges. The gravestone criterion applies to a sao, that of
    dowelled stones to one with a dowel.
    """
    pile: Pile = response.body
    if pile.names[-1] in pile.fixed:
        return None
    top, dowelled = pile.stones[-1], any(pile.names[-1] in group for group in pile.dowels)
    fit = (DOWELLED if dowelled else PLAIN) if top.name == SAO else None
    pile_result = own or ModelResult(PILE, top.name in response.outcome.overturned, None)
    block, stone = rigid_top(pile, 2), Block(top.width, top.height)
    options = RockOptions(vertical=response.options.vertical, gravity=response.options.gravity)
    return compare_models(block, response.motion, stone=stone, fit=fit, extra_results=[pile_result], options=options)

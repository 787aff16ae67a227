"""Where the models of one object disagree: each says whether it falls, and from which strength of the shaking on.

A stone has one fate and several models: a rigid block with sharp edges or worn ones, the fit to whole gravestones, a pulse of the
record's own frequency, a lower limit from experiments. They differ by more than their own scatter, and no one of them says so by itself.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from seisblock.bodies.block import Block
from seisblock.bodies.block_array import wear_within
from seisblock.bodies.cemetery.cemetery import PAPER_WIDTH
from seisblock.bodies.edge_wear import DEFAULT_WEAR, SHARP_EDGES
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.top_block import rigid_top
from seisblock.core.i18n import N_
from seisblock.core.results import Response
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.criteria.gravestones import DOWELLED, FITTED_RATIO, PLAIN, GravestoneFit, overturning_pga
from seisblock.criteria.overturning import ishiyama_acceleration, ishiyama_velocity
from seisblock.criteria.pulses import half_sine_acceleration
from seisblock.measures.baseline import ground_history
from seisblock.measures.frequency import pga_pgv_frequency
from seisblock.measures.peaks import peak_acceleration, peak_velocity
from seisblock.models.rock.verdicts import rock_verdict
from seisblock.models.stack.outcome import StackOutcome
from seisblock.records import Motion

SHARP_BLOCK = N_("rigid block with sharp edges")
WORN_BLOCK = N_("rigid block with worn edges")
GRAVESTONES = N_("criterion of gravestones")
PULSE = N_("half sine of that frequency")
PILE = N_("pile of stones")
ISHIYAMA = N_("Ishiyama's limits of acceleration and velocity")

SAO = "sao"
"""Name of the upper stone of a grave in a pile."""

MAX_FACTOR, FACTOR_STEP = 4.0, 1.05
"""A first fall is looked for at factors up to the first, each greater than the one before by the second."""

GRAVESTONE_WIDTH_RANGE = (0.5, 2.0)
"""Widths, over the 8 sun behind the criterion, at which a block is taken for a stone it was made for ([Furukawa2009]_ table 1)."""


@dataclass(frozen=True)
class ModelResult:
    """What one model says.

    Parameters
    ----------
    model : str
    falls : bool
        Under the motion as it is.
    factor : float or None
        On the motion, from which on it falls: the first one found, for a block that is simulated. None where it never falls up to 4
        times, or where nobody looked.
    made_for_it : bool
        Whether the model was made for objects like this one.
    frequency_hz : float or None
        Of the half sine: PGA/(2 pi PGV) of the motion.
    worn : bool or None
        Of a closed form for blocks, whether it was asked about worn edges, or about those of the drawing.
    """

    model: str
    falls: bool
    factor: float | None
    made_for_it: bool = False
    frequency_hz: float | None = None
    worn: bool | None = None


@dataclass(frozen=True)
class ModelComparison:
    """What all models of one object say.

    Parameters
    ----------
    opinions : tuple of Opinion
    falls, models : int
        In how many of how many models it falls.
    spread : float or None
        The largest of their factors over the smallest, a factor on the shaking; None where fewer than two have one.
    """

    opinions: tuple[ModelResult, ...]
    falls: int
    models: int
    spread: float | None

    @property
    def unanimous(self) -> bool:
        """Whether all models say the same of the motion as it is."""
        return self.falls in (0, self.models)


def compare_models(
    block: Block,
    motion: Motion,
    *,
    stone: Block | None = None,
    fit: GravestoneFit | None = PLAIN,
    extra_results: Sequence[ModelResult] = (),
    gravity: float = STANDARD_GRAVITY,
    **options: Any,
) -> ModelComparison:
    """Return what the models of a block say under a motion, and how far they are apart.

    Parameters
    ----------
    block : Block
        Its own inset counts as its worn edges; 0.05 of the width where it has none.
    motion : Motion
    stone : Block
        The upper stone alone, where the block is more than that: its proportions are those that the criterion of gravestones asks for.
    fit : GravestoneFit or None
        Of that criterion, which is asked only about stones of its width and proportions ([Furukawa2009]_ eqs. (9), (10)); None: not asked.
    extra_results : sequence of Opinion
        Of models that were asked elsewhere.
    gravity : float, m/s^2
    options
        ``restitution``, ``linear``, ``vertical`` of :func:`~seisblock.models.rock.solve.rock_verdict`.

    Examples
    --------
    >>> import numpy as np
    >>> sine = Motion.from_arrays(4.0 * np.sin(2 * np.pi * 0.01 * np.arange(1001)), 0.01)
    >>> found = compare_models(Block(0.2424, 0.63), sine)
    >>> found.falls, found.models
    (3, 5)
    """
    pga = peak_acceleration(motion.horizontal)[0]
    if pga == 0.0:
        return ModelComparison(tuple(extra_results), 0, len(extra_results), None)
    worn_block = block if block.inset else block.with_wear(wear_within(block, DEFAULT_WEAR.share))
    results = [
        _simulate(SHARP_BLOCK, block.with_wear(SHARP_EDGES), motion, pga, gravity, options),
        _simulate(WORN_BLOCK, worn_block, motion, pga, gravity, options),
        *_closed_forms(block, stone or block, motion, pga, fit, gravity),
        *extra_results,
    ]
    factors = [result.factor for result in results if result.factor is not None]
    spread = max(factors) / min(factors) if len(factors) > 1 else None
    return ModelComparison(tuple(results), sum(result.falls for result in results), len(results), spread)


def _simulate(model: str, block: Block, motion: Motion, pga: float, gravity: float, options: dict[str, Any]) -> ModelResult:
    """Return the verdict of a rocking block, and the first factor at which it was found to fall."""

    def falls(factor: float) -> bool:
        return rock_verdict(block, motion, scale=factor, gravity=gravity, **options).overturned

    # below the threshold of rocking nothing can fall, unless the ground falls away under it
    factor = min(block.rocking_threshold(gravity) / pga, MAX_FACTOR) if not options.get("vertical") else 0.1
    while factor <= MAX_FACTOR and not falls(factor):
        factor *= FACTOR_STEP
    if factor > MAX_FACTOR:
        return ModelResult(model, falls(1.0), None)
    low, high = factor / FACTOR_STEP, factor
    for _ in range(6):
        middle = (low * high) ** 0.5
        low, high = (low, middle) if falls(middle) else (middle, high)
    return ModelResult(model, falls(1.0), high)


def _closed_forms(block: Block, stone: Block, motion: Motion, pga: float, fit: GravestoneFit | None, gravity: float) -> list[ModelResult]:
    """Return what the closed forms say: their threshold over the motion's peak."""
    pgv = peak_velocity(ground_history(motion.horizontal, motion.dt), motion.dt)
    frequency = pga_pgv_frequency(pga, pgv)
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


def compare_pile_models(response: Response[StackOutcome]) -> ModelComparison | None:
    """Return what the models of a pile's top stone say beside the pile itself, None where that stone is held ([Furukawa2009]_).

    The top stone, with those it is dowelled to, is taken as one block with the edges of its drawing. The criterion of gravestones is asked
    where the top stone is a sao, and that of dowelled ones where it has a dowel.
    """
    pile: Pile = response.body
    if pile.names[-1] in pile.fixed:
        return None
    top, dowelled = pile.stones[-1], any(pile.names[-1] in group for group in pile.dowels)
    fit = (DOWELLED if dowelled else PLAIN) if top.name == SAO else None
    pile_result = ModelResult(PILE, top.name in response.outcome.overturned, None)
    block, stone = rigid_top(pile, 2), Block(top.width, top.height)
    return compare_models(
        block, response.motion, stone=stone, fit=fit, extra_results=[pile_result], gravity=response.options["gravity_m_s2"]
    )

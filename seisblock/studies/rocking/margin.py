"""Margin to overturning: the scale factors on a record at which the verdict changes.

Overturning is not monotone in amplitude: above an interval of overturning factors there may be another without overturning, and the
boundary between both is fractal. The whole range is therefore scanned, and each change of verdict is bisected; intervals narrower
than the step of the scan are missed, below the first overturning factor as above it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from seisblock.bodies.block import Block
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.limits import MAX_RUNS, check_limit
from seisblock.core.results import Response
from seisblock.core.typing import BoolArray, FloatArray, Progress
from seisblock.models.rock.options import RockOptions
from seisblock.models.rock.outcome import RockOutcome
from seisblock.models.rock.params import RockParams, rock_params
from seisblock.records import Motion
from seisblock.studies.rocking.verdicts import overturns_at

MAX_FACTOR = 3.0
"""Default largest factor of the scan."""

STEP = 0.002
"""Default step of the scan, in the factor."""

FLIP_TOLERANCE = 1e-6
"""Tolerance of the bisection of a change of verdict, in the factor."""

NEARBY_FACTORS = np.linspace(0.98, 1.02, 41)
"""Fine grid of factors around 1, which is among them: a verdict is sensitive if it changes within 2 % of the record's amplitude."""


@dataclass(frozen=True, repr=False)
class FactorRange(DisplayMixin):
    """Range of factors with one verdict."""

    first: float
    last: float
    overturned: bool


@dataclass(frozen=True, repr=False)
class Margin(DisplayMixin):
    """Verdict as a function of the factor on the record.

    Parameters
    ----------
    overturned : bool
        Verdict at factor 1.
    windows : tuple of FactorRange
        From 0 to the limit, alternately stable and overturning.
    flips : tuple of float
        Factors between them, in rising order.
    nearest_flip : float or None
        The flip nearest to 1, by ratio; None if the verdict never changes.
    first_fall : float or None
        Scale factor to overturning: the smallest overturning factor of the scan.
    falls_above_first : float or None
        Share of overturning factors from there to the limit, a step apart.
    step, limit : float, 1
        Step and largest factor of the scan.
    """

    overturned: bool
    windows: tuple[FactorRange, ...]
    flips: tuple[float, ...]
    nearest_flip: float | None
    first_fall: float | None
    falls_above_first: float | None
    step: float
    limit: float


def find_margin(
    block: Block,
    motion: Motion,
    *,
    limit: float = MAX_FACTOR,
    step: float = STEP,
    progress: Progress | None = None,
    options: RockOptions = RockOptions(),
) -> Margin:
    """Return the factors up to a limit at which the verdict on a rocking block changes.

    Parameters
    ----------
    block, motion : Block, Motion
    limit, step : float
        Largest factor and step of the scan; the factors of :func:`nearest_flip` are added. Changes are bisected to 1e-6.
    progress : callable
        Called with the number of finished runs and the total.
    options : RockOptions

    Returns
    -------
    Margin

    Raises
    ------
    ParameterError
        If limit or step are not positive, the step exceeds the limit, or an option is out of range.

    Examples
    --------
    >>> from seisblock.studies import find_margin
    >>> import numpy as np
    >>> pulse = Motion.from_arrays(4.0 * np.sin(np.linspace(0.0, np.pi, 101)), 0.01)
    >>> round(find_margin(Block(0.24, 0.8), pulse, limit=1.0, step=0.05).first_fall, 4)
    0.889
    """
    if not (0.0 < step <= limit < float("inf")):
        raise ParameterError("the scan requires 0 < `step` <= `limit`, found step {step} and limit {limit}", step=step, limit=limit)
    params = rock_params(block, motion, options)
    check_limit(N_("factors"), math.floor(min(limit / step, 1e18)), MAX_RUNS)
    regular_factors = np.unique(np.append(np.arange(round(limit / step) + 1) * step, [1.0, limit]))
    # a finer grid around 1, so that a verdict sensitive to 2 % of the amplitude is not missed
    grid = np.unique(np.concatenate([regular_factors, NEARBY_FACTORS]))
    factors = grid[grid <= limit]
    verdicts = overturns_at(params, motion, factors, progress=progress)
    flips = _bisect_flips(params, motion, factors, verdicts)
    edges = (0.0, *flips, limit)
    # factor 0 is stable, so windows alternate from there
    windows = tuple(FactorRange(low, high, bool(i % 2)) for i, (low, high) in enumerate(pairwise(edges)))
    nearest = min(flips, key=lambda flip: abs(np.log(flip))) if flips else None
    overturns_at_one = bool(verdicts[factors == 1.0][0] if limit >= 1.0 else overturns_at(params, motion, [1.0])[0])
    first = next((window.first for window in windows if window.overturned), None)
    # only the regular grid counts for the share: the finer one around 1 would weight it
    from_first_fall = np.isin(factors, regular_factors) & (factors >= factors[int(verdicts.argmax())])
    share = float(verdicts[from_first_fall].mean()) if verdicts.any() else None
    return Margin(overturns_at_one, windows, flips, nearest, first, share, step, limit)


def _bisect_flips(block: RockParams, motion: Motion, factors: FloatArray, verdicts: BoolArray) -> tuple[float, ...]:
    """Return the factors at which the verdict changes; all brackets are bisected in one batch."""
    changes = np.flatnonzero(verdicts[1:] != verdicts[:-1])
    low, high, upper_verdicts = factors[changes], factors[changes + 1], verdicts[changes + 1]
    # every bracket keeps its own verdict at the upper end, so one batch halves all of them
    while changes.size and (high - low).max() > FLIP_TOLERANCE:
        middle = 0.5 * (low + high)
        same = overturns_at(block, motion, middle) == upper_verdicts
        low, high = np.where(same, low, middle), np.where(same, middle, high)
    return tuple(float(flip) for flip in 0.5 * (low + high))


def flag_near_flip(response: Response[RockOutcome]) -> Response[RockOutcome]:
    """Return a response with a warning if a change of the record by less than 2 % changes its verdict."""
    factor = nearest_flip(response.body, response.motion, options=response.options)
    warnings = response.warnings
    if factor is not None:
        text = "{name}: the result is sensitive to the amplitude: it changes at {factor:.3f} times the record"
        warnings = (*warnings, lazy_gettext(text, name=response.motion.name or "x", factor=factor))
    outcome = replace(response.outcome, verdict_flips_within_2_percent=factor is not None, flips_at_factor=factor)
    return replace(response, outcome=outcome, warnings=warnings)


def nearest_flip(block: Block, motion: Motion, *, options: RockOptions = RockOptions()) -> float | None:
    """Return the factor nearest to 1, of :data:`NEARBY_FACTORS`, with another verdict than factor 1.

    Parameters
    ----------
    block, motion : Block, Motion
    options : RockOptions

    Returns
    -------
    float or None
        None if all verdicts agree.

    Examples
    --------
    >>> import numpy as np
    >>> pulses = [Motion.from_arrays(peak * np.sin(np.linspace(0.0, np.pi, 101)), 0.01) for peak in (4.0, 3.52)]
    >>> nearest_flip(Block(0.24, 0.8), pulses[0]) is None, nearest_flip(Block(0.24, 0.8), pulses[1])
    (True, 1.011)
    """
    verdicts = overturns_at(rock_params(block, motion, options), motion, NEARBY_FACTORS)
    flipped_factors = NEARBY_FACTORS[verdicts != verdicts[NEARBY_FACTORS.size // 2]]
    return round(float(flipped_factors[np.abs(flipped_factors - 1.0).argmin()]), 12) if flipped_factors.size else None

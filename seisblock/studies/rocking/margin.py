"""How close it was: the factors on a record at which the verdict changes, as far as a scan finds them.

Overturning is not monotone in amplitude: above a window in which a block overturns there may be another in which it stands, and the
boundary between both is fractal. So the whole range is scanned, and each change of verdict that is met is bisected; windows narrower
than the step of the scan are missed, below the first fall found as above it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Unpack

import numpy as np

from seisblock.bodies.block import Block
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.limits import check_limit
from seisblock.core.results import Response
from seisblock.core.typing import BoolArray, FloatArray, Progress
from seisblock.models.rock.outcome import RockOutcome
from seisblock.models.rock.params import RockOptions, RockParams, rock_params
from seisblock.records import Motion
from seisblock.studies.rocking.verdicts import overturns_at

MAX_FACTOR = 3.0
"""Default largest factor of the scan."""

STEP = 0.002
"""Default step of the scan, in the factor."""

FLIP_TOLERANCE = 1e-6
"""A change of verdict is located to this, in the factor."""

NEARBY_SHARE = 0.02
"""A verdict that changes within this share of the record's amplitude is fragile."""

NEARBY_STEPS = 41


@dataclass(frozen=True)
class FactorRange:
    """A range of factors with one verdict."""

    first: float
    last: float
    overturned: bool


@dataclass(frozen=True)
class Margin:
    """The verdict against the factor on the record.

    Parameters
    ----------
    overturned : bool
        Verdict at factor 1.
    windows : tuple of FactorRange
        From 0 to the limit, alternately safe and unsafe.
    flips : tuple of float
        The factors between them, in rising order.
    nearest_flip : float or None
        The one nearest to 1, by ratio; None when the verdict never changes.
    first_fall : float or None
        The smallest factor at which it was found to fall.
    falls_above_first : float or None
        Share of the factors, a step apart, from there to the limit at which it falls.
    step, limit : float, 1
        Of the scan.
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
    **options: Unpack[RockOptions],
) -> Margin:
    """Return the factors up to a limit at which a rocking block's verdict is found to change.

    Parameters
    ----------
    block, motion : Block, Motion
    limit, step : float
        Largest factor, and distance of the factors looked at, to which those that :func:`nearest_flip` looks at are added; changes are
        then bisected to 1e-6.
    progress : callable
        Told the number of runs done and the number in all.
    options
        ``restitution``, ``linear``, ``vertical``, ``gravity`` of :func:`~seisblock.models.rock.solve.solve_rock`.

    Raises
    ------
    ParameterError
        If limit or step are not positive, the step exceeds the limit, or an option is out of range.

    Examples
    --------
    >>> import numpy as np
    >>> pulse = Motion.from_arrays(4.0 * np.sin(np.linspace(0.0, np.pi, 101)), 0.01)
    >>> round(find_margin(Block(0.24, 0.8), pulse, limit=1.0, step=0.05).first_fall, 4)
    0.889
    """
    if not (0.0 < step <= limit < float("inf")):
        raise ParameterError("the scan needs 0 < step <= limit, found step {step} and limit {limit}", step=step, limit=limit)
    params = rock_params(block, motion, **options)
    check_limit(N_("factors"), math.floor(min(limit / step, 1e18)), "SEISBLOCK_RUNS")
    regular_factors = np.unique(np.append(np.arange(round(limit / step) + 1) * step, [1.0, limit]))
    grid = np.unique(np.concatenate([regular_factors, _nearby_factors()]))
    factors = grid[grid <= limit]
    verdicts = overturns_at(params, motion, factors, progress=progress)
    flips = _bisect_flips(params, motion, factors, verdicts)
    edges = (0.0, *flips, limit)
    windows = tuple(FactorRange(low, high, bool(i % 2)) for i, (low, high) in enumerate(pairwise(edges)))
    nearest = min(flips, key=lambda flip: abs(np.log(flip))) if flips else None
    overturns_at_one = bool(verdicts[factors == 1.0][0] if limit >= 1.0 else overturns_at(params, motion, [1.0])[0])
    first = next((window.first for window in windows if window.overturned), None)
    from_first_fall = np.isin(factors, regular_factors) & (factors >= factors[int(verdicts.argmax())])
    share = float(verdicts[from_first_fall].mean()) if verdicts.any() else None
    return Margin(overturns_at_one, windows, flips, nearest, first, share, step, limit)


def _bisect_flips(block: RockParams, motion: Motion, factors: FloatArray, verdicts: BoolArray) -> tuple[float, ...]:
    """Return the factors at which the verdict changes, all bisected at once."""
    changes = np.flatnonzero(verdicts[1:] != verdicts[:-1])
    low, high, upper_verdicts = factors[changes], factors[changes + 1], verdicts[changes + 1]
    while changes.size and (high - low).max() > FLIP_TOLERANCE:
        middle = 0.5 * (low + high)
        same = overturns_at(block, motion, middle) == upper_verdicts
        low, high = np.where(same, low, middle), np.where(same, middle, high)
    return tuple(float(flip) for flip in 0.5 * (low + high))


def flag_near_flip(response: Response[RockOutcome]) -> Response[RockOutcome]:
    """Return a response that knows, and warns, whether a change of the record by less than 2 % changes its verdict."""
    options = {key: response.options[key] for key in ("restitution", "linear", "vertical")}
    factor = nearest_flip(response.body, response.motion, gravity=response.options["gravity_m_s2"], **options)
    warnings = response.warnings
    if factor is not None:
        text = "{name}: a change of the record by less than 2 %, to {factor:.3f} times itself, changes the verdict"
        warnings = (*warnings, lazy_gettext(text, name=response.motion.name or "x", factor=factor))
    outcome = replace(response.outcome, verdict_flips_within_2_percent=factor is not None, flips_at_factor=factor)
    return replace(response, outcome=outcome, warnings=warnings)


def has_nearby_flip(
    block: Block, motion: Motion, *, share: float = NEARBY_SHARE, steps: int = NEARBY_STEPS, **options: Unpack[RockOptions]
) -> bool:
    """Return whether some factor within `share` of 1 changes the verdict; options as in :func:`find_margin`."""
    return nearest_flip(block, motion, share=share, steps=steps, **options) is not None


def nearest_flip(
    block: Block, motion: Motion, *, share: float = NEARBY_SHARE, steps: int = NEARBY_STEPS, **options: Unpack[RockOptions]
) -> float | None:
    """Return the factor nearest to 1, of so many within `share` of it, whose verdict is another than that at 1.

    Parameters
    ----------
    block, motion : Block, Motion
    share : float, 1
        How far from 1 the factors lie at most.
    steps : int
        How many are looked at; odd, so that 1 is among them.
    options
        As of :func:`find_margin`.

    Returns
    -------
    float or None
        None where all of them agree.

    Examples
    --------
    >>> import numpy as np
    >>> pulses = [Motion.from_arrays(peak * np.sin(np.linspace(0.0, np.pi, 101)), 0.01) for peak in (4.0, 3.52)]
    >>> nearest_flip(Block(0.24, 0.8), pulses[0]) is None, nearest_flip(Block(0.24, 0.8), pulses[1])
    (True, 1.011)
    """
    factors = _nearby_factors(share, steps)
    verdicts = overturns_at(rock_params(block, motion, **options), motion, factors)
    flipped_factors = factors[verdicts != verdicts[steps // 2]]
    return round(float(flipped_factors[np.abs(flipped_factors - 1.0).argmin()]), 12) if flipped_factors.size else None


def _nearby_factors(share: float = NEARBY_SHARE, steps: int = NEARBY_STEPS) -> FloatArray:
    """Return the factors near 1 that are always looked at, (steps,)."""
    return np.linspace(1.0 - share, 1.0 + share, steps)

"""Simulated overturning of the stones of a cemetery, each as one rocking rigid block.

A block that rocks about the edges of its base requires more shaking than [Furukawa2009]_ eq. (9), fitted to whole piles. The edges are
those of the sheet, of the call, or drawn from the prior of gravestones (:data:`~seisblock.bodies.edge_wear.WORN_RANGE`), whose median
is the wear of the nominal stone. A stone falls if either horizontal component overturns it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from seisblock.bodies.block import Block
from seisblock.bodies.block_array import to_block_array
from seisblock.bodies.cemetery.cemetery import Cemetery, Stone
from seisblock.bodies.edge_wear import EdgeWear
from seisblock.bodies.kinds import GRAVESTONE, of_kind
from seisblock.bodies.table import PAPER_WIDTH
from seisblock.core import checks
from seisblock.core.typing import BoolArray, FloatArray, IntArray, Progress
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.models.rock.options import RockOptions
from seisblock.models.rock.params import rock_batch_params
from seisblock.records import Motion
from seisblock.records._validation import Gain
from seisblock.studies.rocking.verdicts import parallel_verdicts
from seisblock.studies.sampling import ParameterVariation, draw_samples, sample_gains, sample_rock_params
from seisblock.studies.survey.limits import require_undowelled
from seisblock.studies.survey.overturning_rate import CurvePoint
from seisblock.studies.survey.stones import either

SIMULATED_PGA = tuple(0.5 * i for i in range(2, 27))
"""Amplitudes of simulated curves, m/s^2: the range of [Furukawa2009]_ section 3(3)a in half its steps."""

SINE_DURATION = 20.0
"""Length of the sines, s ([Furukawa2009]_ section 3(3)a)."""

SINE_SAMPLES_PER_PERIOD = 200
"""Samples per period: linear interpolation misses the sine by 1.2e-4 of its amplitude."""


def sine_motion(pga: float, frequency: float) -> Motion:
    """Return the sine base motion of [Furukawa2009]_ section 3(3)a: 20 s, starting at zero.

    Parameters
    ----------
    pga : float, m/s^2
        Amplitude.
    frequency : float, Hz
        Positive.

    Raises
    ------
    ParameterError
        If the frequency is not positive.
    """
    checks.positive("the frequency of the sine", frequency, "Hz")
    dt = 1.0 / (SINE_SAMPLES_PER_PERIOD * frequency)
    phase = 2.0 * np.pi * np.arange(round(SINE_DURATION / dt) + 1) / SINE_SAMPLES_PER_PERIOD
    return Motion.from_arrays(pga * np.sin(phase), dt, name=f"sine {frequency:g} Hz")


def stone_block(stone: Stone, *, inset: EdgeWear | None = None, width: float = PAPER_WIDTH) -> Block:
    """Return the upper stone of a grave as a rigid block.

    Parameters
    ----------
    stone : Stone
        Its own edge wear precedes `inset`.
    inset : EdgeWear or None
        Edge wear; None: the prior of gravestones, with its median as nominal value.
    width : float, m
        Width of a stone of unknown width.
    """
    b = width if stone.width is None else stone.width
    sharp = Block(b, b * stone.height_over_width, name="sao")
    known_inset = inset if stone.inset is None else stone.inset
    return of_kind(sharp, GRAVESTONE) if known_inset is None else sharp.with_wear(known_inset)


def _distinct_blocks(cemetery: Cemetery, inset: EdgeWear | None, width: float) -> tuple[list[Block], IntArray]:
    """Return the blocks of different stones, and the index of the block of each row: equal stones share their runs."""
    index: dict[Block, int] = {}
    rows = [index.setdefault(stone_block(stone, inset=inset, width=width), len(index)) for stone in cemetery.stones]
    return list(index), np.array(rows)


def simulated_overturns(
    cemetery: Cemetery,
    motion: Motion,
    *,
    scale: float = 1.0,
    inset: EdgeWear | None = None,
    width: float = PAPER_WIDTH,
    vertical: Gain | None = None,
    gravity: float = STANDARD_GRAVITY,
) -> BoolArray:
    """Return the stones that overturn under a motion, each rocking as one rigid block ([Housner1963]_), (size,).

    Parameters
    ----------
    cemetery : Cemetery
        Stones without dowels: a dowelled pile is not a rigid block.
    motion : Motion
    scale : float
        Factor on the motion.
    inset : EdgeWear or None
        Edge wear of stones without their own; None: the median of gravestones.
    width : float, m
        Width of stones of unknown width.
    vertical : bool, float or None
        True or a factor to apply the vertical component; None: where the record has one.
    gravity : float, m/s^2

    Raises
    ------
    ParameterError
        If a stone is reinforced, or the inset leaves nothing of a base.
    """
    require_undowelled(cemetery)
    blocks, index = _distinct_blocks(cemetery, inset, width)
    stones = rock_batch_params(to_block_array(blocks), motion, options=RockOptions(vertical=vertical, gravity=gravity))
    falls = parallel_verdicts(stones, motion, stones.gains(scale)).overturned[index]
    return np.repeat(falls, [stone.count for stone in cemetery.stones])


def sampled_overturns(
    cemetery: Cemetery,
    motion: Motion,
    runs: int,
    *,
    seed: int = 0,
    inset: EdgeWear | None = None,
    width: float = PAPER_WIDTH,
    vertical: Gain | None = None,
    gravity: float = STANDARD_GRAVITY,
    progress: Progress | None = None,
) -> BoolArray:
    """Return the samples of each row of a cemetery that overturn under a motion, (rows, runs).

    Sizes, restitution and shaking vary by their tolerances, unmeasured edges over the prior of gravestones; all stones, and all
    directions of one record, share the draws.

    Parameters
    ----------
    cemetery, motion, inset, width, vertical, gravity
        As for :func:`simulated_overturns`.
    runs : int
        Number of samples of each stone.
    seed : int
    progress : callable
        Called with the number of finished runs and the total.
    """
    require_undowelled(cemetery)
    options = RockOptions(vertical=vertical, gravity=gravity)
    blocks, index = _distinct_blocks(cemetery, inset, width)
    draws, variation = draw_samples(runs, checks.seed(seed)), ParameterVariation()
    # one batch of all stones and samples keeps all cores busy
    parts = [sample_rock_params(block, motion, variation, draws, options) for block in blocks]
    stones = replace(
        parts[0],
        alphas=np.concatenate([part.alphas for part in parts]),
        levers=np.concatenate([part.levers for part in parts]),
        restitutions=np.concatenate([part.restitutions for part in parts]),
    )
    gains = np.tile(sample_gains(motion, variation, draws, vertical), (len(blocks), 1))
    overturned = parallel_verdicts(stones, motion, gains, progress=progress).overturned
    return overturned.reshape(len(blocks), runs)[index]


def rocking_thresholds(
    cemetery: Cemetery, *, inset: EdgeWear | None = None, width: float = PAPER_WIDTH, gravity: float = STANDARD_GRAVITY
) -> FloatArray:
    """Return the acceleration at which each row of a cemetery starts to rock, (rows,), m/s^2 ([Furukawa2009]_ eq. (2))."""
    blocks, index = _distinct_blocks(cemetery, inset, width)
    return np.array([block.rocking_threshold(gravity) for block in blocks])[index]


def simulated_curve(
    cemetery: Cemetery,
    motions: Sequence[tuple[Sequence[Motion], float]],
    pga: Sequence[float] = SIMULATED_PGA,
    *,
    inset: EdgeWear | None = None,
    width: float = PAPER_WIDTH,
    vertical: Gain | None = None,
    gravity: float = STANDARD_GRAVITY,
    progress: Progress | None = None,
) -> tuple[CurvePoint, ...]:
    """Return the simulated overturning rate against PGA under scaled motions ([Furukawa2009]_ sections 3(3)a, 3(5)).

    Parameters
    ----------
    cemetery : Cemetery
    motions : sequence of (motions, float)
        Components that act on each stone, with their frequency, or equivalent frequency, Hz. A stone falls under any of them.
    pga : sequence of float, m/s^2
        Levels to which the largest component is scaled.
    inset, width, vertical, gravity
        As for :func:`simulated_overturns`.
    progress : callable
        Called with the number of finished points and the total.
    """
    points: list[CurvePoint] = []
    options: dict[str, Any] = {"inset": inset, "width": width, "vertical": vertical, "gravity": gravity}
    for components, frequency in motions:
        # all components share one factor: their ratio stays that of the record
        peak = max(float(np.abs(motion.horizontal).max()) for motion in components)
        for level in pga:
            falls = either([simulated_overturns(cemetery, motion, scale=level / peak, **options) for motion in components])
            points.append(CurvePoint(float(level), frequency, float(falls.mean())))
            if progress is not None:
                progress(len(points), len(motions) * len(pga))
    return tuple(points)

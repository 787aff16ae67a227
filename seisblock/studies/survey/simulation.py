"""Simulated overturning of the stones of a cemetery, each as one rocking rigid block.

A block that rocks about the edges of its base requires more shaking than [Furukawa2009]_ eq. (9), fitted to whole piles; under sines
it agrees within a tenth for edges worn by 0.1 of the width per side, the position of the outermost of 5 x 5 contact points. The
default wear is the median of gravestones (:data:`~seisblock.bodies.edge_wear.DEFAULT_WEAR`).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from seisblock.bodies.block import Block
from seisblock.bodies.block_array import rectangular_blocks
from seisblock.bodies.cemetery.cemetery import PAPER_WIDTH, Cemetery
from seisblock.bodies.edge_wear import DEFAULT_WEAR, EdgeWear
from seisblock.core import checks
from seisblock.core.typing import BoolArray, Progress
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.models.rock.options import RockOptions
from seisblock.models.rock.params import rock_batch_params
from seisblock.records import Motion
from seisblock.records._validation import Gain
from seisblock.studies.rocking.verdicts import parallel_verdicts
from seisblock.studies.survey.limits import require_undowelled
from seisblock.studies.survey.overturning_rate import CurvePoint

SIMULATED_PGA = tuple(float(i) for i in range(1, 14))
"""Amplitudes of simulated curves, m/s^2 ([Furukawa2009]_ section 3(3)a)."""

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


def sao(height_over_width: float, width: float = PAPER_WIDTH, *, inset: EdgeWear = DEFAULT_WEAR) -> Block:
    """Return the upper stone (sao) of a grave as a rigid block with worn edges.

    Parameters
    ----------
    height_over_width, width : float, 1 and m
        H/B and B of the homogeneous stone.
    inset : EdgeWear
        Per side.

    Raises
    ------
    ParameterError
        If the inset leaves nothing of the base.
    """
    return Block(width, width * height_over_width, name="sao").with_wear(inset)


def simulated_overturns(
    cemetery: Cemetery,
    motion: Motion,
    *,
    scale: float = 1.0,
    inset: EdgeWear = DEFAULT_WEAR,
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
    inset : EdgeWear
        As for :func:`sao`.
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
    # equal stones share one run
    sizes, index = np.unique(np.column_stack([cemetery.ratios, cemetery.widths(width)]), axis=0, return_inverse=True)
    ratio, b = sizes.T
    stones = rock_batch_params(rectangular_blocks(b, b * ratio, inset), motion, options=RockOptions(vertical=vertical, gravity=gravity))
    return parallel_verdicts(stones, motion, stones.gains(scale)).overturned[index.ravel()]


def simulated_curve(
    cemetery: Cemetery,
    motions: Sequence[tuple[Motion, float]],
    pga: Sequence[float] = SIMULATED_PGA,
    *,
    inset: EdgeWear = DEFAULT_WEAR,
    width: float = PAPER_WIDTH,
    vertical: Gain | None = None,
    gravity: float = STANDARD_GRAVITY,
    progress: Progress | None = None,
) -> tuple[CurvePoint, ...]:
    """Return the simulated overturning rate against PGA under scaled motions ([Furukawa2009]_ sections 3(3)a, 3(5)).

    Parameters
    ----------
    cemetery : Cemetery
    motions : sequence of (Motion, float)
        With the frequency, or equivalent frequency, of each, Hz.
    pga : sequence of float, m/s^2
        Levels to which each motion is scaled.
    inset, width, vertical, gravity
        As for :func:`simulated_overturns`.
    progress : callable
        Called with the number of finished points and the total.
    """
    points: list[CurvePoint] = []
    for motion, frequency in motions:
        peak = float(np.abs(motion.horizontal).max())
        for level in pga:
            falls = simulated_overturns(cemetery, motion, scale=level / peak, inset=inset, width=width, vertical=vertical, gravity=gravity)
            points.append(CurvePoint(float(level), frequency, float(falls.mean())))
            if progress is not None:
                progress(len(points), len(motions) * len(pga))
    return tuple(points)

"""Which stones of a cemetery fall when each is let rock as one rigid block, beside the formula fitted to whole piles.

A block that turns about the edges of its base needs more shaking than [Furukawa2009]_ eq. (9) says; under sines it comes within a tenth of
(9) about edges worn by 0.1 of its width per side, where the outermost of 5 x 5 contact points lie. Stones stand on edges worn by the median
of gravestones (:data:`~seisblock.bodies.edge_wear.DEFAULT_WEAR`) unless an inset is given.
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
from seisblock.models.rock.params import rock_batch_params
from seisblock.records import Motion
from seisblock.studies.rocking.verdicts import parallel_verdicts
from seisblock.studies.survey.limits import require_undowelled
from seisblock.studies.survey.overturning_rate import CurvePoint

SIMULATED_PGA = tuple(float(i) for i in range(1, 14))
"""Amplitudes at which curves are simulated, m/s^2: those of [Furukawa2009]_ section 3(3)a."""

SINE_DURATION = 20.0
"""Length of the sines, s ([Furukawa2009]_ section 3(3)a)."""

SINE_SAMPLES_PER_PERIOD = 200
"""Straight lines between so many samples miss the sine by 1.2e-4 of its amplitude."""


def sine_motion(pga: float, frequency: float) -> Motion:
    """Return the sine base motion of [Furukawa2009]_ section 3(3)a, 20 s from its zero.

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
    """Return the top stone of a grave as a rigid block with worn edges.

    Parameters
    ----------
    height_over_width, width : float, 1 and m
        H/B and B of the homogeneous stone.
    inset : Inset
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
    gravity: float = STANDARD_GRAVITY,
) -> BoolArray:
    """Return which stones overturn under a motion when each rocks alone as a rigid block ([Housner1963]_), (size,).

    Parameters
    ----------
    cemetery : Cemetery
        Stones that stand loose: a dowelled pile is no such block.
    motion : Motion
    scale : float
        Factor on the motion.
    inset : Inset
        As for :func:`sao`.
    width : float, m
        For stones whose width is not known.
    gravity : float, m/s^2

    Raises
    ------
    ParameterError
        If a stone is reinforced, or the inset leaves nothing of a base.
    """
    require_undowelled(cemetery)
    sizes, index = np.unique(np.column_stack([cemetery.ratios, cemetery.widths(width)]), axis=0, return_inverse=True)
    ratio, b = sizes.T
    stones = rock_batch_params(rectangular_blocks(b, b * ratio, inset), motion, gravity=gravity)
    return parallel_verdicts(stones, motion, stones.gains(scale)).overturned[index.ravel()]


def simulated_curve(
    cemetery: Cemetery,
    motions: Sequence[tuple[Motion, float]],
    pga: Sequence[float] = SIMULATED_PGA,
    *,
    inset: EdgeWear = DEFAULT_WEAR,
    width: float = PAPER_WIDTH,
    gravity: float = STANDARD_GRAVITY,
    progress: Progress | None = None,
) -> tuple[CurvePoint, ...]:
    """Return the simulated rate against PGA under scaled motions ([Furukawa2009]_ sections 3(3)a, 3(5)).

    Parameters
    ----------
    cemetery : Cemetery
    motions : sequence of (Motion, float)
        Each with its frequency, or equivalent frequency, Hz.
    pga : sequence of float, m/s^2
        To which each motion is scaled.
    inset, width, gravity
        As for :func:`simulated_overturns`.
    progress : callable
        Told the number of points done and the number in all.
    """
    points: list[CurvePoint] = []
    for motion, frequency in motions:
        peak = float(np.abs(motion.horizontal).max())
        for level in pga:
            falls = simulated_overturns(cemetery, motion, scale=level / peak, inset=inset, width=width, gravity=gravity)
            points.append(CurvePoint(float(level), frequency, float(falls.mean())))
            if progress is not None:
                progress(len(points), len(motions) * len(pga))
    return tuple(points)

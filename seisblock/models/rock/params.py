"""Validated parameters of rocking runs: corner properties, restitutions, gravity and gains of the ground motion."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from seisblock.bodies.block import Block, Restitution, resolve_restitutions
from seisblock.bodies.block_array import BlockArray, elementwise
from seisblock.core.errors import ParameterError
from seisblock.core.typing import FloatArray, IntArray
from seisblock.models.rock.options import RockOptions
from seisblock.records._validation import validate_inputs, validate_motion, vertical_gain
from seisblock.records.motion import Motion

CornerPair = tuple[float, float]
"""Values of the right and of the left corner."""


def threshold_ratios(alphas: CornerPair, *, linear: bool) -> CornerPair:
    """Return the ratios of horizontal to vertical acceleration at the rocking thresholds.

    tan(alpha) = b/h ([Furukawa2009]_ eq. (2)); alpha of the linear equation ([Zhang2001]_ eqs. (4), (5)).
    """
    return alphas if linear else (math.tan(alphas[0]), math.tan(alphas[1]))


@dataclass(frozen=True)
class RockParams:
    """Parameters of the rocking runs of one block; pairs are (right corner, left corner).

    Parameters
    ----------
    block : Block
    alphas, radii : (float, float), rad and m
        Slenderness angle and distance to the centre of gravity.
    levers : (float, float), 1/m
        m R/I_O.
    restitutions : (float, float)
        Restitution of an impact onto the corner.
    linear : bool
        True for the linear equation of slender blocks ([Zhang2001]_ eqs. (4), (5)).
    vertical : float
        Factor on the vertical ground motion.
    gravity : float, m/s^2
    """

    block: Block
    alphas: CornerPair
    radii: CornerPair
    levers: CornerPair
    restitutions: CornerPair
    linear: bool
    vertical: float
    gravity: float

    @property
    def thresholds(self) -> CornerPair:
        """Ratio of horizontal to vertical acceleration at the rocking threshold of each corner."""
        return threshold_ratios(self.alphas, linear=self.linear)

    @property
    def weak_corner(self) -> int:
        """Corner of easier overturning, 0 (right) or 1 (left)."""
        return 0 if self.alphas[0] <= self.alphas[1] else 1

    def gains(self, scale: float = 1.0) -> tuple[float, float, float]:
        """Return the factors on the motion's rows."""
        return scale, 0.0, scale * self.vertical


@dataclass(frozen=True, eq=False)
class RockBatchParams:
    """Parameters of m rocking blocks under one motion; columns are the right and the left corner.

    Parameters
    ----------
    alphas, levers, restitutions : (m, 2) arrays; rad, 1/m, 1
        See :class:`RockParams`.
    linear, vertical, gravity : bool, float, float
        Common to all rows.
    """

    alphas: FloatArray
    levers: FloatArray
    restitutions: FloatArray
    linear: bool
    vertical: float
    gravity: float

    def __len__(self) -> int:
        return self.alphas.shape[0]

    def __getitem__(self, index: slice | IntArray) -> RockBatchParams:
        """Return a selection of the rows."""
        return replace(self, alphas=self.alphas[index], levers=self.levers[index], restitutions=self.restitutions[index])

    @property
    def thresholds(self) -> FloatArray:
        """Ratio of horizontal to vertical acceleration at the rocking threshold of each corner, (m, 2)."""
        return self.alphas if self.linear else elementwise(math.tan, self.alphas).reshape(-1, 2)

    def gains(self, scale: float = 1.0) -> tuple[float, float, float]:
        """Return the factors on the motion's rows."""
        return scale, 0.0, scale * self.vertical


def rock_params(block: Block, motion: Motion, options: RockOptions = RockOptions()) -> RockParams:
    """Return the validated parameters of a rocking run.

    Raises
    ------
    KindError, ParameterError, ComponentError
        See :func:`~seisblock.models.rock.solve.solve_rock`.
    """
    validate_inputs(block, Block, motion)
    ratios = _check_restitution(resolve_restitutions(block, options.restitution), options.restitution)
    return RockParams(
        block,
        block.slendernesses,
        block.radii,
        block.lever_ratios,
        ratios,
        options.linear,
        vertical_gain(motion, options.vertical),
        options.gravity,
    )


def rock_batch_params(blocks: BlockArray, motion: Motion, options: RockOptions = RockOptions()) -> RockBatchParams:
    """Return the validated parameters of many rocking blocks; options and errors as for :func:`rock_params`."""
    validate_motion(motion)
    restitution = options.restitution
    pair = restitution if isinstance(restitution, tuple) or restitution is None else (restitution, restitution)
    ratios = blocks.restitutions if pair is None else np.tile(_check_restitution(pair, restitution), (len(blocks), 1))
    return RockBatchParams(
        blocks.slendernesses, blocks.lever_ratios, ratios, options.linear, vertical_gain(motion, options.vertical), options.gravity
    )


def _check_restitution(ratios: CornerPair, restitution: Restitution) -> CornerPair:
    """Return `ratios`; raise ParameterError unless both are numbers in [0, 1]."""
    if not all(isinstance(ratio, (int, float, np.floating)) and 0.0 <= ratio <= 1.0 for ratio in ratios):
        raise ParameterError(
            "`restitution` (ratio of angular velocities) must lie in [0, 1], found {found}; default: 1 - 1.5 sin^2(alpha)",
            found=repr(restitution),
        )
    return ratios

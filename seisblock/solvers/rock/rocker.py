"""Blocks as they rock: corners, restitutions, gravity and the gains of the ground motion, worked out once for any number of runs."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TypedDict, Unpack

import numpy as np

from seisblock import checks
from seisblock.bodies.block import Block, Restitution, restitutions
from seisblock.bodies.blocks import Blocks, each
from seisblock.errors import ParameterError
from seisblock.records.given import Factor, check_call, check_motion, vertical_gain
from seisblock.records.motion import Motion
from seisblock.typing import FloatArray, IntArray
from seisblock.units import STANDARD_GRAVITY

Pair = tuple[float, float]
"""One number of the right and one of the left corner."""


class RockOptions(TypedDict, total=False):
    """What may be said of a rocking run beside its block and its motion; see :func:`~seisblock.solvers.rock.solve.solve_rock`."""

    restitution: Restitution
    linear: bool
    vertical: Factor | None
    gravity: float


@dataclass(frozen=True)
class Rocker:
    """What every run of one block rests on.

    Parameters
    ----------
    block : Block
    alphas, radii : (float, float), rad and m
        Of the right and the left corner.
    levers : (float, float), 1/m
        m R/I_O of each.
    onto : (float, float)
        Restitution of an impact onto each.
    linear : bool
        Whether the equation is that of slender blocks ([Zhang2001]_ eqs. (4), (5)).
    vertical : float
        Factor on the vertical ground motion.
    gravity : float, m/s^2
    """

    block: Block
    alphas: Pair
    radii: Pair
    levers: Pair
    onto: Pair
    linear: bool
    vertical: float
    gravity: float

    @property
    def holds(self) -> Pair:
        """Horizontal over vertical acceleration that each corner holds at rest."""
        return self.alphas if self.linear else (math.tan(self.alphas[0]), math.tan(self.alphas[1]))

    @property
    def weaker(self) -> int:
        """The corner about which it falls more easily."""
        return 0 if self.alphas[0] <= self.alphas[1] else 1

    def gains(self, scale: float = 1.0) -> tuple[float, float, float]:
        """Return the factors on the motion's rows."""
        return scale, 0.0, scale * self.vertical


@dataclass(frozen=True, eq=False)
class Rockers:
    """Many blocks that rock under one motion: arrays with a row for each, and a column for its right and one for its left corner.

    Parameters
    ----------
    alphas, levers, onto : (m, 2) arrays; rad, 1/m, 1
        As of a :class:`Rocker`.
    linear, vertical, gravity : bool, float, float
        The same for all.
    """

    alphas: FloatArray
    levers: FloatArray
    onto: FloatArray
    linear: bool
    vertical: float
    gravity: float

    def __len__(self) -> int:
        return self.alphas.shape[0]

    def __getitem__(self, part: slice | IntArray) -> Rockers:
        """Return some of them."""
        return replace(self, alphas=self.alphas[part], levers=self.levers[part], onto=self.onto[part])

    @property
    def holds(self) -> FloatArray:
        """Horizontal over vertical acceleration that each corner holds at rest, (m, 2)."""
        return self.alphas if self.linear else each(math.tan, self.alphas).reshape(-1, 2)

    def gains(self, scale: float = 1.0) -> tuple[float, float, float]:
        """Return the factors on the motion's rows."""
        return scale, 0.0, scale * self.vertical


def rocker(
    block: Block,
    motion: Motion,
    *,
    restitution: Restitution = None,
    linear: bool = False,
    vertical: Factor | None = False,
    gravity: float = STANDARD_GRAVITY,
) -> Rocker:
    """Return a block as it rocks under a motion, or refuse what it cannot be asked.

    Parameters
    ----------
    block, motion, restitution, linear, vertical, gravity
        As for :func:`~seisblock.solvers.rock.solve.solve_rock`.

    Raises
    ------
    KindError, ParameterError, ComponentError
        As there.
    """
    check_call(block, Block, motion)
    onto = _checked(restitutions(block, restitution), restitution)
    return Rocker(
        block,
        block.slendernesses,
        block.radii,
        block.lever_ratios,
        onto,
        linear,
        vertical_gain(motion, vertical),
        checks.gravity(gravity),
    )


def rockers(blocks: Blocks, motion: Motion, **options: Unpack[RockOptions]) -> Rockers:
    """Return many blocks as they rock under a motion; parameters and refusals as of :func:`rocker`."""
    check_motion(motion)
    given = options.get("restitution")
    pair = given if isinstance(given, tuple) or given is None else (given, given)
    onto = blocks.restitutions if pair is None else np.tile(_checked(pair, given), (len(blocks), 1))
    return Rockers(
        blocks.slendernesses,
        blocks.lever_ratios,
        onto,
        options.get("linear", False),
        vertical_gain(motion, options.get("vertical", False)),
        checks.gravity(options.get("gravity", STANDARD_GRAVITY)),
    )


def _checked(onto: Pair, given: Restitution) -> Pair:
    """Return restitutions that are ratios between nothing and all."""
    if not all(0.0 <= ratio <= 1.0 for ratio in onto):
        raise ParameterError(
            "the restitution, a ratio of angular velocities, must lie in [0, 1], found {found}; leave it out for 1 - 1.5 sin^2(alpha)",
            found=str(given),
        )
    return onto

"""What many runs are given, as arrays: bodies and their contact with the ground, without an object for each."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from seisblock.bodies.block_array import BlockArray
from seisblock.core.typing import FloatArray
from seisblock.models.respond import constants
from seisblock.models.respond.params import JAM_WARNING_RATIO, SMALL_RATE, Initial, RespondParams, RigidBody


@dataclass(frozen=True, eq=False)
class RespondBatchParams:
    """Many settings; bit by bit what a :class:`~seisblock.models.respond.params.RespondParams` says of each.

    Parameters
    ----------
    blocks : Blocks
    mu, mu_kinetic, restitution : (m,) arrays, 1
    rocking : (m,) array, 1
        Angular velocity after over that before a rocking impact where `rocking_given`; else over that of an impact without losses beyond
        the impact law's, at most 1.
    rocking_given : bool
        Whether `rocking` stands in place of the impact law.
    gravity, tenon : float, m/s^2; float, m
        The same for all.

    Raises
    ------
    ParameterError
        If a number lies outside its range.
    """

    blocks: BlockArray
    mu: FloatArray
    mu_kinetic: FloatArray
    restitution: FloatArray
    rocking: FloatArray
    rocking_given: bool
    gravity: float
    tenon: float

    def __post_init__(self) -> None:
        is_valid = (self.mu < np.inf) & (self.mu_kinetic >= 0.0) & (self.mu_kinetic <= self.mu)
        is_valid &= (self.restitution >= 0.0) & (self.restitution < 1.0)
        is_valid &= (self.rocking >= 0.0) & (self.rocking <= 1.0)
        # what is the same for all, or wrong in one, is refused in the words of one
        self.row_params(int(np.argmin(is_valid)))

    def __len__(self) -> int:
        return len(self.blocks)

    def __getitem__(self, index: slice) -> RespondBatchParams:
        """Return some of them."""
        return replace(
            self,
            blocks=self.blocks[index],
            mu=self.mu[index],
            mu_kinetic=self.mu_kinetic[index],
            restitution=self.restitution[index],
            rocking=self.rocking[index],
        )

    def row_params(self, row: int) -> RespondParams:
        """Return one of them, by its number; nobody knows its mass and name."""
        right, left, height, gyration = (float(column[row]) for column in self.blocks.columns)
        rocking = float(self.rocking[row])
        return RespondParams(
            RigidBody(right, left, height, gyration, 1.0, ""),
            float(self.mu[row]),
            float(self.mu_kinetic[row]),
            float(self.restitution[row]),
            rocking if self.rocking_given else None,
            self.gravity,
            self.tenon,
            rocking_share=1.0 if self.rocking_given else rocking,
        )

    def parameters(self, dt: float, *, duration_s: float = 0.0, ground_at_rest: bool = False) -> FloatArray:
        """Return the parameters of the model in the order of its names, (m, 15)."""
        table = np.tile(self.row_params(0).parameters(dt, duration_s=duration_s, ground_at_rest=ground_at_rest), (len(self), 1))
        largest = self.blocks.radii.max(axis=1)
        kappa = self.blocks.gyration_squared / (largest * largest)
        limit = 2.0 * np.sqrt(kappa * (1.0 + kappa))
        table[:, constants.MU : constants.RESTITUTION + 1] = np.column_stack([self.mu, self.mu_kinetic, self.restitution])
        table[:, constants.ROCKING_RESTITUTION] = self.rocking if self.rocking_given else -self.rocking
        table[:, constants.ARM_RIGHT : constants.GYRATION + 1] = np.column_stack(self.blocks.columns)
        table[:, constants.NEAR_JAM] = self.mu_kinetic >= JAM_WARNING_RATIO * limit
        table[:, constants.SMALL_RATE] = SMALL_RATE * np.sqrt(self.gravity * largest)
        return table

    def states(self, initial: Initial) -> FloatArray:
        """Return the states of the bodies put down upright and at rest, or with the six numbers given for all."""
        return np.array([self.row_params(row).state(initial) for row in range(1 if initial is None else len(self))])

"""Parameters of many full-response runs as arrays, without one object per row."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from seisblock.bodies.block_array import BlockArray
from seisblock.core.typing import FloatArray
from seisblock.models.respond import constants
from seisblock.models.respond.params import JAM_WARNING_RATIO, SMALL_RATE, Initial, RespondParams, RigidBody


@dataclass(frozen=True, eq=False)
class RespondBatchParams:
    """Parameters of m runs; each row equals a :class:`~seisblock.models.respond.params.RespondParams` bit by bit.

    Parameters
    ----------
    blocks : BlockArray
    mu, mu_kinetic, restitution : (m,) arrays, 1
    rocking : (m,) array, 1
        With `rocking_given` the ratio of angular velocities in a rocking impact, else the share of Housner's ratio, at most 1.
    rocking_given : bool
        True where `rocking` replaces the impact law.
    gravity, tenon : float, m/s^2; float, m
        Common to all rows.

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
        # argmin is the first invalid row, or row 0: its RespondParams raises the message for it and for the common values
        self.row_params(int(np.argmin(is_valid)))

    def __len__(self) -> int:
        return len(self.blocks)

    def __getitem__(self, index: slice) -> RespondBatchParams:
        """Return a slice of the rows."""
        return replace(
            self,
            blocks=self.blocks[index],
            mu=self.mu[index],
            mu_kinetic=self.mu_kinetic[index],
            restitution=self.restitution[index],
            rocking=self.rocking[index],
        )

    def row_params(self, row: int) -> RespondParams:
        """Return the parameters of one row, with unit mass and an empty name."""
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
        """Return the parameter vectors of the model, (m, 15)."""
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
        """Return the initial states, (1 or m, 15): upright and at rest, or from `initial` for all rows."""
        return np.array([self.row_params(row).state(initial) for row in range(1 if initial is None else len(self))])

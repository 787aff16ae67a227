"""What many runs are given, as arrays: bodies and their contact with the ground, without an object for each."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from seisblock.bodies.blocks import Blocks
from seisblock.solvers.respond import names
from seisblock.solvers.respond.setting import NEARLY_JAMS, SMALL_RATE, Initial, Setting, Stand
from seisblock.typing import FloatArray


@dataclass(frozen=True, eq=False)
class Settings:
    """Many settings; bit by bit what a :class:`~seisblock.solvers.respond.setting.Setting` says of each.

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

    blocks: Blocks
    mu: FloatArray
    mu_kinetic: FloatArray
    restitution: FloatArray
    rocking: FloatArray
    rocking_given: bool
    gravity: float
    tenon: float

    def __post_init__(self) -> None:
        good = (self.mu < np.inf) & (self.mu_kinetic >= 0.0) & (self.mu_kinetic <= self.mu)
        good &= (self.restitution >= 0.0) & (self.restitution < 1.0)
        good &= (self.rocking >= 0.0) & (self.rocking <= 1.0)
        # what is the same for all, or wrong in one, is refused in the words of one
        self.one(int(np.argmin(good)))

    def __len__(self) -> int:
        return len(self.blocks)

    def __getitem__(self, part: slice) -> Settings:
        """Return some of them."""
        return replace(
            self,
            blocks=self.blocks[part],
            mu=self.mu[part],
            mu_kinetic=self.mu_kinetic[part],
            restitution=self.restitution[part],
            rocking=self.rocking[part],
        )

    def one(self, row: int) -> Setting:
        """Return one of them, by its number; nobody knows its mass and name."""
        right, left, height, gyration = (float(column[row]) for column in self.blocks.columns)
        rocking = float(self.rocking[row])
        return Setting(
            Stand(right, left, height, gyration, 1.0, ""),
            float(self.mu[row]),
            float(self.mu_kinetic[row]),
            float(self.restitution[row]),
            rocking if self.rocking_given else None,
            self.gravity,
            self.tenon,
            rocking_share=1.0 if self.rocking_given else rocking,
        )

    def parameters(self, dt: float, *, duration_s: float = 0.0, still: bool = False) -> FloatArray:
        """Return the parameters of the model in the order of its names, (m, 15)."""
        table = np.tile(self.one(0).parameters(dt, duration_s=duration_s, still=still), (len(self), 1))
        largest = self.blocks.radii.max(axis=1)
        kappa = self.blocks.gyration_squared / (largest * largest)
        limit = 2.0 * np.sqrt(kappa * (1.0 + kappa))
        table[:, names.MU : names.RESTITUTION + 1] = np.column_stack([self.mu, self.mu_kinetic, self.restitution])
        table[:, names.ROCKING_RESTITUTION] = self.rocking if self.rocking_given else -self.rocking
        table[:, names.ARM_RIGHT : names.GYRATION + 1] = np.column_stack(self.blocks.columns)
        table[:, names.STEEP] = self.mu_kinetic >= NEARLY_JAMS * limit
        table[:, names.SMALL_RATE] = SMALL_RATE * np.sqrt(self.gravity * largest)
        return table

    def states(self, initial: Initial) -> FloatArray:
        """Return the states of the bodies put down upright and at rest, or with the six numbers given for all."""
        return np.array([self.one(row).state(initial) for row in range(1 if initial is None else len(self))])

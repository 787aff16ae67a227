"""Batch results of the jump: arrays with one entry per run, and a table with one row per chain."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from seisblock.core._display import DisplayMixin
from seisblock.core.typing import BoolArray, FloatArray, IntArray
from seisblock.models.jump.chain import (
    ENDED_FLYING,
    ENDED_LANDED,
    ENDED_ROCKING,
    JUMPED,
    NO_JUMP,
    OVERTURNED_LANDED,
    OVERTURNED_ROCKING,
    Chain,
)
from seisblock.models.jump.solve import DID_NOT_ROCK

OUTCOMES = (DID_NOT_ROCK, NO_JUMP, JUMPED, OVERTURNED_ROCKING, OVERTURNED_LANDED, ENDED_ROCKING, ENDED_FLYING, ENDED_LANDED)
"""Outcomes of a block or a chain, indexed by `outcome_code` of :class:`JumpBatchResult`."""

NO_ROCKING, IMPACT, JUMP, OVERTURNS, OVERTURNS_LANDED, ROCKS, FLIES, MOVES = range(len(OUTCOMES))


@dataclass(frozen=True, eq=False)
class ChainTable:
    """Chains of many runs in chronological order; arrays of shape (n,), one entry per chain.

    Parameters
    ----------
    row, outcome_code : int
        Row of the run, and index into ``OUTCOMES``.
    onset_s, landing_s : s
        After the motion's first sample; NaN without a landing.
    friction_needed : 1
        Largest friction coefficient required by a landing; NaN without a landing.
    energy_before_j, energy_after_j : J
        Kinetic energy before and after the landing with the largest ratio of the two.
    """

    row: IntArray
    outcome_code: IntArray
    onset_s: FloatArray
    landing_s: FloatArray
    friction_needed: FloatArray
    energy_before_j: FloatArray
    energy_after_j: FloatArray


@dataclass(frozen=True, eq=False, repr=False)
class JumpBatchResult(DisplayMixin):
    """Results of m runs; arrays of shape (m,).

    Parameters
    ----------
    outcome_code : int
        Index into ``OUTCOMES``, see `outcome` of :class:`~seisblock.models.jump.solve.JumpOutcome`.
    jammed : bool
        True where a landed foot jammed: no result.
    total_displacement_m, final_displacement_m : m
        Sum over the chains, and residual displacement of the centroid; signed.
    friction_needed_at_landing : 1
        Largest friction coefficient required by a landing; NaN without a landing.
    rocking_threshold_m_s2, spin_ratio : m/s^2, 1
    chains : ChainTable
    gave_up : bool
        Abandoned runs without a result: their other entries refer to the preceding chains.
    """

    outcome_code: IntArray
    jammed: BoolArray
    total_displacement_m: FloatArray
    final_displacement_m: FloatArray
    friction_needed_at_landing: FloatArray
    rocking_threshold_m_s2: FloatArray
    spin_ratio: FloatArray
    chains: ChainTable
    gave_up: BoolArray

    @property
    def outcomes(self) -> list[str]:
        """Outcome texts of the rows."""
        return [OUTCOMES[code] for code in self.outcome_code.tolist()]

    def row_dict(self, row: int) -> dict[str, Any]:
        """Return the scalars of one run by their field names in the outcome; None for missing values."""
        friction = float(self.friction_needed_at_landing[row])
        return {
            "outcome": OUTCOMES[self.outcome_code[row]],
            "total_displacement_m": float(self.total_displacement_m[row]),
            "final_displacement_m": float(self.final_displacement_m[row]),
            "friction_needed_at_landing": None if np.isnan(friction) else friction,
            "rocking_threshold_m_s2": float(self.rocking_threshold_m_s2[row]),
            "spin_ratio": float(self.spin_ratio[row]),
        }

    def row_chains(self, row: int, start_s: float) -> tuple[Chain, ...]:
        """Return the chains of one run, with the fields of the table; times count from `start_s` at the first sample, s."""
        result = []
        for n in np.flatnonzero(self.chains.row == row).tolist():
            friction = float(self.chains.friction_needed[n])
            has_landed = not np.isnan(friction)
            chain = Chain(
                OUTCOMES[self.chains.outcome_code[n]],
                direction="",
                rocking_start_s=float(start_s + self.chains.onset_s[n]),
                landing_s=float(start_s + self.chains.landing_s[n]) if has_landed else None,
                friction_needed_at_landing=friction if has_landed else None,
                landing_energy_j=(float(self.chains.energy_before_j[n]), float(self.chains.energy_after_j[n])) if has_landed else None,
            )
            result.append(chain)
        return tuple(result)


def concatenate_chains(tables: Sequence[ChainTable]) -> ChainTable:
    """Return several tables of chains as one."""
    if not tables:
        return ChainTable(np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64), *(np.empty(0) for _ in range(5)))
    return ChainTable(*(np.concatenate([getattr(table, field.name) for table in tables]) for field in fields(ChainTable)))

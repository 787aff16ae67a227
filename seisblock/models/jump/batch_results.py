"""What becomes of many two-layer blocks, as arrays: an entry for each run, and one for each of their chains."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

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
"""What becomes of a block, or of a chain, by the numbers in :class:`JumpBatchResult`."""

NO_ROCKING, IMPACT, JUMP, OVERTURNS, OVERTURNS_LANDED, ROCKS, FLIES, MOVES = range(len(OUTCOMES))


@dataclass(frozen=True, eq=False)
class ChainTable:
    """The chains of many runs in the order of time, arrays with one entry per chain, (n,).

    Parameters
    ----------
    row, outcome_code : int
        Whose it is, and how it ended, a place in ``FATES``.
    onset_s, landing_s : s
        After the motion's first sample; NaN where it did not land.
    friction_needed : 1
        Largest friction that a landing needed; NaN where it did not land.
    energy_before_j, energy_after_j : J
        Kinetic energy before and after the landing that kept the largest share.
    """

    row: IntArray
    outcome_code: IntArray
    onset_s: FloatArray
    landing_s: FloatArray
    friction_needed: FloatArray
    energy_before_j: FloatArray
    energy_after_j: FloatArray


@dataclass(frozen=True, eq=False)
class JumpBatchResult:
    """The ends of many runs, arrays with one entry per row, (m,).

    Parameters
    ----------
    outcome_code : int
        A place in ``FATES``; as `outcome` of :class:`~seisblock.models.jump.solve.JumpOutcome` has it.
    jammed : bool
        Whether a foot that landed jammed, so that there is no answer.
    total_displacement_m, final_displacement_m : m
        Sum over the chains, and where the centroid is in the end; signed.
    friction_needed_at_landing : 1
        Largest that a landing needed; NaN where it never landed.
    rocking_threshold_m_s2, spin_ratio : m/s^2, 1
    chains : Chains
    gave_up : bool
        Runs without an answer: their other entries are those of the chains before.
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
        """In words."""
        return [OUTCOMES[code] for code in self.outcome_code.tolist()]

    def row_dict(self, row: int) -> dict[str, Any]:
        """Return the scalars of one run, by their names in its outcome; None where there is no such thing."""
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
        """Return the chains of one run, with what is known of them; times on a clock that shows `start_s` at the first sample, s."""
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
    """Return the chains of all rows."""
    if not tables:
        return ChainTable(np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64), *(np.empty(0) for _ in range(5)))
    return ChainTable(*(np.concatenate([getattr(table, field.name) for table in tables]) for field in fields(ChainTable)))

"""What becomes of many two-layer blocks, as arrays: an entry for each run, and one for each of their chains."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from seisblock.solvers.jump.chain import (
    ENDED_FLYING,
    ENDED_LANDED,
    ENDED_ROCKING,
    JUMPED,
    NO_JUMP,
    OVERTURNED_LANDED,
    OVERTURNED_ROCKING,
    Chain,
)
from seisblock.solvers.jump.solve import DID_NOT_ROCK
from seisblock.typing import BoolArray, FloatArray, IntArray

FATES = (DID_NOT_ROCK, NO_JUMP, JUMPED, OVERTURNED_ROCKING, OVERTURNED_LANDED, ENDED_ROCKING, ENDED_FLYING, ENDED_LANDED)
"""What becomes of a block, or of a chain, by the numbers in :class:`JumpFates`."""

NOTHING, IMPACT, JUMP, FELL, FELL_LANDED, ROCKS, FLIES, MOVES = range(len(FATES))


@dataclass(frozen=True, eq=False)
class Chains:
    """The chains of many runs in the order of time, arrays with one entry per chain, (n,).

    Parameters
    ----------
    row, fate : int
        Whose it is, and how it ended, a place in ``FATES``.
    onset_s, landing_s : s
        After the motion's first sample; NaN where it did not land.
    needed : 1
        Largest friction that a landing needed; NaN where it did not land.
    before_j, after_j : J
        Kinetic energy before and after the landing that kept the largest share.
    """

    row: IntArray
    fate: IntArray
    onset_s: FloatArray
    landing_s: FloatArray
    needed: FloatArray
    before_j: FloatArray
    after_j: FloatArray


@dataclass(frozen=True, eq=False)
class JumpFates:
    """The ends of many runs, arrays with one entry per row, (m,).

    Parameters
    ----------
    fate : int
        A place in ``FATES``; as `outcome` of :class:`~seisblock.solvers.jump.solve.JumpOutcome` has it.
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

    fate: IntArray
    jammed: BoolArray
    total_displacement_m: FloatArray
    final_displacement_m: FloatArray
    friction_needed_at_landing: FloatArray
    rocking_threshold_m_s2: FloatArray
    spin_ratio: FloatArray
    chains: Chains
    gave_up: BoolArray

    @property
    def outcomes(self) -> list[str]:
        """In words."""
        return [FATES[each] for each in self.fate.tolist()]

    def told(self, row: int) -> dict[str, Any]:
        """Return the scalars of one run, by their names in its outcome; None where there is no such thing."""
        needed = float(self.friction_needed_at_landing[row])
        return {
            "outcome": FATES[self.fate[row]],
            "total_displacement_m": float(self.total_displacement_m[row]),
            "final_displacement_m": float(self.final_displacement_m[row]),
            "friction_needed_at_landing": None if np.isnan(needed) else needed,
            "rocking_threshold_m_s2": float(self.rocking_threshold_m_s2[row]),
            "spin_ratio": float(self.spin_ratio[row]),
        }

    def chains_of(self, row: int, start_s: float) -> tuple[Chain, ...]:
        """Return the chains of one run, with what is known of them; times on a clock that shows `start_s` at the first sample, s."""
        found = []
        for n in np.flatnonzero(self.chains.row == row).tolist():
            needed = float(self.chains.needed[n])
            landed = not np.isnan(needed)
            chain = Chain(
                FATES[self.chains.fate[n]],
                direction="",
                rocking_start_s=float(start_s + self.chains.onset_s[n]),
                landing_s=float(start_s + self.chains.landing_s[n]) if landed else None,
                friction_needed_at_landing=needed if landed else None,
                landing_energy_j=(float(self.chains.before_j[n]), float(self.chains.after_j[n])) if landed else None,
            )
            found.append(chain)
        return tuple(found)


def joined(found: Sequence[Chains]) -> Chains:
    """Return the chains of all rows."""
    if not found:
        return Chains(np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64), *(np.empty(0) for _ in range(5)))
    return Chains(*(np.concatenate([getattr(each, field.name) for each in found]) for field in fields(Chains)))

"""Shaking columns of a batch: peaks of the motion, and time above the threshold of the body."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict
from functools import cached_property
from typing import Any

from seisblock.core.registry import SolverBody
from seisblock.measures.shaking import BodyShaking, body_thresholds, shaking_of
from seisblock.measures.summary import MotionPeaks, conventions_of, motion_peaks
from seisblock.records import Motion
from seisblock.studies.batch.scalar_fields import scalar_fields

SHAKING_COLUMNS: Mapping[str, type] = scalar_fields(BodyShaking)
"""Columns with their types."""


class ShakingColumns:
    """Shaking columns of the bodies of a solver under one motion, whose peaks are computed once.

    Parameters
    ----------
    solver : str
    motion : Motion
    """

    def __init__(self, solver: str, motion: Motion) -> None:
        self.solver, self.motion = solver, motion

    @cached_property
    def _peaks(self) -> MotionPeaks:
        return motion_peaks(self.motion.horizontal, self.motion.dt, conventions_of(self.motion.record))

    def row(self, body: SolverBody) -> dict[str, Any]:
        """Return the columns of a body aligned with the motion."""
        return asdict(shaking_of(self.motion, body_thresholds(self.solver, body.body, body.options), peaks=self._peaks))

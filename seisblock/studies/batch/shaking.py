"""Input columns of a batch: intensity and peaks of the motion, time above the threshold of the body, its sizes and friction."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import Any

from seisblock.core.registry import SolverBody
from seisblock.measures.shaking import BodyShaking, body_thresholds, shaking_of
from seisblock.measures.summary import MotionPeaks, conventions_of, motion_peaks
from seisblock.records import Motion
from seisblock.records.seismic_intensity import jma_intensity
from seisblock.studies.batch.scalar_fields import scalar_fields

SHAKING_COLUMNS: Mapping[str, type] = {"jma_intensity": float, **scalar_fields(BodyShaking)}
"""Columns of the shaking with their types; the JMA intensity is empty without three components."""

BODY_COLUMNS: Mapping[str, type] = {"width_m": float, "height_m": float, "mu": float}
"""Columns of the body with their types, empty where it has no such value."""


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

    @cached_property
    def _jma_intensity(self) -> float | None:
        return None if self.motion.record is None else jma_intensity(self.motion.record)

    def row(self, body: SolverBody) -> dict[str, Any]:
        """Return the columns of a body aligned with the motion."""
        shaking = shaking_of(self.motion, body_thresholds(self.solver, body.body, body.options), peaks=self._peaks)
        contact = getattr(body.options, "contact", body.options)
        return {
            "jma_intensity": self._jma_intensity,
            **vars(shaking),
            "width_m": getattr(body.body, "width", None),
            "height_m": getattr(body.body, "height", None),
            "mu": getattr(contact, "mu", None),
        }

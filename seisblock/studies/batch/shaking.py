"""Input columns of a batch: intensity and peaks of the motion, time above the threshold of the body, its sizes and friction."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from seisblock.core.registry import SolverBody
from seisblock.measures.shaking import BodyShaking, body_thresholds, shakings_of
from seisblock.records import Motion
from seisblock.records.seismic_intensity import jma_intensity
from seisblock.studies.batch.scalar_fields import scalar_fields

SHAKING_COLUMNS: Mapping[str, type] = {"jma_intensity": float, **scalar_fields(BodyShaking)}
"""Columns of the shaking with their types; the JMA intensity is empty without three components."""

BODY_COLUMNS: Mapping[str, type] = {"width_m": float, "height_m": float, "mu": float}
"""Columns of the body with their types, empty where it has no such value."""


def shaking_columns(solver: str, bodies: Sequence[SolverBody], motion: Motion) -> list[dict[str, Any]]:
    """Return the shaking columns of bodies aligned with a motion, in their order.

    Parameters
    ----------
    solver : str
    bodies : sequence of SolverBody
    motion : Motion
    """
    if not bodies:
        return []
    intensity = None if motion.record is None else jma_intensity(motion.record)
    shakings = shakings_of(motion, [body_thresholds(solver, body.body, body.options) for body in bodies])
    return [
        {
            "jma_intensity": intensity,
            **vars(shaking),
            "width_m": getattr(body.body, "width", None),
            "height_m": getattr(body.body, "height", None),
            "mu": getattr(getattr(body.options, "contact", body.options), "mu", None),
        }
        for body, shaking in zip(bodies, shakings, strict=True)
    ]

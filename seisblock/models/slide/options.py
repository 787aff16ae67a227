"""Options of the sliding solver."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from seisblock.core.options import GRAVITY, KEY, VERTICAL, SolverOptions, documented
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.records._validation import Gain


@documented
@dataclass(frozen=True, kw_only=True, repr=False)
class SlideOptions(SolverOptions):
    """Options of :func:`~seisblock.models.slide.solve.solve_slide`."""

    vertical: Gain | None = field(default=None, metadata={KEY: replace(VERTICAL[KEY], key="vertical_scale", document=float)})
    gravity: float = field(default=STANDARD_GRAVITY, metadata=GRAVITY)

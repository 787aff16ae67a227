"""Options of the sliding solver."""

from __future__ import annotations

from dataclasses import dataclass, field

from seisblock.core.options import GRAVITY, SolverOptions, documented, option
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.records._validation import Gain


@documented
@dataclass(frozen=True, kw_only=True, repr=False)
class SlideOptions(SolverOptions):
    """Options of :func:`~seisblock.models.slide.solve.solve_slide`."""

    vertical: Gain | None = field(
        default=False,
        metadata=option("Scale factor on the vertical component; 0 if omitted.", key="vertical_scale", document=float),
    )
    gravity: float = field(default=STANDARD_GRAVITY, metadata=GRAVITY)

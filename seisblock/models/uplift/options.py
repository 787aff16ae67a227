"""Options of the uplift solver."""

from __future__ import annotations

from dataclasses import dataclass, field

from seisblock.core.options import GRAVITY, VERTICAL, SolverOptions, documented
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.records._validation import Gain


@documented
@dataclass(frozen=True, kw_only=True, repr=False)
class UpliftOptions(SolverOptions):
    """Options of :func:`~seisblock.models.uplift.solve.solve_uplift`."""

    vertical: Gain | None = field(default=None, metadata=VERTICAL)
    gravity: float = field(default=STANDARD_GRAVITY, metadata=GRAVITY)

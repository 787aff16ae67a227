"""Options of the rocking solver."""

from __future__ import annotations

from dataclasses import dataclass, field

from seisblock.bodies.block import Restitution
from seisblock.core.i18n import N_
from seisblock.core.options import GRAVITY, VERTICAL, SolverOptions, documented, option
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.records._validation import Gain


@documented
@dataclass(frozen=True, kw_only=True, repr=False)
class RockOptions(SolverOptions):
    """Options of :func:`~seisblock.models.rock.solve.solve_rock`."""

    restitution: Restitution = field(
        default=None,
        metadata=option(
            N_(
                "Coefficient of restitution, ratio of angular velocities after and before an impact, 0 to 1. [default: 1 - 1.5 "
                "sin^2(alpha), or value of the body]"
            ),
            "--restitution",
            unit="1",
            metavar="E",
        ),
    )
    linear: bool = field(
        default=False, metadata=option(N_("Use the linearised equation of slender blocks. [default: exact equation]"), "--linear")
    )
    vertical: Gain | None = field(default=None, metadata=VERTICAL)
    gravity: float = field(default=STANDARD_GRAVITY, metadata=GRAVITY)
    initial: tuple[float, float] = field(
        default=(0.0, 0.0), metadata=option("Tilt, rad, and angular velocity, rad/s, at the first sample.")
    )

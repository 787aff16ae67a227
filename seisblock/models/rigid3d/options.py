"""Options of the solver of a rigid body in three dimensions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from seisblock.core.i18n import N_
from seisblock.core.options import ACROSS, GRAVITY, VERTICAL, SolverOptions, documented, friction, option
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.records._validation import Gain


@documented
@dataclass(frozen=True, kw_only=True, repr=False)
class Rigid3dOptions(SolverOptions):
    """Options of :func:`~seisblock.models.rigid3d.solve.solve_rigid3d`."""

    mu: float = field(metadata=friction(N_("Friction coefficient. [default: value of the body; else required]")))
    restitution: float = field(
        default=0.0,
        metadata=option(
            N_("Coefficient of restitution of an impact (Newton), ratio of normal velocities, [0, 1)."),
            "--restitution",
            unit="1",
            interval="[0, 1)",
            metavar="E",
            section="Body",
        ),
    )
    vertical: Gain | None = field(default=None, metadata=VERTICAL)
    across: Gain = field(default=True, metadata=ACROSS)
    gravity: float = field(default=STANDARD_GRAVITY, metadata=GRAVITY)
    initial: Mapping[str, Sequence[float]] | None = field(
        default=None,
        metadata=option(
            "State at the first sample in the axes of the ground: `position` of the centre of gravity above the ground, m, `quaternion` (w "
            "first, body to ground), `velocity`, m/s, `spin`, rad/s; null: standing, at rest."
        ),
    )
    settle_s: float = field(
        default=20.0,
        metadata=option(
            N_("Duration of the analysis after the end of the record, s."), "--settle", unit="s", interval="[0, inf)", metavar="S"
        ),
    )

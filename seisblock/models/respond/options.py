"""Options of the full-response solver."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

from seisblock.core.i18n import N_
from seisblock.core.options import GRAVITY, VERTICAL, SolverOptions, documented, friction, option
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.records._validation import Gain


@documented
@dataclass(frozen=True, kw_only=True, repr=False)
class RespondOptions(SolverOptions):
    """Options of :func:`~seisblock.models.respond.solve.solve_respond`."""

    mu: float = field(metadata=friction(N_("Static friction coefficient. [default: value of the body; else required]")))
    mu_kinetic: float | None = field(
        default=None,
        metadata=option(
            N_("Kinetic friction coefficient. [default: as --mu]"),
            "--mu-kinetic",
            unit="1",
            interval="[0, inf)",
            label=N_("the kinetic friction coefficient"),
            document=float,
            kind="friction",
            metavar="MU",
            section="Body",
        ),
    )
    restitution: float = field(
        default=0.0,
        metadata=option(
            N_("Coefficient of restitution of a corner impact (Poisson), ratio of impulses, [0, 1)."),
            "--restitution",
            unit="1",
            interval="[0, 1)",
            metavar="E",
            section="Body",
        ),
    )
    rocking_restitution: float | None = field(
        default=None,
        metadata=option(
            N_("Ratio of angular velocities after and before the impact of the other corner, [0, 1]. [default: from the impact equations]"),
            "--rocking-restitution",
            unit="1",
            interval="[0, 1]",
            label=N_("`rocking_restitution` (ratio of angular velocities)"),
            metavar="E",
            section="Body",
        ),
    )
    vertical: Gain | None = field(default=None, metadata=VERTICAL)
    gravity: float = field(default=STANDARD_GRAVITY, metadata=GRAVITY)
    initial: Sequence[float] | None = field(
        default=None,
        metadata=option(
            "x and y of the centre of gravity relative to the ground, m, tilt, rad, and their rates at the first sample; null: upright, "
            "at rest."
        ),
    )
    settle_s: float = field(
        default=60.0,
        metadata=option(N_("Duration of the analysis after the end of the record, s."), "--settle", unit="s", metavar="S"),
    )
    tenon: float = field(
        default=0.0,
        metadata=option(
            N_("Length of the tenons, which hold the feet until they leave the mortises, m or with a unit (2cm). [default: none]"),
            "--tenon",
            unit="m",
            interval="[0, inf)",
            label=N_("`tenon` (length)"),
            section="Body",
        ),
    )
    further_points: Sequence[tuple[float, float]] = field(
        default=(),
        metadata=option(
            "Points of the body, to +x of the centre of gravity and above it, that end the motion on contact with the ground.",
            unit="m",
        ),
    )
    sensitivity: bool = field(
        default=True, metadata=option("Test with four more runs if a change of the input by up to 2e-6 changes the verdict.")
    )


def effective_friction(options: RespondOptions) -> float:
    """Return the friction coefficient at the feet, 1; infinite with tenons.

    Parameters
    ----------
    options : RespondOptions

    Examples
    --------
    >>> effective_friction(RespondOptions(mu=0.3)), effective_friction(RespondOptions(mu=0.3, tenon=0.02))
    (0.3, inf)
    """
    return math.inf if options.tenon > 0.0 else float(options.mu)

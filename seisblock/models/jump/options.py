"""Options of the jump solver."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from seisblock.bodies.two_layer import Contact
from seisblock.core.i18n import N_
from seisblock.core.options import GRAVITY, SolverOptions, documented, option
from seisblock.core.typing import TimeWindow
from seisblock.core.units import STANDARD_GRAVITY

DIRECTIONS = ("+", "-", "both")
LANDINGS = ("paper", "friction", "printed")
"""Rules of the landing impulse, see :mod:`seisblock.models.jump.landing`."""


@documented
@dataclass(frozen=True, kw_only=True, repr=False)
class JumpOptions(SolverOptions):
    """Options of :func:`~seisblock.models.jump.solve.solve_jump`."""

    contact: Contact = field(metadata=option("Friction of the landed foot and restitution of the impact."))
    drop: float = field(
        default=0.0,
        metadata=option(
            N_("Height of the floor above the landing ground, m or with a unit. [default: value of the body, else 0]"),
            "--drop",
            unit="m",
            interval="[0, inf)",
            section="Body",
        ),
    )
    tenon: float = field(
        default=0.0,
        metadata=option(
            N_(
                "Length of the tenons, m or with a unit: the block moves away only where both feet rise higher in flight. "
                "[default: value of the body, else 0]"
            ),
            "--tenon",
            unit="m",
            interval="[0, inf)",
            section="Body",
        ),
    )
    spin: str = field(
        default="momentum",
        metadata=option(
            N_(
                "Angular velocity after the impact: conserved angular momentum, eq. (7a) as printed, its first brace as printed with a "
                "second one inferred from the tables of the paper, or theta'2/theta'1 = Q."
            ),
            "--spin",
            metavar="momentum|printed|tables|ratio=Q",
        ),
    )
    direction: str = field(
        default="both",
        metadata=option(N_("Sign of the ground acceleration that can start a chain of motion."), "--direction", choices=DIRECTIONS),
    )
    landing: str = field(
        default="paper",
        metadata=option(
            N_(
                "Landing of the foot: unlimited friction, as in the paper (paper); Coulomb friction, so that the foot may slip "
                "(friction); or paper with the equations as printed and as its tables were integrated (printed)."
            ),
            "--landing",
            choices=LANDINGS,
        ),
    )
    first: bool = field(
        default=False,
        metadata=option(N_("Compute only the first chain of motion in each --window, as in the paper. [default: all]"), "--first"),
    )
    windows: Sequence[TimeWindow] = field(
        default=(), metadata=option("Time windows of the start of a chain; empty: the entire record.", unit="s")
    )
    gravity: float = field(default=STANDARD_GRAVITY, metadata=GRAVITY)

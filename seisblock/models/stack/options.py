"""Options of the solver of piles."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from seisblock.bodies.pile.contact import PileContact
from seisblock.core.i18n import N_
from seisblock.core.options import ACROSS, GRAVITY, VERTICAL, SolverOptions, documented, option
from seisblock.core.typing import Progress
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.records._validation import Gain

RIGID, SPRINGS = "rigid", "springs"
"""Contact laws."""

EDGES, GRID = 2, 5
"""Contact points along each side of a joint: on the edges, and as in [Furukawa2009]_."""


@documented
@dataclass(frozen=True, kw_only=True, repr=False)
class StackOptions(SolverOptions):
    """Options of :func:`~seisblock.models.stack.solve.solve_stack`."""

    law: str | None = field(
        default=None,
        metadata=option(
            N_(
                "Contact law: rigid stones, or springs and dashpots as in Furukawa2009. [default: rigid; springs with --criterion, --young "
                "or --joint-stiffness]"
            ),
            "--law",
            choices=(RIGID, SPRINGS),
            document=str,
        ),
    )
    points: int = field(default=EDGES, metadata=option("Contact points along each side of a joint; 2: its edges."))
    contact: PileContact | None = field(
        default=None, metadata=option("Springs and dashpots; default with springs: those of Furukawa2009 table 2.")
    )
    mu_kinetic: float | None = field(
        default=None,
        metadata=option(
            N_(
                "Kinetic friction coefficient of every joint, at most the smallest static coefficient; --law rigid. [default: value of "
                "the file, or as --mu]"
            ),
            "--mu-kinetic",
            unit="1",
            kind="friction",
            document=float,
        ),
    )
    restitution: float | None = field(
        default=None,
        metadata=option(
            N_(
                "Coefficient of restitution: ratio of the velocity of the leaving edge of a joint to that of the striking edge; --law "
                "rigid. [default: from conserved angular momentum]"
            ),
            "--restitution",
            unit="1",
            interval="[0, 1]",
            label=N_("the restitution of the joints"),
        ),
    )
    vertical: Gain | None = field(default=None, metadata=VERTICAL)
    across: Gain = field(default=True, metadata=ACROSS)
    gravity: float = field(default=STANDARD_GRAVITY, metadata=GRAVITY)
    step: float | None = field(
        default=None,
        metadata=option(
            N_(
                "Time step, s. [default: 1/55 of the rocking time scale of the smallest stone; springs: 0.7 of the stability limit of the "
                "stiffest contact]"
            ),
            "--step",
            unit="s",
            metavar="S",
            document=float,
        ),
    )
    stop_at_fall: bool = field(default=False, metadata=option("End at the first fall."))
    tilts: Mapping[str, float] | None = field(
        default=None, metadata=option("Initial tilt of stones about y, over the edge of their base, by name.", unit="rad")
    )
    progress: Progress | None = field(default=None, repr=False, compare=False)
    """Function called with the number of finished samples and their total."""

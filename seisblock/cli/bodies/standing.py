"""A free-standing body and what it stands on: one rigid block with its friction, from options, a file or a bundled name."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from seisblock.bodies.block import Block
from seisblock.bodies.friction import SURFACES, surface
from seisblock.bodies.library import friction_of
from seisblock.bodies.toml import read_table
from seisblock.cli import offered
from seisblock.cli.bodies.block import BodyChoice, choose_block
from seisblock.cli.bodies.options import block_options
from seisblock.cli.command import option
from seisblock.cli.types import LENGTH, MU
from seisblock.errors import BodyError
from seisblock.words import said


@dataclass(frozen=True)
class StandingChoice(BodyChoice):
    """A body, its friction, and one line on where they come from."""

    mu: float
    mu_kinetic: float | None
    says: str


_FRICTION = (
    option("--mu", type=MU, section="Body", metavar="MU", help="Static friction coefficient, 1. [default: the body's own; else needed]"),
    option("--mu-kinetic", type=MU, section="Body", metavar="MU", help="Kinetic friction coefficient, 1, at most --mu. [default: as --mu]"),
    option(
        "--surface",
        section="Body",
        metavar="A/B",
        shell_complete=offered.surfaces,
        help=f"Friction from a table of pairs, instead of --mu: {', '.join(SURFACES)}.",
    ),
    option(
        "--restitution",
        type=float,
        default=0.0,
        show_default=True,
        metavar="E",
        section="Body",
        help="Restitution of impacts at a corner (Poisson's), a ratio of impulses, [0, 1).",
    ),
    option(
        "--rocking-restitution",
        type=float,
        metavar="E",
        section="Body",
        help="Angular velocity after over that before when the other corner comes down, [0, 1]. [default: from the impact itself]",
    ),
    option(
        "--tenon",
        type=LENGTH,
        default=0.0,
        section="Body",
        help="Depth of tenons that hold the feet until they have left them in flight, m or with a unit (2cm). [default: none]",
    ),
)


def standing_options(function: Callable[..., Any]) -> Callable[..., Any]:
    """Give a command the options of a free-standing body; it receives them by name, for :func:`choose_standing`."""
    for declare in reversed(_FRICTION):
        function = declare(function)
    return block_options(function)


def choose_standing(asked: Mapping[str, Any]) -> StandingChoice:
    """Return the body and its friction that a set of options describes; taken out of what is left for the solver.

    Raises
    ------
    BodyError
        If the body is not known, or nothing says how rough the ground is.
    """
    chosen = choose_block({**asked, "restitution": None})
    mu, kinetic, origin = asked.get("mu"), asked.get("mu_kinetic"), said("as given")
    body = chosen.body
    if asked.get("surface") is not None:
        if mu is not None:
            raise BodyError("give either --mu or --surface, not both")
        found = surface(asked["surface"])
        mu, kinetic = found.mu, found.mu_kinetic if kinetic is None else kinetic
        origin = said("{surface}, {source}", surface=asked["surface"], source=found.source.replace("_", ""))
        origin = said("{what}: {note}", what=origin, note=said(found.note)) if found.note else origin
    elif mu is None and asked.get("block"):
        mu, own = friction_of(read_table(asked["block"]), asked["block"])
        kinetic = own if kinetic is None else kinetic
        origin = said("from {file}", file=asked["block"])
    if isinstance(body, Block) and (asked.get("mu") is not None or asked.get("surface")):
        body = body.known("mu")
    if mu is None:
        raise BodyError(
            "how rough is it under the body? Give --mu, the static friction coefficient, or --surface with a pair: {pairs}",
            pairs=list(SURFACES),
        )
    told = said("mu {mu:g}", mu=mu) if kinetic is None else said("mu {mu:g}, kinetic {kinetic:g}", mu=mu, kinetic=kinetic)
    return StandingChoice(body, mu, kinetic, said("{body}; {friction} ({origin})", body=chosen.says, friction=told, origin=origin))

"""Free-standing body and friction from options, a file or a bundled name."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from seisblock.bodies.block import Block
from seisblock.bodies.factory import table_friction
from seisblock.bodies.friction import SURFACES, surface
from seisblock.bodies.toml import read_body_toml
from seisblock.cli import shell_completion
from seisblock.cli.bodies.block import BodyChoice, choose_block
from seisblock.cli.bodies.options import block_options
from seisblock.cli.command import option
from seisblock.cli.types import LENGTH, MU
from seisblock.core.errors import BodyError
from seisblock.core.i18n import lazy_gettext


@dataclass(frozen=True)
class FreeStandingChoice(BodyChoice):
    """Body with its friction and a one-line description."""

    mu: float
    mu_kinetic: float | None
    description: str


_FRICTION = (
    option("--mu", type=MU, section="Body", metavar="MU", help="Static friction coefficient. [default: the body's own; else required]"),
    option("--mu-kinetic", type=MU, section="Body", metavar="MU", help="Kinetic friction coefficient, at most --mu. [default: as --mu]"),
    option(
        "--surface",
        section="Body",
        metavar="A/B",
        shell_complete=shell_completion.complete_surfaces,
        help=f"Surface pair that gives the friction coefficient, instead of --mu: {', '.join(SURFACES)}.",
    ),
    option(
        "--restitution",
        type=float,
        default=0.0,
        show_default=True,
        metavar="E",
        section="Body",
        help="Coefficient of restitution of a corner impact (Poisson), ratio of impulses, [0, 1).",
    ),
    option(
        "--rocking-restitution",
        type=float,
        metavar="E",
        section="Body",
        help="Ratio of angular velocities after and before the impact of the other corner, [0, 1]. [default: from the impact equations]",
    ),
    option(
        "--tenon",
        type=LENGTH,
        default=0.0,
        section="Body",
        help="Length of the tenons, which hold the feet until they leave the mortises, m or with a unit (2cm). [default: none]",
    ),
)


def free_standing_options(function: Callable[..., Any]) -> Callable[..., Any]:
    """Add the options of a free-standing body to a command, for :func:`choose_free_standing`."""
    for declare in reversed(_FRICTION):
        function = declare(function)
    return block_options(function)


def choose_free_standing(params: Mapping[str, Any]) -> FreeStandingChoice:
    """Return the body and the friction described by a set of options.

    Raises
    ------
    BodyError
        If the body is unknown, or no friction coefficient is given.
    """
    choice = choose_block({**params, "restitution": None})
    mu, kinetic, origin = params.get("mu"), params.get("mu_kinetic"), lazy_gettext("as given")
    body = choice.body
    if params.get("surface") is not None:
        if mu is not None:
            raise BodyError("--mu and --surface exclude each other: give only one of them")
        pair = surface(params["surface"])
        mu, kinetic = pair.mu, pair.mu_kinetic if kinetic is None else kinetic
        origin = lazy_gettext("{surface}, {source}", surface=params["surface"], source=pair.source.replace("_", ""))
        origin = lazy_gettext("{what}: {note}", what=origin, note=lazy_gettext(pair.note)) if pair.note else origin
    elif mu is None and params.get("block"):
        mu, kinetic_default = table_friction(read_body_toml(params["block"]), params["block"])
        kinetic = kinetic_default if kinetic is None else kinetic
        origin = lazy_gettext("from {file}", file=params["block"])
    if isinstance(body, Block) and (params.get("mu") is not None or params.get("surface")):
        body = body.without_ranges("mu")
    if mu is None:
        raise BodyError(
            "friction required: give --mu (static coefficient) or --surface, one of {pairs}",
            pairs=list(SURFACES),
        )
    friction_text = (
        lazy_gettext("mu {mu:g}", mu=mu) if kinetic is None else lazy_gettext("mu {mu:g}, kinetic {kinetic:g}", mu=mu, kinetic=kinetic)
    )
    return FreeStandingChoice(
        body, mu, kinetic, lazy_gettext("{body}; {friction} ({origin})", body=choice.description, friction=friction_text, origin=origin)
    )

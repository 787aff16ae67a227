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
from seisblock.cli.bodies.options import block_list_options, block_options
from seisblock.cli.build import solver_options
from seisblock.cli.command import option
from seisblock.cli.types import MUS
from seisblock.core.errors import BodyError
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.models.respond.options import RespondOptions


@dataclass(frozen=True)
class FreeStandingChoice(BodyChoice):
    """Body with its friction and a one-line description."""

    mu: float
    mu_kinetic: float | None
    description: str


def surface_option(function: Callable[..., Any]) -> Callable[..., Any]:
    """Add ``--surface`` to a command."""
    return option(
        "--surface",
        section="Body",
        metavar="A/B",
        shell_complete=shell_completion.complete_surfaces,
        help=f"Pair of materials, instead of --mu: {', '.join(SURFACES)}.",
    )(function)


def free_standing_options(function: Callable[..., Any]) -> Callable[..., Any]:
    """Add the options of a free-standing body to a command, for :func:`choose_free_standing`."""
    function = solver_options(RespondOptions, "restitution", "rocking_restitution", "tenon")(function)
    return block_options(solver_options(RespondOptions, "mu", "mu_kinetic")(surface_option(function)))


def free_standing_list_options(function: Callable[..., Any]) -> Callable[..., Any]:
    """Add the options of a free-standing body with lists of width, height and friction."""
    function = solver_options(RespondOptions, "restitution", "rocking_restitution", "tenon")(function)
    text = N_("Static friction coefficient; number, list or range. [default: value of the body; else required]")
    mu = option("--mu", type=MUS, section="Body", help=text)
    return block_list_options(mu(solver_options(RespondOptions, "mu_kinetic")(surface_option(function))))


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

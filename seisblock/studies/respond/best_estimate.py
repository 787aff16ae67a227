"""Best-estimate response of one body: the full model, with a no-slip friction if the friction is unknown."""

from __future__ import annotations

from dataclasses import dataclass

from seisblock.bodies.block import Block
from seisblock.core.results import Response
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.models.respond.options import RespondOptions
from seisblock.models.respond.outcome import RespondOutcome
from seisblock.models.respond.params import rigid_body
from seisblock.models.respond.solve import solve_respond
from seisblock.records import Motion
from seisblock.records._validation import Gain

JAMMING_MARGIN = 0.8
"""Share of Painleve's limit used as no-slip friction: samples vary friction by a fifth, and no sample may jam."""


@dataclass(frozen=True, eq=False)
class BestEstimate:
    """Best-estimate response of a body.

    Parameters
    ----------
    response : Response
    friction_known : bool
        False if the friction is the no-slip friction of the body.
    """

    response: Response[RespondOutcome]
    friction_known: bool


def no_slip_friction(block: Block) -> float:
    """Return a friction, 1, without slip and without jamming: 0.8 of Painleve's limit ([GenotBrogliato1999]_, derived there).

    Parameters
    ----------
    block : Block

    Examples
    --------
    >>> round(no_slip_friction(Block(0.3, 0.9)), 3)
    1.067
    """
    return JAMMING_MARGIN * rigid_body(block).friction_limit


def best_estimate(
    block: Block,
    motion: Motion,
    *,
    mu: float | None = None,
    mu_kinetic: float | None = None,
    vertical: Gain | None = None,
    gravity: float = STANDARD_GRAVITY,
) -> BestEstimate:
    """Return the full response of a body under a motion: rest, sliding, rocking, flight or overturning.

    Parameters
    ----------
    block : Block
    motion : Motion
    mu, mu_kinetic : float or None, 1
        Friction; None if unknown: the no-slip friction is used.
    vertical : bool, float or None
        True or a factor to apply the vertical component; None: if the motion has one.
    gravity : float, m/s^2
    """
    options = RespondOptions(
        mu=no_slip_friction(block) if mu is None else mu,
        mu_kinetic=None if mu is None else mu_kinetic,
        vertical=vertical,
        gravity=gravity,
    )
    return BestEstimate(solve_respond(block, motion, **options.keywords()), mu is not None)

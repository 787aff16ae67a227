"""The governing answer about one body: what it does, whichever comes, and how sure that is, also where its friction is not known."""

from __future__ import annotations

from dataclasses import dataclass

from seisblock.bodies.block import Block
from seisblock.core.results import Response
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.models.respond.outcome import RespondOutcome
from seisblock.models.respond.params import rigid_body
from seisblock.models.respond.solve import solve_respond
from seisblock.records import Motion
from seisblock.studies.respond.probability import Probability, respond_probability

JAMMING_MARGIN = 0.8
"""Share of Painleve's limit that is taken for the friction of feet that hold: versions vary it by a fifth, and none of them may jam."""


@dataclass(frozen=True, eq=False)
class BestEstimate:
    """What a body does, and how sure that is.

    Parameters
    ----------
    response : Response
    probability : Probability or None
        None where nobody asked.
    friction_known : bool
        False where the friction is that of feet that hold.
    """

    response: Response[RespondOutcome]
    probability: Probability | None
    friction_known: bool


def no_slip_friction(block: Block) -> float:
    """Return a friction, 1, at which a body hardly slips and never jams: 0.8 of Painleve's limit ([GenotBrogliato1999]_, derived there).

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
    vertical: bool = True,
    gravity: float = STANDARD_GRAVITY,
    runs: int = 0,
) -> BestEstimate:
    """Return what a body does under a motion, whichever comes.

    Parameters
    ----------
    block : Block
    motion : Motion
    mu, mu_kinetic : float or None, 1
        Friction; None where nothing is known of it: feet that hold.
    vertical : bool
        Whether the vertical component acts, where there is one.
    gravity : float, m/s^2
    runs : int
        Plausible versions behind the probability; 0 for none.
    """
    friction = {"mu": no_slip_friction(block) if mu is None else mu, "mu_kinetic": None if mu is None else mu_kinetic}
    vertical_option = None if vertical else False
    response = solve_respond(block, motion, vertical=vertical_option, gravity=gravity, **friction)  # type: ignore[arg-type]
    probability = None
    if runs:
        probability = respond_probability(block, motion, vertical=vertical_option, gravity=gravity, runs=runs, **friction)  # type: ignore[arg-type]
    return BestEstimate(response, probability, mu is not None)

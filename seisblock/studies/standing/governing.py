"""The governing answer about one body: what it does, whichever comes, and how sure that is, also where its friction is not known."""

from __future__ import annotations

from dataclasses import dataclass

from seisblock.bodies.block import Block
from seisblock.records import Motion
from seisblock.results import Response
from seisblock.solvers.respond.outcome import RespondOutcome
from seisblock.solvers.respond.setting import stand
from seisblock.solvers.respond.solve import solve_respond
from seisblock.studies.standing.probability import Probability, respond_probability
from seisblock.units import STANDARD_GRAVITY

BELOW_JAMS = 0.8
"""Share of Painleve's limit that is taken for the friction of feet that hold: versions vary it by a fifth, and none of them may jam."""


@dataclass(frozen=True, eq=False)
class Governing:
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


def friction_that_holds(block: Block) -> float:
    """Return a friction, 1, at which a body hardly slips and never jams: 0.8 of Painleve's limit ([GenotBrogliato1999]_, derived there).

    Parameters
    ----------
    block : Block

    Examples
    --------
    >>> round(friction_that_holds(Block(0.3, 0.9)), 3)
    1.067
    """
    return BELOW_JAMS * stand(block).friction_limit


def governing(
    block: Block,
    motion: Motion,
    *,
    mu: float | None = None,
    mu_kinetic: float | None = None,
    vertical: bool = True,
    gravity: float = STANDARD_GRAVITY,
    runs: int = 0,
) -> Governing:
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
    friction = {"mu": friction_that_holds(block) if mu is None else mu, "mu_kinetic": None if mu is None else mu_kinetic}
    acts = None if vertical else False
    response = solve_respond(block, motion, vertical=acts, gravity=gravity, **friction)  # type: ignore[arg-type]
    probability = None
    if runs:
        probability = respond_probability(block, motion, vertical=acts, gravity=gravity, runs=runs, **friction)  # type: ignore[arg-type]
    return Governing(response, probability, mu is not None)

"""The jump of a two-layer block: chains of rocking, impact, flight, landing and rocking-sliding ([Sugimoto2017]_)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from seisblock.bodies.two_layer import Contact, TwoLayerBlock
from seisblock.dynamics import Instant, follow
from seisblock.dynamics.status import STOPPED
from seisblock.errors import ParameterError, SolverError
from seisblock.records import Motion
from seisblock.records.given import check_call
from seisblock.results import Channel, Event, Phase, Response
from seisblock.solvers.jump import flight as flying
from seisblock.solvers.jump import rocking
from seisblock.solvers.jump.chain import (
    ENDED_FLYING,
    ENDED_LANDED,
    ENDED_ROCKING,
    JUMPED,
    NO_JUMP,
    REST,
    Chain,
    Followed,
    chain_of,
    curves,
    phases_and_events,
)
from seisblock.solvers.jump.impact import launch, spin_ratio
from seisblock.units import STANDARD_GRAVITY

DIRECTIONS = ("+", "-", "both")
DID_NOT_ROCK = "did not rock"


@dataclass(frozen=True)
class JumpOutcome:
    """What became of the block under one component.

    Parameters
    ----------
    outcome : str
        Of the last chain, or "did not rock".
    chains : tuple of Chain
    rocking_threshold_m_s2 : float
        [Sugimoto2017]_ eq. (2).
    spin_ratio : float
        theta'_2/theta'_1 at the impact.
    """

    outcome: str
    chains: tuple[Chain, ...]
    rocking_threshold_m_s2: float
    spin_ratio: float


def solve_jump(
    block: TwoLayerBlock,
    motion: Motion,
    *,
    contact: Contact,
    drop: float = 0.0,
    spin: str = "momentum",
    direction: str = "both",
    repeat: bool = False,
    gravity: float = STANDARD_GRAVITY,
) -> Response[JumpOutcome]:
    """Follow a two-layer block through rocking, impact, jump and landing ([Sugimoto2017]_ eqs. (1)-(15), corrected).

    Rocking starts where the piecewise-linear horizontal acceleration exceeds g x_G/y_G, and the foot does not slide before the
    impact; flight is ballistic; the chain ends when the landed block's tilt returns to zero. Vertical motion is not part
    of the model.

    Parameters
    ----------
    block : TwoLayerBlock
    motion : Motion
        Only its horizontal row acts.
    contact : Contact
        Friction of the landed foot and restitution of the impact.
    drop : float, m
        Height of the floor on which the block stands above the ground on which it lands ([Sugimoto2017]_ eq. (11)).
    spin : str
        ``momentum``, ``printed`` or ``ratio=Q``, see :func:`seisblock.solvers.jump.impact.spin_ratio`.
    direction : "+", "-" or "both"
        Sign of the ground acceleration that may start a chain; the mirror image is exact.
    repeat : bool
        Whether the block, once more at rest, may start further chains; after it has landed below its floor
        it stands on the ground, and there is no further drop.
    gravity : float, m/s^2

    Returns
    -------
    Response of JumpOutcome
        Channels ``theta`` (rad, positive when the block leans to +x), ``x_G`` (m, displacement of the centroid) and ``y_G`` (m,
        its height above the floor). A block that topples is a result, not an error.

    Raises
    ------
    ParameterError
        If a coefficient is outside its range.
    SolverError
        If kinetic friction is so large that the landed foot jams (a rigid contact has no solution there).

    References
    ----------
    [Sugimoto2017]_

    Examples
    --------
    >>> import numpy as np
    >>> block = TwoLayerBlock(2.08, 2.50, 1.06, 1.84, 1303.7, 160.0)
    >>> pulse = np.concatenate([6.0 * np.sin(np.pi * np.linspace(0, 1, 101)), np.zeros(200)])
    >>> response = solve_jump(block, Motion.from_arrays(pulse, 0.01), contact=Contact(0.18, 0.17, 0.95, 0.85))
    >>> response.outcome.outcome
    'jumped'
    """
    check_call(block, TwoLayerBlock, motion)
    _check(contact, drop, direction, gravity)
    ratio = spin_ratio(block, spin, contact.restitution_x, contact.restitution_y)
    followed: list[Followed] = []
    start, left = Instant(), drop
    while (onset := _onset(motion, block, gravity, direction, start)) is not None:
        followed.append(_follow_chain(motion, block, contact, ratio, gravity, left, *onset))
        start = followed[-1].end
        if followed[-1].touch is not None:
            left = 0.0
        if not repeat or not followed[-1].finished or chain_of(followed[-1]).outcome not in (NO_JUMP, JUMPED):
            break
    options = {
        "mu": contact.mu,
        "mu_kinetic": contact.mu_kinetic,
        "restitution_x": contact.restitution_x,
        "restitution_y": contact.restitution_y,
        "drop_m": drop,
        "spin": spin,
        "direction": direction,
        "repeat": repeat,
        "gravity_m_s2": gravity,
    }
    chains = tuple(chain_of(each) for each in followed)
    outcome = JumpOutcome(chains[-1].outcome if chains else DID_NOT_ROCK, chains, block.rocking_threshold(gravity), ratio)
    warnings = tuple(
        f"{motion.name or 'motion'}: {chain.outcome}, the chain that began at {chain.rocking_start_s:.3f} s is not complete"
        for chain in chains
        if chain.outcome in (ENDED_ROCKING, ENDED_FLYING, ENDED_LANDED)
    )
    bare = Response("jump", outcome, motion, block, np.empty(0), options=options, warnings=warnings, citations=("Sugimoto2017",))
    return _with_curves(bare, followed)


def join(motion: Motion, responses: Sequence[Response[JumpOutcome]]) -> Response[JumpOutcome]:
    """Return one response from those of one body in successive stretches of a motion ([Sugimoto2017]_ figs. 12, 13)."""
    last = responses[-1]
    chains = tuple(chain for response in responses for chain in response.outcome.chains)
    outcome = replace(last.outcome, outcome=chains[-1].outcome if chains else DID_NOT_ROCK, chains=chains)
    channels = tuple(
        replace(channel, values=np.concatenate([response[channel.name] for response in responses])) for channel in last.channels
    )
    return replace(
        last,
        motion=motion,
        outcome=outcome,
        time=np.concatenate([response.time for response in responses]),
        channels=channels,
        phases=tuple(phase for response in responses for phase in response.phases),
        events=tuple(event for response in responses for event in response.events),
        warnings=tuple(dict.fromkeys(message for response in responses for message in response.warnings)),
    )


def _check(contact: Contact, drop: float, direction: str, gravity: float) -> None:
    """Refuse coefficients outside their range."""
    for name in ("restitution_x", "restitution_y"):
        value = getattr(contact, name)
        if not 0.0 <= value <= 1.0:
            raise ParameterError(f"{name.replace('_', ' ')} must lie in [0, 1], found {value}")
    for name in ("mu", "mu_kinetic"):
        value = getattr(contact, name)
        if not (math.isfinite(value) and value >= 0.0):
            raise ParameterError(f"{name.replace('_', ' ')} must be a friction coefficient of zero or more, found {value}")
    if contact.mu_kinetic > contact.mu:
        raise ParameterError(f"kinetic friction {contact.mu_kinetic} must not exceed static friction {contact.mu}")
    if not (math.isfinite(drop) and drop >= 0.0):
        raise ParameterError(f"the drop must be a height of zero or more, found {drop} m")
    if direction not in DIRECTIONS:
        raise ParameterError(f"direction must be one of {', '.join(DIRECTIONS)}, found {direction!r}")
    if not (math.isfinite(gravity) and gravity > 0.0):
        raise ParameterError(f"gravity must be positive, found {gravity} m/s^2")


def _onset(motion: Motion, block: TwoLayerBlock, gravity: float, direction: str, start: Instant) -> tuple[Instant, float] | None:
    """Return when rocking starts next, and the sign of the acceleration that starts it."""
    found = follow(
        rocking.ROCKING,
        motion,
        rocking.rocking_parameters(block, gravity, direction),
        [0.0, 0.0],
        rocking.REST,
        start=start,
        keep_path=False,
    )
    if found.status != STOPPED:
        return None
    return found.end, 1.0 if found.final_mode == rocking.ROSE_FORWARD else -1.0


def _follow_chain(
    motion: Motion, block: TwoLayerBlock, contact: Contact, ratio: float, gravity: float, drop: float, start: Instant, sign: float
) -> Followed:
    """Follow one chain from its onset, in the frame in which it goes forward."""
    gains = (sign, 0.0, 0.0)
    parameters = rocking.rocking_parameters(block, gravity, "both")
    rocked = follow(rocking.ROCKING, motion, parameters, [0.0, 0.0], rocking.ROCK, gains=gains, start=start)
    if rocked.final_mode != rocking.IMPACT:
        return Followed(motion, block, gravity, drop, start, sign, rocked, None, None)
    go = launch(block, float(rocked.final[rocking.OMEGA]), ratio, contact.restitution_x, contact.restitution_y)
    if not go.jumps:
        return Followed(motion, block, gravity, drop, start, sign, rocked, go, None)
    parameters = flying.flight_parameters(block, gravity, contact.mu, contact.mu_kinetic, drop, motion.dt)
    thrown = [0.0, go.spin, 0.0, go.horizontal, 0.0, go.vertical]
    flown = follow(flying.FLYING, motion, parameters, thrown, flying.FLIGHT, gains=gains, start=rocked.end)
    if flown.final_mode == flying.JAMMED:
        raise SolverError(
            f"jump: the foot that lands at {motion.start_s + flown.end_time:.3f} s jams: kinetic friction {contact.mu_kinetic} is more "
            "than a rigid contact can bear"
        )
    return Followed(motion, block, gravity, drop, start, sign, rocked, go, flown)


def _with_curves(response: Response[JumpOutcome], followed: list[Followed]) -> Response[JumpOutcome]:
    """Join the chains with the rest between them into phases, events and channels over the whole motion."""
    motion, block = response.motion, response.body
    clock = motion.time
    parts: list[tuple[np.ndarray, ...]] = []
    phases: list[Phase] = []
    events: list[Event] = []
    now, moved, raised = motion.start_s, 0.0, 0.0
    for each in followed:
        _rest(parts, phases, clock, now, each.onset_s, moved, raised)
        time, theta, x, rise = curves(each)
        parts.append((time, theta, x + moved, rise + raised))
        some_phases, some_events = phases_and_events(each)
        phases.extend(some_phases)
        events.extend(some_events)
        now, moved, raised = float(time[-1]), moved + float(x[-1]), raised + float(rise[-1])
    if not followed or (followed[-1].finished and chain_of(followed[-1]).outcome in (NO_JUMP, JUMPED)):
        _rest(parts, phases, clock, now, float(clock[-1]) + motion.dt, moved, raised)
    time, theta, x, rise = (np.concatenate(column) for column in zip(*parts, strict=True))
    channels = (
        Channel("theta", "rad", theta, "θ"),
        Channel("x_G", "m", x, "x_G"),
        Channel("y_G", "m", block.centroid_height + rise, "y_G"),
        Channel("ground_acceleration", "m/s^2", np.interp(time, clock, motion.horizontal), "z''"),
    )
    return replace(response, time=time, channels=channels, phases=tuple(phases), events=tuple(events))


def _rest(
    parts: list[tuple[np.ndarray, ...]], phases: list[Phase], clock: np.ndarray, since: float, until: float, moved: float, raised: float
) -> None:
    """Add the samples at which the block stands still between two instants."""
    inside = clock[(clock >= since) & (clock < until)]
    zero = np.zeros(inside.size)
    parts.append((inside, zero, zero + moved, zero + raised))
    phases.append(Phase(REST, since, min(until, float(clock[-1]))))

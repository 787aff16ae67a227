"""A run of the jump told over the whole motion: curves, phases, events, and what must be known before believing it."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np

from seisblock.records import Motion
from seisblock.results import Channel, Event, Phase, Response
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
from seisblock.words import noted, said

ROUND_OFF = 1e-9
"""What is no more than this over a limit, as a share, meets it."""


def warnings_of(motion: Motion, chains: tuple[Chain, ...], mu: float) -> tuple[str, ...]:
    """Return what a user should know before believing the chains of a run ([Sugimoto2017]_ 3.10), a sentence each."""
    name, found = motion.name or "motion", []
    for chain in chains:
        if chain.outcome in (ENDED_ROCKING, ENDED_FLYING, ENDED_LANDED):
            text = noted("{name}: {outcome}; the chain that began at {start:.3f} s is not complete")
            found.append(said(text, name=name, outcome=said(chain.outcome), start=chain.rocking_start_s))
    landed = [chain for chain in chains if chain.friction_needed_at_landing is not None]
    needs = [chain.friction_needed_at_landing or 0.0 for chain in landed if exceeds(chain.friction_needed_at_landing, mu)]
    if needs and math.isinf(max(needs)):
        found.append(
            said(
                "{name}: the ground would have to pull to stop the foot as {count} of {landed} landings do; the landing rule friction lets "
                "it slip on",
                name=name,
                count=sum(math.isinf(each) for each in needs),
                landed=len(landed),
            )
        )
    elif needs:
        found.append(
            said(
                "{name}: {count} of {landed} landings stop the foot with more than friction can, mu {mu:g}: they need up to {most:.2f}; "
                "the landing rule friction lets it slip on",
                name=name,
                count=len(needs),
                landed=len(landed),
                mu=mu,
                most=max(needs),
            )
        )
    gains = [chain for chain in landed if chain.landing_energy_j and exceeds(chain.landing_energy_j[1], chain.landing_energy_j[0])]
    if gains:
        most = max(gains, key=lambda chain: chain.landing_energy_j[1] - chain.landing_energy_j[0] if chain.landing_energy_j else 0.0)
        before, after = most.landing_energy_j or (0.0, 0.0)
        found.append(
            said(
                "{name}: {count} of {landed} landings make energy, as at {time:.3f} s, {before:.3g} J before and {after:.3g} J after; the "
                "landing rule friction never does",
                name=name,
                count=len(gains),
                landed=len(landed),
                time=most.landing_s,
                before=before,
                after=after,
            )
        )
    return tuple(found)


def exceeds(needed: float | None, given: float) -> bool:
    """Return whether more is needed than is given, by more than round-off ([Sugimoto2017]_ eq. (14))."""
    return needed is not None and needed > given * (1.0 + ROUND_OFF) + ROUND_OFF


def with_curves(response: Response[Any], followed: list[Followed]) -> Response[Any]:
    """Return a response with phases, events and channels over the whole motion: the chains and the rest between them."""
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
        Channel("rotation", "rad", theta, "θ"),
        Channel("displacement", "m", x, "x_G"),
        Channel("height", "m", block.centroid_height + rise, "y_G"),
        Channel("ground_acceleration", "m/s^2", np.interp(time, clock, motion.horizontal, right=0.0), "z''"),
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

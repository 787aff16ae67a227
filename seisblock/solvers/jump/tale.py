"""A run of the jump told over the whole motion: curves, phases, events, and what must be known before believing it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from seisblock.bodies.two_layer import TwoLayerBlock
from seisblock.limits import check_curves
from seisblock.records import Motion
from seisblock.results import Channel, Event, Histories, Phase
from seisblock.solvers.jump import modes as flying
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
from seisblock.words import noted, said

COLUMNS = 10
"""Rows of a day that are held while curves are made: the clock, the parts and the whole of each."""

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


@dataclass(frozen=True)
class Part:
    """A stretch of the whole motion: a chain, or the rest between two, at which the block has been moved and raised by so much, m."""

    since_s: float
    until_s: float
    moved: float
    raised: float
    chain: Followed | None = None


def parts_of(motion: Motion, followed: Sequence[Followed]) -> tuple[Part, ...]:
    """Return the chains, and the rests before, between and after them, in the order of time."""
    parts: list[Part] = []
    now, moved, raised = motion.start_s, 0.0, 0.0
    last = motion.start_s + motion.dt * float(motion.samples - 1)
    for each in followed:
        parts.append(Part(now, each.onset_s, moved, raised))
        until, x, rise = end_of_curves(each)
        parts.append(Part(each.onset_s, until, moved, raised, each))
        now, moved, raised = until, moved + x, raised + rise
    if not followed or (followed[-1].finished and chain_of(followed[-1]).outcome in (NO_JUMP, JUMPED)):
        parts.append(Part(now, last + motion.dt, moved, raised))
    return tuple(parts)


def final_displacement(parts: Sequence[Part]) -> float:
    """Return where the centroid is in the end, m, relative to where it stood."""
    last = parts[-1]
    return last.moved if last.chain is None else last.moved + end_of_curves(last.chain)[1]


def phases_and_events_of(motion: Motion, parts: Sequence[Part]) -> tuple[tuple[Phase, ...], tuple[Event, ...]]:
    """Return phases and events over the whole motion."""
    phases: list[Phase] = []
    events: list[Event] = []
    last = motion.start_s + motion.dt * float(motion.samples - 1)
    for part in parts:
        if part.chain is None:
            phases.append(Phase(REST, part.since_s, min(part.until_s, last)))
        else:
            some_phases, some_events = phases_and_events(part.chain)
            phases.extend(some_phases)
            events.extend(some_events)
    return tuple(phases), tuple(events)


def curves_of(motion: Motion, block: TwoLayerBlock, parts: Sequence[Part]) -> Histories:
    """Return the curves over the whole motion: the chains and the rest between them."""
    check_curves(motion.samples, COLUMNS)
    clock = motion.time
    columns: list[tuple[np.ndarray, ...]] = []
    for part in parts:
        if part.chain is None:
            time = clock[(clock >= part.since_s) & (clock < part.until_s)]
            theta = x = rise = np.zeros(time.size)
        else:
            time, theta, x, rise = curves(part.chain)
        columns.append((time, theta, x + part.moved, rise + part.raised))
    time, theta, x, rise = (np.concatenate(column) for column in zip(*columns, strict=True))
    channels = (
        Channel("rotation", "rad", theta, "θ"),
        Channel("displacement", "m", x, "x_G"),
        Channel("height", "m", block.centroid_height + rise, "y_G"),
        Channel("ground_acceleration", "m/s^2", np.interp(time, clock, motion.horizontal, right=0.0), "z''"),
    )
    return Histories(time, channels)


def end_of_curves(followed: Followed) -> tuple[float, float, float]:
    """Return the last of each of :func:`curves`, but the tilt: time (s), displacement and rise of the centroid (m)."""
    block, last = followed.block, followed.flown or followed.rocked
    time = followed.motion.start_s + (last.changes[-1].time if last.final_mode < 0 else last.end_time)
    if followed.flown is None:
        lean = block.slenderness - last.final[rocking.THETA]
        x, rise = block.radius * np.sin(lean) - block.width / 2, block.radius * np.cos(lean) - block.centroid_height
    else:
        mode = last.changes[-1].source if last.final_mode < 0 else last.final_mode
        (x,), (rise,) = flying.centroid(block, followed.drop, np.array([mode]), last.final[np.newaxis])
    return time, followed.sign * float(x), float(rise)

"""A run of the jump told over the whole motion: curves, phases, events, and what must be known before believing it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from seisblock.bodies.two_layer import TwoLayerBlock
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.limits import check_curve_memory
from seisblock.core.results import Channel, Event, Histories, Phase
from seisblock.models.jump import modes as flying
from seisblock.models.jump import rocking
from seisblock.models.jump.chain import (
    ENDED_FLYING,
    ENDED_LANDED,
    ENDED_ROCKING,
    JUMPED,
    NO_JUMP,
    REST,
    Chain,
    ChainPath,
    chain_curves,
    phases_and_events,
    summarise_chain,
)
from seisblock.records import Motion

COLUMNS = 10
"""Rows of a day that are held while curves are made: the clock, the parts and the whole of each."""

ROUND_OFF = 1e-9
"""What is no more than this over a limit, as a share, meets it."""


def chain_warnings(motion: Motion, chains: tuple[Chain, ...], mu: float) -> tuple[str, ...]:
    """Return what a user should know before believing the chains of a run ([Sugimoto2017]_ 3.10), a sentence each."""
    name, messages = motion.name or "motion", []
    for chain in chains:
        if chain.outcome in (ENDED_ROCKING, ENDED_FLYING, ENDED_LANDED):
            text = N_("{name}: {outcome}; the chain that began at {start:.3f} s is not complete")
            messages.append(lazy_gettext(text, name=name, outcome=lazy_gettext(chain.outcome), start=chain.rocking_start_s))
    landings = [chain for chain in chains if chain.friction_needed_at_landing is not None]
    needs = [chain.friction_needed_at_landing or 0.0 for chain in landings if exceeds(chain.friction_needed_at_landing, mu)]
    if needs and math.isinf(max(needs)):
        messages.append(
            lazy_gettext(
                "{name}: the ground would have to pull to stop the foot as {count} of {landed} landings do; the landing rule friction lets "
                "it slip on",
                name=name,
                count=sum(math.isinf(need) for need in needs),
                landed=len(landings),
            )
        )
    elif needs:
        messages.append(
            lazy_gettext(
                "{name}: {count} of {landed} landings stop the foot with more than friction can, mu {mu:g}: they need up to {most:.2f}; "
                "the landing rule friction lets it slip on",
                name=name,
                count=len(needs),
                landed=len(landings),
                mu=mu,
                most=max(needs),
            )
        )
    energy_gains = [chain for chain in landings if chain.landing_energy_j and exceeds(chain.landing_energy_j[1], chain.landing_energy_j[0])]
    if energy_gains:
        worst_landing = max(
            energy_gains, key=lambda chain: chain.landing_energy_j[1] - chain.landing_energy_j[0] if chain.landing_energy_j else 0.0
        )
        energy_before, energy_after = worst_landing.landing_energy_j or (0.0, 0.0)
        messages.append(
            lazy_gettext(
                "{name}: {count} of {landed} landings make energy, as at {time:.3f} s, {before:.3g} J before and {after:.3g} J after; the "
                "landing rule friction never does",
                name=name,
                count=len(energy_gains),
                landed=len(landings),
                time=worst_landing.landing_s,
                before=energy_before,
                after=energy_after,
            )
        )
    return tuple(messages)


def exceeds(value: float | None, limit: float) -> bool:
    """Return whether more is needed than is given, by more than round-off ([Sugimoto2017]_ eq. (14))."""
    return value is not None and value > limit * (1.0 + ROUND_OFF) + ROUND_OFF


@dataclass(frozen=True)
class Segment:
    """A stretch of the whole motion: a chain, or the rest between two, at which the block has been moved and raised by so much, m."""

    begin_s: float
    finish_s: float
    displacement_m: float
    rise_m: float
    chain: ChainPath | None = None


def split_segments(motion: Motion, paths: Sequence[ChainPath]) -> tuple[Segment, ...]:
    """Return the chains, and the rests before, between and after them, in the order of time."""
    segments: list[Segment] = []
    time, displacement, total_rise = motion.start_s, 0.0, 0.0
    last = motion.start_s + motion.dt * float(motion.samples - 1)
    for path in paths:
        segments.append(Segment(time, path.onset_s, displacement, total_rise))
        end, x, rise = chain_end(path)
        segments.append(Segment(path.onset_s, end, displacement, total_rise, path))
        time, displacement, total_rise = end, displacement + x, total_rise + rise
    if not paths or (paths[-1].is_complete and summarise_chain(paths[-1]).outcome in (NO_JUMP, JUMPED)):
        segments.append(Segment(time, last + motion.dt, displacement, total_rise))
    return tuple(segments)


def final_displacement(segments: Sequence[Segment]) -> float:
    """Return where the centroid is in the end, m, relative to where it stood."""
    segment = segments[-1]
    return segment.displacement_m if segment.chain is None else segment.displacement_m + chain_end(segment.chain)[1]


def all_phases_and_events(motion: Motion, segments: Sequence[Segment]) -> tuple[tuple[Phase, ...], tuple[Event, ...]]:
    """Return phases and events over the whole motion."""
    phases: list[Phase] = []
    events: list[Event] = []
    last = motion.start_s + motion.dt * float(motion.samples - 1)
    for segment in segments:
        if segment.chain is None:
            phases.append(Phase(REST, segment.begin_s, min(segment.finish_s, last)))
        else:
            some_phases, some_events = phases_and_events(segment.chain)
            phases.extend(some_phases)
            events.extend(some_events)
    return tuple(phases), tuple(events)


def jump_histories(motion: Motion, block: TwoLayerBlock, segments: Sequence[Segment]) -> Histories:
    """Return the curves over the whole motion: the chains and the rest between them."""
    check_curve_memory(motion.samples, COLUMNS)
    clock = motion.time
    columns: list[tuple[np.ndarray, ...]] = []
    for segment in segments:
        if segment.chain is None:
            time = clock[(clock >= segment.begin_s) & (clock < segment.finish_s)]
            theta = x = rise = np.zeros(time.size)
        else:
            time, theta, x, rise = chain_curves(segment.chain)
        columns.append((time, theta, x + segment.displacement_m, rise + segment.rise_m))
    time, theta, x, rise = (np.concatenate(column) for column in zip(*columns, strict=True))
    channels = (
        Channel("rotation", "rad", theta, "θ"),
        Channel("displacement", "m", x, "x_G"),
        Channel("height", "m", block.centroid_height + rise, "y_G"),
        Channel("ground_acceleration", "m/s^2", np.interp(time, clock, motion.horizontal, right=0.0), "z''"),
    )
    return Histories(time, channels)


def chain_end(path: ChainPath) -> tuple[float, float, float]:
    """Return the last of each of :func:`chain_curves`, but the tilt: time (s), displacement and rise of the centroid (m)."""
    block, trajectory = path.block, path.flight_path or path.rocking_path
    time = path.motion.start_s + (trajectory.events[-1].time if trajectory.final_mode < 0 else trajectory.end_time)
    if path.flight_path is None:
        lean = block.slenderness - trajectory.final[rocking.THETA]
        x, rise = block.radius * np.sin(lean) - block.width / 2, block.radius * np.cos(lean) - block.centroid_height
    else:
        mode = trajectory.events[-1].source if trajectory.final_mode < 0 else trajectory.final_mode
        (x,), (rise,) = flying.centroid(block, path.drop, np.array([mode]), trajectory.final[np.newaxis])
    return time, path.sign * float(x), float(rise)

"""Time histories, phases, events and warnings of a jump run over the whole motion."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from seisblock.bodies.two_layer import TwoLayerBlock
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.limits import check_memory
from seisblock.core.results import Channel, Event, Histories, Phase
from seisblock.models.jump import modes as flying
from seisblock.models.jump import rocking
from seisblock.models.jump.chain import (
    COMPLETE,
    Chain,
    ChainOutcome,
    ChainPath,
    JumpPhase,
    chain_curves,
    phases_and_events,
    summarise_chain,
)
from seisblock.records import Motion

COLUMNS = 10
"""Arrays of the motion's length allocated for the time histories, for the memory check."""

ROUND_OFF = 1e-9
"""Tolerance of a limit, relative and absolute."""


def chain_warnings(motion: Motion, chains: tuple[Chain, ...], mu: float) -> tuple[str, ...]:
    """Return the warnings of a run: incomplete chains, friction and energy of landings ([Sugimoto2017]_ section 3.10)."""
    name, messages = motion.name or "motion", []
    for chain in chains:
        if chain.outcome in (ChainOutcome.STILL_ROCKING, ChainOutcome.STILL_FLYING, ChainOutcome.STILL_MOVING):
            text = N_("{name}: {outcome}; the chain of motion from {start:.3f} s is incomplete")
            messages.append(lazy_gettext(text, name=name, outcome=lazy_gettext(chain.outcome), start=chain.rocking_start_s))
    landings = [chain for chain in chains if chain.friction_needed_at_landing is not None]
    needs = [chain.friction_needed_at_landing or 0.0 for chain in landings if exceeds(chain.friction_needed_at_landing, mu)]
    if needs and math.isinf(max(needs)):
        messages.append(
            lazy_gettext(
                "{name}: {count} of {landed} landings stop the foot by a tensile ground force; with `landing` friction the foot slips",
                name=name,
                count=sum(math.isinf(need) for need in needs),
                landed=len(landings),
            )
        )
    elif needs:
        messages.append(
            lazy_gettext(
                "{name}: {count} of {landed} landings require friction of up to {most:.2f} to stop the foot, more than mu {mu:g}; with "
                "`landing` friction the foot slips",
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
                "{name}: {count} of {landed} landings increase the energy (at {time:.3f} s from {before:.3g} J to {after:.3g} J); "
                "`landing` friction never does",
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
    """Return whether a value exceeds a limit by more than round-off ([Sugimoto2017]_ eq. (14))."""
    return value is not None and value > limit * (1.0 + ROUND_OFF) + ROUND_OFF


@dataclass(frozen=True)
class Segment:
    """Part of the motion: a chain, or the rest between two chains, with displacement and rise of the block at its start, m."""

    begin_s: float
    finish_s: float
    displacement_m: float
    rise_m: float
    chain: ChainPath | None = None


def split_segments(motion: Motion, paths: Sequence[ChainPath]) -> tuple[Segment, ...]:
    """Return the chains and the rests before, between and after them, in chronological order."""
    segments: list[Segment] = []
    time, displacement, total_rise = motion.start_s, 0.0, 0.0
    last = motion.start_s + motion.dt * float(motion.samples - 1)
    for path in paths:
        segments.append(Segment(time, path.onset_s, displacement, total_rise))
        end, x, rise = chain_end(path)
        segments.append(Segment(path.onset_s, end, displacement, total_rise, path))
        time, displacement, total_rise = end, displacement + x, total_rise + rise
    # only a block that stands after its last chain rests until the end of the record
    if not paths or (paths[-1].is_complete and summarise_chain(paths[-1]).outcome in COMPLETE):
        # intervals are half-open; one more sampling interval includes the last sample
        segments.append(Segment(time, last + motion.dt, displacement, total_rise))
    return tuple(segments)


def final_displacement(segments: Sequence[Segment]) -> float:
    """Return the residual displacement of the centroid, m."""
    segment = segments[-1]
    return segment.displacement_m if segment.chain is None else segment.displacement_m + chain_end(segment.chain)[1]


def all_phases_and_events(motion: Motion, segments: Sequence[Segment]) -> tuple[tuple[Phase, ...], tuple[Event, ...]]:
    """Return the phases and events of the whole motion."""
    phases: list[Phase] = []
    events: list[Event] = []
    last = motion.start_s + motion.dt * float(motion.samples - 1)
    for segment in segments:
        if segment.chain is None:
            phases.append(Phase(JumpPhase.REST, segment.begin_s, min(segment.finish_s, last)))
        else:
            chain_phases, chain_events = phases_and_events(segment.chain)
            phases.extend(chain_phases)
            events.extend(chain_events)
    return tuple(phases), tuple(events)


def jump_histories(motion: Motion, block: TwoLayerBlock, segments: Sequence[Segment]) -> Histories:
    """Return the time histories of the whole motion, chains and rests."""
    check_memory(N_("samples of time histories"), motion.samples, 8 * (COLUMNS))
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
        # at rest after the record
        Channel("ground_acceleration", "m/s^2", np.interp(time, clock, motion.horizontal, right=0.0), "z''"),
    )
    return Histories(time, channels)


def chain_end(path: ChainPath) -> tuple[float, float, float]:
    """Return time, s, displacement and rise of the centroid, m, at the end of a chain, as in :func:`chain_curves`."""
    block, trajectory = path.block, path.flight_path or path.rocking_path
    time = path.motion.start_s + (trajectory.events[-1].time if trajectory.final_mode < 0 else trajectory.end_time)
    if path.flight_path is None:
        lean = block.slenderness - trajectory.final[rocking.THETA]
        x, rise = block.radius * np.sin(lean) - block.width / 2, block.radius * np.cos(lean) - block.centroid_height
    else:
        mode = trajectory.events[-1].source if trajectory.final_mode < 0 else trajectory.final_mode
        (x,), (rise,) = flying.centroid(block, path.drop, np.array([mode]), trajectory.final[np.newaxis])
        x = x * (not path.held)
    return time, path.sign * float(x), float(rise)

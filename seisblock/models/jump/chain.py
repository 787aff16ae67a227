"""One chain of motion of the jump: trajectories, and the results of [Sugimoto2017]_ table 1."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from seisblock.bodies.two_layer import TwoLayerBlock
from seisblock.core.i18n import N_, Term
from seisblock.core.results import Event, Phase
from seisblock.core.typing import FloatArray
from seisblock.dynamics import GuardEvent, Instant, Trajectory
from seisblock.models.jump import modes as flying
from seisblock.models.jump import rocking
from seisblock.models.jump.impact import Launch, centroid_rise, foot_rise
from seisblock.records import Motion


class ChainOutcome(Term):
    """Outcomes of a chain of motion, and of a run."""

    DID_NOT_ROCK = N_("did not rock")
    NO_JUMP = N_("rocked without jumping")
    JUMPED = N_("jumped")
    OVERTURNED_ROCKING = N_("overturned while rocking")
    OVERTURNED_LANDED = N_("overturned after landing")
    STILL_ROCKING = N_("still rocking a minute after the record")
    STILL_FLYING = N_("still in flight a minute after the record")
    STILL_MOVING = N_("still moving a minute after the record")
    IN_MORTISES = N_("lifted within the mortises")


COMPLETE = (ChainOutcome.NO_JUMP, ChainOutcome.JUMPED, ChainOutcome.IN_MORTISES)
"""Outcomes of a chain that ended upright, after which another may begin."""


class JumpPhase(Term):
    """Names of the phases."""

    REST = N_("rest")
    ROCKING = N_("rocking")
    FLIGHT = N_("flight")
    LANDED = N_("rocking-sliding")


CHUNK_SIZE = 2**12
"""Samples per chunk in the search for the end of the time above the threshold."""

SLIPPING_KINDS = (flying.SLIP_BACKWARD, flying.SLIP_FORWARD, flying.FLAT_BACKWARD, flying.FLAT_FORWARD)
"""Kinds of motion with a slipping foot."""


@dataclass(frozen=True)
class Chain:
    """Results of one chain of motion, a column of [Sugimoto2017]_ table 1.

    Times in s from the record's first sample; None if the chain ended earlier. Displacements of the centroid relative to the
    ground, m, positive in the component's positive direction.

    Parameters
    ----------
    outcome : str
    direction : "+" or "-"
        Sign of the ground acceleration that starts the chain, and of the jump.
    rocking_start_s, impact_s, landing_s, end_s : float
    rocking_duration_s, jump_duration_s, rock_slide_duration_s : float
    max_rotation_rad : float
        Peak tilt in rocking, magnitude.
    impact_velocity_rad_s : float
        Angular velocity at the impact, magnitude.
    max_rise_m : float
        Largest rise of the centroid in flight above its height at rest.
    jump_displacement_m, rock_slide_displacement_m, total_displacement_m : float
        The total is zero where tenons stay in their mortises; the parts are those of a block without tenons.
    time_above_threshold_s : float
        Time from the onset of rocking during which the ground acceleration exceeds the rocking threshold.
    foot_rise_m : float
        Largest height in flight of the lower of the two lower corners above the supporting level.
    landing_corner : "leading" or "trailing"
        Leading: on the side of the jump direction.
    slid : bool
        True if the landed foot slipped ([Sugimoto2017]_ eq. (14)).
    friction_needed_at_landing : float, 1
        Largest P_x/P_y of the landings; infinite where a tensile ground force would be required.
    landing_energy_j : two floats, J
        Kinetic energy before and after the landing with the largest ratio of the two.
    end_angular_velocity_rad_s, end_slip_velocity_m_s : float
        Angular velocity and slip velocity of the foot when the tilt returns to zero, magnitudes; the paper's model ends there.
    """

    outcome: str
    direction: str
    rocking_start_s: float
    impact_s: float | None = None
    landing_s: float | None = None
    end_s: float | None = None
    rocking_duration_s: float | None = None
    jump_duration_s: float | None = None
    rock_slide_duration_s: float | None = None
    max_rotation_rad: float = 0.0
    impact_velocity_rad_s: float | None = None
    max_rise_m: float | None = None
    jump_displacement_m: float | None = None
    rock_slide_displacement_m: float | None = None
    total_displacement_m: float | None = None
    time_above_threshold_s: float = 0.0
    foot_rise_m: float | None = None
    landing_corner: str | None = None
    slid: bool | None = None
    friction_needed_at_landing: float | None = None
    landing_energy_j: tuple[float, float] | None = None
    end_angular_velocity_rad_s: float | None = None
    end_slip_velocity_m_s: float | None = None


@dataclass(frozen=True, eq=False)
class ChainPath:
    """Trajectories of a chain, in the frame of its forward direction.

    Parameters
    ----------
    sign : float
        +1 if this frame is that of the component, -1 if mirrored.
    rocking_path : Trajectory
        From the onset to the impact.
    launch : Launch or None
        Velocities after the impact.
    flight_path : Trajectory or None
        From the impact to the end, if the block jumps.
    held : bool
        True if the tenons stay in their mortises: the flight is that of a block without tenons, but nothing moves away.
    """

    motion: Motion
    block: TwoLayerBlock
    gravity: float
    drop: float
    start: Instant
    sign: float
    rocking_path: Trajectory
    launch: Launch | None
    flight_path: Trajectory | None
    held: bool = False

    @property
    def onset_s(self) -> float:
        """Onset of rocking, s from the record's first sample."""
        return self.motion.start_s + self.start.sample * self.motion.dt + self.start.tau

    @property
    def impact_s(self) -> float:
        """End of rocking, s from the record's first sample."""
        return self.motion.start_s + self.rocking_path.end_time

    @property
    def has_impact(self) -> bool:
        """True if rocking ended in an impact."""
        return self.rocking_path.final_mode == rocking.IMPACT

    @property
    def first_landing(self) -> GuardEvent | None:
        """Event of the first landing, None without one."""
        return next((change for change in self.flight_path.events if change.source == flying.FLIGHT), None) if self.flight_path else None

    @property
    def end(self) -> Instant:
        """Last instant of the chain."""
        return self.flight_path.end if self.flight_path else self.rocking_path.end

    @property
    def is_complete(self) -> bool:
        """True if the chain reached a terminal mode before the time limit."""
        trajectory = self.flight_path or self.rocking_path
        return trajectory.final_mode < 0


def summarise_chain(path: ChainPath) -> Chain:
    """Return the results of a chain ([Sugimoto2017]_ table 1)."""
    onset, impact = path.onset_s, path.impact_s
    entries: dict[str, Any] = {
        "direction": "+" if path.sign > 0 else "-",
        "rocking_start_s": onset,
        "max_rotation_rad": float(path.rocking_path.extrema[0, 0]),
        "time_above_threshold_s": _time_above_threshold(path),
    }
    # without an impact the block overturned, or still rocks at the time limit
    if path.has_impact:
        entries |= {
            "impact_s": impact,
            "rocking_duration_s": impact - onset,
            "impact_velocity_rad_s": abs(float(path.rocking_path.final[rocking.OMEGA])),
        }
    if path.flight_path is None:
        outcome = {rocking.IMPACT: ChainOutcome.NO_JUMP, rocking.OVERTURNED: ChainOutcome.OVERTURNED_ROCKING}.get(
            path.rocking_path.final_mode, ChainOutcome.STILL_ROCKING
        )
        if outcome == ChainOutcome.NO_JUMP:
            entries["total_displacement_m"] = 0.0
        if path.is_complete:
            entries["end_s"] = impact
        return Chain(outcome, **entries)
    return Chain(_flight_outcome(path), **entries, **_flight_results(path))


def _flight_outcome(path: ChainPath) -> ChainOutcome:
    """Return the outcome of a chain with a jump."""
    assert path.flight_path is not None
    if path.held and path.flight_path.final_mode == flying.END:
        return ChainOutcome.IN_MORTISES
    outcome = ChainOutcome.STILL_FLYING if path.flight_path.final_mode == flying.FLIGHT else ChainOutcome.STILL_MOVING
    return {flying.END: ChainOutcome.JUMPED, flying.OVERTURNED: ChainOutcome.OVERTURNED_LANDED}.get(path.flight_path.final_mode, outcome)


def _flight_results(path: ChainPath) -> dict[str, Any]:
    """Return the fields of a chain from the impact on."""
    assert path.flight_path is not None and path.launch is not None
    flight, takeoff, first_landing = path.flight_path, path.launch, path.first_landing
    entries: dict[str, Any] = {
        # a landing may end the flight before the top of the parabola
        "max_rise_m": centroid_rise(
            takeoff.vertical, path.gravity, math.inf if first_landing is None else first_landing.time - path.rocking_path.end_time
        ),
        "foot_rise_m": foot_rise(path.block, takeoff, path.gravity),
    }
    if first_landing is None:
        return entries
    landing = path.motion.start_s + first_landing.time
    jump_displacement = path.sign * float(first_landing.before[flying.X])
    entries |= {
        "landing_s": landing,
        "jump_duration_s": landing - path.impact_s,
        "jump_displacement_m": jump_displacement,
        "landing_corner": "leading" if first_landing.guard == flying.RIGHT else "trailing",
        "friction_needed_at_landing": float(flight.final[flying.FRICTION_NEEDED]),
        "landing_energy_j": (float(flight.final[flying.ENERGY_BEFORE]), float(flight.final[flying.ENERGY_AFTER])),
        # terminal targets have no kind of contact
        "slid": any(c.target > 0 and flying.contact_kind(c.target) in SLIPPING_KINDS for c in flight.events),
    }
    if path.is_complete:
        end = path.motion.start_s + flight.end_time
        # the terminal mode has no corner; the mode that it ended does
        x, _ = flying.centroid(path.block, path.drop, np.array([flight.events[-1].source]), flight.final[np.newaxis])
        total = 0.0 if path.held else path.sign * float(x[0])
        entries |= {
            "end_s": end,
            "rock_slide_duration_s": end - landing,
            "rock_slide_displacement_m": path.sign * float(x[0]) - jump_displacement,
            "total_displacement_m": total,
        }
        # the tilt returns to zero from a contact mode; a corner that lands fires the same guard in flight
        level = next((c for c in flight.events if c.source != flying.FLIGHT and c.guard == flying.TOUCH), None)
        if level is not None:
            entries["end_angular_velocity_rad_s"] = abs(float(level.before[flying.OMEGA]))
            entries["end_slip_velocity_m_s"] = abs(float(level.before[flying.VX]))
    return entries


def _time_above_threshold(path: ChainPath) -> float:
    """Return the time from the onset during which the acceleration stays above the rocking threshold, s."""
    motion, start = path.motion, path.start
    threshold = path.block.rocking_threshold(path.gravity)
    for begin in range(start.sample + 1, motion.samples, CHUNK_SIZE):
        samples_below = np.flatnonzero(path.sign * motion.horizontal[begin : begin + CHUNK_SIZE] <= threshold)
        if samples_below.size:
            # the crossing lies in the interval that ends at the first sample below
            i = begin - 1 + int(samples_below[0])
            break
    else:
        return motion.dt * (motion.samples - 1 - start.sample) - start.tau
    a0, a1 = path.sign * motion.horizontal[i], path.sign * motion.horizontal[i + 1]
    fraction = (a0 - threshold) / (a0 - a1) if a0 > threshold else 1.0
    return max((i - start.sample + float(fraction)) * motion.dt - start.tau, 0.0)


def phases_and_events(path: ChainPath) -> tuple[tuple[Phase, ...], tuple[Event, ...]]:
    """Return the phases and events of a chain; tilt positive to +x."""
    # the model counts the tilt counter-clockwise, results count it positive to +x
    tilt = -path.sign
    onset, impact = path.onset_s, path.impact_s
    rest, final_tilt = np.zeros(1), tilt * path.rocking_path.final[:1]
    phases = [Phase(JumpPhase.ROCKING, onset, impact)]
    events = [Event("rocking starts", onset, rest, rest)]
    if path.rocking_path.final_mode < 0:
        events.append(Event("impact" if path.has_impact else "overturned", impact, final_tilt, final_tilt))
    if path.flight_path is not None:
        end = path.motion.start_s + path.flight_path.end_time
        first_landing = path.first_landing
        landing = path.motion.start_s + first_landing.time if first_landing else end
        phases.append(Phase(JumpPhase.FLIGHT, impact, landing))
        if first_landing is not None:
            phases.append(Phase(JumpPhase.LANDED, landing, end))
            events.append(Event("landing", landing, tilt * first_landing.before[:1], tilt * first_landing.after[:1]))
        if path.is_complete:
            final = tilt * path.flight_path.final[:1]
            events.append(Event("end" if path.flight_path.final_mode == flying.END else "overturned", end, final, final))
    return tuple(phases), tuple(events)


def chain_curves(path: ChainPath) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Return time, s, tilt, rad, displacement and rise of the centroid, m, (n,) each, in the component's frame."""
    block, t0 = path.block, path.motion.start_s
    times, states, _ = path.rocking_path.table()
    time = np.concatenate([[path.onset_s], times + t0])
    theta = np.concatenate([[0.0], states[:, rocking.THETA]])
    # arc of the centroid about the left corner, from the place at rest
    lean = block.slenderness - theta
    x = block.radius * np.sin(lean) - block.width / 2
    rise = block.radius * np.cos(lean) - block.centroid_height
    if path.flight_path is not None:
        times, states, modes = path.flight_path.table()
        # the terminal row has no corner: use the mode of the row before, its state is the same
        modes = np.where(modes < 0, np.roll(modes, 1), modes)
        xs, rises = flying.centroid(block, path.drop, modes, states)
        xs = xs * (not path.held)
        time, theta = np.concatenate([time, times + t0]), np.concatenate([theta, states[:, flying.THETA]])
        x, rise = np.concatenate([x, xs]), np.concatenate([rise, rises])
    return time, -path.sign * theta, path.sign * x, rise

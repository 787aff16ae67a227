"""One chain of the jump: what was followed, and the column of [Sugimoto2017]_ table 1 that it fills."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from seisblock.bodies.two_layer import TwoLayerBlock
from seisblock.dynamics import Change, Instant, Trajectory
from seisblock.records import Motion
from seisblock.results import Event, Phase
from seisblock.solvers.jump import modes as flying
from seisblock.solvers.jump import rocking
from seisblock.solvers.jump.impact import Launch, centroid_rise, foot_rise
from seisblock.typing import FloatArray
from seisblock.words import noted

NO_JUMP = noted("rocked without jumping")
JUMPED = noted("jumped")
OVERTURNED_ROCKING = noted("overturned while rocking")
OVERTURNED_LANDED = noted("overturned after landing")
ENDED_ROCKING = noted("still rocking a minute after the record")
ENDED_FLYING = noted("still in flight a minute after the record")
ENDED_LANDED = noted("still moving a minute after the record")

REST, ROCKING, FLIGHT, LANDED = noted("rest"), noted("rocking"), noted("flight"), noted("rocking-sliding")
"""Names of the phases."""

LOOKED_AT = 2**12
"""Samples at a time among which the end of a stretch is looked for."""

SLIPPING = (flying.BACK, flying.FORTH, flying.FLAT_BACK, flying.FLAT_FORTH)
"""Kinds of motion in which the foot slips."""


@dataclass(frozen=True)
class Chain:
    """One chain of motion, a column of [Sugimoto2017]_ table 1.

    Times in s from the record's first sample; None where the chain did not get so far. Displacements of the
    centroid relative to the ground, m, positive towards the component's positive direction.

    Parameters
    ----------
    outcome : str
    direction : "+" or "-"
        Sign of the ground acceleration that starts it, and of the jump.
    rocking_start_s, impact_s, landing_s, end_s : float
    rocking_duration_s, jump_duration_s, rock_slide_duration_s : float
    max_rotation_rad : float
        Largest tilt while rocking, a magnitude.
    impact_velocity_rad_s : float
        Angular velocity at the impact, a magnitude.
    max_rise_m : float
        Largest rise of the centroid in flight above its height at rest, whether or not it lands before the top of its path.
    jump_displacement_m, rock_slide_displacement_m, total_displacement_m : float
    time_above_threshold_s : float
        How long the ground acceleration stays above the rocking threshold from the start of the rocking.
    foot_rise_m : float
        Largest height in flight of the lower of the two lower corners above the floor.
    landing_corner : "leading" or "trailing"
        Leading: on the side towards which the block jumps.
    slid : bool
        Whether the landed foot slipped ([Sugimoto2017]_ eq. (14)).
    friction_needed_at_landing : float, 1
        Largest P_x/P_y of its landings; infinite where the ground would have to pull.
    landing_energy_j : two floats, J
        Kinetic energy before and after the landing that keeps the largest share of it.
    end_angular_velocity_rad_s, end_slip_velocity_m_s : float
        What is left of the foot's motion when the tilt is back at zero, magnitudes: the paper's model ends there.
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
class Followed:
    """A chain as the engine followed it, in the frame in which it goes forward.

    Parameters
    ----------
    sign : float
        +1 when that frame is the component's own, -1 when it is its mirror image.
    rocked : Trajectory
        From the onset to the impact.
    launch : Launch or None
        Velocities after the impact.
    flown : Trajectory or None
        From the impact to the end, when the block jumps.
    """

    motion: Motion
    block: TwoLayerBlock
    gravity: float
    drop: float
    start: Instant
    sign: float
    rocked: Trajectory
    launch: Launch | None
    flown: Trajectory | None

    @property
    def onset_s(self) -> float:
        """Start of the rocking, s from the record's first sample."""
        return self.motion.start_s + self.start.sample * self.motion.dt + self.start.tau

    @property
    def impact_s(self) -> float:
        """End of the rocking."""
        return self.motion.start_s + self.rocked.end_time

    @property
    def hit(self) -> bool:
        """Whether the rocking ended in an impact."""
        return self.rocked.final_mode == rocking.IMPACT

    @property
    def touch(self) -> Change | None:
        """The first landing."""
        return next((change for change in self.flown.changes if change.source == flying.FLIGHT), None) if self.flown else None

    @property
    def end(self) -> Instant:
        """Where the chain ended."""
        return self.flown.end if self.flown else self.rocked.end

    @property
    def finished(self) -> bool:
        """Whether it came to its own end before the record did."""
        last = self.flown or self.rocked
        return last.final_mode < 0


def chain_of(followed: Followed) -> Chain:
    """Return the numbers of a chain ([Sugimoto2017]_ table 1)."""
    onset, impact = followed.onset_s, followed.impact_s
    found: dict[str, Any] = {
        "direction": "+" if followed.sign > 0 else "-",
        "rocking_start_s": onset,
        "max_rotation_rad": float(followed.rocked.extrema[0, 0]),
        "time_above_threshold_s": _time_above_threshold(followed),
    }
    if followed.hit:
        found |= {
            "impact_s": impact,
            "rocking_duration_s": impact - onset,
            "impact_velocity_rad_s": abs(float(followed.rocked.final[rocking.OMEGA])),
        }
    if followed.flown is None:
        outcome = {rocking.IMPACT: NO_JUMP, rocking.OVERTURNED: OVERTURNED_ROCKING}.get(followed.rocked.final_mode, ENDED_ROCKING)
        if outcome == NO_JUMP:
            found["total_displacement_m"] = 0.0
        if followed.finished:
            found["end_s"] = impact
        return Chain(outcome, **found)
    return Chain(_outcome_of_flight(followed), **found, **_flight_numbers(followed))


def _outcome_of_flight(followed: Followed) -> str:
    """Return in words how a chain that jumped ended."""
    assert followed.flown is not None
    ended = ENDED_FLYING if followed.flown.final_mode == flying.FLIGHT else ENDED_LANDED
    return {flying.END: JUMPED, flying.OVERTURNED: OVERTURNED_LANDED}.get(followed.flown.final_mode, ended)


def _flight_numbers(followed: Followed) -> dict[str, Any]:
    """Return the entries of a chain from the impact on."""
    assert followed.flown is not None and followed.launch is not None
    flown, go, touch = followed.flown, followed.launch, followed.touch
    found: dict[str, Any] = {
        "max_rise_m": centroid_rise(go.vertical, followed.gravity, math.inf if touch is None else touch.time - followed.rocked.end_time),
        "foot_rise_m": foot_rise(followed.block, go, followed.gravity),
    }
    if touch is None:
        return found
    landing = followed.motion.start_s + touch.time
    jumped = followed.sign * float(touch.before[flying.X])
    found |= {
        "landing_s": landing,
        "jump_duration_s": landing - followed.impact_s,
        "jump_displacement_m": jumped,
        "landing_corner": "leading" if touch.guard == flying.RIGHT else "trailing",
        "friction_needed_at_landing": float(flown.final[flying.NEEDED]),
        "landing_energy_j": (float(flown.final[flying.BEFORE]), float(flown.final[flying.AFTER])),
        "slid": any(c.target > 0 and flying.kind_of(c.target) in SLIPPING for c in flown.changes),
    }
    if followed.finished:
        end = followed.motion.start_s + flown.end_time
        x, _ = flying.centroid(followed.block, followed.drop, np.array([flown.changes[-1].source]), flown.final[np.newaxis])
        total = followed.sign * float(x[0])
        found |= {
            "end_s": end,
            "rock_slide_duration_s": end - landing,
            "rock_slide_displacement_m": total - jumped,
            "total_displacement_m": total,
        }
        level = next((c for c in flown.changes if c.source != flying.FLIGHT and c.guard == flying.TOUCH), None)
        if level is not None:
            found["end_angular_velocity_rad_s"] = abs(float(level.before[flying.OMEGA]))
            found["end_slip_velocity_m_s"] = abs(float(level.before[flying.VX]))
    return found


def _time_above_threshold(followed: Followed) -> float:
    """Return how long the acceleration stays above the rocking threshold from the onset on, s."""
    motion, start = followed.motion, followed.start
    threshold = followed.block.rocking_threshold(followed.gravity)
    for begin in range(start.sample + 1, motion.samples, LOOKED_AT):
        below = np.flatnonzero(followed.sign * motion.horizontal[begin : begin + LOOKED_AT] <= threshold)
        if below.size:
            i = begin - 1 + int(below[0])
            break
    else:
        return motion.dt * (motion.samples - 1 - start.sample) - start.tau
    a0, a1 = followed.sign * motion.horizontal[i], followed.sign * motion.horizontal[i + 1]
    fraction = (a0 - threshold) / (a0 - a1) if a0 > threshold else 1.0
    return max((i - start.sample + float(fraction)) * motion.dt - start.tau, 0.0)


def phases_and_events(followed: Followed) -> tuple[tuple[Phase, ...], tuple[Event, ...]]:
    """Return the phases and events of a chain, tilts in the house sign (positive when leaning to +x)."""
    tilt = -followed.sign
    onset, impact = followed.onset_s, followed.impact_s
    rest, last = np.zeros(1), tilt * followed.rocked.final[:1]
    phases = [Phase(ROCKING, onset, impact)]
    events = [Event("rocking starts", onset, rest, rest)]
    if followed.rocked.final_mode < 0:
        events.append(Event("impact" if followed.hit else "overturned", impact, last, last))
    if followed.flown is not None:
        end = followed.motion.start_s + followed.flown.end_time
        touch = followed.touch
        landing = followed.motion.start_s + touch.time if touch else end
        phases.append(Phase(FLIGHT, impact, landing))
        if touch is not None:
            phases.append(Phase(LANDED, landing, end))
            events.append(Event("landing", landing, tilt * touch.before[:1], tilt * touch.after[:1]))
        if followed.finished:
            final = tilt * followed.flown.final[:1]
            events.append(Event("end" if followed.flown.final_mode == flying.END else "overturned", end, final, final))
    return tuple(phases), tuple(events)


def curves(followed: Followed) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Return time (s), tilt (rad), displacement and rise of the centroid (m), each (m,), in the component's frame."""
    block, t0 = followed.block, followed.motion.start_s
    times, states, _ = followed.rocked.table()
    time = np.concatenate([[followed.onset_s], times + t0])
    theta = np.concatenate([[0.0], states[:, rocking.THETA]])
    lean = block.slenderness - theta
    x = block.radius * np.sin(lean) - block.width / 2
    rise = block.radius * np.cos(lean) - block.centroid_height
    if followed.flown is not None:
        times, states, modes = followed.flown.table()
        # the end's second limit names no corner: it is the first one over again
        modes = np.where(modes < 0, np.roll(modes, 1), modes)
        xs, rises = flying.centroid(block, followed.drop, modes, states)
        time, theta = np.concatenate([time, times + t0]), np.concatenate([theta, states[:, flying.THETA]])
        x, rise = np.concatenate([x, xs]), np.concatenate([rise, rises])
    return time, -followed.sign * theta, followed.sign * x, rise

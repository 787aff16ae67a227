"""What a run means in numbers: the outcome, its changes of mode and its phases."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TypedDict

import numpy as np

from seisblock.core.results import Phase, Status
from seisblock.dynamics import EventLog
from seisblock.models.respond import constants
from seisblock.models.respond.describe import OVERTURNED, outcome_text
from seisblock.models.respond.params import RespondParams
from seisblock.models.respond.run import Run


class ModeChange(TypedDict):
    """From when on the body is in a mode: time from the record's first sample, corner left, right or None, slip +, - or None."""

    time_s: float
    mode: str
    corner: str | None
    slip: str | None


class TimeInMode(TypedDict):
    """How long the body was in each mode, s."""

    rest: float
    slide: float
    rock: float
    slide_rock: float
    flight: float


@dataclass(frozen=True)
class RespondOutcome:
    """What became of the body; times in s from the record's first sample, displacements of its centre of gravity relative to the ground.

    Parameters
    ----------
    outcome : str
        In words: rests, slides, rocks, flies or a combination, overturns, moves on (the time to settle was too short), hops without end.
    overturned : bool
    overturned_towards : str or None
        ``+x`` or ``-x``.
    overturning_time_s : float or None
        When a quarter turn, or a further point on the ground, ended the motion.
    max_rotation_rad, max_rotation_ratio : float
        Largest lean, absolute and over alpha of the corner concerned.
    final_displacement_m : float
        Signed, along +x, once it rests, has fallen, or time is up; from x = 0, where it stands unless put down elsewhere.
    max_displacement_m : float
        Largest absolute displacement.
    slip_path_m : float
        Length that the base or a corner has slid.
    flights, impacts : int
        How often it left the ground, and how often a corner or the base met it.
    time_in_mode_s : dict
        Up to the end.
    energy_friction_j, energy_impacts_j, energy_ground_j : float
        Lost by friction and in impacts, and the work of the ground that moves under it.
    sensitive : bool or None
        Whether a change of the input by 1e-6 changes whether, or to which side, it overturns; None when not looked for.
    events : list of dict
        Changes of mode; the first says in which one it starts.
    settled : bool
        Whether it stands at rest at the end.
    end_s : float
        When the motion ended or was given up.
    jams : int
        Slips that ended at once above Painleve's limit.
    ratios_lowered : int
        Rocking impacts whose given ratio would have created energy.
    tenon_left_s : float or None
        When, in flight, the feet left their tenons.
    """

    outcome: str
    overturned: bool
    overturned_towards: str | None
    overturning_time_s: float | None
    max_rotation_rad: float
    max_rotation_ratio: float
    final_displacement_m: float
    max_displacement_m: float
    slip_path_m: float
    flights: int
    impacts: int
    time_in_mode_s: TimeInMode
    energy_friction_j: float
    energy_impacts_j: float
    energy_ground_j: float
    sensitive: bool | None
    events: list[ModeChange]
    settled: bool
    end_s: float
    jams: int
    ratios_lowered: int
    tenon_left_s: float | None


def mode_change(time_s: float, mode: int) -> ModeChange:
    """Return a mode of the model in the user's words."""
    kind = mode % constants.TENON_OFFSET if mode >= 0 else constants.REST
    is_rotating = (
        kind in (constants.ROCK_RIGHT, constants.ROCK_LEFT) or constants.SLIDE_ROCK_RIGHT_PLUS <= kind <= constants.SLIDE_ROCK_LEFT_MINUS
    )
    is_sliding = constants.SLIDE_PLUS <= kind <= constants.SLIDE_ROCK_LEFT_MINUS
    return {
        "time_s": time_s,
        "mode": constants.MODES[mode],
        "corner": ("right" if constants.is_right(kind) else "left") if is_rotating else None,
        "slip": ("+" if constants.slip_sign(kind) > 0.0 else "-") if is_sliding else None,
    }


def mode_changes(run: Run, start_s: float) -> list[ModeChange]:
    """Return the changes of mode; an impact after which the mode is the same is none."""
    result: list[ModeChange] = []
    for time, target in zip(run.events.time.tolist(), run.events.target.tolist(), strict=True):
        if target == constants.GAVE_UP:
            continue
        entry = mode_change(start_s + time, target)
        if not result or any(result[-1][key] != entry[key] for key in ("mode", "corner", "slip")):
            result.append(entry)
    return result


def phases(events: list[ModeChange], end_s: float) -> tuple[Phase, ...]:
    """Return the stretches of one mode each, the two corners and slips told apart by events alone."""
    merged: list[ModeChange] = []
    for event in events:
        if event["mode"] != OVERTURNED and not (merged and merged[-1]["mode"] == event["mode"]):
            merged.append(event)
    ends = [event["time_s"] for event in merged[1:]] + [end_s]
    return tuple(Phase(event["mode"], event["time_s"], end) for event, end in zip(merged, ends, strict=True))


def time_in_mode(intervals: Iterable[Phase]) -> TimeInMode:
    """Return how long each mode lasted in all."""
    total: TimeInMode = {"rest": 0.0, "slide": 0.0, "rock": 0.0, "slide_rock": 0.0, "flight": 0.0}
    for phase in intervals:
        total[phase.name.replace("-", "_")] += phase.duration_s  # type: ignore[literal-required]
    return total


def max_lean_ratio(params: RespondParams, highest: float, lowest: float) -> float:
    """Return the larger lean over alpha of its corner, from the largest leans to +x and, negative, to -x."""
    right, left = params.rigid_body.slendernesses
    return max(highest / right, -lowest / left)


def build_outcome(run: Run, params: RespondParams, start_s: float, sensitive: bool | None) -> RespondOutcome:
    """Gather the outcome of a run."""
    final = run.final
    mass = params.rigid_body.mass
    events = mode_changes(run, start_s)
    end_s = start_s + run.end_s
    time = time_in_mode(phases(events, end_s))
    overturned = run.mode == constants.OVERTURNED
    highest, lowest = run.extrema(constants.THETA)
    max_x, min_x = run.extrema(constants.X)
    release_times = run.events.time[(run.events.guard == constants.RELEASE) & (run.events.target == constants.FLIGHT)]
    return RespondOutcome(
        outcome=outcome_text(run, {event["mode"] for event in events}),
        overturned=overturned,
        overturned_towards=("+x" if final[constants.THETA] > 0.0 else "-x") if overturned else None,
        overturning_time_s=end_s if overturned else None,
        max_rotation_rad=max(highest, -lowest),
        max_rotation_ratio=max_lean_ratio(params, highest, lowest),
        final_displacement_m=float(final[constants.X]),
        max_displacement_m=max(max_x, -min_x),
        slip_path_m=float(final[constants.PATH]),
        flights=_count_flights(run.events),
        impacts=int(final[constants.IMPACTS]),
        time_in_mode_s=time,
        energy_friction_j=mass * float(final[constants.FRICTION]),
        energy_impacts_j=mass * float(final[constants.LOSS]),
        energy_ground_j=mass * float(final[constants.WORK]),
        sensitive=sensitive,
        events=events,
        settled=run.ends_at_rest,
        end_s=end_s,
        jams=int(final[constants.JAMS]),
        ratios_lowered=int(final[constants.RATIO_LOWERED]),
        tenon_left_s=float(start_s + release_times[0]) if release_times.size else None,
    )


def _count_flights(changes: EventLog) -> int:
    """Return how many events begin a flight, be it by a rebound."""
    in_flight = (changes.target >= 0) & (changes.target % constants.TENON_OFFSET == constants.FLIGHT)
    is_rebound = changes.after[:, constants.IMPACTS] > changes.before[:, constants.IMPACTS]
    return int(np.count_nonzero(in_flight & ((changes.source % constants.TENON_OFFSET != constants.FLIGHT) | is_rebound)))


def run_status(run: Run) -> Status:
    """Return how the run ended."""
    if run.mode == constants.GAVE_UP:
        return Status.TOO_MANY_EVENTS
    return Status.STOPPED if run.mode == constants.OVERTURNED or run.ends_at_rest else Status.RECORD_ENDED


def final_mode(run: Run) -> int:
    """Return the last mode that was one of motion or rest, never an end."""
    if run.mode >= 0:
        return run.mode
    if run.mode == constants.SETTLED:
        return constants.REST
    return run.last.events[-1].source


def motion_modes(run: Run, modes: np.ndarray) -> np.ndarray:
    """Return modes with those that end a motion replaced by what they ended."""
    return np.where(modes < 0, final_mode(run), modes)

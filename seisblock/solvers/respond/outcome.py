"""What a run means: the outcome, its events and phases, and what one should know before believing the numbers."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TypedDict

import numpy as np

from seisblock.dynamics import Change
from seisblock.results import Event, Phase, Status
from seisblock.solvers.respond import names
from seisblock.solvers.respond.run import Run
from seisblock.solvers.respond.setting import Setting
from seisblock.words import noted

REST, SLIDE, ROCK = noted("rest"), noted("slide"), noted("rock")
SLIDE_ROCK, FLIGHT, OVERTURNED = noted("slide-rock"), noted("flight"), noted("overturned")

RESTS, OVERTURNS, MOVES_ON, HOPS_ON = "rests", "overturns", "moves on", "hops without end"
"""Outcomes beside those of a body that has moved and stands: slides, rocks, flies, and their combinations."""


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
    kind = mode % names.HELD if mode >= 0 else names.REST
    turns = kind in (names.ROCK_RIGHT, names.ROCK_LEFT) or names.SKID_RIGHT_PLUS <= kind <= names.SKID_LEFT_MINUS
    slips = names.SLIDE_PLUS <= kind <= names.SKID_LEFT_MINUS
    return {
        "time_s": time_s,
        "mode": names.MODES[mode],
        "corner": ("right" if names.is_right(kind) else "left") if turns else None,
        "slip": ("+" if names.sense(kind) > 0.0 else "-") if slips else None,
    }


def mode_changes(run: Run, start_s: float) -> list[ModeChange]:
    """Return the changes of mode; an impact after which the mode is the same is none."""
    found: list[ModeChange] = []
    for time, change in run.changes():
        if change.target == names.GAVE_UP:
            continue
        entry = mode_change(start_s + time, change.target)
        if not found or any(found[-1][key] != entry[key] for key in ("mode", "corner", "slip")):
            found.append(entry)
    return found


def phases(events: list[ModeChange], end_s: float) -> tuple[Phase, ...]:
    """Return the stretches of one mode each, the two corners and slips told apart by events alone."""
    merged: list[ModeChange] = []
    for event in events:
        if event["mode"] != OVERTURNED and not (merged and merged[-1]["mode"] == event["mode"]):
            merged.append(event)
    ends = [event["time_s"] for event in merged[1:]] + [end_s]
    return tuple(Phase(event["mode"], event["time_s"], end) for event, end in zip(merged, ends, strict=True))


def time_in_mode(stretches: Iterable[Phase]) -> TimeInMode:
    """Return how long each mode lasted in all."""
    total: TimeInMode = {"rest": 0.0, "slide": 0.0, "rock": 0.0, "slide_rock": 0.0, "flight": 0.0}
    for phase in stretches:
        total[phase.name.replace("-", "_")] += phase.duration_s  # type: ignore[literal-required]
    return total


def lean_ratio(setting: Setting, highest: float, lowest: float) -> float:
    """Return the larger lean over alpha of its corner, from the largest leans to +x and, negative, to -x."""
    right, left = setting.stand.slendernesses
    return max(highest / right, -lowest / left)


def gather(run: Run, setting: Setting, start_s: float, sensitive: bool | None) -> RespondOutcome:
    """Gather the outcome of a run."""
    final = run.final
    mass = setting.stand.mass
    events = mode_changes(run, start_s)
    end_s = start_s + run.end_s
    time = time_in_mode(phases(events, end_s))
    overturned = run.mode == names.OVERTURNED
    highest, lowest = run.extrema(names.THETA)
    ahead, behind = run.extrema(names.X)
    released = [time for time, change in run.changes() if change.guard == names.RELEASE and change.target == names.FLIGHT]
    return RespondOutcome(
        outcome=in_words(run, events),
        overturned=overturned,
        overturned_towards=("+x" if final[names.THETA] > 0.0 else "-x") if overturned else None,
        overturning_time_s=end_s if overturned else None,
        max_rotation_rad=max(highest, -lowest),
        max_rotation_ratio=lean_ratio(setting, highest, lowest),
        final_displacement_m=float(final[names.X]),
        max_displacement_m=max(ahead, -behind),
        slip_path_m=float(final[names.PATH]),
        flights=sum(_leaves_ground(change) for _, change in run.changes()),
        impacts=int(final[names.IMPACTS]),
        time_in_mode_s=time,
        energy_friction_j=mass * float(final[names.FRICTION]),
        energy_impacts_j=mass * float(final[names.LOSS]),
        energy_ground_j=mass * float(final[names.WORK]),
        sensitive=sensitive,
        events=events,
        settled=run.settles,
        end_s=end_s,
        jams=int(final[names.JAMS]),
        ratios_lowered=int(final[names.LOWERED]),
        tenon_left_s=start_s + released[0] if released else None,
    )


def _leaves_ground(change: Change) -> bool:
    """Whether an event begins a flight, be it by a rebound."""
    if change.target < 0 or change.target % names.HELD != names.FLIGHT:
        return False
    return change.source % names.HELD != names.FLIGHT or bool(change.after[names.IMPACTS] > change.before[names.IMPACTS])


def in_words(run: Run, events: list[ModeChange]) -> str:
    """Say in a word or two what the body did."""
    if run.mode == names.OVERTURNED:
        return OVERTURNS
    if run.mode == names.GAVE_UP:
        return HOPS_ON
    if not run.settles:
        return MOVES_ON
    seen = {event["mode"] for event in events}
    did = [word for word, modes in (("slides", {SLIDE, SLIDE_ROCK}), ("rocks", {ROCK, SLIDE_ROCK}), ("flies", {FLIGHT})) if modes & seen]
    return " and ".join(filter(None, (", ".join(did[:-1]), did[-1]))) if did else RESTS


def status(run: Run) -> Status:
    """Return how the run ended."""
    if run.mode == names.GAVE_UP:
        return Status.TOO_MANY_EVENTS
    return Status.STOPPED if run.mode == names.OVERTURNED or run.settles else Status.RECORD_ENDED


def event_name(change: Change) -> str:
    """Return what happened."""
    if change.target == names.OVERTURNED:
        return "overturns"
    if change.target == names.GAVE_UP:
        return "is given up"
    if change.guard == names.RELEASE:
        return "leaves the tenons" if change.target == names.FLIGHT else "lifts one foot over its tenon"
    struck = change.after[names.IMPACTS] > change.before[names.IMPACTS]
    target = names.MODES[change.target]
    if struck:
        lands = change.source % names.HELD == names.FLIGHT
        return ("landing" if lands else "impact") + (", " + target if target in (REST, SLIDE, FLIGHT) else "")
    return {REST: "comes to rest", SLIDE: "slides", ROCK: "rocks", SLIDE_ROCK: "slides while rocking", FLIGHT: "lifts off"}[target]


def event_log(run: Run, start_s: float) -> tuple[Event, ...]:
    """Return every event with both limits of the state."""
    return tuple(Event(event_name(change), start_s + time, change.before, change.after) for time, change in run.changes())


def warnings(run: Run, setting: Setting, outcome: RespondOutcome, settle_s: float) -> tuple[str, ...]:
    """Return what the user should know before believing the numbers."""
    name = setting.stand.name
    told = []
    if run.mode == names.GAVE_UP:
        told.append(
            f"{name}: given up at {outcome.end_s:.3f} s after {outcome.impacts} impacts: it hops without end; lower the restitution"
        )
    elif not outcome.settled and not outcome.overturned:
        told.append(f"{name}: still in motion {settle_s:g} s after the record; what is given is the state then")
    if setting.may_jam:
        jams = f"{outcome.jams} of its slips jammed" if outcome.jams else "no slip jammed here"
        told.append(
            f"{name}: kinetic friction {setting.mu_kinetic:g} is above {setting.stand.friction_limit:.2f}, where a rigid body that slips "
            f"may jam (Painleve); {jams}"
        )
    if outcome.ratios_lowered:
        told.append(
            f"{name}: the rocking restitution {setting.rocking_restitution:g} would have created energy in "
            f"{outcome.ratios_lowered} impacts and was lowered there"
        )
    return tuple(told)


def final_mode(run: Run) -> int:
    """Return the last mode that was one of motion or rest, never an end."""
    if run.mode >= 0:
        return run.mode
    if run.mode == names.SETTLED:
        return names.REST
    return run.last.changes[-1].source


def motion_modes(run: Run, modes: np.ndarray) -> np.ndarray:
    """Return modes with those that end a motion replaced by what they ended."""
    return np.where(modes < 0, final_mode(run), modes)

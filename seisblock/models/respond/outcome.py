"""Outcome, mode changes and phases of a full-response run."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any, NamedTuple, TypedDict

import numpy as np

from seisblock.core._display import DisplayMixin
from seisblock.core.results import Phase, Status
from seisblock.criteria.initiation import Mode
from seisblock.dynamics import EventLog
from seisblock.models.respond import constants
from seisblock.models.respond.names import outcome_name
from seisblock.models.respond.params import RespondParams
from seisblock.models.respond.run import Run, is_rest


class ModeChange(TypedDict):
    """Start of a mode: time from the record's first sample, corner ``left``, ``right`` or None, slip direction ``+``, ``-`` or None."""

    time_s: float
    mode: str
    corner: str | None
    slip: str | None


class TimeInMode(TypedDict):
    """Total time in each mode, s."""

    rest: float
    slide: float
    rock: float
    slide_rock: float
    flight: float


@dataclass(frozen=True, repr=False)
class RespondOutcome(DisplayMixin):
    """Result of a full-response run.

    Times are in s from the record's first sample; displacements are those of the centre of gravity relative to the ground.

    Parameters
    ----------
    outcome : str
        ``rests``, ``slides``, ``rocks``, ``flies`` or a combination, ``overturns``, ``still moving`` (after `settle_s`) or
        ``still bouncing`` (impact limit exceeded).
    overturned : bool
    overturned_towards : str or None
        ``+x`` or ``-x``.
    overturning_time_s : float or None
        Time of a tilt of pi/2, or of contact of a further point with the ground.
    max_rotation_rad, max_rotation_ratio : float
        Peak tilt, and its ratio to the overturning angle alpha of the corner concerned.
    final_displacement_m : float
        Residual displacement along +x, signed, at rest, at overturning, or at the time limit; measured from x = 0.
    max_displacement_m : float
        Maximum absolute displacement.
    slip_path_m : float
        Length of the slip path of the base or a corner.
    flights, impacts : int
        Number of flights, and of impacts of a corner or the base.
    time_in_mode_s : dict
        Total time in each mode.
    energy_friction_j, energy_impacts_j, energy_ground_j : float
        Energy dissipated by friction and by impacts, and work of the ground motion.
    sensitive : bool or None
        True if a change of the input by up to 2e-6 changes overturning or its side; None: not tested. See also `predictable_until_s` of
        the assessment.
    events : list of dict
        Mode changes; the first entry is the initial mode.
    settled : bool
        True if the body is at rest at the end.
    end_s : float
        End of the motion, or time at which the run was abandoned.
    jams : int
        Slips that ended in a jam above Painleve's limit.
    ratios_lowered : int
        Rocking impacts whose prescribed ratio was reduced because it would create energy.
    tenon_left_s : float or None
        Time at which the feet left their tenons in flight.
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


@cache
def _description(mode: int) -> tuple[str, str | None, str | None]:
    """Return mode, corner and slip direction of a mode of the model."""
    # with the feet in their tenons the codes are shifted; a terminal mode counts as rest
    kind = mode % constants.TENON_OFFSET if mode >= 0 else constants.REST
    is_rotating = (
        kind in (constants.ROCK_RIGHT, constants.ROCK_LEFT) or constants.SLIDE_ROCK_RIGHT_PLUS <= kind <= constants.SLIDE_ROCK_LEFT_MINUS
    )
    is_sliding = constants.SLIDE_PLUS <= kind <= constants.SLIDE_ROCK_LEFT_MINUS
    corner = ("right" if kind % 2 == 1 else "left") if is_rotating else None
    return constants.MODES[mode], corner, ("+" if kind in constants.SLIP_FORWARD else "-") if is_sliding else None


def mode_changes(run: Run, start_s: float) -> list[ModeChange]:
    """Return the mode changes; an impact without a change of mode, corner or slip direction is none."""
    result: list[ModeChange] = []
    previous: tuple[str, str | None, str | None] | None = None
    for time, target in zip(run.events.time.tolist(), run.events.target.tolist(), strict=True):
        # an abandoned run has no further mode of the body
        if target == constants.GAVE_UP:
            continue
        current = _description(target)
        if current != previous:
            mode, corner, slip = previous = current
            result.append({"time_s": start_s + time, "mode": mode, "corner": corner, "slip": slip})
    return result


def phases(events: list[ModeChange], end_s: float) -> tuple[Phase, ...]:
    """Return the phases of one mode each; changes of corner or slip direction do not split a phase."""
    merged: list[ModeChange] = []
    for event in events:
        # overturning ends the last phase and has no duration
        if event["mode"] != Mode.OVERTURNED and not (merged and merged[-1]["mode"] == event["mode"]):
            merged.append(event)
    ends = [event["time_s"] for event in merged[1:]] + [end_s]
    return tuple(Phase(event["mode"], event["time_s"], end) for event, end in zip(merged, ends, strict=True))


def time_in_mode(intervals: Iterable[Phase]) -> TimeInMode:
    """Return the total time in each mode."""
    total: TimeInMode = {"rest": 0.0, "slide": 0.0, "rock": 0.0, "slide_rock": 0.0, "flight": 0.0}
    for phase in intervals:
        total[phase.name.replace("-", "_")] += phase.duration_s  # type: ignore[literal-required]
    return total


def max_lean_ratio(params: RespondParams, highest: float, lowest: float) -> float:
    """Return the larger tilt over alpha of its corner, from the largest tilt to +x and the (negative) largest tilt to -x, rad."""
    right, left = params.rigid_body.slendernesses
    return max(highest / right, -lowest / left)


class RunEnd(NamedTuple):
    """Numbers of a run.

    Parameters
    ----------
    mode : int
        Mode at the end.
    final : (n_states,) sequence
        State at the end.
    time : float, s
        End after the first sample.
    rotations, displacements : (float, float), rad and m
        Largest and smallest tilt, and displacement of the centre of gravity.
    flights : int
    modes : collection of str
        Modes passed through.
    """

    mode: int
    final: Sequence[float]
    time: float
    rotations: tuple[float, float]
    displacements: tuple[float, float]
    flights: int
    modes: Collection[str]

    @property
    def verdict(self) -> tuple[bool, bool]:
        """Overturned, and overturned to +x."""
        overturned = self.mode == constants.OVERTURNED
        return overturned, overturned and self.final[constants.THETA] > 0.0

    @property
    def peaks(self) -> tuple[float, float, float]:
        """Peak tilt, rad, and displacement, and final displacement, m."""
        return max(self.rotations[0], -self.rotations[1]), max(self.displacements[0], -self.displacements[1]), self.final[constants.X]


def run_end(run: Run, modes: Collection[str]) -> RunEnd:
    """Return the numbers of a single run that passed through `modes`."""
    rotations, displacements = run.extrema(constants.THETA), run.extrema(constants.X)
    return RunEnd(run.mode, run.final.tolist(), run.end_s, rotations, displacements, _count_flights(run.events), modes)


PERTURBATIONS = (-2e-6, 2e-6, -1e-6, 1e-6)
"""Relative changes of the input for the sensitivity test."""

MAX_GROWTH = 50.0
"""Growth of the first two changes up to which the other two, between them, are not tried: of 3600 runs 76 changed their verdict, with a
growth of at least 280."""


def has_grown(end: RunEnd, changed: RunEnd) -> bool:
    """Return whether a change of the input has grown beyond MAX_GROWTH in the peaks of tilt and displacement."""
    tilt, displacement, final = end.peaks
    changed_tilt, changed_displacement, changed_final = changed.peaks
    share = MAX_GROWTH * abs(PERTURBATIONS[0])
    largest_change = max(abs(changed_displacement - displacement), abs(changed_final - final))
    return abs(changed_tilt - tilt) > share * tilt or largest_change > share * displacement


def are_sensitive(ends: Sequence[RunEnd], repeat: Callable[[list[int], float], Iterable[RunEnd]]) -> list[bool]:
    """Return which verdicts a change of the motion by up to 2e-6 changes; `repeat` solves runs, by number, with a change."""
    # chaotic runs change their verdict under changes far below the accuracy of any record
    sensitive, rows, grown = [False] * len(ends), list(range(len(ends))), set[int]()
    for k, change in enumerate(PERTURBATIONS):
        # the smaller changes only where one of the larger ones has grown
        rows = [row for row in rows if not sensitive[row] and (k < 2 or row in grown)]
        if not rows:
            break
        for row, changed in zip(rows, repeat(rows, change), strict=True):
            sensitive[row] = changed.verdict != ends[row].verdict
            if has_grown(ends[row], changed):
                grown.add(row)
    return sensitive


def scalar_results(end: RunEnd, params: RespondParams, start_s: float, sensitive: bool | None) -> dict[str, Any]:
    """Return the fields of an outcome that need no history, of a run that starts at `start_s`."""
    final, mass, overturned = end.final, params.rigid_body.mass, end.mode == constants.OVERTURNED
    max_tilt, max_displacement, final_displacement = end.peaks
    end_s = start_s + end.time
    return {
        "outcome": outcome_name(end.mode, end.modes),
        "overturned": overturned,
        "overturned_towards": ("+x" if final[constants.THETA] > 0.0 else "-x") if overturned else None,
        "overturning_time_s": end_s if overturned else None,
        "max_rotation_rad": max_tilt,
        "max_rotation_ratio": max_lean_ratio(params, *end.rotations),
        "final_displacement_m": final_displacement,
        "max_displacement_m": max_displacement,
        "slip_path_m": final[constants.PATH],
        "flights": end.flights,
        "impacts": int(final[constants.IMPACTS]),
        # the state holds energies per unit mass
        "energy_friction_j": mass * final[constants.FRICTION],
        "energy_impacts_j": mass * final[constants.LOSS],
        "energy_ground_j": mass * final[constants.WORK],
        "sensitive": sensitive,
        "settled": is_rest(end.mode),
        "end_s": end_s,
        "jams": int(final[constants.JAMS]),
        "ratios_lowered": int(final[constants.RATIO_LOWERED]),
    }


def build_outcome(run: Run, params: RespondParams, start_s: float, repeat: Callable[[float], RunEnd] | None) -> RespondOutcome:
    """Return the outcome of a run that starts at `start_s`; `repeat` solves it with a change for the sensitivity test."""
    events = mode_changes(run, start_s)
    end = run_end(run, {event["mode"] for event in events})
    sensitive = None if repeat is None else are_sensitive([end], lambda _, change: [repeat(change)])[0]
    release_times = run.events.time[(run.events.guard == constants.RELEASE) & (run.events.target == constants.FLIGHT)]
    return RespondOutcome(
        **scalar_results(end, params, start_s, sensitive),
        time_in_mode_s=time_in_mode(phases(events, start_s + end.time)),
        events=events,
        tenon_left_s=float(start_s + release_times[0]) if release_times.size else None,
    )


def _count_flights(changes: EventLog) -> int:
    """Return the number of events that start a flight, rebounds included."""
    is_flight = np.array(constants.MODES) == "flight"
    # a rebound leads from flight to flight through an impact
    is_rebound = changes.after[:, constants.IMPACTS] > changes.before[:, constants.IMPACTS]
    return int(np.count_nonzero(is_flight[changes.target] & (~is_flight[changes.source] | is_rebound)))


def run_status(run: Run) -> Status:
    """Return the status of a run."""
    if run.mode == constants.GAVE_UP:
        return Status.TOO_MANY_EVENTS
    return Status.STOPPED if run.mode == constants.OVERTURNED or run.ends_at_rest else Status.RECORD_ENDED


def final_mode(run: Run) -> int:
    """Return the last mode of motion or rest, never a terminal one."""
    if run.mode >= 0:
        return run.mode
    if run.mode == constants.SETTLED:
        return constants.REST
    return run.last.events[-1].source


def motion_modes(run: Run, modes: np.ndarray) -> np.ndarray:
    """Return `modes`, (n,), with terminal modes replaced by the mode that they ended."""
    return np.where(modes < 0, final_mode(run), modes)

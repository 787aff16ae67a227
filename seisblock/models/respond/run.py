"""Single full-response run: record, then ground at rest until the body rests, overturns or the time limit is reached."""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass, replace

import numpy as np

from seisblock.core.errors import ParameterError, SolverError
from seisblock.core.typing import BoolArray, FloatArray, IntArray
from seisblock.dynamics import EventLog, Trajectory, integrate
from seisblock.models.respond import constants
from seisblock.models.respond.params import Initial, RespondParams
from seisblock.records import Motion

REST_GROUND_DT = 0.01
"""Longest sampling interval of the ground at rest after the record, s; it limits the step only."""

MAX_SETTLING = 3600.0
"""Longest simulated time after the record, s."""


def check_settling(settle_s: float) -> None:
    """Raise ParameterError unless `settle_s` lies between 0 and ``MAX_SETTLING``."""
    if not 0.0 <= settle_s <= MAX_SETTLING:
        raise ParameterError(
            "the settling time after the record must lie between 0 and {limit:g} s, found {found:g} s",
            limit=MAX_SETTLING,
            found=settle_s,
        )


@functools.lru_cache(maxsize=4)
def zero_motion(settle_s: float) -> Motion:
    """Return a motion with zero acceleration of `settle_s` seconds."""
    samples = max(math.ceil(settle_s / REST_GROUND_DT - 1e-9), 1)
    return Motion(np.zeros((3, samples + 1)), settle_s / samples, name="still")


@dataclass(frozen=True, eq=False)
class Run:
    """Trajectories of a run.

    Parameters
    ----------
    record_part : Trajectory
        Response during the record.
    free_part : Trajectory or None
        Response on ground at rest after the record; None if the motion had ended.
    duration_s : float
        Duration of the record.
    """

    record_part: Trajectory
    free_part: Trajectory | None
    duration_s: float

    @property
    def last(self) -> Trajectory:
        """Last trajectory of the run."""
        return self.free_part or self.record_part

    @property
    def final(self) -> FloatArray:
        """State at the end."""
        return self.last.final

    @property
    def mode(self) -> int:
        """Mode at the end."""
        return self.last.final_mode

    @property
    def end_s(self) -> float:
        """End of the run, s after the first sample."""
        return self.record_part.end_time if self.free_part is None else self.duration_s + self.free_part.end_time

    @property
    def ends_at_rest(self) -> bool:
        """True if the run ends at rest."""
        return is_rest(self.mode)

    def extrema(self, state: int) -> tuple[float, float]:
        """Return maximum and minimum of a tracked state."""
        tables = [part.extrema[state] for part in (self.record_part, self.free_part) if part is not None]
        return max(float(table[0]) for table in tables), min(float(table[2]) for table in tables)

    @functools.cached_property
    def events(self) -> EventLog:
        """All events; times in s after the first sample."""
        return (
            self.record_part.events
            if self.free_part is None
            else self.record_part.events + self.free_part.events.shift_time(0, self.duration_s)
        )

    def table(self) -> tuple[FloatArray, FloatArray, IntArray]:
        """Return times (s after the first sample), states and modes at samples and at both limits of every event."""
        time, states, modes = self.record_part.table()
        if self.free_part is None:
            return time, states, modes
        free_time, free_states, free_modes = self.free_part.table()
        return np.append(time, self.duration_s + free_time), np.concatenate([states, free_states]), np.append(modes, free_modes)

    def interpolate(self, values: FloatArray) -> FloatArray:
        """Return a sampled input at the times of :meth:`table`, zero after the record."""
        record_values = self.record_part.interpolate(values)
        if self.free_part is None:
            return record_values
        return np.append(record_values, np.zeros(self.free_part.table()[0].size))


def run(
    params: RespondParams, motion: Motion, gains: tuple[float, float, float], initial: Initial, settle_s: float, *, keep_path: bool = True
) -> Run:
    """Solve one run through a motion and up to rest; without `keep_path` samples and events are discarded."""
    duration = (motion.samples - 1) * motion.dt
    record_part = _integrate(
        params, motion, params.state(initial), params.first_mode, gains, duration_s=duration, ground_at_rest=False, keep_path=keep_path
    )
    # at rest nothing can start a motion once the ground is still
    if not is_moving(record_part.final_mode) or settle_s == 0.0:
        return Run(record_part, None, duration)
    ground = zero_motion(settle_s)
    free_part = _integrate(
        params,
        ground,
        record_part.final,
        record_part.final_mode,
        (1.0, 0.0, 1.0),
        duration_s=duration + settle_s,
        ground_at_rest=True,
        keep_path=keep_path,
    )
    return Run(record_part, free_part, duration)


def _integrate(
    params: RespondParams,
    motion: Motion,
    initial: FloatArray,
    mode: int,
    gains: tuple[float, float, float],
    *,
    duration_s: float,
    ground_at_rest: bool,
    keep_path: bool,
) -> Trajectory:
    """Integrate one part of a run; repeat it with bodies set flat where its impacts do not end."""

    def attempt(params: RespondParams) -> Trajectory:
        p = params.parameters(motion.dt, duration_s=duration_s, ground_at_rest=ground_at_rest)
        return integrate(params.model, motion, p, initial, mode, gains=gains, keep_path=keep_path, keep_events=keep_path)

    try:
        return attempt(params)
    except SolverError:
        pass
    try:
        return attempt(replace(params, sets_flat=True))
    except SolverError as error:
        # rebounds of lively slender bodies follow each other too fast
        if params.restitution == 0.0:
            raise
        raise SolverError("{reason}; use a smaller `restitution`", reason=error.message) from error


def are_rest(modes: IntArray) -> BoolArray:
    """Return which final modes are rest."""
    return (modes == constants.SETTLED) | ((modes >= 0) & (modes % constants.TENON_OFFSET == constants.REST))


def is_rest(mode: int) -> bool:
    """Return whether a final mode is rest."""
    return bool(are_rest(np.array(mode)))


def is_moving(mode: int) -> bool:
    """Return whether a body in this mode at the end of the record is still in motion."""
    return mode >= 0 and not is_rest(mode)

"""One run: through the record, and on over still ground until the body rests, has fallen, or time is up."""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass

import numpy as np

from seisblock.core.errors import ParameterError
from seisblock.core.typing import FloatArray, IntArray
from seisblock.dynamics import EventLog, Instant, Trajectory, integrate
from seisblock.models.respond import constants
from seisblock.models.respond.params import Initial, RespondParams
from seisblock.records import Motion

REST_GROUND_DT = 0.01
"""Longest sampling interval of the still ground after the record, s: only the longest step depends on it."""

MAX_SETTLING = 3600.0
"""Longest time after the record that is followed, s."""


def check_settling(settle_s: float) -> None:
    """Refuse a time to settle that is negative, endless or no number."""
    if not 0.0 <= settle_s <= MAX_SETTLING:
        raise ParameterError(
            "the time to settle after the record must lie between 0 and {most:g} s, found {found:g} s",
            most=MAX_SETTLING,
            found=settle_s,
        )


@functools.lru_cache(maxsize=4)
def zero_motion(settle_s: float) -> Motion:
    """Return ground that does not move for `settle_s` seconds, as a motion."""
    samples = max(math.ceil(settle_s / REST_GROUND_DT - 1e-9), 1)
    return Motion(np.zeros((3, samples + 1)), settle_s / samples, name="still")


@dataclass(frozen=True, eq=False)
class Run:
    """What was followed.

    Parameters
    ----------
    record_part : Trajectory
        Through the record.
    after : Trajectory or None
        On still ground, when there was something left to happen.
    duration_s : float
        Length of the record.
    """

    record_part: Trajectory
    after: Trajectory | None
    duration_s: float

    @property
    def last(self) -> Trajectory:
        """The trajectory in which the run ends."""
        return self.after or self.record_part

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
        """When the run ends, s after the first sample."""
        return self.record_part.end_time if self.after is None else self.duration_s + self.after.end_time

    @property
    def ends_at_rest(self) -> bool:
        """Whether it ends at rest."""
        return self.mode == constants.SETTLED or (self.mode >= 0 and self.mode % constants.TENON_OFFSET == constants.REST)

    def extrema(self, state: int) -> tuple[float, float]:
        """Return the highest and the lowest value of a tracked state."""
        tables = [part.extrema[state] for part in (self.record_part, self.after) if part is not None]
        return max(float(table[0]) for table in tables), min(float(table[2]) for table in tables)

    @functools.cached_property
    def events(self) -> EventLog:
        """Every event; times in s after the first sample."""
        return self.record_part.events if self.after is None else self.record_part.events + self.after.events.shift_time(0, self.duration_s)

    def table(self) -> tuple[FloatArray, FloatArray, IntArray]:
        """Return times, s after the first sample, states and modes, at samples and both limits of every event."""
        time, states, modes = self.record_part.table()
        if self.after is None:
            return time, states, modes
        free_time, free_states, free_modes = self.after.table()
        return np.append(time, self.duration_s + free_time), np.concatenate([states, free_states]), np.append(modes, free_modes)

    def interpolate(self, values: FloatArray) -> FloatArray:
        """Return a sampled input at the times of :meth:`table`, zero after the record."""
        record_values = self.record_part.interpolate(values)
        if self.after is None:
            return record_values
        return np.append(record_values, np.zeros(self.after.table()[0].size))


def run(
    params: RespondParams, motion: Motion, gains: tuple[float, float, float], initial: Initial, settle_s: float, *, keep_path: bool = True
) -> Run:
    """Follow a body through a motion and to its rest.

    `keep_path` says whether samples and events are wanted, or the end alone.
    """
    duration = (motion.samples - 1) * motion.dt
    record_part = integrate(
        params.model,
        motion,
        params.parameters(motion.dt, duration_s=duration),
        params.state(initial),
        params.first_mode,
        gains=gains,
        start=Instant(),
        keep_path=keep_path,
        keep_events=keep_path,
    )
    if not is_moving(record_part.final_mode) or settle_s == 0.0:
        return Run(record_part, None, duration)
    ground = zero_motion(settle_s)
    free_part = integrate(
        params.model,
        ground,
        params.parameters(ground.dt, duration_s=duration + settle_s, ground_at_rest=True),
        record_part.final,
        record_part.final_mode,
        gains=(1.0, 0.0, 1.0),
        keep_path=keep_path,
        keep_events=keep_path,
    )
    return Run(record_part, free_part, duration)


def is_moving(mode: int) -> bool:
    """Whether a body that the record leaves in this mode has not come to its end."""
    return mode >= 0 and mode % constants.TENON_OFFSET != constants.REST

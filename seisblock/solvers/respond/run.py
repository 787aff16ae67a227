"""One run: through the record, and on over still ground until the body rests, has fallen, or time is up."""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass

import numpy as np

from seisblock.dynamics import Changes, Instant, Trajectory, follow
from seisblock.errors import ParameterError
from seisblock.records import Motion
from seisblock.solvers.respond import names
from seisblock.solvers.respond.setting import Initial, Setting
from seisblock.typing import FloatArray, IntArray

STILL_DT = 0.01
"""Longest sampling interval of the still ground after the record, s: only the longest step depends on it."""

LONGEST_SETTLING = 3600.0
"""Longest time after the record that is followed, s."""


def check_settling(settle_s: float) -> None:
    """Refuse a time to settle that is negative, endless or no number."""
    if not 0.0 <= settle_s <= LONGEST_SETTLING:
        raise ParameterError(
            "the time to settle after the record must lie between 0 and {most:g} s, found {found:g} s",
            most=LONGEST_SETTLING,
            found=settle_s,
        )


@functools.lru_cache(maxsize=4)
def still_ground(settle_s: float) -> Motion:
    """Return ground that does not move for `settle_s` seconds, as a motion."""
    samples = max(math.ceil(settle_s / STILL_DT - 1e-9), 1)
    return Motion(np.zeros((3, samples + 1)), settle_s / samples, name="still")


@dataclass(frozen=True, eq=False)
class Run:
    """What was followed.

    Parameters
    ----------
    shaken : Trajectory
        Through the record.
    after : Trajectory or None
        On still ground, when there was something left to happen.
    duration_s : float
        Length of the record.
    """

    shaken: Trajectory
    after: Trajectory | None
    duration_s: float

    @property
    def last(self) -> Trajectory:
        """The trajectory in which the run ends."""
        return self.after or self.shaken

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
        return self.shaken.end_time if self.after is None else self.duration_s + self.after.end_time

    @property
    def settles(self) -> bool:
        """Whether it ends at rest."""
        return self.mode == names.SETTLED or (self.mode >= 0 and self.mode % names.HELD == names.REST)

    def extrema(self, state: int) -> tuple[float, float]:
        """Return the highest and the lowest value of a tracked state."""
        tables = [part.extrema[state] for part in (self.shaken, self.after) if part is not None]
        return max(float(table[0]) for table in tables), min(float(table[2]) for table in tables)

    @functools.cached_property
    def changes(self) -> Changes:
        """Every event; times in s after the first sample."""
        return self.shaken.changes if self.after is None else self.shaken.changes + self.after.changes.later(0, self.duration_s)

    def table(self) -> tuple[FloatArray, FloatArray, IntArray]:
        """Return times, s after the first sample, states and modes, at samples and both limits of every event."""
        time, states, modes = self.shaken.table()
        if self.after is None:
            return time, states, modes
        later, further, kinds = self.after.table()
        return np.append(time, self.duration_s + later), np.concatenate([states, further]), np.append(modes, kinds)

    def sampled(self, values: FloatArray) -> FloatArray:
        """Return a sampled input at the times of :meth:`table`, zero after the record."""
        during = self.shaken.sampled(values)
        if self.after is None:
            return during
        return np.append(during, np.zeros(self.after.table()[0].size))


def run(
    setting: Setting, motion: Motion, gains: tuple[float, float, float], initial: Initial, settle_s: float, *, keep: bool = True
) -> Run:
    """Follow a body through a motion and to its rest.

    `keep` says whether samples and events are wanted, or the end alone.
    """
    duration = (motion.samples - 1) * motion.dt
    shaken = follow(
        setting.model,
        motion,
        setting.parameters(motion.dt, duration_s=duration),
        setting.state(initial),
        setting.first_mode,
        gains=gains,
        start=Instant(),
        keep_path=keep,
        keep_events=keep,
    )
    if not moves_on(shaken.final_mode) or settle_s == 0.0:
        return Run(shaken, None, duration)
    ground = still_ground(settle_s)
    after = follow(
        setting.model,
        ground,
        setting.parameters(ground.dt, duration_s=duration + settle_s, still=True),
        shaken.final,
        shaken.final_mode,
        gains=(1.0, 0.0, 1.0),
        keep_path=keep,
        keep_events=keep,
    )
    return Run(shaken, after, duration)


def moves_on(mode: int) -> bool:
    """Whether a body that the record leaves in this mode has not come to its end."""
    return mode >= 0 and mode % names.HELD != names.REST

"""Integration of a pile through a motion, in interruptible slices; repeated for the time histories of a long motion."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from time import perf_counter

import numpy as np

from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_
from seisblock.core.limits import check_memory
from seisblock.core.results import Status
from seisblock.core.typing import FloatArray
from seisblock.dynamics.cancellation import check_cancelled, count_samples
from seisblock.models.stack.arrays import PileArrays
from seisblock.models.stack.buffers import (
    FIRST_SAMPLE,
    N_COUNTERS,
    ROW_COUNT,
    SAMPLE,
    STEPS_REMAINING,
    PileMemory,
    PileOutput,
    PileSettings,
    PileState,
)
from seisblock.models.stack.cylinder import RADIUS
from seisblock.models.stack.frames import Q, X, update_rotation_matrix
from seisblock.models.stack.outcome import SimulationResult, Track, stone_track
from seisblock.models.stack.recorder import FALL_COLUMNS, FALL_TIME, HEIGHT_LIMIT, LEDGER_COLUMNS, MIN_COSINE, TILT_LIMIT
from seisblock.models.stack.rigid_run import run_rigid
from seisblock.models.stack.spring_run import run_springs
from seisblock.models.stack.static_equilibrium import settle_on_springs
from seisblock.records.motion import ACROSS, UP, Motion

FALL_TILT = math.radians(60.0)
"""A stone that tilts more than this, rad, and more than its overturning angle, has fallen."""

FALL_DROP_RATIO = 0.5
"""Drop of a stone's centre over its smallest size from which it has fallen."""

SETTLING_TIME = 10.0
"""Longest time, s, with the ground at rest after the record, until every stone is still."""

ROW_TOLERANCE = 1e-5
MAX_ROW_INTERVAL = 0.1
"""Movement, m and rad, and time, s, after which a row is stored."""

END_ROWS = 2
"""Rows stored of a long motion: the first and the last."""

CURVE_COLUMNS = 17
"""Numbers per stone in a row of the time histories and of their intermediate arrays."""

FIRST_SLICE_STEPS, SLICE_TIME = 100, 0.1
"""Steps of the first slice of compiled code, and duration, s, of the later ones; Python may be interrupted between slices."""


@dataclass(frozen=True, eq=False)
class Simulation:
    """Parameters of an integration.

    Parameters
    ----------
    pile : PileArrays
    motion : Motion
    factors : (float, float)
        On the transverse and on the vertical component.
    gravity : float, m/s^2
    steps : int
        Per sampling interval.
    rigid : bool
        Whether contacts are rigid or springs.
    stop_at_fall : bool
    tilts : mapping of str to float, rad
        Stones released from a tilt about y.
    """

    pile: PileArrays
    motion: Motion
    factors: tuple[float, float]
    gravity: float
    steps: int
    rigid: bool
    stop_at_fall: bool
    tilts: Mapping[str, float]

    @property
    def settings(self) -> PileSettings:
        """Settings of the compiled loop."""
        motion, settling_samples = self.motion, math.ceil(SETTLING_TIME / self.motion.dt)
        row_interval, last_sample = max(1, round(MAX_ROW_INTERVAL / motion.dt)), motion.samples - 1
        return PileSettings(
            self.gravity, motion.dt, self.steps, self.stop_at_fall, ROW_TOLERANCE, row_interval, last_sample, last_sample + settling_samples
        )

    def run(self, rows: int | None = None, *, progress: Callable[[int, int], None] | None = None) -> SimulationResult:
        """Integrate the pile to the end.

        Parameters
        ----------
        rows : int or None
            Rows to store; None: all of a short motion, the first and the last of a long one.
        progress : callable
            Called with the number of samples done and the total.

        Raises
        ------
        ParameterError
            If a tilted stone does not exist or is fixed.
        """
        pile, settings = self.pile, self.settings
        if rows is None:
            # time histories of long motions are computed again on access, which costs time instead of memory
            rows = END_ROWS if self.motion.is_long else settings.last + 1
        memory = pile.memory()
        state = PileState(np.zeros(N_COUNTERS, dtype=np.int64), pile.bodies.copy())
        # springs must carry the weight at the start; otherwise the release would shake the pile
        if not self.rigid:
            settle_on_springs(pile, self.gravity, state.bodies, memory.stretches)
        output = PileOutput(
            fall_states=_initial_fall_states(pile, state.bodies),
            rows=np.zeros((rows, 1 + 7 * len(pile.members))),
            last_contact=np.full((len(state.bodies), len(state.bodies)), -1.0),
            energy_ledger=np.zeros(LEDGER_COLUMNS),
        )
        for name, angle in self.tilts.items():
            _tilt_body(pile, state.bodies, name, angle)
        status = self._integrate(settings, memory, state, output, progress)
        row_count = int(state.counters[ROW_COUNT])
        path = output.rows[: min(row_count, rows)].copy()
        time = float(state.counters[SAMPLE]) * self.motion.dt
        return SimulationResult(status, time, state.bodies, output._replace(rows=path), row_count, stone_track(pile, path))

    def full_track(self, end: SimulationResult) -> Track:
        """Return the positions of the stones as stored, or integrate again, with bit-identical results.

        Raises
        ------
        ParameterError
            If the time histories exceed the memory limit.
        """
        if end.rows <= len(end.track.time):
            return end.track
        check_memory(N_("samples of time histories"), end.rows, 8 * CURVE_COLUMNS * len(self.pile.body.stones))
        return self.run(end.rows).track

    def _motion_chunks(self) -> Iterator[tuple[int, FloatArray]]:
        """Yield chunks of the motion with the index of their first sample; the ground is at rest after the last sample."""
        zero_motion = np.zeros((3, self.settings.last + 1 - self.motion.samples))
        for chunk in self.motion.segments((True, *(factor != 0.0 for factor in self.factors))):
            # the ground at rest after the record belongs to the last chunk
            shaking = np.array(chunk.acceleration) if chunk.samples_after else np.concatenate([chunk.acceleration, zero_motion], axis=1)
            shaking[[ACROSS, UP]] *= np.array(self.factors)[:, None]
            shaking.flags.writeable = False
            yield chunk.first, shaking

    def _integrate(
        self,
        settings: PileSettings,
        memory: PileMemory,
        state: PileState,
        output: PileOutput,
        progress: Callable[[int, int], None] | None,
    ) -> Status:
        """Integrate to the end, in slices between which Python may be interrupted."""
        layout = self.pile.layout
        status, run, steps = Status.PAUSED, run_rigid if self.rigid else run_springs, FIRST_SLICE_STEPS
        for first, shaking in self._motion_chunks():
            state.counters[FIRST_SAMPLE] = first
            last = first + shaking.shape[1] - 1
            # the last chunk has no end of its own: the run stops when every stone is still
            while status == Status.PAUSED and (state.counters[SAMPLE] < last or last == settings.last):
                check_cancelled()
                state.counters[STEPS_REMAINING] = steps
                start = perf_counter()
                status = Status(run(shaking, settings, layout, memory, state, output))
                # a step of a pile that falls takes a hundred times as long as one of a pile that stands
                steps = max(1, min(2 * steps, int(steps * SLICE_TIME / (perf_counter() - start))))
                if progress is not None and status == Status.PAUSED:
                    progress(*count_samples(int(state.counters[SAMPLE]), settings.record_end, settings.last))
            if status != Status.PAUSED:
                break
        return status


def _initial_fall_states(pile: PileArrays, bodies: FloatArray) -> FloatArray:
    """Return the rows in which the kernel records the falls, with the fall criteria of each body."""
    fall_states = np.zeros((len(pile.members), FALL_COLUMNS))
    fall_states[:, MIN_COSINE] = 1.0
    fall_states[:, FALL_TIME] = -1.0
    for b, group in enumerate(pile.members):
        boxes = pile.boxes[list(group), :3]
        # height of the centre of gravity above its own base, and half the smaller side of that base
        foot, rise = boxes[0, :2].max(), bodies[b, X + 2] - (pile.boxes[group[0], 5] + bodies[b, X + 2] - boxes[0, 2])
        # slender bodies overturn below FALL_TILT, squat ones above: 0.1 rad beyond the overturning angle is past recovery
        fall_states[b, TILT_LIMIT] = math.cos(max(FALL_TILT, math.atan2(foot, rise) + 0.1))
        fall_states[b, HEIGHT_LIMIT] = bodies[b, X + 2] - FALL_DROP_RATIO * 2.0 * boxes.min()
    return fall_states


def _tilt_body(pile: PileArrays, bodies: FloatArray, name: str, angle: float) -> None:
    """Tilt a body about y, over the outermost point of its lower joint."""
    if name not in pile.body.names or pile.owner[pile.body.names.index(name)] == len(pile.members):
        raise ParameterError("no free stone named {name!r} in the pile; stones: {names}", name=name, names=list(pile.body.names))
    b = int(pile.owner[pile.body.names.index(name)])
    first = pile.members[b][0]
    box = pile.boxes[first]
    pivot_x = pile.rims[first, 0, RADIUS] if pile.body.stones[first].is_round else pile.corners[first, 1, 0]
    pivot = np.array([math.copysign(pivot_x, angle), 0.0, -box[2]]) + box[3:]
    # rotation about y: x' = c x + s z, z' = -s x + c z
    rotation = np.array([math.cos(angle), math.sin(angle)])
    rotated_pivot = np.array([rotation[0] * pivot[0] + rotation[1] * pivot[2], 0.0, -rotation[1] * pivot[0] + rotation[0] * pivot[2]])
    # the pivot stays in place
    bodies[b, X : X + 3] += pivot - rotated_pivot
    bodies[b, Q : Q + 4] = (math.cos(0.5 * angle), 0.0, math.sin(0.5 * angle), 0.0)
    update_rotation_matrix(bodies[b])

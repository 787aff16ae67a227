"""Integration of a model under a motion.

The path (state and mode at each sample) is stored for short motions only. Long motions are integrated in segments; their path, if
requested, is computed by a second integration, to the same bits.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TypeVar

import numpy as np

from seisblock.core.errors import SolverError
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.limits import check_memory
from seisblock.core.status import FAILURES, PAUSED, TOO_MANY_EVENTS
from seisblock.core.typing import ArrayLike, FloatArray, IntArray
from seisblock.dynamics import hybrid
from seisblock.dynamics.buffers import (
    MODE,
    N_EVENTS,
    N_FLUSHED,
    SAMPLE,
    SAMPLES_AFTER,
    SEGMENT_START,
    STEPS_LEFT,
    TAU,
    Forcing,
    Output,
    State,
)
from seisblock.dynamics.cancellation import check_cancelled, report_progress
from seisblock.dynamics.events import BEGINNING, EVENT_SAMPLE, EventLog, Instant, allocate_events, bytes_per_event, concatenate_events
from seisblock.dynamics.model import Model
from seisblock.dynamics.trajectory import Path, Trajectory
from seisblock.records.motion import Motion, MotionSegment

STEPS_PER_SLICE = 1 << 16
"""Steps per call of compiled code, 10 to 150 ms, after which Python can be interrupted; the overhead of a call is below 1e-3."""

_INITIAL_EVENT_CAPACITY = 1 << 12
_MAX_EVENT_CAPACITY = 1 << 18
"""Initial and maximum capacity of the event tables; half of it is available for a single sample interval."""

_MAX_EVENTS, _MAX_EVENTS_PER_SAMPLE = 1 << 24, 4
"""Maximum number of events, and for long motions of events per sample; beyond both the status is TOO_MANY_EVENTS."""

RowArray = TypeVar("RowArray", FloatArray, IntArray)

_NO_TRANSITION_COUNTS, _NO_DWELL_TIMES = np.empty((0, 0), dtype=np.int64), np.empty((0, 2))


def integrate(
    model: Model,
    motion: Motion,
    parameters: ArrayLike,
    initial: ArrayLike,
    mode: int,
    *,
    gains: Sequence[float] = (1.0, 0.0, 0.0),
    start: Instant = BEGINNING,
    keep_path: bool = True,
    keep_events: bool = True,
) -> Trajectory:
    """Integrate a model under a motion.

    Parameters
    ----------
    model : Model
    motion : Motion
        Acceleration, linear between samples.
    parameters : (n_parameters,) array
        In the model's order and units.
    initial : (n_states,) array
        State at `start`.
    mode : int
        Mode at `start`.
    gains : three floats
        Factors on the longitudinal, transverse and vertical acceleration; rows with a zero factor are not read.
    start : Instant
        Start of the integration.
    keep_path, keep_events : bool
        True to store states at samples, and events. A path that is not stored (never for long motions) is recomputed on access.

    Returns
    -------
    Trajectory

    Raises
    ------
    SolverError
        If the integration fails.
    """
    integration = _Integration(model, motion, np.array(parameters, dtype=np.float64), np.array(gains, dtype=np.float64))
    n_states = len(model.states)
    extrema = np.zeros((model.tracked, 4))
    stores_path = keep_path and not motion.is_long
    path, modes = (np.empty((motion.samples, n_states)), np.empty(motion.samples, dtype=np.int64)) if stores_path else _empty_path(n_states)
    capacity = _INITIAL_EVENT_CAPACITY if keep_events else 0
    while True:
        # a copy: the kernel advances the state in place, and a restart with larger tables needs the original
        state = initial_state(start, mode, np.array(initial, dtype=np.float64))
        output = Output(path, modes, *allocate_events(capacity, n_states), extrema, _NO_TRANSITION_COUNTS, _NO_DWELL_TIMES)
        status, logs = PAUSED, list[EventLog]()
        for segment in integration.segments(start.sample):
            status = integration.advance(segment, state, output, logs)
            if status != PAUSED:
                break
        # the tables overflowed within one sample interval: start again with larger ones
        if not (status == TOO_MANY_EVENTS and state.counters[N_EVENTS] - state.counters[N_FLUSHED] == capacity < _MAX_EVENT_CAPACITY):
            break
        capacity *= 8
    n_events, final_mode = int(state.counters[N_EVENTS]), int(state.counters[MODE])
    end = Instant(int(state.counters[SAMPLE]), float(state.clock[TAU]))
    if status in FAILURES:
        time = motion.start_s + end.sample * motion.dt + end.tau
        raise SolverError(
            "{name}: integration stopped at {at:.6f} s: {failure}", name=model.name, at=time, failure=lazy_gettext(FAILURES[status])
        )
    if keep_events:
        check_memory(N_("mode changes"), n_events, bytes_per_event(n_states))
        logs.append(_flush_events(output, state, motion.dt))
    events = concatenate_events(logs) if logs else _empty_events(n_states)
    # a stored path is one piece; otherwise the pieces are recomputed on access
    if stores_path:
        samples = slice(_first_stored_sample(start), end.sample + 1)
        full_path = Path(motion.dt, samples.start, _trim(path, samples), _trim(modes, samples), events)
        iter_paths: Callable[[], Iterator[Path]] = partial(iter, (full_path,))
    else:
        iter_paths = partial(integration.iter_paths, start, mode, np.array(initial, dtype=np.float64), events)
    return Trajectory(model, motion.dt, status, events, n_events, extrema, end, state.state, final_mode, iter_paths)


def initial_state(start: Instant, mode: int, state: FloatArray) -> State:
    """Return the initial state of a trajectory; the array `state` is updated in place by the integration."""
    # the counters in the order of SAMPLE to N_FLUSHED
    return State(np.array([start.sample, mode, 0, 0, 1, 0, 0, 0, 0, 0]), np.array([start.tau, np.nan, 0.0]), state)


@dataclass(frozen=True, eq=False)
class _Integration:
    """Model, motion, parameters and gains of a trajectory."""

    model: Model
    motion: Motion
    p: FloatArray
    gains: FloatArray

    def segments(self, first_sample: int) -> Iterator[MotionSegment]:
        """Yield the segments of the motion from a sample on."""
        return self.motion.segments((self.gains != 0.0).tolist(), first_sample)

    def advance(self, segment: MotionSegment, state: State, output: Output, logs: list[EventLog]) -> int:
        """Advance a trajectory through a segment in interruptible slices; return the status.

        Events are moved from the output tables to `logs` whenever the tables are half full; the last ones stay in the tables.
        """
        forcing = Forcing(segment.acceleration, self.gains, self.motion.dt)
        scratch = hybrid.allocate_scratch(self.model.shape, state.state.size, segment.acceleration.shape[0])
        state.counters[SEGMENT_START], state.counters[SAMPLES_AFTER] = segment.first, segment.samples_after
        last = segment.first + segment.acceleration.shape[1] - 1
        status = PAUSED
        # a segment that is followed by another one ends at its last sample, which is the first of the next
        while status == PAUSED and (state.counters[SAMPLE] < last or not segment.samples_after):
            check_cancelled()
            state.counters[STEPS_LEFT] = STEPS_PER_SLICE
            status = hybrid.integrate_kernel(*self.model.pointers, forcing, self.model.shape, self.p, state, output, scratch)
            # paused because of half-full tables, not because of the steps
            if status == PAUSED and 2 * (state.counters[N_EVENTS] - state.counters[N_FLUSHED]) > output.times.size > 0:
                # the limit grows with the record: long ones may have more events
                if state.counters[N_EVENTS] > max(_MAX_EVENTS, _MAX_EVENTS_PER_SAMPLE * self.motion.samples):
                    return TOO_MANY_EVENTS
                check_memory(N_("mode changes"), int(state.counters[N_EVENTS]), bytes_per_event(state.state.size))
                logs.append(_flush_events(output, state, self.motion.dt))
                state.counters[N_FLUSHED] = state.counters[N_EVENTS]
            report_progress(int(state.counters[SAMPLE]), self.motion.samples - 1)
        return int(status)

    def iter_paths(self, start: Instant, mode: int, initial: FloatArray, events: EventLog) -> Iterator[Path]:
        """Yield the path piece by piece by a second integration, with the events of the first one."""
        state, first_sample, first_event = initial_state(start, mode, initial.copy()), _first_stored_sample(start), 0
        extrema = np.zeros((self.model.tracked, 4))
        for segment in self.segments(start.sample):
            size = segment.acceleration.shape[1]
            path, modes = np.empty((size, initial.size)), np.empty(size, dtype=np.int64)
            status = self.advance(
                segment, state, Output(path, modes, *allocate_events(0, initial.size), extrema, _NO_TRANSITION_COUNTS, _NO_DWELL_TIMES), []
            )
            last_sample = int(state.counters[SAMPLE])
            rows = slice(first_sample - segment.first, last_sample + 1 - segment.first)
            # events in the interval after last_sample belong to the next piece
            end_event = int(np.searchsorted(events.sample, last_sample)) if status == PAUSED else len(events)
            yield Path(self.motion.dt, first_sample, path[rows], modes[rows], events[first_event:end_event])
            first_sample, first_event = last_sample + 1, end_event
            if status != PAUSED:
                return


def _first_stored_sample(start: Instant) -> int:
    """Return the first sample at or after the start."""
    return start.sample if start.tau == 0.0 else start.sample + 1


def _empty_path(n_states: int) -> tuple[FloatArray, IntArray]:
    return np.empty((0, n_states)), np.empty(0, dtype=np.int64)


def _empty_events(n_states: int) -> EventLog:
    log, tau, limits = allocate_events(0, n_states)
    return EventLog(log, tau, tau, limits)


def _flush_events(output: Output, state: State, dt: float) -> EventLog:
    """Return a copy of the events in the output tables, which can then be reused."""
    count = int(state.counters[N_EVENTS] - state.counters[N_FLUSHED])
    log, tau = output.events[:count].copy(), output.times[:count].copy()
    return EventLog(log, tau, log[:, EVENT_SAMPLE] * dt + tau, output.limits[:count].copy())


def _trim(rows: RowArray, selection: slice) -> RowArray:
    """Return the selected rows; as a copy if they are less than half, so that the memory of the rest is released."""
    view = rows[selection]
    return view if 2 * len(view) > len(rows) else view.copy()

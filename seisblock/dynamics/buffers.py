"""Input, state and output of the integration loop as named tuples of arrays."""

from __future__ import annotations

from typing import NamedTuple

from seisblock._jit import types
from seisblock.core.typing import FloatArray, IntArray
from seisblock.dynamics.array_types import BLOCK, INTEGER_BLOCK, INTEGER_TABLE, INTEGERS, MATRIX, READ_ONLY_MATRIX, VECTOR

_t = types()


class Forcing(NamedTuple):
    """Ground motion of one trajectory.

    Parameters
    ----------
    acceleration : (rows, n) array, m/s^2
        Ground acceleration at the samples of the motion or of a segment of it, linear in between.
    gains : (rows,) array
        Factor on each row, so that a record is scaled without a copy; rows with a zero factor are not read.
    dt : float, s
    """

    acceleration: FloatArray
    gains: FloatArray
    dt: float


class Shape(NamedTuple):
    """Sizes of a model: scratch rows, guards, tracked states, order, exact guards."""

    scratch: int
    guards: int
    tracked: int
    order: int
    sharp: int


class State(NamedTuple):
    """Current state of a trajectory, updated in place by the loop, which continues from it at the next call.

    Parameters
    ----------
    counters : (10,) array of int
        See ``SAMPLE`` to ``N_FLUSHED``.
    clock : (3,) array, s
        ``TAU``: time after the current sample. ``FIRST_EVENT_TIME``: time of the first event after sample 0, NaN before it.
        ``MODE_START``: time of the last event or of the start.
    state : (n_states,) array
    """

    counters: IntArray
    clock: FloatArray
    state: FloatArray


SAMPLE, MODE, N_EVENTS, N_SIMULTANEOUS, AT_REST, HAS_STARTED, STEPS_LEFT, SEGMENT_START, SAMPLES_AFTER, N_FLUSHED = range(10)
"""Integer counters of a state: current sample; mode; number of events; events at the current instant; 1 if the state is constant; 1 if the
trajectory has started; steps left before the loop pauses; first sample of the current segment; number of samples after the segment;
events already moved out of the output tables."""

TAU, FIRST_EVENT_TIME, MODE_START = range(3)


class Output(NamedTuple):
    """Output of a trajectory; arrays without rows are not written.

    Parameters
    ----------
    path, modes : (n, n_states), (n,) arrays
        State and mode at each sample of the segment.
    events, times, limits : (m, 4), (m,), (m, 2, n_states) arrays
        Events, see :class:`~seisblock.dynamics.events.EventLog`: sample, guard, mode before and after; time after that sample, s; state
        before and after. The loop pauses when the tables are half full. Without rows, events are counted only, without a limit.
    extrema : (n_tracked, 4) array
        Maximum, its time, minimum, its time (s after sample 0) of the first states.
    transition_counts : (n_guards, n_modes) array of int
        Number of transitions by guard and next mode; negative modes index from the end.
    dwell_times : (n_modes, 2) array, s
        Time spent in each mode: total, and longest interval between two events (``TOTAL``, ``LONGEST``).
    """

    path: FloatArray
    modes: IntArray
    events: IntArray
    times: FloatArray
    limits: FloatArray
    extrema: FloatArray
    transition_counts: IntArray
    dwell_times: FloatArray


TOTAL, LONGEST = range(2)


class Scratch(NamedTuple):
    """Work arrays of one step: series of states and guards, ground motion (value, slope), and three polynomials."""

    c: FloatArray
    g: FloatArray
    f: FloatArray
    q: FloatArray
    d: FloatArray
    rate: FloatArray


class BatchForcing(NamedTuple):
    """Ground motion of many trajectories: acceleration (rows, n), m/s^2, gains (m, rows), sampling interval, s."""

    acceleration: FloatArray
    gains: FloatArray
    dt: float


class BatchState(NamedTuple):
    """State and output of many trajectories: the arrays of :class:`State` and :class:`Output` with a first axis of length m."""

    counters: IntArray
    clocks: FloatArray
    states: FloatArray
    extrema: FloatArray
    transition_counts: IntArray
    dwell_times: FloatArray
    statuses: IntArray


FORCING = _t.NamedTuple((READ_ONLY_MATRIX, VECTOR, _t.float64), Forcing)
SHAPE = _t.NamedUniTuple(_t.int64, 5, Shape)
STATE = _t.NamedTuple((INTEGERS, VECTOR, VECTOR), State)
OUTPUT = _t.NamedTuple((MATRIX, INTEGERS, INTEGER_TABLE, VECTOR, BLOCK, MATRIX, INTEGER_TABLE, MATRIX), Output)
SCRATCH = _t.NamedTuple((MATRIX, MATRIX, MATRIX, VECTOR, VECTOR, VECTOR), Scratch)
BATCH_FORCING = _t.NamedTuple((READ_ONLY_MATRIX, MATRIX, _t.float64), BatchForcing)
BATCH_STATE = _t.NamedTuple((INTEGER_TABLE, MATRIX, MATRIX, BLOCK, INTEGER_BLOCK, BLOCK, INTEGERS), BatchState)

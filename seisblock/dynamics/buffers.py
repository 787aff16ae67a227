"""What the engine's loop is given and what it leaves behind, as named tuples of arrays."""

from __future__ import annotations

from typing import NamedTuple

from seisblock._jit import types
from seisblock.core.typing import FloatArray, IntArray
from seisblock.dynamics.array_types import BLOCK, INTEGER_BLOCK, INTEGER_TABLE, INTEGERS, MATRIX, READ_ONLY_MATRIX, VECTOR

_t = types()


class Forcing(NamedTuple):
    """What shakes.

    Parameters
    ----------
    acceleration : (rows, n) array, m/s^2
        Ground acceleration at the samples of the motion, or of a stretch of it, linear between them.
    gains : (rows,) array
        Factor on each row, so that scaling a record copies nothing; a zero leaves the row unread.
    dt : float, s
    """

    acceleration: FloatArray
    gains: FloatArray
    dt: float


class Shape(NamedTuple):
    """How large a model is: rows of scratch, guards, tracked states, order, 1 where parameters end in floors, sharp guards."""

    scratch: int
    guards: int
    tracked: int
    order: int
    has_floors: int
    sharp: int


class State(NamedTuple):
    """Where a trajectory is; the loop moves it on, and goes on from it when it is called again.

    Parameters
    ----------
    counters : (10,) array of int
        See ``SAMPLE`` to ``LOGGED``.
    clock : (3,) array, s
        ``TAU``: time after the sample. ``FIRST_EVENT``: time of the first event after sample 0, NaN before it. ``SINCE``: that of the last
        event, or of the start.
    state : (n_states,) array
    """

    counters: IntArray
    clock: FloatArray
    state: FloatArray


SAMPLE, MODE, N_EVENTS, N_SIMULTANEOUS, AT_REST, HAS_STARTED, STEPS_LEFT, SEGMENT_START, SAMPLES_AFTER, N_FLUSHED = range(10)
"""A cursor's integers: sample, mode, events so far, events since time last moved, whether the state does not move, whether the
trajectory has begun, how many steps may be taken before the loop pauses; of the motion's samples, which one the ground given begins with,
and how many follow after it; how many events were taken out of the tables, which begin with the next."""

TAU, FIRST_EVENT_TIME, MODE_START = range(3)


class Output(NamedTuple):
    """What a trajectory leaves behind; what has no rows is not kept.

    Parameters
    ----------
    path, modes : (n, n_states), (n,) arrays
        State and mode at each sample reached, counted from the first of the stretch.
    events, times, limits : (m, 4), (m,), (m, 2, n_states) arrays
        The events, see :class:`~seisblock.dynamics.events.EventLog`: sample, guard, mode before and after; seconds after that sample; both
        limits of the state. The loop pauses when they are half full. With no rows events are counted, without a bound.
    extrema : (n_tracked, 4) array
        Highest value, its time, lowest value, its time (s after sample 0), of the first states.
    transition_counts : (n_guards, n_modes) array of int
        How often each guard led to each mode; negative modes are counted from the end.
    dwell_times : (n_modes, 2) array, s
        How long it was in each mode, in all and at the longest stretch between two events (``TOTAL``, ``LONGEST``).
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
    """Room for one step: series of states and guards, ground motion (value, slope), and three polynomials."""

    c: FloatArray
    g: FloatArray
    f: FloatArray
    q: FloatArray
    d: FloatArray
    rate: FloatArray


class BatchForcing(NamedTuple):
    """What shakes many: a motion or a stretch of it, (rows, n), m/s^2, with factors of each one's own, (m, rows), every dt seconds."""

    acceleration: FloatArray
    gains: FloatArray
    dt: float


class BatchState(NamedTuple):
    """Where each of many trajectories is, and what it leaves: first axis m; else as in a cursor, and in what is kept of a single one."""

    counters: IntArray
    clocks: FloatArray
    states: FloatArray
    extrema: FloatArray
    transition_counts: IntArray
    dwell_times: FloatArray
    statuses: IntArray


FORCING = _t.NamedTuple((READ_ONLY_MATRIX, VECTOR, _t.float64), Forcing)
SHAPE = _t.NamedUniTuple(_t.int64, 6, Shape)
STATE = _t.NamedTuple((INTEGERS, VECTOR, VECTOR), State)
OUTPUT = _t.NamedTuple((MATRIX, INTEGERS, INTEGER_TABLE, VECTOR, BLOCK, MATRIX, INTEGER_TABLE, MATRIX), Output)
SCRATCH = _t.NamedTuple((MATRIX, MATRIX, MATRIX, VECTOR, VECTOR, VECTOR), Scratch)
BATCH_FORCING = _t.NamedTuple((READ_ONLY_MATRIX, MATRIX, _t.float64), BatchForcing)
BATCH_STATE = _t.NamedTuple((INTEGER_TABLE, MATRIX, MATRIX, BLOCK, INTEGER_BLOCK, BLOCK, INTEGERS), BatchState)

"""Many runs at once: rows of settings and factors through one record and on to rest, with no Python between the samples."""

from __future__ import annotations

import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, fields
from threading import Event

import numpy as np

from seisblock import checks
from seisblock.dynamics import Ensemble, follow_many
from seisblock.dynamics.arguments import LONGEST, TOTAL
from seisblock.dynamics.halt import halting, heeding
from seisblock.errors import ParameterError, SolverError
from seisblock.records import Motion
from seisblock.records.given import check_motion
from seisblock.solvers.respond import names
from seisblock.solvers.respond.run import check_settling, still_ground
from seisblock.solvers.respond.setting import Initial, Setting
from seisblock.solvers.respond.settings import Settings
from seisblock.solvers.respond.tale import FLIGHT, REST, ROCK, SLIDE, SLIDE_ROCK
from seisblock.typing import ArrayLike, BoolArray, FloatArray, IntArray

AT_ONCE = 8
"""Rows that a thread takes at a time, at least: some fall at once, others hop for a minute."""

SAMPLES_AT_ONCE = 10_000
"""Samples times rows that a thread takes at a time, where the motion is short."""

KINDS = (REST, SLIDE, ROCK, SLIDE_ROCK, FLIGHT)
"""Modes as columns of :attr:`Fates.time_in_mode_s`."""


@dataclass(frozen=True, eq=False)
class Fates:
    """The ends of many runs, arrays with one entry per row, (m,) unless told.

    Parameters
    ----------
    overturned, settled, gave_up : bool
        A run that was given up, among its hops or where its motion could not be followed on, has no answer: its other entries are
        those of the instant at which that happened.
    towards : int
        +1 or -1 where it has fallen to +x or -x, else 0.
    final_displacement_m, max_displacement_m : m
        Of the centre of gravity from x = 0; the former signed.
    max_rotation_rad : rad
    slip_path_m : m
    impacts : int
    end_s : s
        After the motion's first sample.
    time_in_mode_s : (m, 5) array, s
        At rest, sliding, rocking, sliding while rocking, in flight, up to the end.
    longest_flight_s : s
        From one impact to the next.
    """

    overturned: BoolArray
    settled: BoolArray
    gave_up: BoolArray
    towards: IntArray
    final_displacement_m: FloatArray
    max_displacement_m: FloatArray
    max_rotation_rad: FloatArray
    slip_path_m: FloatArray
    impacts: IntArray
    end_s: FloatArray
    time_in_mode_s: FloatArray
    longest_flight_s: FloatArray

    def answered(self) -> Fates:
        """Return these fates, all of them answers.

        Raises
        ------
        SolverError
            If one was given up: whether it would fall is not known.
        """
        count = int(np.count_nonzero(self.gave_up))
        if count:
            raise no_answer(count, len(self.gave_up), int(self.impacts[self.gave_up].min()))
        return self


def no_answer(count: int, runs: int, impacts: int) -> SolverError:
    """Return the error of so many of some runs, which were given up after so many impacts at least."""
    return SolverError(
        "{count} of {runs} runs were given up after {impacts} impacts and have no answer: they hop without end; lower the restitution",
        count=count,
        runs=runs,
        impacts=impacts,
    )


def respond_many(
    settings: Sequence[Setting] | Settings,
    motion: Motion,
    *,
    gains: ArrayLike = (1.0, 0.0, 1.0),
    initial: Initial = None,
    settle_s: float = 60.0,
    workers: int | None = None,
) -> Fates:
    """Return the fates of many bodies, or of versions of one, under one motion; bit by bit those of single runs ([ShentonJones1991]_).

    Parameters
    ----------
    settings : Settings, or sequence of Setting
        One per row, all with as many further points, all with tenons or none.
    motion : Motion
    gains : (3,) or (m, 3) array
        Factors on the motion's rows along, across and up: (s cos, s sin, s_v) turns it by an angle and scales it.
    initial : six floats or None, m, rad, m/s, rad/s
        As in :func:`seisblock.solvers.respond.solve.solve_respond`, the same for all.
    settle_s : float, s
    workers : int or None
        Threads; None: one per core. The answer does not depend on it.

    Examples
    --------
    >>> import numpy as np
    >>> from seisblock.bodies.block import Block
    >>> from seisblock.solvers.respond.solve import make_setting
    >>> pulse = Motion.from_arrays(4.0 * np.sin(np.linspace(0.0, np.pi, 101)), 0.01)
    >>> respond_many([make_setting(Block(0.24, 0.8), mu=0.5)] * 2, pulse, gains=[(0.5, 0.0, 0.0), (1.0, 0.0, 0.0)]).overturned.tolist()
    [False, True]
    """
    check_motion(motion)
    check_settling(settle_s)
    if not len(settings):
        raise ParameterError("an ensemble needs at least one row")
    for setting in () if isinstance(settings, Settings) else settings:
        checks.instance(setting, Setting)
    rows = np.array(np.broadcast_to(np.asarray(gains, dtype=np.float64), (len(settings), 3)))
    share = max(AT_ONCE, SAMPLES_AT_ONCE // motion.samples)
    pool, gone = ThreadPoolExecutor(workers or os.cpu_count()), Event()
    events = (*halting(), gone)

    def part(first: int) -> Fates:
        """Follow some rows, as long as anybody waits for them."""
        last = first + share
        with heeding(events):
            return _fates(settings[first:last], motion, rows[first:last], initial, settle_s)

    try:
        found = list(pool.map(part, range(0, len(settings), share)))
    finally:
        gone.set()
        pool.shutdown(cancel_futures=True)
    return Fates(*(np.concatenate([getattr(each, field.name) for each in found]) for field in fields(Fates)))


def _fates(settings: Sequence[Setting] | Settings, motion: Motion, gains: FloatArray, initial: Initial, settle_s: float) -> Fates:
    """Return the fates of some rows, on this thread."""
    if isinstance(settings, Settings):
        first, starts = settings.one(0), settings.states(initial)
    else:
        first, starts = settings[0], np.array([setting.state(initial) for setting in settings])
    model = first.model
    duration = (motion.samples - 1) * motion.dt
    shaken = follow_many(
        model, motion, _parameters(settings, motion.dt, duration), starts, first.first_mode, gains=gains, allow_failures=True
    )
    failed = shaken.failed.copy()
    final, mode, end = shaken.final.copy(), shaken.final_mode.copy(), shaken.end_time.copy()
    high, low = _extrema(shaken)
    spent, longest = _stays(shaken)
    moving = ~failed & (mode >= 0) & (mode % names.HELD != names.REST)
    if settle_s > 0.0 and moving.any():
        ground = still_ground(settle_s)
        p = _parameters(settings, ground.dt, duration + settle_s, still=True)
        for kind in np.unique(mode[moving]):
            rows = np.flatnonzero(moving & (shaken.final_mode == kind))
            after = follow_many(model, ground, p[rows], shaken.final[rows], int(kind), gains=(1.0, 0.0, 1.0), allow_failures=True)
            failed[rows] = after.failed
            final[rows], mode[rows] = after.final, after.final_mode
            end[rows] = duration + after.end_time
            higher, lower = _extrema(after)
            high[rows], low[rows] = np.maximum(high[rows], higher), np.minimum(low[rows], lower)
            longer = _stays(after)
            spent[rows] += longer[0]
            longest[rows] = np.maximum(longest[rows], longer[1])
    fallen = mode == names.OVERTURNED
    return Fates(
        overturned=fallen,
        settled=~failed & ((mode == names.SETTLED) | ((mode >= 0) & (mode % names.HELD == names.REST))),
        gave_up=failed | (mode == names.GAVE_UP),
        towards=np.where(fallen, np.sign(final[:, names.THETA]), 0.0).astype(np.int64),
        final_displacement_m=final[:, names.X],
        max_displacement_m=np.maximum(high[:, names.X], -low[:, names.X]) + 0.0,
        max_rotation_rad=np.maximum(high[:, names.THETA], -low[:, names.THETA]) + 0.0,
        slip_path_m=final[:, names.PATH],
        impacts=final[:, names.IMPACTS].astype(np.int64),
        end_s=end,
        time_in_mode_s=spent,
        longest_flight_s=longest[:, KINDS.index(FLIGHT)],
    )


def _parameters(settings: Sequence[Setting] | Settings, dt: float, duration_s: float, *, still: bool = False) -> FloatArray:
    """Return the parameters of the model, one row for each."""
    if isinstance(settings, Settings):
        return settings.parameters(dt, duration_s=duration_s, still=still)
    return np.array([setting.parameters(dt, duration_s=duration_s, still=still) for setting in settings])


def _stays(ensemble: Ensemble) -> tuple[FloatArray, FloatArray]:
    """Return the time in each mode, in all and at the longest stretch, (m, 5) each, whichever corner and with or without tenons."""
    columns = [[i for i, mode in enumerate(names.MODES[: 2 * names.HELD]) if mode == kind] for kind in KINDS]
    total = [ensemble.stays[:, each, TOTAL].sum(axis=1) for each in columns]
    longest = [ensemble.stays[:, each, LONGEST].max(axis=1) for each in columns]
    return np.column_stack(total), np.column_stack(longest)


def _extrema(ensemble: Ensemble) -> tuple[FloatArray, FloatArray]:
    """Return the highest and the lowest values of the tracked states, (m, 2) each."""
    return ensemble.extrema[:, :, 0].copy(), ensemble.extrema[:, :, 2].copy()

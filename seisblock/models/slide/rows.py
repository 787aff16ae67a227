"""Outcomes of many objects under one motion in one compiled loop, bit by bit as those of single runs."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from seisblock._jit import kernel
from seisblock.bodies.sliding_base import SlidingBase
from seisblock.core.registry import RowResult, SolverBody
from seisblock.dynamics import integrate_many
from seisblock.dynamics.buffers import N_EVENTS, N_FLUSHED
from seisblock.dynamics.ensemble import Observer
from seisblock.dynamics.events import EVENT_FROM, EVENT_GUARD, EVENT_SAMPLE, EVENT_TO
from seisblock.dynamics.model_api import OBSERVE
from seisblock.models.slide.model import BACKWARD, FLIGHT, FOOT, FORWARD, LEVEL, SLIDE, SLIP, STICK, parameters
from seisblock.models.slide.solve import SlideRun, build_outcome, motion_gains, warnings
from seisblock.records.motion import Motion

LAST_EVENT, SLIP_COUNT, REVERSALS, FELL_OFF, LIFTED_OFF, LAST_SLIP, PARTS, PATH = range(8)
"""Columns of the results: time of the last event, s; counts of slips and reversals; passings of the foot and lift-offs; slip at the last
event, m; number of the parts of the path, and the parts, m."""

MAX_PARTS = 40
"""Largest number of floats of 53 bits that do not overlap: their exponents span 2098 bits."""


@kernel(OBSERVE)
def _observe(forcing, p, state, output, observed):
    """Count slips, reversals, passings of the foot and lift-offs, and add up the path without round-off."""
    if math.isnan(observed[PARTS]):
        observed[:] = 0.0
    for k in range(state.counters[N_EVENTS] - state.counters[N_FLUSHED]):
        source, target = output.events[k, EVENT_FROM] % LEVEL, output.events[k, EVENT_TO] % LEVEL
        observed[LAST_EVENT] = output.events[k, EVENT_SAMPLE] * forcing.dt + output.times[k]
        if output.events[k, EVENT_GUARD] != FOOT and target in (FORWARD, BACKWARD):
            observed[SLIP_COUNT] += 1.0
            if source in (FORWARD, BACKWARD):
                observed[REVERSALS] += 1.0
        if output.events[k, EVENT_FROM] < LEVEL and output.events[k, EVENT_TO] >= LEVEL:
            observed[FELL_OFF] += 1.0
        if target == FLIGHT:
            observed[LIFTED_OFF] += 1.0
        slip = output.limits[k, 0, SLIP]
        rest = abs(slip - observed[LAST_SLIP])
        observed[LAST_SLIP] = slip
        # a sum without overlaps and its errors, as in `math.fsum`
        count = 0
        for part in range(int(observed[PARTS])):
            value = observed[PATH + part]
            total = rest + value
            larger, smaller = (rest, value) if rest >= value else (value, rest)
            error = smaller - (total - larger)
            if error != 0.0:
                observed[PATH + count] = error
                count += 1
            rest = total
        observed[PATH + count] = rest
        observed[PARTS] = count + 1


_level_base = lru_cache(maxsize=1024)(SlidingBase)
"""Level base of a friction coefficient, the same under every record."""

OBSERVER = Observer(_observe, PATH + MAX_PARTS)


def solve_slide_rows(bodies: Sequence[SolverBody], motion: Motion) -> dict[str, RowResult]:
    """Return outcomes and warnings of objects by name; those in flight and of long motions are left out, for their single run."""
    if motion.is_long:
        return {}
    gravity = bodies[0].options.gravity
    bases = [body.body if isinstance(body.body, SlidingBase) else _level_base(body.body) for body in bodies]
    rows = [parameters(base, gravity) for base in bases]
    gains = [motion_gains(motion, body.options.vertical) for body in bodies]
    ensemble = integrate_many(SLIDE, motion, rows, np.zeros(4), STICK, gains=gains, allow_failures=True, observer=OBSERVER)
    finals, modes, extrema = ensemble.final.tolist(), ensemble.final_mode.tolist(), ensemble.extrema[:, SLIP].tolist()
    firsts, numbers = ensemble.first_event_time.tolist(), ensemble.observed.tolist()
    result: dict[str, RowResult] = {}
    for row in np.flatnonzero(ensemble.observed[:, LIFTED_OFF] == 0.0).tolist():
        last, slips, reversals, fell_off, _, last_slip, parts, *path = numbers[row]
        # errors are signed: the exact parts are rounded once
        path_m = math.fsum([*path[: int(parts)], abs(finals[row][SLIP] - last_slip)])
        run = SlideRun(
            finals[row], modes[row], extrema[row], firsts[row], last, int(slips), int(reversals), path_m, fell_off > 0.0, lifted_off=False
        )
        outcome = build_outcome(run, motion.start_s, rows[row])
        result[bodies[row].name] = vars(outcome), warnings(outcome, motion)
    return result

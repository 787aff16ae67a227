"""Outcomes of many bodies under one motion in one compiled loop, bit by bit as those of single runs."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from seisblock._jit import kernel
from seisblock.core.registry import RowResult, SolverBody
from seisblock.core.typing import BoolArray, FloatArray
from seisblock.dynamics.buffers import N_EVENTS, N_FLUSHED
from seisblock.dynamics.ensemble import Observer
from seisblock.dynamics.events import EVENT_FROM, EVENT_TO
from seisblock.dynamics.model_api import OBSERVE
from seisblock.models.respond.batch import Runs, solve_runs
from seisblock.models.respond.constants import FLIGHT, GAVE_UP, IMPACTS, MODES, START, TENON_OFFSET, THETA, X
from seisblock.models.respond.names import run_warnings
from seisblock.models.respond.outcome import RunEnd, are_sensitive, scalar_results
from seisblock.models.respond.params import RespondParams, motion_gains
from seisblock.models.respond.solve import respond_params
from seisblock.records import Motion

FLIGHTS = START
"""Number of flights, after the numbers of entries into each mode."""


@kernel(OBSERVE)
def _observe(forcing, p, state, output, observed):
    """Count the entries into each mode, and the flights, rebounds included."""
    if math.isnan(observed[FLIGHTS]):
        observed[:] = 0.0
    for k in range(state.counters[N_EVENTS] - state.counters[N_FLUSHED]):
        target = output.events[k, EVENT_TO]
        if target < 0:
            continue
        target %= TENON_OFFSET
        observed[target] += 1.0
        # a rebound leads from flight to flight through an impact
        is_rebound = output.limits[k, 1, IMPACTS] > output.limits[k, 0, IMPACTS]
        if target == FLIGHT and (output.events[k, EVENT_FROM] % TENON_OFFSET != FLIGHT or is_rebound):
            observed[FLIGHTS] += 1.0


OBSERVER = Observer(_observe, FLIGHTS + 1)


def _run_end(runs: Runs, row: int) -> RunEnd:
    """Return the numbers of one run."""
    rotations, displacements = ((float(runs.high[row, state]), float(runs.low[row, state])) for state in (THETA, X))
    counts = runs.observed[row]
    modes = {MODES[mode] for mode in np.flatnonzero(counts[:FLIGHTS]).tolist()}
    flights = int(counts[FLIGHTS]) if counts.size else 0
    return RunEnd(int(runs.mode[row]), runs.final[row].tolist(), float(runs.time[row]), rotations, displacements, flights, modes)


REST_MARGIN = 1e-5
"""Relative change of the motion up to which a body must stay at rest not to be tried for sensitivity; several times the changes tried."""


def _stay_at_rest(params: Sequence[RespondParams], motion: Motion, gains: FloatArray) -> BoolArray:
    """Return which bodies, at rest on the ground at first, a motion changed by up to ``REST_MARGIN`` makes neither rock nor slip."""
    demands = dict[tuple[float, float], float]()
    result = np.zeros(len(params), dtype=np.bool_)
    for row, row_params in enumerate(params):
        body, key = row_params.rigid_body, (row_params.gravity, float(gains[row, 2]))
        if key not in demands:
            vertical = key[1] * motion.vertical
            weight = key[0] + vertical - REST_MARGIN * np.abs(vertical)
            # a ratio of linear functions has its extrema at samples
            demands[key] = (1.0 + REST_MARGIN) * float((np.abs(motion.horizontal) / weight).max()) if weight.min() > 0.0 else math.inf
        result[row] = demands[key] < min(row_params.mu, body.left / body.height, body.right / body.height)
    return result


def solve_respond_rows(bodies: Sequence[SolverBody], motion: Motion) -> dict[str, RowResult]:
    """Return scalar results and warnings of bodies without tenons by name; runs without a result are left out, for their single run."""
    options = bodies[0].options
    if motion.is_long or options.tenon > 0.0:
        return {}
    params = [respond_params(body.body, body.options) for body in bodies]
    gains = np.array([motion_gains(motion, body.options.vertical) for body in bodies])
    runs = solve_runs(params, motion, gains, options.initial, options.settle_s, OBSERVER)
    rows = np.flatnonzero(~(runs.failed | (runs.mode == GAVE_UP) | np.isnan(runs.observed[:, FLIGHTS]))).tolist()
    ends = [_run_end(runs, row) for row in rows]

    def repeat(places: list[int], change: float) -> list[RunEnd]:
        changed = [rows[place] for place in places]
        factors = (1.0 + change) * gains[changed]
        repeated = solve_runs([params[row] for row in changed], motion, factors, options.initial, options.settle_s)
        return [_run_end(repeated, place) for place in range(len(changed))]

    flags: list[bool | None] = [None] * len(rows)
    if options.sensitivity:
        stays = _stay_at_rest([params[row] for row in rows], motion, gains[rows]) & (options.initial is None)
        flags = [False] * len(rows)
        moving = np.flatnonzero(~stays).tolist()
        changes = are_sensitive([ends[place] for place in moving], lambda places, change: repeat([moving[k] for k in places], change))
        for place, is_sensitive in zip(moving, changes, strict=True):
            flags[place] = is_sensitive
    result: dict[str, RowResult] = {}
    for row, end, flag in zip(rows, ends, flags, strict=True):
        values = {**scalar_results(end, params[row], motion.start_s, flag), "tenon_left_s": None}
        result[bodies[row].name] = values, run_warnings(end.mode, end.final, params[row], values["end_s"], options.settle_s)
    return result

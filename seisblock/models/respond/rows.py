"""Outcomes of many bodies under one motion in one compiled loop, bit by bit as those of single runs."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from seisblock._jit import kernel
from seisblock.core.registry import RowResult, SolverBody
from seisblock.dynamics.buffers import N_EVENTS, N_FLUSHED
from seisblock.dynamics.ensemble import Observer
from seisblock.dynamics.events import EVENT_FROM, EVENT_TO
from seisblock.dynamics.model_api import OBSERVE
from seisblock.models.respond.batch import Runs, solve_runs
from seisblock.models.respond.constants import FLIGHT, GAVE_UP, IMPACTS, MODES, START, TENON_OFFSET, THETA, X
from seisblock.models.respond.names import run_warnings
from seisblock.models.respond.outcome import RunEnd, are_sensitive, scalar_results
from seisblock.models.respond.params import motion_gains
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

    flags = are_sensitive(ends, repeat) if options.sensitivity else [None] * len(rows)
    result: dict[str, RowResult] = {}
    for row, end, flag in zip(rows, ends, flags, strict=True):
        values = {**scalar_results(end, params[row], motion.start_s, flag), "tenon_left_s": None}
        result[bodies[row].name] = values, run_warnings(end.mode, end.final, params[row], values["end_s"], options.settle_s)
    return result

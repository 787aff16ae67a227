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
from seisblock.models.respond.options import RespondOptions
from seisblock.models.respond.outcome import PERTURBATIONS, RunEnd, has_grown, scalar_results
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


def _are_sensitive(
    params: Sequence[RespondParams], ends: Sequence[RunEnd], motion: Motion, gains: FloatArray, options: RespondOptions
) -> BoolArray:
    """Return which verdicts a change of the motion changes, as :func:`~seisblock.models.respond.outcome.is_sensitive` does."""
    sensitive, rows, grown = np.zeros(len(params), dtype=bool), list(range(len(params))), set[int]()
    for k, change in enumerate(PERTURBATIONS):
        # the smaller changes only where one of the larger ones has grown
        rows = [row for row in rows if not sensitive[row] and (k < 2 or row in grown)]
        if not rows:
            break
        runs = solve_runs([params[row] for row in rows], motion, (1.0 + change) * gains[rows], options.initial, options.settle_s)
        for place, row in enumerate(rows):
            changed = _run_end(runs, place)
            sensitive[row] = changed.verdict != ends[row].verdict
            if has_grown(ends[row], changed):
                grown.add(row)
    return sensitive


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
    row_params = [params[row] for row in rows]
    flags = _are_sensitive(row_params, ends, motion, gains[rows], options).tolist() if options.sensitivity else [None] * len(rows)
    result: dict[str, RowResult] = {}
    for row, end, body_params, flag in zip(rows, ends, row_params, flags, strict=True):
        values = {**scalar_results(end, body_params, motion.start_s, flag), "tenon_left_s": None}
        result[bodies[row].name] = values, run_warnings(end.mode, end.final, body_params, values["end_s"], options.settle_s)
    return result

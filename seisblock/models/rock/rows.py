"""Outcomes of many blocks under one motion in one compiled loop, bit by bit as those of single runs."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from seisblock._jit import kernel
from seisblock.core.registry import RowResult, SolverBody
from seisblock.dynamics import integrate_many
from seisblock.dynamics.buffers import MODE, N_EVENTS, SAMPLE
from seisblock.dynamics.ensemble import Observer
from seisblock.dynamics.events import EVENT_FROM, EVENT_GUARD, EVENT_SAMPLE, EVENT_TO
from seisblock.dynamics.model_api import OBSERVE
from seisblock.models.rock import model
from seisblock.models.rock.forces import SEARCH_SIZE, make_demand, parameters, search_path, start_search
from seisblock.models.rock.free_rocking import STANDS, trace_free_rocking
from seisblock.models.rock.model import (
    ALONG,
    BEYOND_LEFT,
    BEYOND_RIGHT,
    LOWER_BOUND,
    OMEGA,
    OVERTURNED,
    REST,
    THETA,
    TO_LEFT,
    TO_RIGHT,
    UPWARD,
)
from seisblock.models.rock.outcome import RockRun, build_outcome, warnings
from seisblock.models.rock.params import rock_params
from seisblock.models.rock.solve import initial_mode, outcome_after_record
from seisblock.records import Motion

FIRST_START, LAST_ALPHA, IMPACTS, SEARCH = range(4)
"""Columns of the results: first start of rocking and last passing of alpha, s (NaN: none), impacts, and the state of the search for the
friction demand."""


@kernel(OBSERVE)
def _observe(forcing, p, state, output, observed):
    """Write starts, passings of alpha and impacts of a run, and search its friction demand."""
    counters, events = state.counters, output.events
    first_start = last_alpha = math.nan
    impacts = 0
    for k in range(counters[N_EVENTS]):
        time, source, target = events[k, EVENT_SAMPLE] * forcing.dt + output.times[k], events[k, EVENT_FROM], events[k, EVENT_TO]
        if source == REST and math.isnan(first_start):
            first_start = time
        if target in (BEYOND_RIGHT, BEYOND_LEFT):
            last_alpha = time
        if source in (TO_RIGHT, TO_LEFT) and events[k, EVENT_GUARD] == LOWER_BOUND:
            impacts += 1
    observed[FIRST_START], observed[LAST_ALPHA], observed[IMPACTS] = first_start, last_alpha, impacts
    search, mode, samples = observed[SEARCH:], counters[MODE], counters[SAMPLE] + 1
    falls = mode == OVERTURNED
    if mode in (BEYOND_RIGHT, BEYOND_LEFT):
        # neither the peak tilts of free rocking nor its legs are needed here
        ending, _ = trace_free_rocking(p, state.state[THETA], state.state[OMEGA], search, output.path[:0])
        falls = ending != STANDS
    passed = 0.0 if math.isnan(last_alpha) else last_alpha
    start_search(search, passed if falls else math.inf)
    search_path(
        p,
        search,
        0,
        forcing.dt,
        output.path[:samples],
        output.modes[:samples],
        forcing.acceleration[ALONG],
        forcing.acceleration[UPWARD],
        forcing.gains[UPWARD],
        counters[N_EVENTS],
        events,
        output.times,
        output.limits,
    )


OBSERVER = Observer(_observe, SEARCH + SEARCH_SIZE, has_path=True)


def solve_rock_rows(bodies: Sequence[SolverBody], motion: Motion) -> dict[str, RowResult]:
    """Return outcomes and warnings of blocks by name; failed runs and those of long motions are left out, for their single run."""
    if motion.is_long:
        return {}
    params = [rock_params(body.body, motion, body.options) for body in bodies]
    initial = [body.options.initial for body in bodies]
    modes = [initial_mode(*pair) for pair in zip(params, initial, strict=True)]
    ensemble = integrate_many(
        model.ROCKING,
        motion,
        [parameters(block, motion.dt) for block in params],
        initial,
        np.array(modes),
        gains=[block.gains() for block in params],
        allow_failures=True,
        observer=OBSERVER,
    )
    result: dict[str, RowResult] = {}
    numbers, end_times, final_modes = ensemble.observed.tolist(), ensemble.end_time.tolist(), ensemble.final_mode.tolist()
    for row in np.flatnonzero(~np.isnan(ensemble.observed[:, IMPACTS])).tolist():
        first_start, last_alpha, impacts, *search = numbers[row]
        run = RockRun(
            final_modes[row],
            float(ensemble.final[row, THETA]),
            end_times[row],
            ensemble.extrema[row, THETA].tolist(),
            first_start,
            last_alpha,
            modes[row] != REST,
            int(impacts),
            make_demand(search),
        )
        outcome = build_outcome(params[row], motion, run, outcome_after_record(run.final_mode, ensemble.final[row], params[row]))
        result[bodies[row].name] = vars(outcome), warnings(params[row], outcome)
    return result

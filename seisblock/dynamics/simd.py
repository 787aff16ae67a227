"""SIMD integration: many trajectories of one model advance in parallel lanes between events.

The recurrence of a power series is a chain of dependent operations; a vector unit computes many such chains in the time of
one. A model may therefore define a ``stride``, which advances several trajectories from sample to sample by the same operations in the
same order as its ``series``, so that results agree to the last bit. Everything else (events, new extrema, shorter steps) is
left to the engine, one trajectory after another.
"""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.core.status import PAUSED
from seisblock.dynamics.array_types import INTEGERS, MATRIX, VECTOR
from seisblock.dynamics.buffers import (
    AT_REST,
    BATCH_FORCING,
    BATCH_STATE,
    N_EVENTS,
    OUTPUT,
    SAMPLE,
    SAMPLES_AFTER,
    SCRATCH,
    SEGMENT_START,
    SHAPE,
    STEPS_LEFT,
    Forcing,
    Output,
    State,
)
from seisblock.dynamics.hybrid import LOOP_POINTERS
from seisblock.dynamics.model_api import STRIDE

_t = types()

LANE_ARGUMENTS = BATCH_FORCING, SHAPE, MATRIX, BATCH_STATE, INTEGERS, INTEGERS, VECTOR, OUTPUT, SCRATCH, _t.int64, _t.int64
"""Types of the arguments of the loop after the functions."""


@kernel(_t.int64(*LOOP_POINTERS, _t.FunctionType(STRIDE), *LANE_ARGUMENTS))
def integrate_in_lanes(
    advance,
    series,
    reset,
    skip,
    stride,
    forcing,
    shape,
    parameters,
    rows,
    lane_rows,
    needs_engine,
    lane_state,
    no_output,
    scratch,
    first_row,
    steps,
):
    """Integrate one trajectory per row from `first_row` on for `steps` steps in total; return the next unassigned row.

    The caller repeats the call until all lanes are empty. `no_output` holds empty path and event arrays; the kernel allocates
    nothing itself, because reference counting would dominate its machine code.
    """
    last = forcing.acceleration.shape[1] - 1
    next_row = first_row
    running = True
    while running and steps > 0:
        running = False
        for lane in range(lane_rows.size):
            # still advancing in the stride: nothing to do for the engine
            if needs_engine[lane] == 0:
                running = True
                continue
            while steps > 0:
                # fill the lane with the next trajectory that has not ended in an earlier segment
                while lane_rows[lane] < 0 and next_row < parameters.shape[0]:
                    lane_rows[lane] = next_row if rows.statuses[next_row] == PAUSED else -1
                    next_row += 1
                lane_row = lane_rows[lane]
                if lane_row < 0:
                    break
                # one sample interval by the engine, then back to the stride
                counters = rows.counters[lane_row]
                counters[STEPS_LEFT] = 1
                events_before = counters[N_EVENTS]
                rows.statuses[lane_row] = advance(
                    series,
                    reset,
                    skip,
                    Forcing(forcing.acceleration, forcing.gains[lane_row], forcing.dt),
                    shape,
                    parameters[lane_row],
                    State(counters, rows.clocks[lane_row], rows.states[lane_row]),
                    Output(
                        no_output.path,
                        no_output.modes,
                        no_output.events,
                        no_output.times,
                        no_output.limits,
                        rows.extrema[lane_row],
                        rows.transition_counts[lane_row],
                        rows.dwell_times[lane_row],
                    ),
                    scratch,
                )
                # one step for the interval, one for the call, so that rows at rest use up the allowance
                steps -= 2 - counters[STEPS_LEFT]
                segment_done = counters[SAMPLES_AFTER] > 0 and counters[SAMPLE] - counters[SEGMENT_START] >= last
                if rows.statuses[lane_row] != PAUSED or segment_done:
                    lane_rows[lane] = -1
                # a trajectory at rest stays with the engine, whose skip passes many samples at once; so does one after an event, which
                # others often follow in the next sample
                elif counters[AT_REST] == 0 and counters[N_EVENTS] == events_before:
                    running = True
                    break
        if running:
            steps -= stride(forcing, parameters, rows, lane_rows, needs_engine, lane_state, max(steps // lane_rows.size, 1))
    return next_row

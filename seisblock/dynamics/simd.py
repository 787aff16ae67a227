"""Many trajectories of one model side by side, each in a lane of its own: they move on together where nothing happens to them.

One step of a power series is a chain of operations, each of which waits for the one before it; a processor does many such chains in the
time of one. A model may therefore bring a ``stride``, which moves some trajectories at once from sample to sample, by the very operations
of its ``series``, in their order: the same bits. Whatever is more than that, an event, a new extremum, a series that needs another step,
is left to the engine, one trajectory after another.
"""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.core.status import PAUSED
from seisblock.dynamics.array_types import INTEGERS, MATRIX, VECTOR
from seisblock.dynamics.buffers import (
    AT_REST,
    BATCH_FORCING,
    BATCH_STATE,
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
from seisblock.dynamics.hybrid import MODEL_POINTERS, advance
from seisblock.dynamics.model_api import STRIDE

_t = types()

LANE_ARGUMENTS = BATCH_FORCING, SHAPE, MATRIX, BATCH_STATE, INTEGERS, INTEGERS, VECTOR, OUTPUT, SCRATCH, _t.int64, _t.int64
"""What the loop is given beside its functions."""


@kernel(_t.int64(*MODEL_POINTERS, _t.FunctionType(STRIDE), *LANE_ARGUMENTS))
def integrate_in_lanes(
    series, reset, skip, stride, forcing, shape, parameters, rows, lane_rows, needs_engine, lane_state, no_output, scratch, first_row, steps
):
    """Follow one trajectory per row of `parameters`, from row `first_row` on, for so many steps in all; return the first that no lane has.

    It is called again, with the lanes as they are, until all of them are empty. Of a single trajectory `no_output` is kept; it makes no
    room of its own, whose counting of references would be the larger part of its machine code.
    """
    last = forcing.acceleration.shape[1] - 1
    next_row = first_row
    running = True
    while running and steps > 0:
        running = False
        for lane in range(lane_rows.size):
            if needs_engine[lane] == 0:
                running = True
                continue
            while steps > 0:
                # what ended in an earlier stretch of the motion has its lane no more
                while lane_rows[lane] < 0 and next_row < parameters.shape[0]:
                    lane_rows[lane] = next_row if rows.statuses[next_row] == PAUSED else -1
                    next_row += 1
                lane_row = lane_rows[lane]
                if lane_row < 0:
                    break
                counters = rows.counters[lane_row]
                counters[STEPS_LEFT] = 1
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
                steps -= 2 - counters[STEPS_LEFT]
                segment_done = counters[SAMPLES_AFTER] > 0 and counters[SAMPLE] - counters[SEGMENT_START] >= last
                if rows.statuses[lane_row] != PAUSED or segment_done:
                    lane_rows[lane] = -1
                elif counters[AT_REST] == 0:
                    running = True
                    break
        if running:
            steps -= stride(forcing, parameters, rows, lane_rows, needs_engine, lane_state, max(steps // lane_rows.size, 1))
    return next_row

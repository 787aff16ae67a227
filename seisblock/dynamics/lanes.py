"""Many trajectories of one model side by side, each in a lane of its own: they move on together where nothing happens to them.

One step of a power series is a chain of operations, each of which waits for the one before it; a processor does many such chains in the
time of one. A model may therefore bring a ``stride``, which moves some trajectories at once from sample to sample, by the very operations
of its ``series``, in their order: the same bits. Whatever is more than that, an event, a new extremum, a series that needs another step,
is left to the engine, one trajectory after another.
"""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.dynamics.arguments import (
    BASE,
    BEYOND,
    GROUNDS,
    KEPT,
    ROWS,
    SAMPLE,
    SCRATCH,
    SHAPE,
    STEPS_LEFT,
    STILL,
    Cursor,
    Ground,
    Kept,
)
from seisblock.dynamics.arrays import INTEGERS, MATRIX, VECTOR
from seisblock.dynamics.contract import STRIDE
from seisblock.dynamics.hybrid import POINTERS, go_on
from seisblock.dynamics.status import PAUSED

_t = types()

LANE = GROUNDS, SHAPE, MATRIX, ROWS, INTEGERS, INTEGERS, VECTOR, KEPT, SCRATCH, _t.int64, _t.int64
"""What the loop is given beside its functions."""


@kernel(_t.int64(*POINTERS, _t.FunctionType(STRIDE), *LANE))
def integrate_in_lanes(series, reset, skip, stride, grounds, shape, parameters, rows, chosen, waits, lanes, nothing, scratch, first, steps):
    """Follow one trajectory per row of `parameters`, from row `first` on, for so many steps in all; return the first that no lane has.

    It is called again, with the lanes as they are, until all of them are empty. Of a single trajectory `nothing` is kept; it makes no
    room of its own, whose counting of references would be the larger part of its machine code.
    """
    last = grounds.acceleration.shape[1] - 1
    row = first
    busy = True
    while busy and steps > 0:
        busy = False
        for lane in range(chosen.size):
            if waits[lane] == 0:
                busy = True
                continue
            while steps > 0:
                # what ended in an earlier stretch of the motion has its lane no more
                while chosen[lane] < 0 and row < parameters.shape[0]:
                    chosen[lane] = row if rows.statuses[row] == PAUSED else -1
                    row += 1
                each = chosen[lane]
                if each < 0:
                    break
                place = rows.places[each]
                place[STEPS_LEFT] = 1
                rows.statuses[each] = go_on(
                    series,
                    reset,
                    skip,
                    Ground(grounds.acceleration, grounds.gains[each], grounds.dt),
                    shape,
                    parameters[each],
                    Cursor(place, rows.clocks[each], rows.states[each]),
                    Kept(
                        nothing.path,
                        nothing.modes,
                        nothing.events,
                        nothing.times,
                        nothing.limits,
                        rows.extrema[each],
                        rows.tallies[each],
                        rows.stays[each],
                    ),
                    scratch,
                )
                steps -= 2 - place[STEPS_LEFT]
                through = place[BEYOND] > 0 and place[SAMPLE] - place[BASE] >= last
                if rows.statuses[each] != PAUSED or through:
                    chosen[lane] = -1
                elif place[STILL] == 0:
                    busy = True
                    break
        if busy:
            steps -= stride(grounds, parameters, rows, chosen, waits, lanes, max(steps // chosen.size, 1))
    return row

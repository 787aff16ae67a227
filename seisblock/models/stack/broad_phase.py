"""Broad phase: axis-aligned bounding boxes (AABB) that select the pairs of boxes for the narrow phase.

The bounds are enlarged by a margin for the motion until their next update, so that not every step has to recompute them.
"""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import INTEGERS, MATRIX
from seisblock.models.stack.frames import BOX_CENTRE, R, V, W, X

_t = types()

BROAD_PHASE_INTERVAL = 1e-3
"""Interval between updates of the bounding boxes, s; longer steps update them every time."""

AABB_MARGIN_RATIO, SPEED_FACTOR = 0.02, 2.0
"""Constant margin of the bounding boxes over half the length of a stone, and factor on the speed of the fastest corner: an impact may
reverse or increase a velocity."""


@kernel(_t.float64(MATRIX, MATRIX, INTEGERS))
def max_corner_speed(bodies, boxes, owner):
    """Return an upper bound of the speed of all box corners, m/s."""
    max_speed = 0.0
    for i in range(boxes.shape[0]):
        b, box = bodies[owner[i]], boxes[i]
        reach = (box[0] ** 2 + box[1] ** 2 + box[2] ** 2) ** 0.5 + (
            box[BOX_CENTRE] ** 2 + box[BOX_CENTRE + 1] ** 2 + box[BOX_CENTRE + 2] ** 2
        ) ** 0.5
        spin_speed = (b[W] ** 2 + b[W + 1] ** 2 + b[W + 2] ** 2) ** 0.5
        max_speed = max(max_speed, (b[V] ** 2 + b[V + 1] ** 2 + b[V + 2] ** 2) ** 0.5 + spin_speed * reach)
    return max_speed


@kernel(_t.void(MATRIX, MATRIX, INTEGERS, _t.float64, MATRIX))
def update_aabbs(bodies, boxes, owner, dt, bounds):
    """Write the bounding boxes, valid until the next update: centres and half sizes along the ground's axes, m."""
    # a box may move at the speed of the fastest corner until the next update
    path = SPEED_FACTOR * max(dt, BROAD_PHASE_INTERVAL) * max_corner_speed(bodies, boxes, owner)
    for i in range(boxes.shape[0]):
        b = bodies[owner[i]]
        box = boxes[i]
        # the ground, last, needs no margin
        margin = path + (AABB_MARGIN_RATIO * max(box[0], max(box[1], box[2])) if i < boxes.shape[0] - 1 else 0.0)
        for k in range(3):
            r = R + 3 * k
            bounds[i, k] = b[X + k] + b[r] * box[BOX_CENTRE] + b[r + 1] * box[BOX_CENTRE + 1] + b[r + 2] * box[BOX_CENTRE + 2]
            bounds[i, 3 + k] = abs(b[r]) * box[0] + abs(b[r + 1]) * box[1] + abs(b[r + 2]) * box[2] + margin


@kernel(_t.boolean(_t.int64, _t.int64, MATRIX), inline=True)
def aabbs_overlap(i, j, bounds):
    """Return whether two bounding boxes overlap."""
    # the vertical axis first: stones of a pile lie above each other, so it separates most pairs
    return (
        abs(bounds[i, 2] - bounds[j, 2]) <= bounds[i, 5] + bounds[j, 5]
        and abs(bounds[i, 0] - bounds[j, 0]) <= bounds[i, 3] + bounds[j, 3]
        and abs(bounds[i, 1] - bounds[j, 1]) <= bounds[i, 4] + bounds[j, 4]
    )

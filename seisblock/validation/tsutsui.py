"""Validation against [Tsutsui]_: table 1, and equation (4) against the exact velocity step."""

from __future__ import annotations

import math
from functools import partial

from seisblock.criteria.gravestones import overturning_level
from seisblock.criteria.overturning import tsutsui_sine_velocity, tsutsui_velocity, velocity_step
from seisblock.validation.case import Case, expected_difference

GRAVITY = 9.8
WIDTH = 0.242
_ROUNDING = 0.005
"""Half of the last digit of table 1, m/s."""

TABLE_1 = ((2.5, 4.70, 2.0, 0.75, 0.78), (3.0, 6.00, 2.5, 0.76, 0.71), (4.0, 6.10, 3.0, 0.65, 0.62))
"""1/lambda, acceleration (m/s^2), frequency (Hz), v1 and v2 (m/s) of table 1."""


WIDTHS = (1.0, 2.5, 5.0)
"""Widths of the blocks of figs. 2 and 3, m; lambda = 1/4."""


def exact_step(width: float, height: float) -> float:
    """Return the exact velocity step of a rectangle, m/s ([Tsutsui]_ eq. (2), exact)."""
    return velocity_step(math.atan2(width, height), math.sqrt(1.5 * GRAVITY / math.hypot(width, height)), GRAVITY)


def printed_velocity(ratio: float) -> float:
    """Return v2 with the paper's factor 0.8, rounded from sqrt(2/pi), m/s ([Tsutsui]_ eq. (4), second form)."""
    return 0.8 * tsutsui_velocity(WIDTH, ratio * WIDTH, GRAVITY)


CASES = (
    *(
        Case(
            f"tsutsui-table1-v1-{ratio:g}", "[Tsutsui]_ table 1", f"v1 = a/(pi f), lambda = 1/{ratio:g}", "m/s", v1, _ROUNDING,
            partial(tsutsui_sine_velocity, a, f), note="printed in integer cm/s",
        )
        for ratio, a, f, v1, _ in TABLE_1
    ),
    *(
        Case(
            f"tsutsui-table1-v2-{ratio:g}", "[Tsutsui]_ table 1", f"v2 = 0.8 sqrt(b lambda g), lambda = 1/{ratio:g}", "m/s", v2, _ROUNDING,
            partial(printed_velocity, ratio), note="printed in integer cm/s; b = 0.242 m, g = 9.8 m/s^2; the heading of the table cites eq. (1)",
        )
        for ratio, _, _, _, v2 in TABLE_1
    ),
    *(
        Case(
            f"tsutsui-eq4-{ratio:g}", "[Tsutsui]_ eq. (4)", f"overturning velocity, lambda = 1/{ratio:g}", "m/s",
            exact_step(WIDTH, ratio * WIDTH), 0.01 * exact_step(WIDTH, ratio * WIDTH),
            partial(tsutsui_velocity, WIDTH, ratio * WIDTH, GRAVITY, cosine=True), status="differs", kind="derived", today=expected_difference(today),
            note="eq. (4) approximates the restoring force by a cosine and neglects the block's own inertia: 4 to 8 % below the exact velocity "
            "step sqrt((8/3) g R (1 - cos alpha))/cos alpha (expected value)",
        )
        for (ratio, *_), today in zip(TABLE_1, (0.7771248168, 0.7094146536, 0.6143711118), strict=True)
    ),
    *(
        Case(
            f"tsutsui-eq2-{width:g}", "[Tsutsui]_ eq. (2), figs. 2, 3", f"overturning velocity, b = {width:g} m, lambda = 1/4", "m/s",
            exact_step(width, 4.0 * width), 0.01 * exact_step(width, 4.0 * width), partial(tsutsui_velocity, width, 4.0 * width, GRAVITY),
            status="differs", kind="derived", today=expected_difference(math.sqrt(width * GRAVITY / 4.0)),
            note="eq. (2) has a restoring force that does not decrease, and no rotation: 20 % above the exact velocity step (expected value)",
        )
        for width in WIDTHS
    ),
    Case(
        "tsutsui-fig4-long", "[Tsutsui]_ fig. 4", "acceleration times period at 2 s over that at 1 s, eq. (9) of Furukawa et al. (2009)", "1",
        2.0, 0.2, lambda: 2.0 * float(overturning_level(0.5) / overturning_level(1.0)), note="paper: proportional to the period where it is long; tolerance 10 %, chosen here",
    ),
)  # fmt: skip
"""Cases of this paper."""

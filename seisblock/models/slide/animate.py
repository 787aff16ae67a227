"""Animation of a sliding object on a level or sloping base, with record and slip below."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from seisblock.bodies.sliding_base import SlidingBase
from seisblock.core.i18n import gettext
from seisblock.core.results import Response
from seisblock.core.typing import FloatArray
from seisblock.models.slide.describe import describe_base
from seisblock.models.slide.plot import COLOURS
from seisblock.models.slide.solve import SlideOutcome
from seisblock.output.animation.animation import Animation, Line, Strip, ground_strip, motion_interval, sample_at
from seisblock.output.animation.render import AnimationOptions
from seisblock.output.animation.scene2d import Body, Piece, Scene2D, Trail, ground_shift, rectangle
from seisblock.output.animation.writers import write_animation
from seisblock.output.figures.heading import motions_heading
from seisblock.output.units_display import length_unit

MIN_HALF_WIDTH = 0.05
"""Smallest half width of the drawn object, m; the model has no width, so it is drawn half as wide as the range of the slip."""


def animate(response: Response[SlideOutcome], path: Path | str, options: AnimationOptions) -> None:
    """Write the animation of sliding, see :func:`seisblock.output.animation.writers.write_animation`."""
    span = motion_interval(response.phases, COLOURS, float(response.motion.time[0]), float(response.motion.time[-1]))
    write_animation(lambda times: slide_animation(response, times, gal=options.gal), span, path, options)


def slide_animation(response: Response[SlideOutcome], times: FloatArray, *, gal: bool = True) -> Animation:
    """Return the animation of sliding for the times of its frames, (n,), s."""
    base: SlidingBase = response.body
    motion = response.motion
    slip = sample_at(times, response.time, response["displacement"])
    x, z, turn = position_on_base(base, slip)
    path = position_on_base(base, response["displacement"])[:2]
    size = max(0.5 * float(np.ptp(slip)), MIN_HALF_WIDTH)
    block = Piece(rectangle(-size, size, 0.0, 1.2 * size), "#b5a58a")
    limit = base.mu * float(response.options.gravity)
    disp_unit = length_unit([response.outcome.max_slip_m], gal=gal)
    level = not base.slope_deg and not response.options.vertical
    return Animation(
        title=describe_base(response, in_figure=True),
        heading=motions_heading([motion]),
        direction=motion.name,
        time=times,
        scene=Scene2D(
            shift=ground_shift(motion, times),
            bodies=(Body((block,), x, z, turn),),
            floors=(_floor(base, float(np.abs(slip).max()) + 4.0 * size),),
            trails=(Trail(gettext("object"), response.time, *path),),
        ),
        strips=(
            ground_strip(motion, (-limit, limit) if level else (), gal=gal),
            Strip(gettext("x − z ({unit})", unit=disp_unit.name), (Line(response.time, response["displacement"] / disp_unit.size),)),
        ),
        phases=response.phases,
        colours=COLOURS,
    )


def position_on_base(base: SlidingBase, slip: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return position x, z, m, and rotation, rad, (n,), of an object after a slip along its base.

    Downhill is +x for a positive slope; beyond the foot of the slope the path is level.
    """
    downhill = math.copysign(1.0, base.slope_deg)
    angle = abs(base.angle)
    foot = math.inf if base.slope_length is None else base.slope_length
    # split the path at the foot of the slope
    on_slope = np.minimum(downhill * slip, foot)
    overrun = downhill * slip - on_slope
    x = downhill * (on_slope * math.cos(angle) + overrun)
    return x, -on_slope * math.sin(angle), np.where(overrun > 0.0, 0.0, base.angle)


def _floor(base: SlidingBase, travel: float) -> FloatArray:
    """Return the outline of the base, beyond the range of the object."""
    downhill = math.copysign(1.0, base.slope_deg)
    ends = [-downhill * 3.0 * travel, *([] if base.slope_length is None else [downhill * base.slope_length]), downhill * 3.0 * travel]
    if base.slope_length is not None:
        ends[-1] = downhill * (base.slope_length + 3.0 * travel)
    x, z, _ = position_on_base(base, np.array(ends))
    bottom = float(z.min()) - 2.0 * travel
    return np.array([*zip(x, z, strict=True), (x[-1], bottom), (x[0], bottom)])

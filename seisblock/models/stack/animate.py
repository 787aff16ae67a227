"""Animation of a pile of stones in three dimensions, with record, tilts and slips below."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from seisblock.bodies.pile.pile import Pile
from seisblock.core.i18n import gettext
from seisblock.core.results import Response
from seisblock.core.typing import FloatArray
from seisblock.models.stack.outcome import StackOutcome
from seisblock.models.stack.plot import line_style, max_standing, motion_interval, stone_slip, stone_tilt
from seisblock.output.animation.animation import Animation, Line, Strip, ground_strip
from seisblock.output.animation.render import REAL_TIME, AnimationOptions
from seisblock.output.animation.scene3d import FRAMES_PER_RAD, Scene3D, Solid, ground_path
from seisblock.output.animation.writers import write_animation
from seisblock.output.figures.heading import motions_heading
from seisblock.output.units_display import length_unit


def animate(response: Response[StackOutcome], path: Path | str, options: AnimationOptions = REAL_TIME) -> None:
    """Write the animation of a pile, see :func:`seisblock.output.animation.writers.write_animation`."""
    span = motion_interval(response, margin=1.5)
    write_animation(lambda times: stack_animation(response, times, gal=options.gal), span, path, options, rate=FRAMES_PER_RAD)


def stack_animation(response: Response[StackOutcome], times: FloatArray, *, gal: bool = True) -> Animation:
    """Return the animation of a pile for the times of its frames, (n,), s."""
    body: Pile = response.body
    motion, options = response.motion, response.options
    fall_times = {stone.name: math.inf if stone.fell_at_s is None else stone.fell_at_s for stone in response.outcome.stones}
    solids = tuple(
        Solid(stone.size, *_stone_trajectory(response, stone.name, times), fall_times[stone.name], stone.is_round) for stone in body.stones
    )
    size = max(max(stone.width, stone.depth) for stone in body.stones)
    disp_unit = length_unit([max_standing(response, "slip")], gal=gal)
    return Animation(
        title=gettext(body.name),
        heading=motions_heading([motion]),
        direction=motion.name,
        note=f"+x = {motion.name or 'x'}",
        time=times,
        scene=Scene3D(ground_path(motion, (True, bool(options.across), bool(options.vertical)), times), solids, 1.1 * size),
        strips=(
            ground_strip(motion, gal=gal),
            Strip(gettext("tilt θ (deg)"), _lines(response, "tilt", math.degrees(1.0))),
            Strip(gettext("slip s ({unit})", unit=disp_unit.name), _lines(response, "slip", 1.0 / disp_unit.size)),
        ),
    )


def _lines(response: Response[StackOutcome], quantity: str, factor: float) -> tuple[Line, ...]:
    """Return one curve per stone in the styles of the figure; a curve ends at the overturning of its stone."""
    lines = []
    for index, stone in enumerate(reversed(response.outcome.stones)):
        values = (stone_slip if quantity == "slip" else stone_tilt)(response, stone.name) * factor
        colour, dashes = line_style(index)
        style = () if isinstance(dashes, str) else dashes[1]
        lines.append(Line(response.time, values, colour, gettext(stone.name), style))
    return tuple(lines)


def _stone_trajectory(response: Response[StackOutcome], name: str, times: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return centre (n, 3), m, and unit quaternion (n, 4) of a stone at the times of the frames."""
    centre = np.array([np.interp(times, response.time, response[f"{name}_{axis}"]) for axis in "xyz"]).T
    turn = np.array([np.interp(times, response.time, response[f"{name}_q{axis}"]) for axis in "wxyz"]).T
    return centre, turn / np.linalg.norm(turn, axis=1, keepdims=True)

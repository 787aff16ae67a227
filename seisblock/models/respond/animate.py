"""Animation of the full response: side view of the object, with record, displacement and tilt below."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from seisblock.bodies.block import Block
from seisblock.bodies.body_name import body_name
from seisblock.core.i18n import gettext
from seisblock.core.results import Response
from seisblock.core.typing import FloatArray
from seisblock.models.respond.options import effective_friction
from seisblock.models.respond.outcome import RespondOutcome
from seisblock.models.respond.plot import COLOURS, motion_interval
from seisblock.models.rock.animate import corners, ground_heights
from seisblock.output.animation.animation import Animation, Line, Strip, ground_strip, sample_at
from seisblock.output.animation.render import REAL_TIME, AnimationOptions
from seisblock.output.animation.scene2d import Body, Piece, Scene2D, Trail, ground_shift, rectangle
from seisblock.output.animation.writers import write_animation
from seisblock.output.figures.heading import motions_heading
from seisblock.output.units_display import length_unit


def animate(response: Response[RespondOutcome], path: Path | str, options: AnimationOptions = REAL_TIME) -> None:
    """Write the animation of a full response, see :func:`seisblock.output.animation.writers.write_animation`."""
    write_animation(lambda times: respond_animation(response, times, gal=options.gal), motion_interval(response), path, options)


def respond_animation(response: Response[RespondOutcome], times: FloatArray, *, gal: bool = True) -> Animation:
    """Return the animation of a full response for the times of its frames, (n,), s."""
    block: Block = response.body
    motion, outcome, options = response.motion, response.outcome, response.options
    centre = np.array([block.centroid_offset, block.centre])
    outline = corners(block, 0.0) - centre
    x, z, tilt = (sample_at(times, response.time, response[name]) for name in ("displacement", "height", "rotation"))
    level = options.gravity * min(effective_friction(options), min(block.arms) / block.centre)
    alpha = math.degrees(block.slenderness)
    half_width = 4.0 * math.hypot(block.width, block.height) + 2.0 * outcome.max_displacement_m
    disp_unit = length_unit([outcome.max_displacement_m], gal=gal)
    return Animation(
        title=gettext(body_name(block.name)),
        heading=motions_heading([motion]),
        direction=motion.name,
        time=times,
        scene=Scene2D(
            shift=ground_shift(motion, times),
            bodies=(Body((Piece(outline),), block.centroid_offset + x, ground_heights(outline, z, tilt), tilt),),
            floors=(rectangle(-half_width, half_width, -block.height, 0.0),),
            trails=(
                Trail(gettext("centre of gravity"), response.time, block.centroid_offset + response["displacement"], response["height"]),
            ),
        ),
        strips=(
            ground_strip(motion, (-level, level), gal=gal),
            Strip(gettext("x ({unit})", unit=disp_unit.name), (Line(response.time, response["displacement"] / disp_unit.size, "#1f5a8c"),)),
            Strip(gettext("θ (deg)"), (Line(response.time, np.degrees(response["rotation"])),), (-alpha, alpha)),
        ),
        phases=response.phases,
        colours=COLOURS,
    )

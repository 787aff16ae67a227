"""Animation of a jumping two-layer block: side view, close-up of the path of its feet, record below."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from seisblock.bodies.body_name import body_name
from seisblock.bodies.two_layer import TwoLayerBlock
from seisblock.core.i18n import gettext
from seisblock.core.results import Response
from seisblock.core.typing import FloatArray
from seisblock.models.jump.chain import JumpPhase
from seisblock.models.jump.interpolate import interpolate_phases
from seisblock.models.jump.plot import COLOURS
from seisblock.models.jump.solve import JumpOutcome
from seisblock.output.animation.animation import Animation, Line, Strip, ground_strip, motion_interval, sample_at
from seisblock.output.animation.render import AnimationOptions
from seisblock.output.animation.scene2d import Body, Box, Piece, Scene2D, Trail, ground_shift, rectangle
from seisblock.output.animation.writers import write_animation
from seisblock.output.figures.heading import motions_heading
from seisblock.output.units_display import length_unit

PEDESTAL = 0.06
"""Half width of the stone under each foot over the width of the block."""


def animate(response: Response[JumpOutcome], path: Path | str, options: AnimationOptions) -> None:
    """Write the animation of a jump, see :func:`seisblock.output.animation.writers.write_animation`."""
    span = motion_interval(
        response.phases, COLOURS, float(response.motion.time[0]), float(max(response.motion.time[-1], response.time[-1]))
    )
    write_animation(lambda times: jump_animation(response, times, gal=options.gal), span, path, options)


def jump_animation(response: Response[JumpOutcome], times: FloatArray, *, gal: bool = True) -> Animation:
    """Return the animation of a jump for the times of its frames, (n,), s."""
    block: TwoLayerBlock = response.body
    motion, drop = response.motion, float(response.options.drop)
    time, curves = interpolate_phases(response)
    leaning, tilt = interpolate_phases(response, [JumpPhase.ROCKING])
    x, z, turn = (sample_at(times, time, curves[name]) for name in ("displacement", "height", "rotation"))
    body = Body(_layers(block), x, z, turn)
    half, base_offset = block.width / 2, -block.centroid_height
    exact = Body((), curves["displacement"], curves["height"], curves["rotation"])
    feet = [exact.path(np.array([side * half, base_offset])) for side in (-1.0, 1.0)]
    trails = tuple(
        Trail(name, time, *foot, colour) for name, foot, colour in zip(map(gettext, ("left foot", "right foot")), feet, FEET, strict=True)
    )
    disp_unit = length_unit([float(np.abs(response["displacement"]).max())], gal=gal)
    rise = (curves["height"] - block.centroid_height) / disp_unit.size
    level = response.outcome.rocking_threshold_m_s2
    return Animation(
        title=gettext(body_name(block.name)),
        heading=motions_heading([motion]),
        direction=motion.name,
        time=times,
        scene=Scene2D(
            shift=ground_shift(motion, times),
            bodies=(body,),
            floors=tuple(_floors(block, drop, float(np.abs(x).max()))),
            trails=trails,
            close=_close_up(feet, float(x[-1])),
        ),
        strips=(
            ground_strip(motion, (-level, level), gal=gal),
            Strip(gettext("θ (deg)"), (Line(leaning, np.degrees(tilt["rotation"])),)),
            Strip(gettext("rise of G ({unit})", unit=disp_unit.name), (Line(time, rise),)),
        ),
        phases=response.phases,
        colours=COLOURS,
    )


FEET = ("#1f5a8c", "#c0392b")
"""Colours of the paths of the left and right foot."""


def _layers(block: TwoLayerBlock) -> tuple[Piece, ...]:
    """Return the outlines of both layers relative to the centroid."""
    half, centroid_height = block.width / 2, block.centroid_height
    lower = rectangle(-half, half, -centroid_height, block.lower_height - centroid_height)
    upper = rectangle(-half, half, block.lower_height - centroid_height, block.height - centroid_height)
    return Piece(lower, "#efe9dc"), Piece(upper, "#b5a58a")


def _floors(block: TwoLayerBlock, drop: float, reach: float) -> list[FloatArray]:
    """Return the ground, and the stones under the feet if the block stands above it."""
    half_width, depth = 4.0 * (block.width + reach) + 2.0, block.height
    ground = rectangle(-half_width, half_width, -drop - depth, -drop)
    if drop == 0.0:
        return [ground]
    half, stone = block.width / 2, PEDESTAL * block.width
    return [ground, *(rectangle(side * half - stone, side * half + stone, -drop, 0.0) for side in (-1.0, 1.0))]


def _close_up(feet: list[tuple[FloatArray, FloatArray]], displacement: float) -> Box:
    """Return the window around the path of the foot on the side of the displacement."""
    x, z = feet[1] if displacement >= 0.0 else feet[0]
    size = 1.2 * max(float(np.ptp(x)), float(np.ptp(z)), 0.02)
    middle_x, middle_z = (float(np.min(v) + np.max(v)) / 2 for v in (x, z))
    return middle_x - size / 2, middle_x + size / 2, middle_z - 0.55 * size, middle_z + 0.45 * size

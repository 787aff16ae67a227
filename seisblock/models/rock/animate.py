"""Animation of a rocking block, with record and tilt below."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from seisblock.bodies.block import Block
from seisblock.bodies.body_name import body_name
from seisblock.core.i18n import gettext
from seisblock.core.results import Response
from seisblock.core.typing import FloatArray
from seisblock.models.rock.outcome import RockOutcome
from seisblock.models.rock.plot import COLOURS, motion_interval
from seisblock.output.animation.animation import Animation, Line, Strip, ground_strip, sample_at
from seisblock.output.animation.render import REAL_TIME, AnimationOptions
from seisblock.output.animation.scene2d import Body, Piece, Scene2D, ground_shift, rectangle, rotate
from seisblock.output.animation.writers import write_animation
from seisblock.output.figures.heading import motions_heading


def animate(response: Response[RockOutcome], path: Path | str, options: AnimationOptions = REAL_TIME) -> None:
    """Write the animation of a rocking block, to scale and by default in real time.

    Parameters
    ----------
    response : Response
        Result of :func:`~seisblock.models.rock.solve.solve_rock`.
    path : path
        ``.gif``, ``.mp4`` or ``.html``.
    options : AnimationOptions
        Speed, units and progress callback.
    """
    write_animation(lambda times: rocking_animation(response, times, gal=options.gal), motion_interval(response), path, options)


def rocking_animation(response: Response[RockOutcome], times: FloatArray, *, gal: bool = True) -> Animation:
    """Return the animation of a rocking block for the times of its frames, (n,), s."""
    block: Block = response.body
    motion, outcome = response.motion, response.outcome
    tilt = sample_at(times, response.time, response["rotation"])
    origins = np.array([corners(block, float(theta))[0] for theta in tilt])
    outline = corners(block, 0.0)
    piece = outline - outline[0]
    level = outcome.threshold_m_s2
    alpha = math.degrees(outcome.slenderness_rad)
    half_width = 4.0 * math.hypot(block.width, block.height)
    return Animation(
        title=gettext(body_name(block.name)),
        heading=motions_heading([motion]),
        direction=motion.name,
        time=times,
        scene=Scene2D(
            shift=ground_shift(motion, times),
            bodies=(Body((Piece(piece),), origins[:, 0], ground_heights(piece, origins[:, 1], tilt), tilt),),
            floors=(rectangle(-half_width, half_width, -block.height, 0.0),),
        ),
        strips=(
            ground_strip(motion, (-level, level), gal=gal),
            Strip(gettext("θ (deg)"), (Line(response.time, np.degrees(response["rotation"])),), (-alpha, alpha)),
        ),
        phases=response.phases,
        colours=COLOURS,
    )


def corners(block: Block, theta: float) -> FloatArray:
    """Return the corners of the tilted block, (4, 2), or (6, 2) with worn edges, m, from the middle of its base at rest."""
    half, top, bevel = block.width / 2, block.height, block.inset
    base = [[bevel - half, 0.0], [half - bevel, 0.0]]
    sides = [[half, bevel], [half, top], [-half, top], [-half, bevel]] if bevel else [[half, top], [-half, top]]
    at_rest = np.array([*base, *sides])
    return _rotate_about_corner(at_rest, block, theta)


def ground_heights(outline: FloatArray, z: FloatArray, turn: FloatArray) -> FloatArray:
    """Return heights of the origin of a body, (n,), m, with no corner below the ground.

    In the models a block with worn edges keeps its pivot while overturning; beyond 45 degrees it is drawn on its bevel, then on its side.

    Parameters
    ----------
    outline : (k, 2) array, m
        Corners about the origin, upright.
    z, turn : (n,) arrays, m, rad
        Height of the origin above the ground, and tilt.
    """
    # vertical position of the lowest corner after rotation by `turn`
    lowest = (np.outer(np.cos(turn), outline[:, 1]) - np.outer(np.sin(turn), outline[:, 0])).min(axis=1)
    return z - np.minimum(z + lowest, 0.0)


def _rotate_about_corner(points: FloatArray, block: Block, theta: float) -> FloatArray:
    """Rotate points about the corner in contact, the right one for positive tilt."""
    pivot = np.array([math.copysign(block.width / 2 - block.inset, theta), 0.0])
    return rotate(points - pivot, theta) + pivot

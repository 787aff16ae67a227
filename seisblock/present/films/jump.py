"""The jump as a film: the pavilion on its shaking ground, the path of its feet enlarged, the record below."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from seisblock.bodies.two_layer import TwoLayerBlock
from seisblock.present.figures.between import with_points_between
from seisblock.present.figures.heading import heading_of
from seisblock.present.figures.jump import COLOURS
from seisblock.present.films.animation import Filming
from seisblock.present.films.film import Film, Line, Strip, at, ground_strip, stretch, titled
from seisblock.present.films.plane import Body, Box, Piece, Plane, Trail, ground_shift, rectangle
from seisblock.present.films.projector import animate_film
from seisblock.present.scales import length_unit
from seisblock.results import Response
from seisblock.solvers.jump.chain import ROCKING
from seisblock.solvers.jump.solve import JumpOutcome
from seisblock.typing import FloatArray
from seisblock.words import tell

PEDESTAL = 0.06
"""Half width of the stone under each foot, a share of the block's width."""


def animate_jump(response: Response[JumpOutcome], path: Path | str, filming: Filming) -> None:
    """Write the film of a jump, see :func:`seisblock.present.films.projector.animate_film`."""
    span = stretch(response.phases, COLOURS, float(response.motion.time[0]), float(max(response.motion.time[-1], response.time[-1])))
    animate_film(lambda times: jump_film(response, times, gal=filming.gal), span, path, filming)


def jump_film(response: Response[JumpOutcome], times: FloatArray, *, gal: bool = True) -> Film:
    """Return the film of a jump for the times of its pictures, (n,), s."""
    block: TwoLayerBlock = response.body
    motion, drop = response.motion, float(response.options["drop_m"])
    time, drawn = with_points_between(response)
    leaning, tilt = with_points_between(response, [ROCKING])
    x, z, turn = (at(times, time, drawn[name]) for name in ("displacement", "height", "rotation"))
    body = Body(_pieces(block), x, z, turn)
    half, below = block.width / 2, -block.centroid_height
    exact = Body((), drawn["displacement"], drawn["height"], drawn["rotation"])
    feet = [exact.path(np.array([side * half, below])) for side in (-1.0, 1.0)]
    trails = tuple(
        Trail(name, time, *foot, colour) for name, foot, colour in zip(map(tell, ("left foot", "right foot")), feet, FEET, strict=True)
    )
    far = length_unit([float(np.abs(response["displacement"]).max())], gal=gal)
    rise = (drawn["height"] - block.centroid_height) / far.size
    level = response.outcome.rocking_threshold_m_s2
    return Film(
        title=titled(block.name, response.outcome.outcome),
        heading=heading_of([motion]),
        direction=motion.name,
        time=times,
        scene=Plane(
            shift=ground_shift(motion, times),
            bodies=(body,),
            floors=tuple(_floors(block, drop, float(np.abs(x).max()))),
            trails=trails,
            close=_close(feet, float(x[-1]), drop),
        ),
        strips=(
            ground_strip(motion, (-level, level), gal=gal),
            Strip(tell("θ (deg)"), (Line(leaning, np.degrees(tilt["rotation"])),)),
            Strip(tell("rise of G ({unit})", unit=far.name), (Line(time, rise),)),
        ),
        phases=response.phases,
        colours=COLOURS,
    )


FEET = ("#1f5a8c", "#c0392b")
"""Colours of the paths of the left and the right foot."""


def _pieces(block: TwoLayerBlock) -> tuple[Piece, ...]:
    """Return both layers about the centroid."""
    half, down = block.width / 2, block.centroid_height
    lower = rectangle(-half, half, -down, block.lower_height - down)
    upper = rectangle(-half, half, block.lower_height - down, block.height - down)
    return Piece(lower, "#efe9dc"), Piece(upper, "#b5a58a")


def _floors(block: TwoLayerBlock, drop: float, reach: float) -> list[FloatArray]:
    """Return the ground, and when the block stands above it the stones under its feet."""
    wide, deep = 4.0 * (block.width + reach) + 2.0, block.height
    ground = rectangle(-wide, wide, -drop - deep, -drop)
    if drop == 0.0:
        return [ground]
    half, stone = block.width / 2, PEDESTAL * block.width
    return [ground, *(rectangle(side * half - stone, side * half + stone, -drop, 0.0) for side in (-1.0, 1.0))]


def _close(feet: list[tuple[FloatArray, FloatArray]], moved: float, drop: float) -> Box:
    """Return the window about the path of the foot towards which the block goes."""
    x, z = feet[1] if moved >= 0.0 else feet[0]
    size = 1.2 * max(float(np.ptp(x)), float(np.ptp(z)), 0.02)
    middle_x, middle_z = (float(np.min(v) + np.max(v)) / 2 for v in (x, z))
    return middle_x - size / 2, middle_x + size / 2, middle_z - 0.55 * size, middle_z + 0.45 * size

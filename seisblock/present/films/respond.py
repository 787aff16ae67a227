"""A free-standing object on its shaking ground, with the record, its displacement and its lean running below."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from seisblock.bodies.block import Block
from seisblock.present.figures.heading import heading_of
from seisblock.present.figures.respond import COLOURS, stretch
from seisblock.present.films.animation import REAL_TIME, Filming
from seisblock.present.films.film import Film, Line, Strip, at, ground_strip, titled
from seisblock.present.films.plane import Body, Piece, Plane, Trail, ground_shift, rectangle
from seisblock.present.films.projector import animate_film
from seisblock.present.films.rock import corners, on_the_ground
from seisblock.present.scales import length_unit
from seisblock.present.text.onset import grip
from seisblock.results import Response
from seisblock.solvers.respond.outcome import RespondOutcome
from seisblock.typing import FloatArray
from seisblock.words import tell


def animate_respond(response: Response[RespondOutcome], path: Path | str, filming: Filming = REAL_TIME) -> None:
    """Write the film of a free-standing object, see :func:`seisblock.present.films.projector.animate_film`."""
    animate_film(lambda times: respond_film(response, times, gal=filming.gal), stretch(response), path, filming)


def respond_film(response: Response[RespondOutcome], times: FloatArray, *, gal: bool = True) -> Film:
    """Return the film for the times of its pictures, (n,), s."""
    block: Block = response.body
    motion, outcome, options = response.motion, response.outcome, response.options
    centre = np.array([block.centroid_offset, block.centre])
    outline = corners(block, 0.0) - centre
    x, z, lean = (at(times, response.time, response[name]) for name in ("displacement", "height", "rotation"))
    level = options["gravity_m_s2"] * min(grip(options), min(block.arms) / block.centre)
    alpha = math.degrees(block.slenderness)
    wide = 4.0 * math.hypot(block.width, block.height) + 2.0 * outcome.max_displacement_m
    far = length_unit([outcome.max_displacement_m], gal=gal)
    return Film(
        title=titled(block.name, outcome.outcome),
        heading=heading_of([motion]),
        direction=motion.name,
        time=times,
        scene=Plane(
            shift=ground_shift(motion, times),
            bodies=(Body((Piece(outline),), block.centroid_offset + x, on_the_ground(outline, z, lean), lean),),
            floors=(rectangle(-wide, wide, -block.height, 0.0),),
            trails=(Trail(tell("centre of gravity"), response.time, block.centroid_offset + response["displacement"], response["height"]),),
        ),
        strips=(
            ground_strip(motion, (-level, level), gal=gal),
            Strip(tell("x ({unit})", unit=far.name), (Line(response.time, response["displacement"] / far.size, "#1f5a8c"),)),
            Strip(tell("θ (deg)"), (Line(response.time, np.degrees(response["rotation"])),), (-alpha, alpha)),
        ),
        phases=response.phases,
        colours=COLOURS,
    )

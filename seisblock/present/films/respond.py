"""A free-standing object on its shaking ground, with the record, its displacement and its lean running below."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from seisblock.bodies.block import Block
from seisblock.present.figures.respond import COLOURS, stretch
from seisblock.present.films.animation import REAL_TIME, Filming
from seisblock.present.films.film import Body, Film, Piece, Strip, Trail, at, ground_shift, rectangle, titled
from seisblock.present.films.projector import animate_film
from seisblock.present.films.rock import corners
from seisblock.results import Response
from seisblock.solvers.respond.outcome import RespondOutcome
from seisblock.typing import FloatArray


def animate_respond(response: Response[RespondOutcome], path: Path | str, filming: Filming = REAL_TIME) -> None:
    """Write the film of a free-standing object, see :func:`seisblock.present.films.projector.animate_film`."""
    animate_film(lambda times: respond_film(response, times), stretch(response), path, filming)


def respond_film(response: Response[RespondOutcome], times: FloatArray) -> Film:
    """Return the film for the times of its pictures, (n,), s."""
    block: Block = response.body
    motion, outcome, options = response.motion, response.outcome, response.options
    centre = np.array([block.centroid_offset, block.centre])
    outline = corners(block, 0.0) - centre
    x, z, lean = (at(times, response.time, response[name]) for name in ("displacement", "height", "rotation"))
    level = 100.0 * options["gravity_m_s2"] * min(options["mu"], min(block.arms) / block.centre)
    alpha = math.degrees(block.slenderness)
    wide = 4.0 * math.hypot(block.width, block.height) + 2.0 * outcome.max_displacement_m
    return Film(
        title=titled(motion.name, block.name, outcome.outcome),
        time=times,
        shift=ground_shift(motion, times),
        bodies=(Body((Piece(outline),), block.centroid_offset + x, z, lean),),
        floors=(rectangle(-wide, wide, -block.height, 0.0),),
        trails=(Trail("centre", block.centroid_offset + x, z),),
        strips=(
            Strip("a (gal)", motion.time, motion.horizontal * 100.0, (-level, level), "#737373"),
            Strip("x (cm)", response.time, response["displacement"] * 100.0, (), "#1f5a8c"),
            Strip("θ (deg)", response.time, np.degrees(response["rotation"]), (-alpha, alpha)),
        ),
        phases=response.phases,
        colours=COLOURS,
    )

"""A block on its corner springs, in three dimensions, its motion magnified, with the record and the rise of its corners below."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from seisblock.bodies.spring_block import CORNERS, SpringBlock
from seisblock.present.figures.heading import heading_of
from seisblock.present.figures.uplift import LIFTED, stretch
from seisblock.present.films.animation import REAL_TIME, Filming
from seisblock.present.films.film import Film, Line, Strip, at, ground_strip, titled
from seisblock.present.films.projector import animate_film
from seisblock.present.films.space import MOMENTS, Solid, Space, Spring, ground_path
from seisblock.present.scales import length_unit
from seisblock.results import Phase, Response
from seisblock.solvers.uplift.model import WHOLE_BASE, contact_name
from seisblock.solvers.uplift.outcome import UpliftOutcome
from seisblock.typing import FloatArray
from seisblock.words import noted, tell

MOST_LEAN, MOST_RISE = 0.15, 0.15
"""Largest lean, rad, and rise, of the height, that are drawn: smaller ones are magnified up to it, by a round factor."""

FREE = 0.16
"""Height at which a spring is drawn when nothing presses on it, of the block's."""

COLOURS = ("#c0392b", "#1f5a8c", "#7d7d7d", "#b8860b")
DASHES: tuple[tuple[float, ...], ...] = ((), (6, 2), (2, 1.5), (6, 2, 1, 2))
"""Of the corners."""

IN_AIR = noted("a corner in the air")
LIFTS, STAYS, BEYOND = noted("a corner lifts"), noted("no corner lifts"), noted("lifts beyond what the model holds for")


def animate_uplift(response: Response[UpliftOutcome], path: Path | str, filming: Filming = REAL_TIME) -> None:
    """Write the film of a block on springs, see :func:`seisblock.present.films.projector.animate_film`."""
    animate_film(lambda times: uplift_film(response, times, gal=filming.gal), stretch(response), path, filming, rate=MOMENTS)


def uplift_film(response: Response[UpliftOutcome], times: FloatArray, *, gal: bool = True) -> Film:
    """Return the film of a block on springs for the times of its pictures, (n,), s."""
    body: SpringBlock = response.body
    motion, outcome = response.motion, response.outcome
    factor = magnification(response)
    what = BEYOND if not outcome.within_model else LIFTS if outcome.uplifts else STAYS
    far = length_unit((corner.max_uplift_m for corner in outcome.corners), gal=gal)
    lines = tuple(
        Line(response.time, response[f"uplift_{i + 1}"] / far.size, COLOURS[i], tell("corner {number}", number=i + 1), DASHES[i])
        for i in range(len(CORNERS))
    )
    return Film(
        title=titled(f"{body.width:g} × {body.depth:g} × {body.height:g} m", what),
        heading=heading_of([motion]),
        direction=motion.name,
        note=tell("motion on the springs drawn {factor:g} times as large; +x = {name}", factor=factor, name=motion.name or "x"),
        time=times,
        scene=_scene(response, times, factor),
        strips=(ground_strip(motion, gal=gal), Strip(tell("u ({unit})", unit=far.name), lines, (0.0,))),
        phases=_lifts(response),
        colours={IN_AIR: LIFTED},
    )


def magnification(response: Response[UpliftOutcome]) -> float:
    """Return by which factor the motion on the springs is drawn: 1, 2, 5, 10 ..., or less than 1 for what is no small motion."""
    rise = max(float(np.abs(response[f"uplift_{i + 1}"]).max()) for i in range(len(CORNERS)))
    room = min(MOST_LEAN / max(response.outcome.max_rotation_rad, 1e-12), MOST_RISE * response.body.height / max(rise, 1e-12))
    decade = 10.0 ** math.floor(math.log10(room))
    return decade * max(step for step in (1.0, 2.0, 5.0) if step * decade <= room)


def _scene(response: Response[UpliftOutcome], times: FloatArray, factor: float) -> Space:
    """Return the block and its springs, everything relative to the ground magnified."""
    body: SpringBlock = response.body
    along, across, up, lean, aside = (
        factor * at(times, response.time, response[name])
        for name in ("displacement", "displacement_across", "displacement_up", "rotation", "rotation_across")
    )
    # positive leans to +x and +y are turns about +y and -x
    turns = Rotation.from_rotvec(np.column_stack([-aside, lean, np.zeros_like(lean)]))
    free = FREE * body.height
    centre = np.column_stack([along, across, free + 0.5 * body.height + up])
    corners = [np.array([x * body.width / 2, y * body.depth / 2, -body.height / 2]) for x, y in CORNERS]
    tops = [centre + turns.apply(corner) for corner in corners]
    for i, top in enumerate(tops):
        # the corner's own height: whether it touches its spring must not hang on the curvature of a magnified turn
        top[:, 2] = free + factor * at(times, response.time, response[f"uplift_{i + 1}"])
    springs = tuple(Spring(corner * [1.0, 1.0, 0.0], top, free) for corner, top in zip(corners, tops, strict=True))
    solid = Solid((body.width, body.depth, body.height), centre, np.roll(turns.as_quat(), 1, axis=1))
    motion = response.motion
    moved = ground_path(motion, (True, True, bool(response.options["vertical"])), times)
    return Space(moved, (solid,), 1.1 * max(body.width, body.depth), springs)


def _lifts(response: Response[UpliftOutcome]) -> tuple[Phase, ...]:
    """Return the stretches in which at least one corner is in the air."""
    lifts: list[Phase] = []
    for phase in response.phases:
        if phase.name == contact_name(WHOLE_BASE):
            continue
        joined = bool(lifts) and lifts[-1].end_s == phase.start_s
        start = lifts.pop().start_s if joined else phase.start_s
        lifts.append(Phase(IN_AIR, start, phase.end_s))
    return tuple(lifts)

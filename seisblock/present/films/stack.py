"""The pile in three dimensions on its moving ground, with the record and the tilts and slips of its stones below."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from seisblock.bodies.pile.pile import Pile
from seisblock.present.figures.heading import heading_of
from seisblock.present.figures.stack import largest, slip_of, stretch, style_of, tilt_of
from seisblock.present.films.animation import REAL_TIME, Filming
from seisblock.present.films.film import Film, Line, Strip, ground_strip, titled
from seisblock.present.films.projector import animate_film
from seisblock.present.films.space import MOMENTS, Solid, Space, ground_path
from seisblock.present.scales import length_unit
from seisblock.results import Response
from seisblock.solvers.stack.outcome import StackOutcome
from seisblock.typing import FloatArray
from seisblock.words import listed, tell


def animate_stack(response: Response[StackOutcome], path: Path | str, filming: Filming = REAL_TIME) -> None:
    """Write the film of a pile, see :func:`seisblock.present.films.projector.animate_film`."""
    span = stretch(response, margin=1.5)
    animate_film(lambda times: stack_film(response, times, gal=filming.gal), span, path, filming, rate=MOMENTS)


def stack_film(response: Response[StackOutcome], times: FloatArray, *, gal: bool = True) -> Film:
    """Return the film of a pile for the times of its pictures, (n,), s."""
    body: Pile = response.body
    motion, options = response.motion, response.options
    fell = {stone.name: math.inf if stone.fell_at_s is None else stone.fell_at_s for stone in response.outcome.stones}
    solids = tuple(Solid(stone.size, *_followed(response, stone.name, times), fell[stone.name], stone.is_round) for stone in body.stones)
    size = max(max(stone.width, stone.depth) for stone in body.stones)
    far = length_unit([largest(response, "slip")], gal=gal)
    return Film(
        title=titled(body.name, _fate(response.outcome.overturned)),
        heading=heading_of([motion]),
        direction=motion.name,
        note=f"+x = {motion.name or 'x'}",
        time=times,
        scene=Space(ground_path(motion, (True, bool(options["across"]), bool(options["vertical"])), times), solids, 1.1 * size),
        strips=(
            ground_strip(motion, gal=gal),
            Strip(tell("tilt θ (deg)"), _lines(response, "tilt", math.degrees(1.0))),
            Strip(tell("slip s ({unit})", unit=far.name), _lines(response, "slip", 1.0 / far.size)),
        ),
    )


def _fate(fallen: tuple[str, ...]) -> str:
    """Return what becomes of the pile."""
    if not fallen:
        return tell("every stone stands")
    return tell("{stones} falls" if len(fallen) == 1 else "{stones} fall", stones=listed(map(tell, fallen)))


def _lines(response: Response[StackOutcome], quantity: str, factor: float) -> tuple[Line, ...]:
    """Return one curve per stone, in the colours and dashes of the figure; each ends where its stone falls."""
    lines = []
    for index, stone in enumerate(reversed(response.outcome.stones)):
        values = (slip_of if quantity == "slip" else tilt_of)(response, stone.name) * factor
        colour, dashes = style_of(index)
        style = () if isinstance(dashes, str) else dashes[1]
        lines.append(Line(response.time, values, colour, tell(stone.name), style))
    return tuple(lines)


def _followed(response: Response[StackOutcome], name: str, times: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return where the centre of a stone is at the times of the pictures, and how it is turned, (n, 3), m, and (n, 4)."""
    centre = np.array([np.interp(times, response.time, response[f"{name}_{axis}"]) for axis in "xyz"]).T
    turn = np.array([np.interp(times, response.time, response[f"{name}_q{axis}"]) for axis in "wxyz"]).T
    return centre, turn / np.linalg.norm(turn, axis=1, keepdims=True)

"""A film as one page: its data and the script that draws them, so that it plays at any size and any speed."""

from __future__ import annotations

from typing import Any

import numpy as np

from seisblock.present.figures.curves import thin
from seisblock.present.films.animation import Filming
from seisblock.present.films.film import Film, Strip
from seisblock.present.page import page
from seisblock.typing import FloatArray
from seisblock.words import tell

PACES = (0.02, 0.05, 0.1, 0.25, 0.5, 1.0, 2.0, 4.0)
METRES, RADIANS, SECONDS = 5, 6, 4
"""Decimals that are kept: 0.01 mm, 1e-6 rad, 0.1 ms."""


def film_page(film: Film, filming: Filming) -> str:
    """Return the page of a film.

    Parameters
    ----------
    film : Film
        For as many moments as slow motion needs.
    filming : Filming
        Speed at the start.
    """
    pace = 1.0 / filming.slow
    return page("film.html", film.title, film=film, data=_data(film, filming), pace=pace, paces=_paces(pace))


def _paces(chosen: float) -> list[tuple[float, str]]:
    """Return the choices of speed, the chosen one among them."""
    return [(value, f"× {value:g}" + (f" ({tell('real time')})" if value == 1.0 else "")) for value in sorted({*PACES, chosen})]


def _data(film: Film, filming: Filming) -> dict[str, Any]:
    """Return everything the script draws."""
    return {
        "first": float(film.time[0]),
        "last": float(film.time[-1]),
        "pace": 1.0 / filming.slow,
        "extent": film.extent,
        "close": film.close,
        "shift": _numbers(film.shift, METRES),
        "floors": [_numbers(floor, METRES) for floor in film.floors],
        "bodies": [
            {
                "x": _numbers(body.x, METRES),
                "z": _numbers(body.z, METRES),
                "turn": _numbers(body.turn, RADIANS),
                "pieces": [{"corners": _numbers(piece.corners, METRES), "colour": piece.colour} for piece in body.pieces],
            }
            for body in film.bodies
        ],
        "trails": [{"x": _numbers(t.x, METRES), "z": _numbers(t.z, METRES), "colour": t.colour} for t in film.trails],
        "strips": [_strip(film, strip) for strip in film.strips],
        "phases": [[phase.start_s, phase.end_s, film.colours[phase.name]] for phase in film.seen if phase.name in film.colours],
        "names": [[phase.start_s, phase.end_s, tell(phase.name)] for phase in film.seen],
        "words": {"play": tell("play"), "pause": tell("pause")},
    }


def _strip(film: Film, strip: Strip) -> dict[str, Any]:
    """Return one curve over the time shown, with the range of its axis."""
    inside = (strip.time >= film.time[0]) & (strip.time <= film.time[-1])
    time, values = thin(strip.time[inside], strip.values[inside], 3000)
    low, high = float(np.min(values, initial=0.0)), float(np.max(values, initial=0.0))
    margin = 0.08 * (high - low) or 1.0
    return {
        "label": strip.label,
        "time": _numbers(time, SECONDS),
        "values": [float(f"{v:.5g}") for v in values],
        "levels": strip.levels,
        "colour": strip.colour,
        "inner": [low, high],
        "range": [low - margin, high + margin],
    }


def _numbers(values: FloatArray, decimals: int) -> Any:
    """Return rounded numbers; adding zero after rounding turns -0.0 into 0.0."""
    return (np.round(values, decimals) + 0.0).tolist()

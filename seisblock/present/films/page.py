"""A film as one page: its data and the script that draws them, so that it plays at any size and any speed."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from seisblock.present.directions import side
from seisblock.present.figures.canvas import BETWEEN
from seisblock.present.figures.curves import extremes, in_view, thin
from seisblock.present.films.animation import Filming
from seisblock.present.films.film import Film, Strip
from seisblock.present.films.plane import Plane, Trail
from seisblock.present.films.space import AZIMUTH, ELEVATION, LIGHT, STONE, Solid, Space, Spring
from seisblock.present.page import page
from seisblock.typing import FloatArray
from seisblock.words import tell

PACES = (0.02, 0.05, 0.1, 0.25, 0.5, 1.0, 2.0, 4.0)
METRES, RADIANS, SECONDS = 5, 6, 4
"""Decimals that are kept: 0.01 mm, 1e-6 rad, 0.1 ms."""

IN_SPACE = 4
"""Decimals of metres and quaternions in a scene in three dimensions: 0.1 mm."""

WAYS = 36
"""Directions from which it is told what a scene in three dimensions takes of the picture; between them it changes evenly."""

MOST_POINTS, MOST_ON_PATH = 3000, 8000
"""Of a curve against time, and of the path of a point."""


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
    named = {phase.name: film.colours[phase.name] for phase in film.seen if phase.name in film.colours}
    return page(
        "film.html",
        film.title,
        subtitles=[film.heading.replace(BETWEEN, " · ")],
        note=film.note,
        strips=len(film.panels),
        close=isinstance(film.scene, Plane) and film.scene.close is not None,
        space=isinstance(film.scene, Space),
        trails=[(trail.name, trail.colour) for trail in film.scene.trails] if isinstance(film.scene, Plane) else [],
        phases=[(film.called(name), colour) for name, colour in named.items()],
        lines=_lines(film),
        data=_data(film, filming),
        pace=pace,
        paces=_paces(pace),
    )


def _paces(chosen: float) -> list[tuple[float, str]]:
    """Return the choices of speed, the chosen one among them."""
    return [(value, tell("× {pace:g} (real time)", pace=value) if value == 1.0 else f"× {value:g}") for value in sorted({*PACES, chosen})]


def _lines(film: Film) -> list[tuple[str, str, str]]:
    """Return the curves that have a name: name, colour, and the style of a border that looks like them."""
    found = {}
    for line in (line for strip in film.panels for line in strip.lines if line.name):
        found[line.name] = (line.colour, "solid" if not line.dashes else "dashed" if line.dashes[0] > 2 else "dotted")
    return [(name, *style) for name, style in found.items()]


def _data(film: Film, filming: Filming) -> dict[str, Any]:
    """Return everything the script draws."""
    return {
        "first": float(film.time[0]),
        "last": float(film.time[-1]),
        "count": int(film.time.size),
        "along": side(film.direction, 1.0),
        "pace": 1.0 / filming.slow,
        "si": not filming.gal,
        "scene": _plane(film.scene, float(film.time[0]), float(film.time[-1])) if isinstance(film.scene, Plane) else _space(film.scene),
        "strips": [_strip(film, strip) for strip in film.panels],
        "phases": [[phase.start_s, phase.end_s, film.colours[phase.name]] for phase in film.seen if phase.name in film.colours],
        "names": [[phase.start_s, phase.end_s, film.called(phase.name)] for phase in film.seen],
        "words": {"play": tell("play"), "pause": tell("pause")},
    }


def _plane(scene: Plane, first: float, last: float) -> dict[str, Any]:
    """Return a scene from the side."""
    return {
        "extent": scene.extent,
        "close": scene.close,
        "shift": _numbers(scene.shift, METRES),
        "floors": [_numbers(floor, METRES) for floor in scene.floors],
        "bodies": [
            {
                "x": _numbers(body.x, METRES),
                "z": _numbers(body.z, METRES),
                "turn": _numbers(body.turn, RADIANS),
                "pieces": [{"corners": _numbers(piece.corners, METRES), "colour": piece.colour} for piece in body.pieces],
            }
            for body in scene.bodies
        ],
        "trails": [_trail(trail, first, last) for trail in scene.trails],
    }


def _trail(trail: Trail, first: float, last: float) -> dict[str, Any]:
    """Return the path of a point between two times; of too many points those furthest to either side, up and down."""
    kept = np.flatnonzero((trail.time >= first) & (trail.time <= last))
    if kept.size > MOST_ON_PATH:
        kept = kept[np.union1d(*(extremes(trail.time[kept], values[kept], MOST_ON_PATH // 2) for values in (trail.x, trail.z)))]
    time, x, z = (_numbers(values[kept], digits) for values, digits in ((trail.time, SECONDS), (trail.x, METRES), (trail.z, METRES)))
    return {"time": time, "x": x, "z": z, "colour": trail.colour}


def _space(scene: Space) -> dict[str, Any]:
    """Return a scene in three dimensions."""
    return {
        "extents": [_numbers(np.array(scene.extent(azimuth)), IN_SPACE) for azimuth in AZIMUTH + 2.0 * math.pi * np.arange(WAYS) / WAYS],
        "view": [AZIMUTH, ELEVATION],
        "half": scene.half,
        "patch": [_numbers(corner, METRES) for corner in scene.patch],
        "stone": STONE.tolist(),
        "light": LIGHT.tolist(),
        "moved": _columns(scene.moved),
        "solids": [_solid(solid) for solid in scene.solids],
        "springs": [_spring(spring) for spring in scene.springs],
    }


def _solid(solid: Solid) -> dict[str, Any]:
    """Return a cuboid or a cylinder."""
    fell = solid.fell_s if math.isfinite(solid.fell_s) else None
    return {
        "size": solid.size,
        "centre": _columns(solid.centre),
        "turn": _columns(solid.turn),
        "fell": fell,
        "round": solid.is_round,
    }


def _spring(spring: Spring) -> dict[str, Any]:
    """Return a spring under a corner."""
    return {"foot": _numbers(spring.foot, METRES), "free": spring.free, "top": _columns(spring.top)}


def _columns(values: FloatArray) -> list[Any]:
    """Return the columns of an (n, k) array; one that never changes is a single number."""
    rounded = (np.round(values, IN_SPACE) + 0.0).T
    return [float(row[0]) if (row == row[0]).all() else row.tolist() for row in rounded]


def _strip(film: Film, strip: Strip) -> dict[str, Any]:
    """Return the curves of a strip over the time shown, with the range of its axis."""
    first, last = float(film.time[0]), float(film.time[-1])
    low, high = strip.range_over(first, last)
    margin = 0.08 * (high - low)
    lines = []
    for line in strip.lines:
        time, values = thin(*in_view(line.time, line.values, first, last), MOST_POINTS)
        kept = [float(f"{value:.5g}") if math.isfinite(value) else None for value in values]
        lines.append({"time": _numbers(time, SECONDS), "values": kept, "colour": line.colour, "dashes": line.dashes})
    return {"label": strip.label, "lines": lines, "levels": strip.levels, "inner": [low, high], "range": [low - margin, high + margin]}


def _numbers(values: FloatArray, decimals: int) -> Any:
    """Return rounded numbers; adding zero after rounding turns -0.0 into 0.0."""
    return (np.round(values, decimals) + 0.0).tolist()

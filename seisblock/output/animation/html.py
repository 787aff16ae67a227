"""Animation as a self-contained HTML page, drawn by a script at any size and speed."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from seisblock.core.i18n import gettext
from seisblock.core.typing import FloatArray
from seisblock.output.animation.animation import Animation, Strip
from seisblock.output.animation.render import AnimationOptions
from seisblock.output.animation.scene2d import Scene2D, Trail
from seisblock.output.animation.scene3d import AZIMUTH, ELEVATION, LIGHT, STONE, Scene3D, Solid, Spring
from seisblock.output.directions import direction_label
from seisblock.output.figures.curves import bin_extremes, decimate, in_view
from seisblock.output.figures.style import SEPARATOR
from seisblock.output.templating import render_page

SPEEDS = (0.02, 0.05, 0.1, 0.25, 0.5, 1.0, 2.0, 4.0)
LENGTH_DECIMALS, ANGLE_DECIMALS, TIME_DECIMALS = 5, 6, 4
"""Decimals of lengths, angles and times: 0.01 mm, 1e-6 rad, 0.1 ms."""

SCENE3D_DECIMALS = 4
"""Decimals of metres and quaternions in 3-D scenes: 0.1 mm."""

VIEW_AZIMUTHS = 36
"""View azimuths for which the extent of a 3-D scene is stored; the script interpolates between them."""

MAX_POINTS, MAX_PATH_POINTS = 3000, 8000
"""Points of a curve against time, and of the path of a point, at most."""


def animation_html(film: Animation, options: AnimationOptions) -> str:
    """Return the page of an animation.

    Parameters
    ----------
    film : Animation
        Built for enough times that slow motion is smooth.
    options : AnimationOptions
        Units and initial speed.
    """
    speed = 1.0 / options.slow
    phase_colours = {phase.name: film.colours[phase.name] for phase in film.visible_phases if phase.name in film.colours}
    return render_page(
        "film.html",
        film.title,
        subtitles=[film.heading.replace(SEPARATOR, " · ")],
        note=film.note,
        strips=len(film.panels),
        close=isinstance(film.scene, Scene2D) and film.scene.close is not None,
        space=isinstance(film.scene, Scene3D),
        trails=[(trail.name, trail.colour) for trail in film.scene.trails] if isinstance(film.scene, Scene2D) else [],
        phases=[(film.phase_label(name), colour) for name, colour in phase_colours.items()],
        lines=_lines(film),
        data=_data(film, options),
        pace=speed,
        paces=_speed_choices(speed),
    )


def _speed_choices(speed: float) -> list[tuple[float, str]]:
    """Return value and label of the speeds offered, the initial one included."""
    return [
        (value, gettext("× {pace:g} (real time)", pace=value) if value == 1.0 else f"× {value:g}") for value in sorted({*SPEEDS, speed})
    ]


def _lines(film: Animation) -> list[tuple[str, str, str]]:
    """Return the legend of the named curves: name, colour, CSS border style."""
    styles = {}
    for line in (line for strip in film.panels for line in strip.lines if line.name):
        styles[line.name] = (line.colour, "solid" if not line.dashes else "dashed" if line.dashes[0] > 2 else "dotted")
    return [(name, *style) for name, style in styles.items()]


def _data(film: Animation, options: AnimationOptions) -> dict[str, Any]:
    """Return the data of the page script."""
    return {
        "first": float(film.time[0]),
        "last": float(film.time[-1]),
        "count": int(film.time.size),
        "along": direction_label(film.direction, 1.0),
        "pace": 1.0 / options.slow,
        "si": not options.gal,
        "scene": _plane(film.scene, float(film.time[0]), float(film.time[-1])) if isinstance(film.scene, Scene2D) else _space(film.scene),
        "strips": [_strip(film, strip) for strip in film.panels],
        "phases": [[phase.start_s, phase.end_s, film.colours[phase.name]] for phase in film.visible_phases if phase.name in film.colours],
        "names": [[phase.start_s, phase.end_s, film.phase_label(phase.name)] for phase in film.visible_phases],
        "words": {"play": gettext("play"), "pause": gettext("pause")},
    }


def _plane(scene: Scene2D, first: float, last: float) -> dict[str, Any]:
    return {
        "extent": scene.extent,
        "close": scene.close,
        "shift": _numbers(scene.shift, LENGTH_DECIMALS),
        "floors": [_numbers(floor, LENGTH_DECIMALS) for floor in scene.floors],
        "bodies": [
            {
                "x": _numbers(body.x, LENGTH_DECIMALS),
                "z": _numbers(body.z, LENGTH_DECIMALS),
                "turn": _numbers(body.turn, ANGLE_DECIMALS),
                "pieces": [{"corners": _numbers(piece.corners, LENGTH_DECIMALS), "colour": piece.colour} for piece in body.pieces],
            }
            for body in scene.bodies
        ],
        "trails": [_trail(trail, first, last) for trail in scene.trails],
    }


def _trail(trail: Trail, first: float, last: float) -> dict[str, Any]:
    """Return the path of a point between two times, thinned to the extremes of x and z if too long."""
    index = np.flatnonzero((trail.time >= first) & (trail.time <= last))
    if index.size > MAX_PATH_POINTS:
        index = index[np.union1d(*(bin_extremes(trail.time[index], values[index], MAX_PATH_POINTS // 2) for values in (trail.x, trail.z)))]
    time, x, z = (
        _numbers(values[index], digits)
        for values, digits in ((trail.time, TIME_DECIMALS), (trail.x, LENGTH_DECIMALS), (trail.z, LENGTH_DECIMALS))
    )
    return {"time": time, "x": x, "z": z, "colour": trail.colour}


def _space(scene: Scene3D) -> dict[str, Any]:
    return {
        "extents": [
            _numbers(np.array(scene.extent(azimuth)), SCENE3D_DECIMALS)
            for azimuth in AZIMUTH + 2.0 * math.pi * np.arange(VIEW_AZIMUTHS) / VIEW_AZIMUTHS
        ],
        "view": [AZIMUTH, ELEVATION],
        "half": scene.half,
        "patch": [_numbers(corner, LENGTH_DECIMALS) for corner in scene.patch],
        "stone": STONE.tolist(),
        "light": LIGHT.tolist(),
        "ground": _columns(scene.ground_displacement),
        "solids": [_solid(solid) for solid in scene.solids],
        "springs": [_spring(spring) for spring in scene.springs],
    }


def _solid(solid: Solid) -> dict[str, Any]:
    fell = solid.fell_s if math.isfinite(solid.fell_s) else None
    return {
        "size": solid.size,
        "centre": _columns(solid.centre),
        "turn": _columns(solid.turn),
        "fell": fell,
        "round": solid.is_round,
        "hull": None if solid.hull is None else [_numbers(corner, LENGTH_DECIMALS) for corner in solid.hull],
        "faces": [] if solid.hull is None else solid.sides,
    }


def _spring(spring: Spring) -> dict[str, Any]:
    return {"foot": _numbers(spring.foot, LENGTH_DECIMALS), "free": spring.free, "top": _columns(spring.top)}


def _columns(values: FloatArray) -> list[Any]:
    """Return the columns of an (n, k) array; a constant column is a single number."""
    rounded = (np.round(values, SCENE3D_DECIMALS) + 0.0).T
    return [float(row[0]) if (row == row[0]).all() else row.tolist() for row in rounded]


def _strip(film: Animation, strip: Strip) -> dict[str, Any]:
    """Return the curves of a strip in the time shown, with the range of the axis."""
    first, last = float(film.time[0]), float(film.time[-1])
    low, high = strip.range_over(first, last)
    margin = 0.08 * (high - low)
    lines = []
    for line in strip.lines:
        time, values = decimate(*in_view(line.time, line.values, first, last), MAX_POINTS)
        numbers = [float(f"{value:.5g}") if math.isfinite(value) else None for value in values]
        lines.append({"time": _numbers(time, TIME_DECIMALS), "values": numbers, "colour": line.colour, "dashes": line.dashes})
    return {"label": strip.label, "lines": lines, "levels": strip.levels, "inner": [low, high], "range": [low - margin, high + margin]}


def _numbers(values: FloatArray, decimals: int) -> Any:
    """Return rounded numbers; adding zero turns -0.0 into 0.0."""
    return (np.round(values, decimals) + 0.0).tolist()

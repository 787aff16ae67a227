"""What becomes of a body in every direction: a rose for each record, in which falls stand out."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from seisblock.present.directions import side
from seisblock.present.figures import canvas
from seisblock.present.figures.body import rose
from seisblock.present.figures.heading import heading_over, name_of
from seisblock.present.figures.spectrum import FELL, ROCKED
from seisblock.present.scales import length_unit
from seisblock.results import Response
from seisblock.words import tell

Directions = Sequence[Any]

RIM = 1.0
"""Lean over alpha at the rim of a rose: what falls reaches it."""


def figure(responses: Sequence[Response[Any]], directions: Sequence[Directions], *, gal: bool = True) -> Figure:
    """Return the figure: per record a rose of the largest lean over alpha and, of what slides, one of the furthest displacement.

    Parameters
    ----------
    responses : sequence of Response
        That of the worst direction, for each record.
    directions : sequence of sequences
        What became of the body in each direction.
    gal : bool
        Displacements in cm, else m.
    """
    slides = any(hasattr(each, "max_displacement_m") for found in directions for each in found)
    made = _drawn(responses, directions, slides=slides, stacked=False, gal=gal)
    made.stacked = lambda: _drawn(responses, directions, slides=slides, stacked=True, gal=gal)
    return made


def _drawn(responses: Sequence[Response[Any]], directions: Sequence[Directions], *, slides: bool, stacked: bool, gal: bool) -> canvas.Sheet:
    """Return the figure, the roses of a record beside or below each other."""
    across, down = 1 + slides, len(responses)
    rows, columns = (across * down, 1) if stacked else (down, across)
    title = heading_over([response.motion.record for response in responses], [tell("all azimuths")])
    made = canvas.titled(title, width=0.6 + 4.4 * columns, height=1.0 + 4.2 * rows)
    for row, (response, found) in enumerate(zip(responses, directions, strict=True)):
        record = response.motion.record
        called = f"{name_of(record)}: " if record is not None and down > 1 else ""
        lean = made.add_subplot(rows, columns, across * row + 1, projection="polar")
        worst = side(response.motion.name, _towards(response, found))
        _bars(lean, found, [RIM if each.overturned else min(each.max_rotation_ratio, RIM) for each in found])
        if not any(each.max_rotation_ratio for each in found):
            lean.annotate(
                tell("rocks in no direction"), (0.5, 0.5), xycoords="axes fraction", ha="center", va="center", backgroundcolor="w"
            )
        rose(lean, called + tell("largest lean over α, worst: {direction}", direction=worst), RIM)
        if slides:
            path = made.add_subplot(rows, columns, across * row + 2, projection="polar")
            unit = length_unit((each.max_displacement_m for each in found), gal=gal)
            far = [each.max_displacement_m / unit.size for each in found]
            _bars(path, found, far)
            rose(path, called + tell("furthest from start ({unit})", unit=unit.name), max(*far, 1e-3 / unit.size))
    handles = [Patch(facecolor=ROCKED, edgecolor="0.4", linewidth=0.5, label=tell("stands"))]
    half = all(map(_half, directions))
    if any(each.overturned for found in directions for each in found):
        handles.append(Patch(facecolor=FELL, edgecolor="0.4", linewidth=0.5, label=tell("falls to this side") if half else tell("falls")))
    canvas.legend_outside(made, handles, loc="outside lower center", ncols=2)
    return made


def _towards(response: Response[Any], found: Directions) -> str:
    """Return to which side of its direction the worst is told: to that to which the body falls, where its bar is."""
    name = response.motion.name
    return next((each.overturned_towards for each in found if each.overturned and f"{each.azimuth_deg:g}" == name), "+x")


def _bars(panel: Any, found: Directions, values: Sequence[float]) -> None:
    """Draw a bar for each direction; where half of the circle stands for all of it to both sides, or to that to which the body falls."""
    both = ("+x", "-x") if _half(found) else ("+x",)
    width = np.radians((180.0 if len(both) == 2 else 360.0) / len(found))
    for each, value in zip(found, values, strict=True):
        for towards in (each.overturned_towards,) if len(both) == 2 and each.overturned else both:
            turn = np.radians(each.azimuth_deg + (180.0 if towards == "-x" else 0.0))
            panel.bar(turn, value, width=0.9 * width, color=FELL if each.overturned else ROCKED, edgecolor="0.4", linewidth=0.4)


def _half(found: Directions) -> bool:
    """Return whether directions are those of half the circle."""
    return max(each.azimuth_deg for each in found) < 180.0

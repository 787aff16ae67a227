"""Polar diagrams of peak tilt and maximum displacement over azimuth."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.patches import Patch

from seisblock.core.i18n import gettext
from seisblock.core.results import Response
from seisblock.output.directions import direction_label
from seisblock.output.figures import style
from seisblock.output.figures.heading import record_label, records_heading
from seisblock.output.figures.rose import draw_fall_rose, style_rose
from seisblock.output.units_display import length_unit
from seisblock.report.figures.spectrum import OVERTURNED_COLOUR, ROCKED_COLOUR

Directions = Sequence[Any]

RIM = 1.0
"""Tilt over alpha at the rim of a polar panel, drawn for overturned blocks."""


@style.narrow_too
def figure(
    responses: Sequence[Response[Any]], directions: Sequence[Directions], *, gal: bool = True, narrow: bool = False
) -> style.StyledFigure:
    """Return the figure: per record a polar panel of peak tilt over alpha and, with sliding, one of maximum displacement.

    Panels of a record side by side, or stacked if `narrow`.

    In three dimensions a rose of the directions of fall, over the azimuths of the body's +x, stands beside them.

    Parameters
    ----------
    responses : sequence of Response
        Response in the governing direction of each record.
    directions : sequence of sequences
        Results in each direction, per record.
    gal : bool
        Displacements in cm, else m.
    """
    slides = any(hasattr(result, "max_displacement_m") for group in directions for result in group)
    falls = [[azimuth for result in group if (azimuth := getattr(result, "fell_azimuth_deg", None)) is not None] for group in directions]
    across, down = 1 + slides + any(falls), len(responses)
    rows, columns = (across * down, 1) if narrow else (down, across)
    title = records_heading([response.motion.record for response in responses], [gettext("all azimuths")])
    fig = style.titled_figure(title, width=0.6 + 4.4 * columns, height=1.0 + 4.2 * rows)
    for row, (response, results, fall_azimuths) in enumerate(zip(responses, directions, falls, strict=True)):
        record = response.motion.record
        prefix = f"{record_label(record)}: " if record is not None and down > 1 else ""
        tilt = fig.add_subplot(rows, columns, across * row + 1, projection="polar")
        worst = direction_label(response.motion.name, _worst_direction(response, results))
        _bars(tilt, results, [RIM if result.overturned else min(result.max_rotation_ratio, RIM) for result in results])
        if not any(result.max_rotation_ratio for result in results):
            tilt.annotate(
                gettext("no rocking in any azimuth"), (0.5, 0.5), xycoords="axes fraction", ha="center", va="center", backgroundcolor="w"
            )
        style_rose(tilt, prefix + gettext("peak tilt θ/α, worst: {direction}", direction=worst), RIM)
        if slides:
            path = fig.add_subplot(rows, columns, across * row + 2, projection="polar")
            unit = length_unit((result.max_displacement_m for result in results), gal=gal)
            displacements = [result.max_displacement_m / unit.size for result in results]
            _bars(path, results, displacements)
            style_rose(path, prefix + gettext("maximum displacement ({unit})", unit=unit.name), max(*displacements, 1e-3 / unit.size))
        if fall_azimuths:
            draw_fall_rose(fig.add_subplot(rows, columns, across * (row + 1), projection="polar"), fall_azimuths, len(results))
    handles = [Patch(facecolor=ROCKED_COLOUR, edgecolor="0.4", linewidth=0.5, label=gettext("did not overturn"))]
    half_circle = all(map(_is_half_circle, directions))
    if any(result.overturned for results in directions for result in results):
        handles.append(
            Patch(
                facecolor=OVERTURNED_COLOUR,
                edgecolor="0.4",
                linewidth=0.5,
                label=gettext("overturned to this side") if half_circle else gettext("overturned"),
            )
        )
    style.add_figure_legend(fig, handles, loc="outside lower center", ncols=2)
    return fig


def _worst_direction(response: Response[Any], results: Directions) -> str:
    """Return the sense of the governing direction: that of overturning, else +x."""
    name = response.motion.name
    return next((result.overturned_towards for result in results if result.overturned and f"{result.azimuth_deg:g}" == name), "+x")


def _bars(panel: Any, results: Directions, values: Sequence[float]) -> None:
    """Draw a bar per direction; of a half circle in both senses, or only in the sense of overturning."""
    sides = ("+x", "-x") if _is_half_circle(results) else ("+x",)
    width = np.radians((180.0 if len(sides) == 2 else 360.0) / len(results))
    for result, value in zip(results, values, strict=True):
        for towards in (result.overturned_towards,) if len(sides) == 2 and result.overturned else sides:
            turn = np.radians(result.azimuth_deg + (180.0 if towards == "-x" else 0.0))
            panel.bar(
                turn,
                value,
                width=0.9 * width,
                color=OVERTURNED_COLOUR if result.overturned else ROCKED_COLOUR,
                edgecolor="0.4",
                linewidth=0.4,
            )


def _is_half_circle(results: Directions) -> bool:
    """Return True if the directions cover half of the circle."""
    return max(result.azimuth_deg for result in results) < 180.0

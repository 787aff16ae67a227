"""Figure of a body in three dimensions: ground acceleration, displacement, tilt and twist; rose of the directions of fall."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure, SubFigure

from seisblock.bodies.convex import convex_body
from seisblock.core.i18n import gettext
from seisblock.core.results import Response
from seisblock.core.typing import FloatArray
from seisblock.models.rigid3d.describe import verdict
from seisblock.models.rigid3d.outcome import Rigid3dOutcome
from seisblock.output.figures import style
from seisblock.output.figures.curves import draw_curve
from seisblock.output.figures.heading import motions_heading, object_label, panel_labels
from seisblock.output.figures.rose import draw_fall_rose
from seisblock.output.figures.time_histories import Interval, history_columns, strong_motion_interval
from seisblock.output.units_display import acceleration_unit, length_unit

MIN_STEP = 1e-5
"""Smallest change of position, m, or tilt, rad, from sample to sample of a body in motion, for the interval shown."""

AFTER_FALL_S = 2.5
"""Time after overturning that is shown, s."""


HISTORY_HEIGHT, ROSE_HEIGHT = 9.0, 3.4
"""Heights of the time histories and of a row of roses, in."""


class Falls(Protocol):
    """Samples of a body: number of runs, and the azimuth of each fall, degrees clockwise from north, or from +x where that is unknown."""

    runs: int
    fell_azimuths_deg: Sequence[float]


def figure(
    responses: Sequence[Response[Rigid3dOutcome]],
    *,
    gal: bool = True,
    probabilities: Sequence[float | None] = (),
    falls: Sequence[Falls | None] = (),
) -> Figure:
    """Return the figure, one column per direction: ground acceleration, displacement of the centre of gravity, tilt, twist.

    Parameters
    ----------
    responses : sequence of Response
    gal : bool
    probabilities : sequence of float or None
        Overturning probability of each response, where known.
    falls : sequence of Falls or None
        Samples of each response, where known; those that fall are drawn as a rose below.
    """
    motions = [response.motion for response in responses]
    has_falls = any(item is not None and item.fell_azimuths_deg for item in falls)
    height = HISTORY_HEIGHT + ROSE_HEIGHT * has_falls
    fig = style.titled_figure(motions_heading(motions), width=3.0 + 5.0 * len(responses), height=height)
    histories: Figure | SubFigure = fig
    if has_falls:
        histories, roses = fig.subfigures(2, 1, squeeze=False, height_ratios=(HISTORY_HEIGHT, ROSE_HEIGHT))[:, 0]
        for place, (response, item) in enumerate(zip(responses, falls, strict=True), start=1):
            if item is not None and item.fell_azimuths_deg:
                panel = roses.add_subplot(1, len(responses), place, projection="polar")
                origin = "+x" if response.motion.azimuth_deg is None else ""
                draw_fall_rose(panel, item.fell_azimuths_deg, item.runs, origin=origin)
    spans = [motion_interval(response) for response in responses]
    disp_unit = length_unit((response.outcome.max_displacement_m for response in responses), gal=gal)
    columns = history_columns(histories, motions, spans, 4, heights=(1.3, 1.0, 1.0, 1.0))
    chances = list(probabilities) or [None] * len(responses)
    for panels, name, response, chance in zip(columns, panel_labels(motions), responses, chances, strict=True):
        solid = convex_body(response.body)
        sizes = object_label(*np.ptp(solid.points, axis=0).tolist(), friction=response.options.mu, probability=chance, gal=gal)
        _draw_ground(panels[0], f"{name}  {gettext(solid.name)} {sizes}\n{gettext(verdict(response, gal=gal))}", response, gal=gal)
        for channel, colour, dashes in (("x", style.ACCENT, "-"), ("y", style.SECOND, (0, (5, 1.5)))):
            shift = (response[channel] - response[channel][0]) / disp_unit.size
            draw_curve(panels[1], response.time, shift, color=colour, label=channel, linestyle=dashes, linewidth=1.1)
        style.label_axes(panels[1], y=gettext("displacement ({unit})", unit=disp_unit.name))
        style.add_legend(panels[1])
        draw_curve(panels[2], response.time, np.degrees(response["tilt"]), color=style.ACCENT, linewidth=1.1)
        style.label_axes(panels[2], y=gettext("tilt (deg)"))
        draw_curve(panels[3], response.time, twist_history(response), color=style.ACCENT, linewidth=1.1)
        style.label_axes(panels[3], y=gettext("twist (deg)"))
    return fig


def twist_history(response: Response[Rigid3dOutcome]) -> FloatArray:
    """Return the rotation about the vertical at each sample, degrees."""
    return np.degrees(np.unwrap(2.0 * np.arctan2(response["qz"], response["qw"])))  # type: ignore[no-any-return]


def motion_interval(response: Response[Rigid3dOutcome]) -> Interval:
    """Return the interval of motion with a margin, or the strong motion of a body that remains at rest."""
    changes = [np.abs(np.diff(response[name], prepend=response[name][0])) for name in ("x", "y", "tilt")]
    moving = np.flatnonzero(np.max(changes, axis=0) > MIN_STEP)
    if not moving.size:
        return strong_motion_interval(response.motion)
    start, end = response.time[moving[0]], response.time[moving[-1]]
    if response.outcome.overturning_time_s is not None:
        end = min(end, response.outcome.overturning_time_s + AFTER_FALL_S)
    margin = 0.05 * (end - start) + 0.2
    return max(float(response.time[0]), float(start) - margin), min(float(response.time[-1]), float(end) + margin)


def _draw_ground(axis: Axes, title: str, response: Response[Rigid3dOutcome], *, gal: bool) -> None:
    """Draw the components of the ground acceleration."""
    unit, unit_name = acceleration_unit(gal=gal)
    motion = response.motion
    names = gettext("along {name}", name=motion.name or "x"), gettext("transverse"), gettext("vertical")
    for values, name, colour in zip(motion.acceleration, names, ("0.2", "0.6", style.SECOND), strict=True):
        if np.any(values):
            draw_curve(axis, motion.time, values / unit, color=colour, label=name, linewidth=0.7)
    style.label_axes(axis, y=gettext("a ({unit})", unit=unit_name))
    style.set_panel_title(axis, title)
    style.add_legend(axis)

"""Figure of a pile of stones: ground acceleration, tilt and slip of each stone."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from seisblock.core.i18n import gettext
from seisblock.core.results import Response
from seisblock.core.typing import FloatArray
from seisblock.models.stack.describe import NOTICEABLE_SLIP, NOTICEABLE_TILT, StackResponses
from seisblock.models.stack.outcome import StackOutcome
from seisblock.models.stack.stone_falls import describe_falls
from seisblock.output.figures import style
from seisblock.output.figures.curves import draw_curve
from seisblock.output.figures.heading import motions_heading, object_label, panel_labels
from seisblock.output.figures.time_histories import history_columns, strong_motion_interval
from seisblock.output.text.wrap import wrap_text
from seisblock.output.units_display import Unit, acceleration_unit, length_unit

SHADES = ("#c0392b", "#1f5a8c", "#7d7d7d", "#b8860b", "#4f7f4f", "#7a4f8c", "#111111")
DASHES = ("-", (0, (6, 2)), (0, (2, 1.5)), (0, (6, 2, 1, 2)), (0, (1, 1)), (0, (8, 2, 2, 2)))
"""Colours and dashes of the stones from top to bottom, see :func:`line_style`; dashes are distinct in greyscale."""

WRAP_COLUMNS = 84
"""Line width of the list of overturned stones, characters: that of one of two panels."""

FALL_DURATION_S = 0.2
"""Duration before overturning in which slip is not defined (the stone rotates away), s."""

AFTER_FALL_S = 2.0
"""Time shown after overturning of a stone, s; a lying cylinder may roll until the end of the record."""


def figure(responses: StackResponses, *, gal: bool = True, probabilities: Sequence[float | None] = ()) -> Figure:
    """Return the figure: per run ground acceleration, tilts and slips of the stones over time.

    Parameters
    ----------
    responses : sequence of Response
    gal : bool
    probabilities : sequence of float or None
        Probability that a stone falls, of each response, where known.
    """
    motions = [response.motion for response in responses]
    # curves end at overturning of their stone
    stretches = [motion_interval(response, margin=1.0, after_fall=0.0) for response in responses]
    fig = style.titled_figure(motions_heading(motions), width=3.5 + 4.5 * len(responses), height=6.6)
    disp_unit = length_unit((max_standing(response, "slip") for response in responses), gal=gal)
    columns, chances = history_columns(fig, motions, stretches, 3), list(probabilities) or [None] * len(responses)
    for panels, name, response, chance in zip(columns, panel_labels(motions), responses, chances, strict=True):
        body = response.body
        height = max(centre[2] + 0.5 * stone.height for centre, stone in zip(body.centres(), body.stones, strict=True))
        title = gettext("{what}: {note}", what=f"+x = {name}", note=gettext(body.name))
        label = gettext("height {height}", height=object_label(height, friction=body.mu, probability=chance, gal=gal))
        _draw_column(panels, f"{title}\n{label}", response, disp_unit, gal=gal)
    return fig


def _draw_column(panels: Sequence[Any], title: str, response: Response[StackOutcome], disp_unit: Unit, *, gal: bool) -> None:
    """Draw the three panels of one run."""
    motion = response.motion
    unit, unit_name = acceleration_unit(gal=gal)
    rows = (
        (gettext("vertical"), 2, style.SECOND),
        (gettext("transverse"), 1, "0.7"),
        (gettext("along {name}", name=motion.name or "x"), 0, "0.2"),
    )
    for name, row, colour in rows:
        values = motion.acceleration[row]
        acts = row == 0 or (row == 1 and response.options.across) or (row == 2 and response.options.vertical)
        if acts and values.any():
            draw_curve(panels[0], motion.time, values / unit, color=colour, linewidth=0.7, label=name)
    for index, name in enumerate(reversed(response.body.names)):
        colour, dashes = line_style(index)
        line_kwargs: dict[str, Any] = {"color": colour, "linestyle": dashes, "label": gettext(name)}
        draw_curve(panels[1], response.time, np.degrees(stone_tilt(response, name)), **line_kwargs)
        draw_curve(panels[2], response.time, stone_slip(response, name) / disp_unit.size, **line_kwargs)
    for panel, quantity, factor in ((panels[1], "tilt", math.degrees(1.0)), (panels[2], "slip", 1.0 / disp_unit.size)):
        top = factor * max_standing(response, quantity)
        panel.set_ylim(-0.05 * top, 1.1 * top)
        for event in response.events:
            panel.axvline(event.time_s, color="0.3", linewidth=0.8, linestyle=(0, (2, 2)))
    if response.events:  # above the panel, so that no curve or event line is hidden
        falls_text = "\n".join(wrap_text(describe_falls(response), WRAP_COLUMNS))
        panels[1].set_title(falls_text, fontsize=7, loc="left", linespacing=1.4, parse_math=False)
    style.add_legend(panels[0])
    style.add_legend(panels[2])  # between the two panels of the stones
    style.set_panel_title(panels[0], title)
    labels = gettext("a ({unit})", unit=unit_name), gettext("tilt θ (deg)"), gettext("slip s ({unit})", unit=disp_unit.name)
    for panel, text in zip(panels, labels, strict=True):
        style.label_axes(panel, y=text)


def line_style(index: int) -> tuple[str, Any]:
    """Return colour and dashes of a stone, counted from the top; 7 colours and 6 dash patterns give 42 combinations."""
    return SHADES[index % len(SHADES)], DASHES[index % len(DASHES)]


def stone_tilt(response: Response[StackOutcome], name: str) -> FloatArray:
    """Return the tilt of a stone, (n,), rad; NaN after its overturning."""
    return _until_fall(response, name, "tilt", 0.0)


def stone_slip(response: Response[StackOutcome], name: str) -> FloatArray:
    """Return the slip of a stone, (n,), m; NaN from :data:`FALL_DURATION_S` before its overturning."""
    return _until_fall(response, name, "slip", FALL_DURATION_S)


def _until_fall(response: Response[StackOutcome], name: str, quantity: str, lead_time: float) -> FloatArray:
    """Return a channel of a stone, (n,); NaN from `lead_time`, s, before its overturning."""
    fall_time = next(stone.fell_at_s for stone in response.outcome.stones if stone.name == name)
    values = response[f"{name}_{quantity}"]
    return values if fall_time is None else np.where(response.time <= fall_time - lead_time, values, np.nan)


def max_standing(response: Response[StackOutcome], quantity: str) -> float:
    """Return the largest tilt or slip of the stones before their overturning."""
    top = 1e-3
    for stone in response.outcome.stones:
        before_fall = response.time <= (
            np.inf if stone.fell_at_s is None else stone.fell_at_s - (FALL_DURATION_S if quantity == "slip" else 0.0)
        )
        top = max(top, float(response[f"{stone.name}_{quantity}"][before_fall].max(initial=0.0)))
    return top


def motion_interval(response: Response[StackOutcome], *, margin: float, after_fall: float = AFTER_FALL_S) -> tuple[float, float]:
    """Return the interval of noticeable motion, s, or the strong motion without any; stones count until `after_fall` after overturning."""
    time, moving = response.time, np.zeros(response.time.size, dtype=bool)
    for stone in response.outcome.stones:
        before_end = time <= (np.inf if stone.fell_at_s is None else stone.fell_at_s + after_fall)
        for quantity, threshold in (("tilt", NOTICEABLE_TILT), ("slip", NOTICEABLE_SLIP)):
            values = response[f"{stone.name}_{quantity}"]
            # in motion (gradient per row) and already noticeably away from the initial value
            moving |= (np.abs(np.gradient(values)) > 0.1 * threshold) & (np.abs(values - values[0]) > threshold) & before_end
    if not moving.any():
        return strong_motion_interval(response.motion)
    first, last = time[moving][[0, -1]]
    return max(float(first) - margin, float(time[0])), min(float(last) + margin, float(time[-1]))

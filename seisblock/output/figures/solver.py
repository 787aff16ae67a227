"""Figure of any solver: the one that it registers, else one panel per quantity, over the strong motion."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from seisblock.core.i18n import format_share, gettext, join_list
from seisblock.core.registry import get_solver
from seisblock.core.results import Channel, Response
from seisblock.output.figures import style
from seisblock.output.figures.curves import draw_curve
from seisblock.output.figures.heading import motions_heading, object_label, panel_labels
from seisblock.output.figures.time_histories import history_columns, strong_motion_interval
from seisblock.output.text.shaking import shaking_lines
from seisblock.output.text.solver import event_text
from seisblock.output.units_display import Unit, length_unit

MAX_PANELS = 6
"""Most panels of a column; further channels stand in the file of histories."""


MAX_COLUMNS = 3
"""Most responses in full; more are drawn as small multiples."""

MAX_TITLE = 36
"""Most letters of a line above a small multiple."""

MAX_MULTIPLES = 30
"""Most small multiples of a page."""

MAIN_CHANNELS = ("rotation", "tilt", "displacement")
"""Channel of a small multiple: the first of these that is not zero, else the first of the model."""


def response_figure(
    responses: Sequence[Response[Any]], *, gal: bool = True, probabilities: Sequence[float | None] = (), **samples: Any
) -> Figure:
    """Return the figure of responses of one model: the one that it registers, else that of its channels; many as small multiples.

    Parameters
    ----------
    responses : sequence of Response
    gal : bool
    probabilities : sequence of float or None
        Overturning probability of each response, where known.
    samples : keyword arguments
        What else the figure of the model shows of the samples.
    """
    if len(responses) > MAX_COLUMNS:
        return small_multiples(responses, gal=gal, probabilities=probabilities)
    draw: Callable[..., Figure] = get_solver(responses[0].model).presenter("plot") or figure
    known = {"probabilities": probabilities} if any(p is not None for p in probabilities) else {}
    fig = draw(responses, gal=gal, **known, **samples)
    if isinstance(fig, style.StyledFigure):
        fig.set_footer([text.plain for text in shaking_lines(responses, gal=gal, static=responses[0].model == "uplift")])
    return fig


def small_multiples(responses: Sequence[Response[Any]], *, gal: bool = True, probabilities: Sequence[float | None] = ()) -> Figure:
    """Return a page with one small panel per response: tilt, or displacement of a body that does not tilt, on common axes.

    Parameters
    ----------
    responses : sequence of Response
        The first 30 are drawn.
    gal : bool
    probabilities : sequence of float or None
        Overturning probability of each response, where known.
    """
    panels = list(responses[:MAX_MULTIPLES])
    columns = [_main_channel(panels, response) for response in panels]
    rows = math.ceil(len(panels) / MAX_COLUMNS)
    subject = join_list(filter(None, [panels[0].model, gettext(getattr(panels[0].body, "name", "") or ""), _object_of(panels[0], gal=gal)]))
    title = gettext("{subject}: {count} of {total} time histories", subject=subject, count=len(panels), total=len(responses))
    fig, axes = style.new_figure(rows, columns=MAX_COLUMNS, width=10.0, height=0.9 + 1.7 * rows, title=title, sharex=False, sharey=True)
    unit = length_unit((float(np.abs(c.values).max()) for c in columns if c.unit == "m"), gal=gal)
    for index, (axis, response, channel) in enumerate(zip(axes, panels, columns, strict=False)):
        size, label, suffix = _display(channel, unit)
        draw_curve(axis, response.time, channel.values / size, color=style.ACCENT)
        axis.set_xlim(*strong_motion_interval(response.motion))
        name = panel_labels([item.motion for item in panels])[index]
        probability = probabilities[index] if probabilities else None
        share = "" if probability is None else gettext("overturning probability {share}", share=format_share(probability))
        peak = gettext("peak {value}", value=f"{float(np.abs(channel.values).max()) / size:.3g}{suffix}")
        style.set_panel_title(axis, f"{_shorten(name)}\n{share or peak}")
        last_row, first_column = index + MAX_COLUMNS >= len(panels), index % MAX_COLUMNS == 0
        style.label_axes(axis, x=gettext("t (s)") if last_row else "", y=label if first_column else "")
    for axis in axes[len(panels) :]:
        axis.remove()
    return fig


def _main_channel(responses: Sequence[Response[Any]], response: Response[Any]) -> Channel:
    """Return the channel of the small multiples, the same for all responses."""
    names = [channel.name for channel in response.channels]
    moving = (name for name in MAIN_CHANNELS if name in names and any(np.any(item[name]) for item in responses))
    channel_name = next(moving, names[0])
    return response.channels[names.index(channel_name)]


def _shorten(name: str) -> str:
    """Return a name without its middle where it is too long; the direction stands at the end."""
    return name if len(name) <= MAX_TITLE else f"{name[: MAX_TITLE // 2]}…{name[-MAX_TITLE // 2 + 1 :]}"


def _object_of(response: Response[Any], *, gal: bool) -> str:
    """Return sizes and friction of the object of a response, as far as its model has them."""
    body, options = response.body, response.options
    sizes = [getattr(body, name) for name in ("width", "height") if hasattr(body, "width") and hasattr(body, "height")]
    owners = (options, getattr(options, "contact", None), body)
    return object_label(*sizes, friction=next((mu for owner in owners if (mu := getattr(owner, "mu", None)) is not None), None), gal=gal)


def _display(channel: Channel, length: Unit) -> tuple[float, str, str]:
    """Return the size of the display unit, the axis label of a channel and the unit behind a value."""
    symbol = channel.symbol or gettext(channel.name)
    if channel.unit == "rad":
        return math.radians(1.0), gettext("{symbol} (deg)", symbol=symbol), "°"
    if channel.unit == "m":
        return length.size, f"{symbol} ({length.name})", f" {length.name}"
    return 1.0, f"{symbol} ({channel.unit})", f" {channel.unit}"


@style.narrow_too
def figure(responses: Sequence[Response[Any]], *, gal: bool = True, narrow: bool = False) -> style.StyledFigure:
    """Return the figure of the channels of each direction, SI, in the order of the solver.

    Columns side by side, or stacked if `narrow`.
    """
    motions = [response.motion for response in responses]
    rows = min(len(responses[0].channels), MAX_PANELS) or 1
    wide, high = (8.5, 1.0 + 1.6 * rows * len(responses)) if narrow else (4.5 + 4.0 * len(responses), 1.0 + 1.6 * rows)
    fig = style.titled_figure(motions_heading(motions), width=wide, height=high)
    columns = history_columns(fig, motions, [strong_motion_interval(motion) for motion in motions], rows, narrow=narrow)
    for panels, name, response in zip(columns, panel_labels(motions), responses, strict=True):
        for panel, channel in zip(panels, response.channels, strict=False):
            draw_curve(panel, response.time, channel.values, color=style.ACCENT)
            quantity = channel.symbol or gettext(channel.name.replace("_", " "))
            unit = "" if channel.unit == "1" else f" ({channel.unit})"
            style.label_axes(panel, y=f"{quantity}{unit}")
        style.set_panel_title(panels[0], gettext("{name}: {what}", name=name, what=event_text(response)))
    return fig

"""Figure of several widths, heights or friction coefficients: probability and tilt against one of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from matplotlib.figure import Figure

from seisblock.core.i18n import gettext
from seisblock.core.results import Response
from seisblock.output.figures.heading import records_heading
from seisblock.output.figures.style import ACCENT, SEPARATOR, add_figure_legend, label_axes, new_figure
from seisblock.report.text.variants import assess_variant, group_variants, variant_label

COLOURS = ("0.1", ACCENT, "#2c6fa6", "#7a7a7a", "#d08a2e", "#4f8f5b")
MARKERS = "osD^v*"


def figure(responses: Sequence[Response[Any]], extras: Sequence[Mapping[str, Any]], *, gal: bool) -> Figure:
    """Return the figure: overturning probability and peak tilt of the variants, one line for each combination of the other values.

    Parameters
    ----------
    responses : sequence of Response
    extras : sequence of mapping
        Further results of each: ``variant``, ``assessment``.
    gal : bool
    """
    variants = [extra["variant"] for extra in extras]
    varied = list(variants[0])
    # the option with most values is the axis, the first of several
    axis_name = max(varied, key=lambda name: len({variant[name] for variant in variants}))
    lines: dict[str, list[tuple[float, Any, float]]] = {}
    groups = group_variants(responses, extras)
    for columns in groups:
        record = columns[0][0][0].motion.record
        for column in columns:
            variant = column[0][1]["variant"]
            other_values = {name: value for name, value in variant.items() if name != axis_name}
            parts = [variant_label(other_values, gal=gal)] if other_values else []
            if len(groups) > 1 and record is not None:
                parts.append(record.station or record.source)
            tilt = max(1.0 if response.outcome.overturned else response.outcome.max_rotation_ratio for response, _ in column)
            assessment = assess_variant([extra for _, extra in column])
            lines.setdefault(SEPARATOR.join(parts), []).append((variant[axis_name], assessment, tilt))
    has_probability = "assessment" in extras[0]
    body = responses[0].body
    fixed = {name: getattr(body, name) for name in ("width", "height") if name not in varied and hasattr(body, name)}
    heading = records_heading([response.motion.record for response in responses], [response.motion.name for response in responses])
    names = [heading, " ".join(filter(None, (gettext(body.name), variant_label(fixed, gal=gal))))]
    fig, panels = new_figure(
        2 if has_probability else 1, width=5.2, height=4.6 if has_probability else 2.8, title=SEPARATOR.join(filter(None, names))
    )
    size = 0.01 if gal and axis_name != "mu" else 1.0
    for index, (name, points) in enumerate(lines.items()):
        points = sorted(points, key=lambda point: point[0])
        style: dict[str, Any] = {
            "color": COLOURS[index % len(COLOURS)],
            "marker": MARKERS[index % len(MARKERS)],
            "markersize": 4,
            "linewidth": 1.1,
        }
        x = [value / size for value, _, _ in points]
        if has_probability:
            shares = [100.0 * assessment.overturning_probability for _, assessment, _ in points]
            bounds = [[100.0 * end for end in assessment.interval] for _, assessment, _ in points]
            errors = [
                [share - low for share, (low, _) in zip(shares, bounds, strict=True)],
                [high - share for share, (_, high) in zip(shares, bounds, strict=True)],
            ]
            panels[0].errorbar(
                x, shares, yerr=errors, capsize=2, elinewidth=0.7, label=name or gettext("overturns, 95 % interval"), **style
            )
            moved = [100.0 * assessment.moved_probability for _, assessment, _ in points]
            label = None if len(lines) > 1 and index else gettext("moves or overturns")
            panels[0].plot(x, moved, linestyle=":", color=style["color"], linewidth=1.1, label=label)
        panels[-1].plot(x, [tilt for _, _, tilt in points], label=None if has_probability else name or None, **style)
    if has_probability:
        panels[0].set_ylim(-3.0, 103.0)
        label_axes(panels[0], y=gettext("probability (%)"))
    panels[-1].set_ylim(-0.03, 1.06)
    unit = "cm" if gal else "m"
    axis_label = {
        "width": f"{gettext('width')} ({unit})",
        "height": f"{gettext('height')} ({unit})",
        "mu": gettext("friction coefficient (1)"),
    }
    label_axes(panels[-1], x=axis_label[axis_name], y=gettext("tilt / overturning angle (1)"))
    handles = panels[0].get_legend_handles_labels()[0]
    if handles:
        add_figure_legend(fig, handles, loc="outside lower center", ncols=3)
    return fig

"""Figure of a scenario: probabilities of each object, worst on top."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.figure import Figure

from seisblock.core.i18n import escape_control, gettext
from seisblock.output.figures.style import add_figure_legend, label_axes, new_figure
from seisblock.output.text.wrap import display_width
from seisblock.report.figures.probability import share_colour
from seisblock.report.text.scenario import object_name
from seisblock.studies.assessment import LIKELY_SHARE, MAY_SHARE
from seisblock.studies.scenario.assess import ObjectRisk

MAX_OBJECTS = 40
"""Largest number of objects drawn; the worst ones."""

MAX_NAME_WIDTH = 28
"""Width of a name at the axis, columns."""

MOVES_COLOUR = "#d5dade"


def _short(name: str) -> str:
    """Return a name that leaves room for the bars."""
    return name if display_width(name) <= MAX_NAME_WIDTH else name[: MAX_NAME_WIDTH // 2 - 1] + "…" + name[-6:]


def figure(results: Sequence[ObjectRisk], label: str) -> Figure:
    """Return the figure: a bar of the overturning probability with its interval, on that of the moved probability."""
    plotted = [result for result in results if result.overturning_probability is not None]
    title = gettext("Overturning in a scenario: {scenario}", scenario=gettext(label))
    if len(plotted) > MAX_OBJECTS:
        title = gettext("{title}; the worst {count} of {all} objects", title=title, count=MAX_OBJECTS, all=len(plotted))
    plotted = plotted[:MAX_OBJECTS]
    fig, (axes,) = new_figure(1, width=6.4, height=1.65 + 0.26 * max(len(plotted), 3), title=title)
    rows = range(len(plotted))
    axes.barh(
        rows, [100.0 * (r.moved_probability or 0.0) for r in plotted], color=MOVES_COLOUR, height=0.7, label=gettext("moves or overturns")
    )
    falls = [r.overturning_probability or 0.0 for r in plotted]
    axes.barh(
        rows,
        [100.0 * share for share in falls],
        color=[share_colour(share) for share in falls],
        edgecolor="0.2",
        linewidth=0.5,
        height=0.4,
        label=gettext("overturns (colour by probability)"),
    )
    for row, result in zip(rows, plotted, strict=True):
        if result.interval is not None:
            axes.plot(
                [100.0 * end for end in result.interval],
                [row, row],
                color="0.1",
                linewidth=1.0,
                label=None if row else gettext("95 % interval"),
            )
    for share in (MAY_SHARE, LIKELY_SHARE):
        text = gettext("limits of the classes") if share == MAY_SHARE else None
        axes.axvline(100.0 * share, color="0.4", linewidth=0.7, linestyle="--", label=text)
    axes.set_yticks(list(rows), [_short(escape_control(object_name(result))) for result in plotted], parse_math=False)
    axes.set_ylim(max(len(plotted), 1) - 0.4, -0.6)
    axes.set_xlim(0.0, 100.0)
    label_axes(axes, x=gettext("probability (%)"))
    add_figure_legend(fig, axes.get_legend_handles_labels()[0], loc="outside lower center", ncols=2)
    return fig

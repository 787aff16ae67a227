"""Figure of the measures that make an object safe: overturning probability against each of them."""

from __future__ import annotations

from matplotlib.figure import Figure

from seisblock.core.i18n import gettext
from seisblock.output.figures.style import ACCENT, INPUT, label_axes, new_figure, set_panel_title
from seisblock.report.text.secure import LABELS, measure_value, verdict
from seisblock.studies.scenario.secure import BASE_MASS, FRICTION, HEIGHT, INSET, RESTRAINT, WIDTH, Measure, Security

COLUMNS = 2


def _axis_label(measure: Measure) -> tuple[float, str]:
    """Return the size of the display unit and the label of an axis."""
    if measure.measure in (WIDTH, HEIGHT, INSET):
        name = {WIDTH: gettext("width"), HEIGHT: gettext("height"), INSET: gettext("inset of the feet")}[measure.measure]
        return 0.01, f"{name} (cm)"
    if measure.measure == FRICTION:
        return 1.0, gettext("friction coefficient (1)")
    if measure.measure == BASE_MASS:
        return 1.0, gettext("ballast (kg)") if measure.unit == "kg" else gettext("ballast over own mass (1)")
    return 1.0, gettext("force (N)") if measure.unit == "N" else gettext("force over weight (1)")


def figure(result: Security, label: str) -> Figure:
    """Return the figure: a panel for each measure, with its value and the target."""
    rows = -(-len(result.measures) // COLUMNS)
    fig, panels = new_figure(rows, columns=COLUMNS, width=6.8, height=1.0 + 1.9 * rows, title=verdict(result, label), sharey=True)
    for index, (axes, measure) in enumerate(zip(panels, result.measures, strict=False)):
        size, name = _axis_label(measure)
        points = sorted(measure.curve, key=lambda point: (point[0], -point[1]))
        shape = {"drawstyle": "steps-post"} if measure.measure == RESTRAINT else {"marker": ".", "markersize": 3}
        axes.plot([value / size for value, _ in points], [100.0 * share for _, share in points], color="0.15", linewidth=1.1, **shape)
        axes.axhline(100.0 * result.target_probability, color=INPUT, linestyle="--", linewidth=0.8)
        if measure.value is not None:
            axes.plot(measure.value / size, 100.0 * (measure.overturning_probability or 0.0), "o", color=ACCENT, markersize=5)
        head = gettext("{measure}: {value}", measure=gettext(LABELS[measure.measure]), value=measure_value(measure))
        set_panel_title(
            axes, head if measure.value is not None else gettext("{measure}: not reached", measure=gettext(LABELS[measure.measure]))
        )
        if measure.measure == BASE_MASS and measure.value:
            axes.set_xlim(-0.1 * measure.value / size, 3.0 * measure.value / size)
        elif len(points) == 1:
            # no restraint required: a force is not negative
            axes.set_xlim(-0.05, 1.0)
        axes.set_ylim(-3.0, 103.0)
        label_axes(axes, x=name, y=gettext("overturns (%)") if index % COLUMNS == 0 else "")
    for axes in panels[len(result.measures) :]:
        fig.delaxes(axes)
    return fig

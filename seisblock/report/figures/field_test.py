"""Figure of the field test: surveyed overturning rates of gravestones and those of the models."""

from __future__ import annotations

from matplotlib.figure import Figure

from seisblock.core.i18n import N_, gettext
from seisblock.output.figures import style
from seisblock.validation.furukawa import SURVEYS
from seisblock.validation.furukawa_field import MODELS, SURVEYED_RATES, bias, rates, rms

STYLES = {
    "eq-9": ("o", style.ACCENT, N_("eq. (9)")),
    "worn": ("s", style.SECOND, N_("edge wear 0.1 B")),
    "sharp": ("^", "0.2", N_("sharp edges")),
    "half-sine": ("v", "0.55", N_("sharp edges, half-sine pulse")),
    "worn-more": ("D", "#9bb3c4", N_("edge wear 0.15 B")),
}
"""Marker, colour and label of each model."""

SPREAD = 0.11
"""Horizontal spacing of the markers of one station."""


def figure() -> Figure:
    """Return the figure: surveyed rate (bar) and rate of each model (marker) at the stations of [Furukawa2009]_ table 6."""
    fig, (axis,) = style.new_figure(
        1, width=6.4, height=3.5, title=gettext("Tottori 2000: overturning rates of gravestones, survey and models")
    )
    places = range(len(SURVEYS))
    axis.bar(places, SURVEYED_RATES, width=0.86, color="0.88", edgecolor="0.6", linewidth=0.6, label=gettext("survey"))
    for index, model in enumerate(MODELS):
        marker, colour, name = STYLES[model.key]
        x = [place + SPREAD * (index - (len(MODELS) - 1) / 2) for place in places]
        text = gettext("{model}: rms {rms:.2f}, bias {bias:+.2f}", model=gettext(name), rms=rms(model.key), bias=bias(model.key))
        axis.plot(x, rates(model.key), marker, color=colour, markersize=4.5, label=text)
    axis.set_xticks(list(places), [gettext(survey.name) for survey in SURVEYS])
    axis.set_ylim(-0.03, 1.42)
    axis.set_yticks([0.0, 0.25, 0.5, 0.75, 1.0])
    style.label_axes(axis, "", gettext("overturning rate (1)"))
    axis.legend(fontsize=7, frameon=False, loc="upper left", ncols=2)
    return fig

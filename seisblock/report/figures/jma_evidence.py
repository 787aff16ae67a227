"""Figure of JMA's statements on furniture and of the surveyors' rule on gravestones, beside what the models give."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from seisblock.bodies.body_name import body_name
from seisblock.core.i18n import N_, gettext
from seisblock.core.typing import FloatArray
from seisblock.output.figures import style
from seisblock.validation.edge_wear import RULE, rate_intensities
from seisblock.validation.jma_furniture import CLASSES, FALLS, FURNITURE, STATEMENTS, WORDS, shares

PIECES = {"bookcase": ("o", "0.1"), "filing_cabinet": ("s", style.ACCENT)}
"""Marker and colour of the pieces drawn one by one."""

WEAR = {
    "sharp": ("^", "0.2", N_("sharp edges")),
    "prior": ("o", style.ACCENT, N_("edges worn by 0 to 0.1 B")),
    "tenth": ("v", "0.55", N_("edges worn by 0.1 B")),
}
"""Marker, colour and label of each candidate of edge wear."""

CLASS_NAMES = ("5-", "5+", "6-", "6+", "7")


def evidence() -> tuple[dict[str, FloatArray], dict[str, FloatArray]]:
    """Return the shares of each piece of furniture that fall, by class, and the intensities of each candidate of edge wear; one minute."""
    return {piece: shares(piece)[FALLS] for piece in FURNITURE}, {key: rate_intensities(key) for key in WEAR}


def figure(falls: Mapping[str, FloatArray], intensities: Mapping[str, FloatArray]) -> Figure:
    """Return the figure: share of furniture that falls against JMA intensity, and the rate of gravestones beside the surveyors' rule.

    Parameters
    ----------
    falls : mapping of str to (5,) array
        Share of the records in which each piece falls, by class.
    intensities : mapping of str to (2,) array
        JMA intensities at which 40 and 90 % of the gravestones fall, by candidate of edge wear.
    """
    fig, (left, right) = style.new_figure(
        1, columns=2, width=7.6, height=3.5, sharex=False, title=gettext("Objects that fall, by JMA intensity")
    )
    levels = list(CLASSES.values())
    for name, effect, word in STATEMENTS:
        if effect == FALLS:
            low, high = WORDS[word]
            left.bar(CLASSES[name], high - low, bottom=low, width=0.42, color="0.88", edgecolor="0.7", linewidth=0.6)
    for piece, (marker, colour) in PIECES.items():
        left.plot(
            levels,
            falls[piece],
            marker=marker,
            color=colour,
            markersize=4,
            linewidth=1.0,
            label=gettext(body_name(piece.replace("_", " "))),
        )
    mean = np.mean(list(falls.values()), axis=0)
    left.plot(levels, mean, color=style.SECOND, linestyle="--", linewidth=1.2, label=gettext("mean of six pieces"))
    left.set_xticks(levels, [gettext(name) for name in CLASS_NAMES])
    left.set_ylim(-0.03, 1.05)
    style.set_panel_title(left, gettext("unfastened furniture"))
    style.label_axes(left, gettext("JMA intensity class"), gettext("share that falls (1)"))
    handles = [Patch(facecolor="0.88", edgecolor="0.7", label=gettext("JMA's table in words")), *left.get_legend_handles_labels()[0]]
    left.legend(handles=handles, fontsize=7, frameon=False, loc="upper left")
    rates = [rate for rate, _ in RULE]
    right.plot([level for _, level in RULE], rates, "D", color="0.45", markersize=7, label=gettext("surveyors' rule"))
    for key, (marker, colour, label) in WEAR.items():
        right.plot(intensities[key], rates, marker=marker, color=colour, markersize=4, linewidth=1.0, label=gettext(label))
    right.set_ylim(-0.03, 1.05)
    right.set_xlim(5.2, 7.0)
    style.set_panel_title(right, gettext("gravestones of Aoyama"))
    style.label_axes(right, gettext("JMA intensity (1)"), gettext("share that falls (1)"))
    right.legend(fontsize=7, frameon=False, loc="lower right")
    return fig

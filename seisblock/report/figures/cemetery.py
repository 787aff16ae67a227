"""Figures of cemeteries: distribution of H/B and overturning rates ([Furukawa2009]_ figs. 14 to 20)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from seisblock.bodies.cemetery.cemetery import Cemetery
from seisblock.core.i18n import N_, gettext
from seisblock.output.figures.heading import panel_label, records_heading
from seisblock.output.figures.style import ACCENT, INPUT, SEPARATOR, add_legend, label_axes, new_figure, set_panel_title
from seisblock.output.units_display import acceleration_unit
from seisblock.records import Record
from seisblock.studies.survey.assessment import EITHER_COMPONENT, LARGER_COMPONENT, CemeteryRate, Reinforcement
from seisblock.studies.survey.overturning_rate import FREQUENCIES, CurvePoint

LINES = (
    ("#08214a", "-"),
    ("#1f4e8c", (0, (6, 1.5))),
    ("#3f78b5", (0, (1.5, 1.2))),
    ("#0a6b5e", (0, (5, 1, 1.2, 1))),
    ("#3fa08f", "-"),
    ("#9bb3c4", (0, (6, 1.5))),
)
"""Colour and dashes of the curves by frequency, dark to light, so that the order is readable in greyscale."""

MARKERS = "osD^vP"
BIN = 0.25
"""Width of the histogram's bins of H/B."""


def draw_slenderness(axis: Axes, cemetery: Cemetery, threshold: float | None = None) -> None:
    """Draw the histogram and the exceedance curve of H/B; stones above the threshold in colour."""
    ratios = np.sort(cemetery.ratios)
    edges = np.arange(np.floor(ratios[0] / BIN) * BIN, ratios[-1] + BIN, BIN).tolist()
    share = np.full(ratios.size, 1.0 / ratios.size)
    axis.hist(ratios, bins=edges, weights=share, color="0.78", edgecolor="white", label=gettext("fraction per {width:g}", width=BIN))
    if threshold is not None:
        exceeds = ratios > threshold
        axis.hist(
            ratios[exceeds],
            bins=edges,
            weights=share[exceeds],
            color=ACCENT,
            alpha=0.55,
            edgecolor="white",
            label=gettext("above threshold"),
        )
        axis.axvline(threshold, color=ACCENT, linewidth=0.9, linestyle=(0, (4, 2)))
    exceedance = 1.0 - np.arange(ratios.size + 1) / ratios.size
    axis.step(np.concatenate([ratios, ratios[-1:]]), exceedance, where="pre", color="0.15", linewidth=1.1, label=gettext("fraction above"))
    axis.set_ylim(0.0, 1.02)
    label_axes(axis, x=gettext("H/B"), y=gettext("fraction of stones (1)"))
    add_legend(axis, loc="upper right", bbox_to_anchor=None, ncols=1)


def draw_rates(axis: Axes, curve: Iterable[CurvePoint], *, gal: bool = True) -> None:
    """Draw the overturning rate against PGA for each frequency."""
    unit, name = acceleration_unit(gal=gal)
    points = list(curve)
    for frequency in dict.fromkeys(point.frequency_hz for point in points):
        pga = np.array([p.pga_m_s2 for p in points if p.frequency_hz == frequency]) / unit
        rate = np.array([p.rate for p in points if p.frequency_hz == frequency])
        index = FREQUENCIES.index(frequency) if frequency in FREQUENCIES else len(LINES) - 1
        colour, dashes = LINES[index % len(LINES)]
        axis.plot(pga, rate, label=f"{frequency:.3g} Hz", linewidth=1.1, color=colour, linestyle=dashes)
    axis.set_ylim(-0.02, 1.02)
    label_axes(axis, x=gettext("PGA ({unit})", unit=name), y=gettext("overturning rate (1)"))


def overturn_rate_figure(
    cemetery: Cemetery,
    groups: Sequence[tuple[Record | None, Sequence[CemeteryRate]]],
    curve: Sequence[CurvePoint],
    reinforced_curve: Sequence[CurvePoint] = (),
    *,
    gal: bool = True,
) -> Figure:
    """Return the figure of ``overturn-rate``: distribution of H/B, rate curves with the results of records, and the same with dowels.

    Parameters
    ----------
    cemetery : Cemetery
    groups : sequence of (Record or None, results)
        Results of the components of records, or of given values; may be empty.
    curve : sequence of CurvePoint
        Curve drawn without results.
    reinforced_curve : sequence of CurvePoint
        The same with dowels, if any are compared.
    gal : bool
        Unit of accelerations, else m/s^2.
    """
    records = [record for record, _ in groups]
    combined_names = (LARGER_COMPONENT, EITHER_COMPONENT)
    results = [(record, result) for record, record_results in groups for result in record_results if result.component not in combined_names]
    points = [(_point_label(record, result, records), result) for record, result in results]
    governing = max((result for _, result in points), key=lambda result: result.rate, default=None)
    has_reinforced = bool(reinforced_curve) if governing is None else governing.reinforced is not None
    columns = 3 if has_reinforced else 2
    stones = gettext("{name}: {stones} stones", name=cemetery.name, stones=cemetery.size)
    title = SEPARATOR.join(part for part in (records_heading(records, [result.component or "" for _, result in results]), stones) if part)
    surveyed = next((rates[-1] for _, rates in groups if rates and rates[-1].contingency is not None), None)
    rows = 1 if surveyed is None else 2
    figure, axes = new_figure(rows, columns=columns, width=4.2 * columns + 1.2, height=0.3 + 3.6 * rows, title=title)
    if surveyed is not None:
        draw_stones(axes[columns], axes[columns + 1], surveyed, gal=gal)
        for axis in axes[columns + 2 :]:
            axis.set_visible(False)
    draw_slenderness(axes[0], cemetery, governing.threshold_ratio if governing else None)
    _draw_rates(axes[1], [(name, result, result) for name, result in points], governing, curve, gal=gal)
    if governing is not None and governing.reinforced is not None:
        reinforced_points = [(name, result, result.reinforced) for name, result in points if result.reinforced is not None]
        _draw_rates(axes[2], reinforced_points, governing.reinforced, curve, gal=gal)
        set_panel_title(axes[1], gettext("as surveyed"))
        text = gettext("{stones} of {all} stones reinforced", stones=governing.reinforced.reinforced_stones, all=cemetery.size)
        set_panel_title(axes[2], text)
    elif has_reinforced:
        _draw_rates(axes[2], [], None, reinforced_curve, gal=gal)
        set_panel_title(axes[1], gettext("as surveyed"))
        set_panel_title(axes[2], gettext("reinforced"))
    # beside the panel: inside, it would hide curves
    add_legend(axes[columns - 1], loc="upper left", bbox_to_anchor=(1.01, 1.0), ncols=1)
    return figure


OUTCOMES = (
    (True, True, "o", ACCENT, ACCENT, N_("overturned as computed")),
    (True, False, "^", "white", ACCENT, N_("computed only")),
    (False, True, "v", "white", "black", N_("observed only")),
    (False, False, "s", "0.75", "0.45", N_("neither")),
)
"""Computed and observed outcome, marker, face and edge colour, and label."""


def draw_stones(left: Axes, right: Axes, result: CemeteryRate, *, gal: bool = True) -> None:
    """Draw the H/B of each surveyed stone over its threshold, and its overturning probability over H/B, hits and misses apart."""
    unit, name = acceleration_unit(gal=gal)
    for computed, observed, marker, face, edge, text in OUTCOMES:
        stones = [stone for stone in result.each_stone if (stone.overturns, stone.observed) == (computed, observed)]
        ratios = [stone.height_m / stone.width_m for stone in stones]
        style: dict[str, Any] = {"marker": marker, "facecolor": face, "edgecolor": edge, "s": 20, "linewidth": 0.8, "zorder": 3}
        count = sum(stone.count for stone in stones)
        left.scatter([stone.threshold_m_s2 / unit for stone in stones], ratios, label=f"{gettext(text)}: {count}", **style)
        right.scatter(ratios, [stone.probability for stone in stones], **style)
    left.axvline(result.pga_m_s2 / unit, color=INPUT, linewidth=0.9, linestyle=(0, (4, 2)), label="PGA")
    label_axes(left, x=gettext("threshold of the stone ({unit})", unit=name), y=gettext("H/B"))
    add_legend(left, loc="upper right", bbox_to_anchor=None, ncols=1)
    right.axhline(0.5, color="0.6", linewidth=0.8)
    right.set_ylim(-0.03, 1.03)
    label_axes(right, x=gettext("H/B"), y=gettext("overturning probability (1)"))


def _point_label(record: Record | None, result: CemeteryRate, records: Sequence[Record | None]) -> str:
    """Return the label of a point up to its frequency."""
    return "" if record is None else f"{panel_label(record, result.component or '', records)}, "


def _draw_rates(
    axis: Axes,
    shakings: Sequence[tuple[str, CemeteryRate, CemeteryRate | Reinforcement]],
    governing: CemeteryRate | Reinforcement | None,
    curve: Sequence[CurvePoint],
    *,
    gal: bool,
) -> None:
    """Draw the rate curves, those of the results in colour, and the rate of each result with its interval."""
    unit, _ = acceleration_unit(gal=gal)
    frequencies = {result.equivalent_frequency_hz for _, result, _ in shakings}
    draw_rates(axis, [p for p in (governing.curve if governing else curve) if p.frequency_hz not in frequencies], gal=gal)
    for index, (name, result, curve_source) in enumerate(shakings):
        points = [p for p in curve_source.curve if p.frequency_hz == result.equivalent_frequency_hz]
        thick = 1.8 if curve_source is governing else 0.9
        axis.plot([p.pga_m_s2 / unit for p in points], [p.rate for p in points], color=ACCENT, linewidth=thick, zorder=3)
        (low, high), pga = curve_source.rate_interval, result.pga_m_s2 / unit
        axis.errorbar(
            [pga],
            [curve_source.rate],
            yerr=[[curve_source.rate - low], [high - curve_source.rate]],
            fmt=MARKERS[index % len(MARKERS)] + "-",  # the line shows only in the legend, which thereby covers the curve as well
            color=ACCENT,
            ecolor="black",
            markeredgecolor="black",
            markersize=5,
            markerfacecolor=ACCENT,
            capsize=2.5,
            linewidth=thick,
            elinewidth=0.9,
            zorder=4,
            label=f"{name}{result.equivalent_frequency_hz:.3g} Hz",
        )
    axis.set_xlim(left=0.0)  # last, since it disables autoscaling

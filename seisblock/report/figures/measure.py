"""Figure of a record: acceleration, velocity, Fourier and response spectra of its components."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from seisblock.core.i18n import gettext
from seisblock.core.typing import FloatArray
from seisblock.measures import RecordMeasures, fourier_amplitude, response_spectrum
from seisblock.measures.spectra import DAMPING
from seisblock.measures.summary import velocity_history
from seisblock.output.figures.curves import decimate, draw_curve, in_view, insert_crossings
from seisblock.output.figures.heading import heading
from seisblock.output.figures.style import ACCENT, INPUT, SEPARATOR, add_legend, draw_thresholds, label_axes, style_axes, titled_figure
from seisblock.output.figures.time_histories import history_columns, strong_interval
from seisblock.output.units_display import acceleration_unit, velocity_unit
from seisblock.records import Component, Motion, Record
from seisblock.records.process import select_component

LINES = (("0.1", "-"), ("#1f5a8c", (0, (5, 1.5))), ("#b5651d", (0, (1.2, 1.2))), ("0.55", "-"))
"""Colour and dashes of the components in the spectra, distinct in greyscale."""

COMPACT_LEGEND = {"handlelength": 1.5, "columnspacing": 1.1}
"""Options of a legend that fits beside the title of a half-width panel."""


def measure_figure(record: Record, answer: RecordMeasures, *, gal: bool = True) -> Figure:
    """Return the figure of a record: acceleration (above the threshold in colour), velocity, and spectra.

    Parameters
    ----------
    record, answer : Record, RecordMeasures
        The record and its result of :func:`seisblock.measures.measure`.
    gal : bool
        Accelerations in gal and velocities in kine, else SI.
    """
    parts = [select_component(record, m.component) for m in answer.components]
    n = len(parts)
    interval = strong_interval(record.time, *(part.acceleration for part in parts))
    figure = titled_figure(_title(record, answer), width=8.5, height=1.1 + 2.2 * n + 3.0)
    history_figure, spectrum_figure = figure.subfigures(2, 1, squeeze=False, height_ratios=(2.2 * n + 0.4, 3.0))[:, 0]
    strongest = max(parts, key=lambda part: float(np.abs(part.acceleration).max()))
    motion = Motion.from_arrays(strongest.acceleration, record.dt, name=strongest.code, start_s=record.offset_s)
    motion = replace(motion, record=record)
    (histories,) = history_columns(history_figure, [motion], [interval], 2 * n)
    left, right = spectrum_figure.subplots(1, 2)
    for axis in (left, right):
        style_axes(axis)
    _draw_accelerations(histories[:n], record, parts, answer, gal=gal)
    _draw_velocities(histories[n:], record, parts, answer, gal=gal)
    _draw_fourier(left, record, parts, answer.conventions.fourier_smoothing_hz, gal=gal)
    _draw_response(right, record, parts, gal=gal)
    return figure


def _title(record: Record, answer: RecordMeasures) -> str:
    """Return the title: record and JMA intensity."""
    intensity = (
        ""
        if answer.jma_intensity is None
        else gettext("JMA intensity {value:.2f} ({name})", value=answer.jma_intensity, name=gettext(answer.jma_class or ""))
    )
    return SEPARATOR.join(text for text in (heading(record), intensity) if text)


def _draw_accelerations(axes: list[Axes], record: Record, parts: list[Component], answer: RecordMeasures, *, gal: bool) -> None:
    """Draw the accelerations on a common scale, exceedances of the threshold filled."""
    unit, name = acceleration_unit(gal=gal)
    limit = 1.15 * max(m.pga_m_s2 for m in answer.components) / unit or 1.0
    for axis, part, m in zip(axes, parts, answer.components, strict=True):
        values = part.acceleration / unit
        level = m.duration.threshold_m_s2 / unit
        signs = {"both": (1, -1), "positive": (1,), "negative": (-1,)}[answer.conventions.threshold_side]
        if level < limit:
            draw_thresholds(axis, [sign * level for sign in signs])
        draw_curve(axis, record.time, values, color=INPUT, linewidth=0.6)
        # decimation by extrema keeps every peak of the filled area
        time, thinned = decimate(*in_view(record.time, values, *axis.get_xlim()))
        for sign in signs:
            at, clipped = insert_crossings(time, thinned, sign * level)
            axis.fill_between(at, sign * level, clipped, where=sign * clipped >= level, color=ACCENT, linewidth=0.6, zorder=3)
        peak = values[round((m.time_of_pga_s - record.offset_s) / record.dt)]
        axis.plot([m.time_of_pga_s], [peak], "o", ms=4, mfc="white", mec="black", zorder=4)
        axis.set_ylim(-limit, limit)
        text = gettext(
            "{name}   PGA {pga};  {time:.3g} s above {level}",
            name=part.code,
            pga=f"{m.pga_m_s2 / unit:.4g} {name}",
            time=m.duration.total_s,
            level=f"{level:.4g} {name}",
        )
        _annotate_panel(axis, text)
    label_axes(axes[len(axes) // 2], y=gettext("a ({unit})", unit=name))


def _draw_velocities(axes: list[Axes], record: Record, parts: list[Component], answer: RecordMeasures, *, gal: bool) -> None:
    """Draw the velocities, with the baseline correction of PGV, on a common scale."""
    unit, name = velocity_unit(gal=gal)
    limit = 1.15 * max(m.pgv_m_s for m in answer.components) / unit or 1.0
    for axis, part, m in zip(axes, parts, answer.components, strict=True):
        history = velocity_history(part.acceleration, record.dt, answer.conventions)
        draw_curve(axis, record.time, history.velocity / unit, color="0.2", linewidth=0.7)
        axis.set_ylim(-limit, limit)
        _annotate_panel(axis, f"{part.code}   PGV {m.pgv_m_s / unit:.4g} {name}")
    label_axes(axes[len(axes) // 2], y=gettext("v ({unit})", unit=name))


def _draw_fourier(axis: Axes, record: Record, parts: list[Component], smoothing_hz: float, *, gal: bool) -> None:
    """Draw the smoothed Fourier amplitudes from 0.1 Hz to 30 Hz or half the sampling rate."""
    unit, name = (acceleration_unit(gal=True).size, "gal s") if gal else velocity_unit(gal=False)
    for part, (colour, dashes) in zip(parts, _styles(len(parts)), strict=True):
        frequency, amplitude = fourier_amplitude(part.acceleration, record.dt, smoothing_hz=smoothing_hz)
        in_range = (frequency >= 0.1) & (frequency <= min(0.5 / record.dt, 30.0))
        axis.plot(frequency[in_range], amplitude[in_range] / unit, color=colour, linestyle=dashes, linewidth=1.0, label=part.code)
    _logarithmic(axis)
    label_axes(axis, x=gettext("f (Hz)"), y=f"|A| ({name})")
    axis.set_title(gettext("Fourier amplitude, Parzen {width:g} Hz", width=smoothing_hz), fontsize=8, loc="left")
    add_legend(axis, **COMPACT_LEGEND)


def _draw_response(axis: Axes, record: Record, parts: list[Component], *, gal: bool) -> None:
    """Draw the absolute acceleration response."""
    unit, name = acceleration_unit(gal=gal)
    for part, (colour, dashes) in zip(parts, _styles(len(parts)), strict=True):
        spectrum = response_spectrum(part.acceleration, record.dt)
        axis.plot(spectrum.period_s, spectrum.sa_m_s2 / unit, color=colour, linestyle=dashes, linewidth=1.0, label=part.code)
    _logarithmic(axis)
    label_axes(axis, x=gettext("T (s)"), y=f"Sₐ ({name})")
    axis.set_title(gettext("Response spectrum, damping {damping:g%}", damping=DAMPING), fontsize=8, loc="left")
    add_legend(axis, **COMPACT_LEGEND)


def _styles(count: int) -> list[tuple[str, object]]:
    """Return a colour and dashes for each component."""
    return [LINES[i % len(LINES)] for i in range(count)]


def _logarithmic(axis: Axes) -> None:
    """Set logarithmic axes if any value is positive, with at most three decades of amplitude."""
    highest = max((float(np.max(line.get_ydata(), initial=0.0)) for line in axis.get_lines()), default=0.0)
    axis.set_xscale("log")
    if highest > 0:
        axis.set_yscale("log")
        axis.set_ylim(max(highest * 1e-3, _min_positive(axis)) * 0.8, highest * 1.6)
    axis.xaxis.set_major_formatter("{x:g}")


def _min_positive(axis: Axes) -> float:
    """Return the smallest positive value drawn."""
    curves: list[FloatArray] = [np.asarray(line.get_ydata()) for line in axis.get_lines()]
    return min((float(values[values > 0].min()) for values in curves if (values > 0).any()), default=0.0)


def _annotate_panel(axis: Axes, text: str) -> None:
    """Write a label above a panel."""
    axis.set_title(text, fontsize=7.5, loc="left", pad=2.0)

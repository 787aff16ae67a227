"""Figures of records, motions and spectra without a body."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from seisblock.core.i18n import gettext
from seisblock.core.typing import FloatArray
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.measures import ResponseSpectrum
from seisblock.output.directions import direction_label, transverse_component
from seisblock.output.figures import style
from seisblock.output.figures.curves import draw_curve
from seisblock.output.figures.heading import heading, motions_heading
from seisblock.output.units_display import acceleration_unit
from seisblock.records import Motion, Record
from seisblock.report.figures.spectrum import figure as spectrum_figure
from seisblock.studies.rocking.spectrum import RockingSpectrum


def record_figure(record: Record) -> Figure:
    """Return the figure of a record: acceleration, gal, a panel per component on a common scale."""
    parts = {part.code: part.acceleration for part in record.components}
    return _histories(heading(record), record.time, parts)


def motion_figure(motion: Motion) -> Figure:
    """Return the figure of the nonzero rows of a motion, gal."""
    names = (motion.name or "+x", direction_label(*transverse_component(motion)), "UD")
    rows = {name: row for name, row in zip(names, motion.acceleration, strict=True) if row.any()}
    time: FloatArray = motion.start_s + motion.dt * np.arange(motion.acceleration.shape[1], dtype=np.float64)
    return _histories(motions_heading([motion]), time, rows or {names[0]: motion.horizontal})


def response_spectrum_figure(spectrum: ResponseSpectrum) -> Figure:
    """Return the figure of the absolute acceleration response spectrum, gal."""
    unit, name = acceleration_unit(gal=True)
    fig, (axis,) = style.new_figure(1, height=3.6)
    axis.plot(spectrum.period_s, spectrum.sa_m_s2 / unit, color=style.ACCENT, linewidth=1.0)
    axis.set_xscale("log")
    axis.xaxis.set_major_formatter("{x:g}")
    style.label_axes(axis, x=gettext("T (s)"), y=f"Sₐ ({name})")
    style.set_panel_title(axis, gettext("Response spectrum, damping {damping:g%}", damping=spectrum.damping))
    return fig


def rocking_spectrum_figure(spectrum: RockingSpectrum) -> Figure:
    """Return the map of size over slenderness; the spectrum does not hold its motion, hence no title."""
    return spectrum_figure([(Motion.from_arrays(np.zeros(2), 1.0, name=""), spectrum)], "rocking", STANDARD_GRAVITY)


def _histories(title: str, time: FloatArray, rows: dict[str, FloatArray]) -> Figure:
    unit, name = acceleration_unit(gal=True)
    limit = 1.15 * max(float(np.abs(row).max()) for row in rows.values()) / unit or 1.0
    fig, axes = style.new_figure(len(rows), title=title)
    for axis, (code, row) in zip(axes, rows.items(), strict=True):
        axis.set_xlim(time[0], time[-1])
        axis.set_ylim(-limit, limit)
        draw_curve(axis, time, row / unit, color=style.INPUT, linewidth=0.6)
        style.set_panel_title(axis, f"{code}   PGA {np.abs(row).max() / unit:.4g} {name}")
    style.label_axes(axes[len(axes) // 2], y=gettext("a ({unit})", unit=name))
    style.label_axes(axes[-1], x=gettext("t (s)"))
    return fig

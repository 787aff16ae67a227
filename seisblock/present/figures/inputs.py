"""What goes in and what comes of it without a body: records and motions against time, spectra."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from seisblock.measures import ResponseSpectrum
from seisblock.present.directions import across, side
from seisblock.present.figures import canvas
from seisblock.present.figures.curves import curve
from seisblock.present.figures.heading import heading, heading_of
from seisblock.present.figures.spectrum import figure as spectrum_figure
from seisblock.present.scales import acceleration_unit
from seisblock.records import Motion, Record
from seisblock.studies.rocking.spectra import RockingSpectrum
from seisblock.typing import FloatArray
from seisblock.units import STANDARD_GRAVITY
from seisblock.words import tell


def record_figure(record: Record) -> Figure:
    """Return the accelerations of a record on one scale, a panel per component, gal."""
    parts = {part.code: part.acceleration for part in record.components}
    return _histories(heading(record), record.time, parts)


def motion_figure(motion: Motion) -> Figure:
    """Return the rows of a motion that move, gal."""
    names = (motion.name or "+x", side(*across(motion)), "UD")
    rows = {name: row for name, row in zip(names, motion.acceleration, strict=True) if row.any()}
    time: FloatArray = motion.start_s + motion.dt * np.arange(motion.acceleration.shape[1], dtype=np.float64)
    return _histories(heading_of([motion]), time, rows or {names[0]: motion.horizontal})


def response_spectrum_figure(spectrum: ResponseSpectrum) -> Figure:
    """Return the absolute acceleration response against the period, gal."""
    unit, name = acceleration_unit(gal=True)
    made, (axis,) = canvas.new_figure(1, height=3.6)
    axis.plot(spectrum.period_s, spectrum.sa_m_s2 / unit, color=canvas.ACCENT, linewidth=1.0)
    axis.set_xscale("log")
    axis.xaxis.set_major_formatter("{x:g}")
    canvas.label(axis, x=tell("T (s)"), y=f"Sₐ ({name})")
    canvas.panel_title(axis, tell("Response spectrum, damping {damping:g%}", damping=spectrum.damping))
    return made


def rocking_spectrum_figure(spectrum: RockingSpectrum) -> Figure:
    """Return the map of size against slenderness; the motion behind it is no longer known."""
    return spectrum_figure([(Motion.from_arrays(np.zeros(2), 1.0, name=""), spectrum)], "rocking", STANDARD_GRAVITY)


def _histories(title: str, time: FloatArray, rows: dict[str, FloatArray]) -> Figure:
    """Return one panel per row."""
    unit, name = acceleration_unit(gal=True)
    reach = 1.15 * max(float(np.abs(row).max()) for row in rows.values()) / unit or 1.0
    made, axes = canvas.new_figure(len(rows), title=title)
    for axis, (code, row) in zip(axes, rows.items(), strict=True):
        axis.set_xlim(time[0], time[-1])
        axis.set_ylim(-reach, reach)
        curve(axis, time, row / unit, color=canvas.INPUT, linewidth=0.6)
        canvas.panel_title(axis, f"{code}   PGA {np.abs(row).max() / unit:.4g} {name}")
    canvas.label(axes[len(axes) // 2], y=tell("a ({unit})", unit=name))
    canvas.label(axes[-1], x=tell("t (s)"))
    return made

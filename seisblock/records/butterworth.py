"""Butterworth high-pass as in-place second-order sections.

Bilinear transform with prewarped corner; each section is a direct form II transposed biquad with a double zero at frequency zero.
"""

from __future__ import annotations

import math

import numpy as np

from seisblock._jit import kernel
from seisblock.core.limits import CHUNK_SIZE
from seisblock.core.typing import FloatArray

N_SECTIONS = 2
"""Second-order sections of the filter."""


def highpass_sections(dt: float, hz: float) -> FloatArray:
    """Return gain and denominator coefficients a1, a2 of the second-order sections, (2, 3).

    The poles of the analogue filter lie on a circle; the bilinear transform, prewarped to keep the corner frequency, maps each pair to a
    section with a double zero at frequency zero. The first section carries the gain of both, as in scipy.

    Parameters
    ----------
    dt : float, s
        Sampling interval.
    hz : float, Hz
        Corner frequency, below half the sampling rate.
    """
    # the bilinear transform compresses frequencies and would lower the corner, hence the tangent
    prewarped = math.tan(math.pi * hz * dt)
    # Butterworth pole pairs: damping ratios cos of the pole angles
    damping = np.cos(np.pi * (np.arange(N_SECTIONS) + 0.5) / (2 * N_SECTIONS))
    scale = 1.0 + 2.0 * damping * prewarped + prewarped**2
    a1, a2 = 2.0 * (prewarped**2 - 1.0) / scale, (1.0 - 2.0 * damping * prewarped + prewarped**2) / scale
    gain = np.ones(N_SECTIONS)
    # the whole gain in the first section, as scipy.signal.butter(output="sos") has it
    gain[0] = 1.0 / scale.prod()
    return np.column_stack((gain, a1, a2))


def run_sections(sections: FloatArray, row: FloatArray, *, steady_state: bool, backwards: bool = False) -> None:
    """Filter a row of samples in place.

    Parameters
    ----------
    sections : (2, 3) array
        Result of :func:`highpass_sections`.
    row : (n,) array, m/s^2
        Samples, modified in place.
    steady_state : bool
        True: start from the steady state of the first sample met (a constant gives zero output); False: start from rest.
    backwards : bool
        Filter from the last sample to the first.
    """
    memory = np.zeros((N_SECTIONS, 2))
    if steady_state and row.size:
        # steady state of the first section for a constant input; its output is zero, so the second starts at rest
        # an output of zero for the constant input x needs the memory (-x, x)
        initial = sections[0, 0] * row[-1 if backwards else 0]
        memory[0] = -initial, initial
    starts = range(0, row.size, CHUNK_SIZE)
    for begin in reversed(starts) if backwards else starts:
        # in chunks: an interrupt is handled between two kernel calls
        _run(sections, row[begin : begin + CHUNK_SIZE], memory, backwards)


@kernel("void(float64[:, ::1], float64[::1], float64[:, ::1], boolean)")
def _run(sections, row, memory, backwards):
    """Filter samples with two direct form II transposed sections; update the filter state `memory`, (2, 2)."""
    gain, a1, a2 = sections[0, 0], sections[0, 1], sections[0, 2]
    gain_2, c1, c2 = sections[1, 0], sections[1, 1], sections[1, 2]
    m0, m1, n0, n1 = memory[0, 0], memory[0, 1], memory[1, 0], memory[1, 1]
    for count in range(row.size):
        i = row.size - 1 - count if backwards else count
        x = gain * row[i]
        y = x + m0
        # numerator 1, -2, 1: double zero at frequency zero
        m0 = -2.0 * x - a1 * y + m1
        m1 = x - a2 * y
        x = gain_2 * y
        y = x + n0
        n0 = -2.0 * x - c1 * y + n1
        n1 = x - c2 * y
        row[i] = y
    memory[0, 0], memory[0, 1], memory[1, 0], memory[1, 1] = m0, m1, n0, n1

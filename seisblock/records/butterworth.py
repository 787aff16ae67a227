"""The Butterworth high-pass, section by section over the samples, in their place."""

from __future__ import annotations

import math

import numpy as np

from seisblock._jit import kernel
from seisblock.core.limits import CHUNK_SIZE
from seisblock.core.typing import FloatArray

N_SECTIONS = 2
"""Of the second order each."""


def highpass_sections(dt: float, hz: float) -> FloatArray:
    """Return the sections of the filter, (2, 3): of each its gain, and the two coefficients of its memory.

    The poles of the analogue filter lie on a circle; the bilinear transformation, bent so that the corner stays where it is, makes of
    each pair a section with a double zero at frequency zero. The first section has the gain of both, as scipy's has.

    Parameters
    ----------
    dt : float, s
        Sampling interval.
    hz : float, Hz
        Corner frequency, below half the sampling rate.
    """
    prewarped = math.tan(math.pi * hz * dt)
    damping = np.cos(np.pi * (np.arange(N_SECTIONS) + 0.5) / (2 * N_SECTIONS))
    scale = 1.0 + 2.0 * damping * prewarped + prewarped**2
    a1, a2 = 2.0 * (prewarped**2 - 1.0) / scale, (1.0 - 2.0 * damping * prewarped + prewarped**2) / scale
    gain = np.ones(N_SECTIONS)
    gain[0] = 1.0 / scale.prod()
    return np.column_stack((gain, a1, a2))


def run_sections(sections: FloatArray, row: FloatArray, *, steady_state: bool, backwards: bool = False) -> None:
    """Filter a row of samples in its place.

    Parameters
    ----------
    sections : (2, 3) array
        Of :func:`highpass_sections`.
    row : (n,) array, m/s^2
        Changed.
    steady_state : bool
        Whether what is met first has lasted for ever: nothing is left of it; else there was rest before.
    backwards : bool
        From the last sample to the first.
    """
    memory = np.zeros((N_SECTIONS, 2))
    if steady_state and row.size:
        initial = sections[0, 0] * row[-1 if backwards else 0]
        memory[0] = -initial, initial
    starts = range(0, row.size, CHUNK_SIZE)
    for begin in reversed(starts) if backwards else starts:
        # a piece at a time: Ctrl-C is heard between two
        _run(sections, row[begin : begin + CHUNK_SIZE], memory, backwards)


@kernel("void(float64[:, ::1], float64[::1], float64[:, ::1], boolean)")
def _run(sections, row, memory, backwards):
    """Pass samples through two sections (direct form II, transposed, as scipy's), and leave their memory as it then is."""
    gain, a1, a2 = sections[0, 0], sections[0, 1], sections[0, 2]
    gain_2, c1, c2 = sections[1, 0], sections[1, 1], sections[1, 2]
    m0, m1, n0, n1 = memory[0, 0], memory[0, 1], memory[1, 0], memory[1, 1]
    for count in range(row.size):
        i = row.size - 1 - count if backwards else count
        x = gain * row[i]
        y = x + m0
        m0 = -2.0 * x - a1 * y + m1
        m1 = x - a2 * y
        x = gain_2 * y
        y = x + n0
        n0 = -2.0 * x - c1 * y + n1
        n1 = x - c2 * y
        row[i] = y
    memory[0, 0], memory[0, 1], memory[1, 0], memory[1, 1] = m0, m1, n0, n1

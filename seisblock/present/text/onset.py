"""What it would take: the shaking from which a body that kept still would move, beside that of the record."""

from __future__ import annotations

import numpy as np

from seisblock.present.text.tables import told_acceleration
from seisblock.records import Motion
from seisblock.words import noted, tell

ROCKS, SLIDES = noted("rocks from {threshold} on{factor}"), noted("slides from {threshold} on{factor}")
"""How a body that kept still would begin to move."""


def onset(how: str, threshold: float, motion: Motion, *, gal: bool = True) -> str:
    """Return from which acceleration of the ground, m/s^2, a body moves, and how many times the motion's peak that is.

    Parameters
    ----------
    how : str
        ``ROCKS`` or ``SLIDES``.
    threshold : float, m/s^2
    motion : Motion
        A peak above the threshold is not told: then something else held the body.
    gal : bool

    Examples
    --------
    >>> onset(ROCKS, 2.0, Motion.from_arrays([0.0, 1.0, -1.6], 0.01))
    "rocks from 200.0 gal on, 1.25 times this record's PGA"
    """
    peak = float(np.abs(motion.horizontal).max())
    factor = tell(", {times} times this record's PGA", times=times(threshold / peak)) if 0.0 < peak < threshold else ""
    return tell(how, threshold=told_acceleration(threshold, gal=gal), factor=factor)


def times(factor: float) -> str:
    """Return a factor to three digits, whole from 100 on; never as a power of ten.

    Examples
    --------
    >>> times(1.25), times(340.2), times(1053.7)
    ('1.25', '340', '1054')
    """
    return f"{factor:.3g}" if factor < 100.0 else f"{factor:.0f}"

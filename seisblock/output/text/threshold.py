"""Thresholds of rocking and sliding of a body at rest, relative to the record."""

from __future__ import annotations

import math

import numpy as np

from seisblock.core.i18n import N_, gettext
from seisblock.criteria.initiation import onset_factor
from seisblock.output.text.tables import format_acceleration
from seisblock.records import Motion

ROCKS, SLIDES = N_("rocking threshold {threshold}{factor}"), N_("sliding threshold {threshold}{factor}")
"""Templates of the two kinds of initiation."""

MAX_DECIMALS = 9
"""Decimals of a factor just above 1, at most."""

SCIENTIFIC_LIMIT = 1e6
"""Factor from which scientific notation is used."""


def threshold_text(
    template: str, towards: tuple[float, float], motion: Motion, *, gravity: float, vertical: float = 0.0, gal: bool = True
) -> str:
    """Return the ground acceleration at which a body moves, and its ratio to the record.

    Parameters
    ----------
    template : str
        ``ROCKS`` or ``SLIDES``.
    towards : two float, 1
        Horizontal over vertical force at the feet at initiation of motion to +x and to -x; infinite if impossible.
    motion : Motion
        No factor is printed for a motion above the threshold.
    gravity : float, m/s^2
    vertical : float, 1
        Factor on the vertical motion, which varies the weight; the factor then differs from threshold over PGA.
    gal : bool

    Examples
    --------
    >>> threshold_text(ROCKS, (0.2, 0.2), Motion.from_arrays([0.0, 1.0, -1.6], 0.01), gravity=10.0)
    "rocking threshold 200.0 gal (1.25 times this record's PGA)"
    >>> sinking = Motion.from_arrays([0.0, 1.0, -1.6], 0.01, vertical=[0.0, 0.0, -1.0])
    >>> threshold_text(ROCKS, (0.2, 0.2), sinking, gravity=10.0, vertical=1.0)
    'rocking threshold 200.0 gal without vertical motion (1.11 times this record with vertical motion)'
    """
    threshold, peak = min(towards) * gravity, float(np.abs(motion.horizontal).max())
    factor = onset_factor(towards, motion, gravity=gravity, vertical=vertical)
    factor_text = ""
    if 1.0 < factor < np.inf:
        if vertical and motion.vertical.any():
            factor_text = gettext(" without vertical motion ({times} times this record with vertical motion)", times=format_factor(factor))
        elif np.isclose(factor * peak, threshold):
            factor_text = gettext(" ({times} times this record's PGA)", times=format_factor(factor))
        else:
            factor_text = gettext(" ({times} times this record)", times=format_factor(factor))
    return gettext(template, threshold=format_acceleration(threshold, gal=gal), factor=factor_text)


def format_factor(factor: float) -> str:
    """Return a factor to three digits, as an integer from 100 on, as a power of ten from a million on.

    A factor just above 1 keeps the digits that tell it from 1.

    Examples
    --------
    >>> format_factor(1.25), format_factor(1.0004), format_factor(340.2), format_factor(1053.7), format_factor(8.7e300)
    ('1.25', '1.0004', '340', '1054', '8.70e+300')
    """
    if 0.0 < factor - 1.0 < 0.005:
        return f"{factor:.{min(math.ceil(-math.log10(factor - 1.0)), MAX_DECIMALS)}f}"
    return f"{factor:.0f}" if 100.0 <= factor < SCIENTIFIC_LIMIT else f"{factor:#.3g}"

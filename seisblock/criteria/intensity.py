"""Empirical relation of JMA intensity and peak ground velocity."""

from __future__ import annotations

import math

from seisblock.core import checks
from seisblock.core.units import KINE

SCATTER = 0.21
"""Standard deviation of the intensity ([Midorikawa1999]_)."""

FITTED_INTENSITY = (4.0, 7.0)
"""Range of intensities of the data ([Midorikawa1999]_)."""


def intensity_from_velocity(pgv: float) -> float:
    """Return the instrumental JMA intensity I = 2.68 + 1.72 log10 PGV ([Midorikawa1999]_ relation).

    PGV in cm/s (kine), I from 4 to 7, standard deviation 0.21.

    Parameters
    ----------
    pgv : float, m/s
        Peak horizontal ground velocity, positive.

    Returns
    -------
    float

    Raises
    ------
    ParameterError
        If the velocity is not positive.

    Examples
    --------
    >>> from seisblock.criteria import intensity_from_velocity
    >>> round(intensity_from_velocity(0.5), 2)
    5.6
    """
    checks.positive("the peak velocity", pgv, "m/s")
    return 2.68 + 1.72 * math.log10(pgv / KINE)

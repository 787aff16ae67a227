"""What it would take: the shaking from which a body that kept still would move, beside that of the record."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from seisblock.core.i18n import N_, gettext
from seisblock.records import Motion
from seisblock.records.motion import ALONG, UP
from seisblock.report.text.tables import format_acceleration

ROCKS, SLIDES = N_("rocks from {threshold} on{factor}"), N_("slides from {threshold} on{factor}")
"""How a body that kept still would begin to move."""

SCIENTIFIC_LIMIT = 1e6
"""Factor from which nobody counts its digits."""


def threshold_text(
    template: str, towards: tuple[float, float], motion: Motion, *, gravity: float, vertical: float = 0.0, gal: bool = True
) -> str:
    """Return from which acceleration of the ground a body moves, and how many times the record that is.

    Parameters
    ----------
    template : str
        ``ROCKS`` or ``SLIDES``.
    towards : two float, 1
        Horizontal over vertical force, at the feet, at which it begins to move to +x and to -x; infinite where it cannot.
    motion : Motion
        A motion above the threshold is told no factor: then something else held the body.
    gravity : float, m/s^2
    vertical : float, 1
        Factor on the vertical motion: where it acts the weight comes and goes, and the record's factor is not that of its peak.
    gal : bool

    Examples
    --------
    >>> threshold_text(ROCKS, (0.2, 0.2), Motion.from_arrays([0.0, 1.0, -1.6], 0.01), gravity=10.0)
    "rocks from 200.0 gal on, 1.25 times this record's PGA"
    >>> sinking = Motion.from_arrays([0.0, 1.0, -1.6], 0.01, vertical=[0.0, 0.0, -1.0])
    >>> threshold_text(ROCKS, (0.2, 0.2), sinking, gravity=10.0, vertical=1.0)
    'rocks from 200.0 gal on without vertical motion, 1.11 times this record with it'
    """
    threshold, peak = min(towards) * gravity, float(np.abs(motion.horizontal).max())
    factor = onset_factor(towards, motion, gravity=gravity, vertical=vertical)
    words = ""
    if 1.0 < factor < np.inf:
        if vertical and motion.vertical.any():
            words = gettext(" without vertical motion, {times} times this record with it", times=format_factor(factor))
        elif np.isclose(factor * peak, threshold):
            words = gettext(", {times} times this record's PGA", times=format_factor(factor))
        else:
            words = gettext(", {times} times this record", times=format_factor(factor))
    return gettext(template, threshold=format_acceleration(threshold, gal=gal), factor=words)


def effective_friction(options: Mapping[str, Any]) -> float:
    """Return the friction that holds the feet of a body that stands, 1: without limit where tenons hold them, too.

    Parameters
    ----------
    options : mapping
        Of a response of ``respond``.

    Examples
    --------
    >>> effective_friction({"mu": 0.3, "tenon_m": 0.0}), effective_friction({"mu": 0.3, "tenon_m": 0.02})
    (0.3, inf)
    """
    return math.inf if options["tenon_m"] > 0.0 else float(options["mu"])


def onset_factor(towards: tuple[float, float], motion: Motion, *, gravity: float, vertical: float = 0.0) -> float:
    """Return the least factor on a motion from which a body moves; infinite where none does.

    The ground pushes the body to +x where it goes to -x, with -a against a resistance of c (g + a_v), both of them scaled.

    Examples
    --------
    >>> onset_factor((0.1, 0.2), Motion.from_arrays([0.0, 1.6, -0.5], 0.01), gravity=10.0)
    1.25
    """
    max_ratio = 0.0
    for stretch in motion.segments((True, False, vertical != 0.0)):
        along, up = stretch.acceleration[ALONG], vertical * stretch.acceleration[UP]
        for sense, share in zip((-1.0, 1.0), towards, strict=True):
            if 0.0 < share < np.inf:
                max_ratio = max(max_ratio, float(np.max(sense * along - share * up)) / share)
    return gravity / max_ratio if max_ratio > 0.0 else np.inf


def format_factor(factor: float) -> str:
    """Return a factor to three digits, whole from 100 on, as a power of ten from a million on.

    Examples
    --------
    >>> format_factor(1.25), format_factor(340.2), format_factor(1053.7), format_factor(8.7e300)
    ('1.25', '340', '1054', '8.7e+300')
    """
    return f"{factor:.0f}" if 100.0 <= factor < SCIENTIFIC_LIMIT else f"{factor:.3g}"

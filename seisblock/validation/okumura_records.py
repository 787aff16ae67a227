"""Validation of uplift in the time domain: steady-state thresholds of Okumura et al. (1987) by time integration."""

from __future__ import annotations

import functools

import numpy as np

from seisblock.bodies.spring_block import SpringBlock
from seisblock.core.results import Response
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.models.uplift.harmonic import shaking_direction, uplift_thresholds
from seisblock.models.uplift.modes import natural_modes
from seisblock.models.uplift.outcome import UpliftOutcome
from seisblock.models.uplift.solve import solve_uplift
from seisblock.records.motion import Motion
from seisblock.validation.okumura_modes import COUNT_TOLERANCE, dimensionless

BODY = SpringBlock.from_ratios(1.0, 0.707, frequency_vertical=2.0, damping=0.10)
PHI, RHO = 45.0, 60.0

POLYGON_TOLERANCE = 1e-3
"""Error of a sine of 200 chords per cycle (8e-5) and of the transient left by a ramp of 30 cycles."""


@functools.cache
def _steady(ratio: float, share: float) -> tuple[float, Response[UpliftOutcome]]:
    """Return the threshold A/g at theta/omega_1, and the response to a ramped sine of `share` times the threshold."""
    threshold = float(uplift_thresholds(BODY, [ratio], phi_deg=PHI, rho_deg=RHO, damping="dashpots").min())
    phase = 2.0 * np.pi * np.arange(50 * 200 + 1) / 200
    # a ramp over 30 cycles keeps the transient below the steady amplitude
    envelope = 0.5 - 0.5 * np.cos(np.pi * np.minimum(phase / (60.0 * np.pi), 1.0))
    rows = share * threshold * STANDARD_GRAVITY * np.outer(shaking_direction(PHI, RHO), envelope * np.sin(phase))
    return threshold, solve_uplift(BODY, Motion(rows, 2.0 * np.pi / (ratio * natural_modes(BODY).omega_1) / 200))


def _scale(ratio: float) -> float:
    """Return the factor on a sine of the threshold's amplitude at which a corner lifts in the time domain."""
    return _steady(ratio, 1.0)[1].outcome.uplift_scale or float("nan")


RECORDS = (
    dimensionless(
        "26-time-1", "eq. (26)", "uplift amplitude in the time domain over the threshold, theta = omega_1", 1.0, POLYGON_TOLERANCE, lambda: _scale(1.0)
    ),
    dimensionless(
        "26-time-2", "eq. (26)", "uplift amplitude in the time domain over the threshold, theta = 2.75 omega_1", 1.0, POLYGON_TOLERANCE, lambda: _scale(2.75)
    ),
    dimensionless(
        "26-below", "eq. (26)", "number of contact changes at 0.98 of the threshold, theta = omega_1", 0.0, COUNT_TOLERANCE,
        lambda: float(_steady(1.0, 0.98)[1].outcome.contact_changes),
    ),
    dimensionless(
        "26-above", "eq. (26)", "first corner to lift at 1.02 of the threshold, theta = omega_1", 4.0, COUNT_TOLERANCE,
        lambda: float(_steady(1.0, 1.02)[1].outcome.corner or 0),
    ),
    dimensionless(
        "26-corner-1", "section 5, fig. 11", "first corner to lift at 1.02 of the threshold, theta = 1.75 omega_1", 4.0, COUNT_TOLERANCE,
        lambda: float(_steady(1.75, 1.02)[1].outcome.corner or 0), status="differs", today=(1.0, 0.0),
        note="the paper assumes that corner 4 lifts first; at this frequency corner 1 does, in the steady state and in the time domain",
    ),
)  # fmt: skip
"""Cases in the time domain, with the corner dashpots of the solver."""

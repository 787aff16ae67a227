"""Arm, slenderness and frequency parameter of a scanned body for each azimuth."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seisblock.bodies.block import RIGHT
from seisblock.bodies.scan.body import ScannedBody
from seisblock.core import checks
from seisblock.core.i18n import N_
from seisblock.core.limits import MAX_RUNS, check_limit
from seisblock.core.units import STANDARD_GRAVITY

DEFAULT_STEP_DEG = 10.0
"""Default azimuth step, degrees."""


@dataclass(frozen=True)
class ScanAzimuth:
    """Rocking parameters of a body towards an azimuth.

    Parameters
    ----------
    azimuth_deg : float
        Clockwise from north.
    arm_m : float
        Horizontal distance b from the pivot line to the centre of gravity.
    slenderness_rad : float
        alpha, the angle between the vertical and R.
    radius_m : float
        R, from the pivot line to the centre of gravity.
    pivot_inertia_kg_m2 : float
        I_O about the pivot line.
    frequency_parameter_rad_s : float
        p.
    restitution : float
        Ratio of angular velocities after and before an impact on that side, from conserved angular momentum.
    threshold_m_s2 : float
        Horizontal ground acceleration at which rocking towards the azimuth starts.
    """

    azimuth_deg: float
    arm_m: float
    slenderness_rad: float
    radius_m: float
    pivot_inertia_kg_m2: float
    frequency_parameter_rad_s: float
    restitution: float
    threshold_m_s2: float


def scan_azimuths(body: ScannedBody, *, step_deg: float = DEFAULT_STEP_DEG, gravity: float = STANDARD_GRAVITY) -> list[ScanAzimuth]:
    """Return the rocking parameters for azimuths all around ([Furukawa2009]_ eqs. (2), (3)).

    Parameters
    ----------
    body : ScannedBody
    step_deg : float
        Azimuth step, starting at north.
    gravity : float, m/s^2

    Examples
    --------
    >>> from seisblock.bodies.scan.toml import load_scan
    >>> [round(row.slenderness_rad, 2) for row in scan_azimuths(load_scan("boulder"), step_deg=90.0)]
    [0.22, 0.3, 0.26, 0.26]
    """
    checks.instance(body, ScannedBody)
    checks.positive("`step_deg`", step_deg, "degrees")
    check_limit(N_("azimuths"), math.ceil(360.0 / step_deg), MAX_RUNS)
    return [_at_azimuth(body, azimuth, gravity) for azimuth in np.arange(0.0, 360.0, step_deg).tolist()]


def _at_azimuth(body: ScannedBody, azimuth: float, gravity: float) -> ScanAzimuth:
    """Return the rocking parameters for one azimuth."""
    block = body.block_toward(azimuth)
    return ScanAzimuth(
        azimuth,
        block.arms[RIGHT],
        block.slendernesses[RIGHT],
        block.radii[RIGHT],
        block.corner_inertias[RIGHT],
        math.sqrt(gravity * block.lever_ratios[RIGHT]),
        block.restitutions[RIGHT],
        gravity * block.arms[RIGHT] / block.centre,
    )

"""Azimuth sweep: directions of a record, the block in each, and the gains that rotate the motion."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seisblock.bodies.block import Block
from seisblock.bodies.scan.body import ScannedBody
from seisblock.bodies.sliding_base import SlidingBase
from seisblock.core import checks
from seisblock.core.i18n import N_
from seisblock.core.limits import MAX_RUNS, check_limit
from seisblock.core.typing import FloatArray
from seisblock.records import Motion, Record
from seisblock.records._validation import Gain, vertical_gain
from seisblock.records.motion import motion_toward
from seisblock.records.rotation import oriented_pair

STEP_DEG = 5.0
"""Default step between directions, degrees."""


@dataclass(frozen=True, eq=False)
class AzimuthSweep:
    """Directions of a record, and a body in each.

    Parameters
    ----------
    azimuths : (m,) array, degrees
        Of +x, clockwise from north.
    blocks : tuple of Block
        One per direction.
    motion : Motion
        Towards north.
    gains : (m, 3) array
        Factors on its rows that rotate it to each azimuth.
    """

    azimuths: FloatArray
    blocks: tuple[Block, ...]
    motion: Motion
    gains: FloatArray


def sweep_azimuths(body: object, step_deg: float = STEP_DEG) -> FloatArray:
    """Return the directions of a sweep, (m,), degrees: the full circle for an asymmetric or one-way body, else half.

    Examples
    --------
    >>> sweep_azimuths(Block(0.24, 0.72), 45.0).tolist()
    [0.0, 45.0, 90.0, 135.0]
    """
    checks.positive("the azimuth step", step_deg, "degrees")
    is_asymmetric = isinstance(body, Block) and body.centroid_offset != 0.0
    is_one_way = isinstance(body, SlidingBase) and (body.one_way or body.slope_deg != 0.0)
    full_range_deg = 360.0 if is_asymmetric or is_one_way else 180.0
    check_limit(N_("azimuths"), math.ceil(full_range_deg / step_deg), MAX_RUNS)
    return np.arange(0.0, full_range_deg, step_deg)


def make_azimuth_sweep(
    body: Block | ScannedBody, record: Record, *, step_deg: float = STEP_DEG, vertical: Gain | None = None
) -> AzimuthSweep:
    """Return the directions of a record: half a circle, or the full circle for an asymmetric block.

    A block stands with its width towards north, and its base is projected on each azimuth. A scan keeps its orientation: towards the
    opposite azimuth it is the same block seen from behind.

    Parameters
    ----------
    body : Block or ScannedBody
    record : Record
        With two horizontal components of known azimuths.
    step_deg : float
        Step between directions, degrees.
    vertical : bool, float or None
        True or a factor to apply the vertical motion; None: if the record has one.

    Raises
    ------
    ParameterError
        If the step is not positive, or there are more directions than the limit.
    ComponentError
        If the record has no two horizontals of known azimuths, or lacks a required vertical component.

    Examples
    --------
    >>> from seisblock.readers import read
    >>> make_azimuth_sweep(Block(0.24, 0.72), read("synthetic_jma.csv"), step_deg=45.0).azimuths.tolist()
    [0.0, 45.0, 90.0, 135.0]
    """
    checks.instance(body, ScannedBody if isinstance(body, ScannedBody) else Block)
    checks.instance(record, Record)
    azimuths = sweep_azimuths(body, step_deg)
    oriented_pair(record)
    motion = motion_toward(record, 0.0)
    turn = np.radians(azimuths)
    gains = np.column_stack([np.cos(turn), -np.sin(turn), np.full(turn.size, vertical_gain(motion, vertical))])
    blocks = tuple(body.block_toward(azimuth) for azimuth in azimuths.tolist())
    return AzimuthSweep(azimuths, blocks, motion, gains)

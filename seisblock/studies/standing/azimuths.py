"""Every direction: NS and EW are the sensor's axes, and the worst azimuth is what the object may have met."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from seisblock import checks
from seisblock.bodies.block import Block
from seisblock.limits import check_budget
from seisblock.records import Record, motion_of
from seisblock.records.given import Factor, vertical_gain
from seisblock.solvers.respond.many import Fates, respond_many
from seisblock.solvers.respond.solve import make_setting
from seisblock.words import noted

STEP_DEG = 5.0


@dataclass(frozen=True)
class AzimuthFate:
    """What became of the body when its +x points to an azimuth.

    Parameters
    ----------
    azimuth_deg : float
        Clockwise from north.
    overturned : bool
    overturned_towards : str or None
    max_rotation_rad, final_displacement_m, max_displacement_m : float
    end_s : float
        When it came to rest or had fallen, from the record's first sample.
    """

    azimuth_deg: float
    overturned: bool
    overturned_towards: str | None
    max_rotation_rad: float
    final_displacement_m: float
    max_displacement_m: float
    end_s: float


def respond_directions(
    block: Block, record: Record, *, vertical: Factor | None = None, step_deg: float = STEP_DEG, **options: Any
) -> list[AzimuthFate]:
    """Return what becomes of a body in every direction of a record, the worst first.

    Directions run over the half circle when the body is the same to both sides, else over the whole. A body that falls is worse than one
    that leans, one that falls sooner worse than one that falls later, one that leans further worse than one that leans less, and of two
    that do not lean the one that moves further is worse.

    Parameters
    ----------
    block : Block
    record : Record
        With two horizontal components.
    vertical : bool, float or None
        Whether the vertical motion acts, or a factor on it; None: where the record has one.
    step_deg : float
        Degrees between directions.
    options
        ``mu``, ``mu_kinetic``, ``restitution``, ``rocking_restitution``, ``gravity``, ``tenon`` as in
        :func:`~seisblock.solvers.respond.solve.solve_respond`, and ``settle_s``.

    Examples
    --------
    >>> from seisblock.bodies.library import load_block
    >>> from seisblock.readers import read
    >>> worst = respond_directions(load_block("gravestone"), read("synthetic_jma.csv"), mu=0.5, step_deg=45.0)[0]
    >>> worst.azimuth_deg
    90.0
    """
    checks.instance(block, Block)
    checks.instance(record, Record)
    checks.positive("the step between directions", step_deg, "degrees")
    settle_s = options.pop("settle_s", 60.0)
    round_about = 360.0 if block.centroid_offset else 180.0
    check_budget(noted("directions"), math.ceil(round_about / step_deg), "SEISBLOCK_RUNS")
    azimuths = np.arange(0.0, round_about, step_deg)
    motion = motion_of(record, "0")
    turn = np.radians(azimuths)
    gains = np.column_stack([np.cos(turn), -np.sin(turn), np.full(turn.size, vertical_gain(motion, vertical))])
    fates = respond_many([make_setting(block, **options)] * turn.size, motion, gains=gains, settle_s=settle_s)
    found = [_direction(float(azimuth), fates, row, motion.start_s) for row, azimuth in enumerate(azimuths)]
    return sorted(found, key=_severity, reverse=True)


def _severity(each: AzimuthFate) -> tuple[float, float, float]:
    """Return what makes one direction worse than another."""
    if each.overturned:
        return 1.0, -each.end_s, each.max_displacement_m
    return 0.0, round(each.max_rotation_rad, 12), each.max_displacement_m


def _direction(azimuth: float, fates: Fates, row: int, start_s: float) -> AzimuthFate:
    """Return the fate of one direction."""
    fallen = bool(fates.overturned[row])
    return AzimuthFate(
        azimuth,
        fallen,
        ("+x" if fates.towards[row] > 0 else "-x") if fallen else None,
        float(fates.max_rotation_rad[row]),
        float(fates.final_displacement_m[row]),
        float(fates.max_displacement_m[row]),
        start_s + float(fates.end_s[row]),
    )

"""Rocking in every direction: NS and EW are the sensor's axes, and the worst azimuth is what the object may have met."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Unpack

import numpy as np

from seisblock.bodies.block import Block
from seisblock.bodies.blocks import gathered
from seisblock.bodies.scan.body import ScannedBody
from seisblock.records import Record, motion_of
from seisblock.solvers.rock.rocker import RockOptions, rockers
from seisblock.solvers.rock.solve import solve_rock
from seisblock.studies.azimuths import STEP_DEG, sweep
from seisblock.studies.rocking.verdicts import all_verdicts
from seisblock.typing import Progress


@dataclass(frozen=True)
class RockAzimuth:
    """What became of a block that rocks when its +x points to an azimuth.

    Parameters
    ----------
    azimuth_deg : float
        Clockwise from north.
    overturned : bool
        During the record or, by its energy, afterwards.
    overturned_towards : str or None
    overturning_time_s : float or None
        When it lies, from the record's first sample.
    max_rotation_ratio : float
        Largest lean over alpha of the side concerned.
    slenderness_rad : float
        alpha of the side to which it falls more easily.
    gave_up : bool
        Whether the run was given up, so that there is no answer in this direction, and the largest lean stands at 0.
    """

    azimuth_deg: float
    overturned: bool
    overturned_towards: str | None
    overturning_time_s: float | None
    max_rotation_ratio: float
    slenderness_rad: float
    gave_up: bool = False


def rock_directions(
    body: Block | ScannedBody,
    record: Record,
    *,
    step_deg: float = STEP_DEG,
    progress: Progress | None = None,
    **options: Unpack[RockOptions],
) -> list[RockAzimuth]:
    """Return what becomes of a block, or of a scan, in every direction of a record, the worst first.

    Directions are those of :func:`~seisblock.studies.azimuths.sweep`; all of them go through the record side by side. One in which it
    falls is worse than one in which it does not, one in which it falls sooner worse than one in which it falls later, and of two in which
    it stands the one in which it leans further over alpha is worse.

    Parameters
    ----------
    body : Block or ScannedBody
    record : Record
        With two horizontal components of known azimuths.
    step_deg : float
        Degrees between directions.
    progress : callable
        Told the number of runs done and the number in all.
    options
        ``restitution``, ``linear``, ``vertical``, ``gravity`` of :func:`~seisblock.solvers.rock.solve.solve_rock`.

    Examples
    --------
    >>> from seisblock.readers import read
    >>> worst = rock_directions(Block(0.24, 0.72), read("synthetic_jma.csv"), step_deg=45.0)[0]
    >>> worst.azimuth_deg, worst.overturned
    (90.0, True)
    """
    around = sweep(body, record, step_deg=step_deg, vertical=options.get("vertical", False))
    some = rockers(gathered(around.blocks), around.motion, **options)
    found = all_verdicts(some, around.motion, around.gains, progress=progress)
    directions = []
    for row, (azimuth, block) in enumerate(zip(around.azimuths.tolist(), around.blocks, strict=True)):
        fallen, time = bool(found.overturned[row]), float(found.lies_down_s[row])
        if fallen and np.isnan(time):  # after the record, where energy decides
            after = solve_rock(block, motion_of(record, f"{azimuth:g}"), **options).outcome.overturning_time_s
        else:
            after = around.motion.start_s + time if fallen else None
        gave_up = bool(found.gave_up[row])
        ratio = 0.0 if gave_up else float(found.max_rotation_ratio[row])
        towards = ("+x" if found.towards[row] > 0 else "-x") if fallen else None
        directions.append(RockAzimuth(azimuth, fallen, towards, after, ratio, block.slenderness, gave_up))
    return sorted(directions, key=_severity, reverse=True)


def _severity(each: RockAzimuth) -> tuple[bool, float]:
    """Return what makes one direction worse than another."""
    if each.gave_up:
        return False, -1.0
    if each.overturned:
        return True, -(each.overturning_time_s if each.overturning_time_s is not None else np.inf)
    return False, round(each.max_rotation_ratio, 12)

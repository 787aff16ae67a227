"""Rocking in every direction: NS and EW are the sensor's axes, and the worst azimuth is what the object may have met."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Unpack

import numpy as np

from seisblock.bodies.block import Block
from seisblock.bodies.block_array import to_block_array
from seisblock.bodies.scan.body import ScannedBody
from seisblock.core.typing import Progress
from seisblock.models.rock.params import RockOptions, rock_batch_params
from seisblock.models.rock.solve import solve_rock
from seisblock.records import Record, motion_of
from seisblock.studies.azimuths import STEP_DEG, make_azimuth_sweep
from seisblock.studies.rocking.verdicts import parallel_verdicts


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

    Directions are those of :func:`~seisblock.studies.azimuths.make_azimuth_sweep`; all of them go through the record side by side. One
    in which it
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
        ``restitution``, ``linear``, ``vertical``, ``gravity`` of :func:`~seisblock.models.rock.solve.solve_rock`.

    Examples
    --------
    >>> from seisblock.readers import read
    >>> worst = rock_directions(Block(0.24, 0.72), read("synthetic_jma.csv"), step_deg=45.0)[0]
    >>> worst.azimuth_deg, worst.overturned
    (90.0, True)
    """
    azimuth_sweep = make_azimuth_sweep(body, record, step_deg=step_deg, vertical=options.get("vertical", False))
    params = rock_batch_params(to_block_array(azimuth_sweep.blocks), azimuth_sweep.motion, **options)
    verdicts = parallel_verdicts(params, azimuth_sweep.motion, azimuth_sweep.gains, progress=progress)
    directions = []
    for row, (azimuth, block) in enumerate(zip(azimuth_sweep.azimuths.tolist(), azimuth_sweep.blocks, strict=True)):
        fallen, time = bool(verdicts.overturned[row]), float(verdicts.overturning_time_s[row])
        if fallen and np.isnan(time):  # after the record, where energy decides
            fall_time = solve_rock(block, motion_of(record, f"{azimuth:g}"), **options).outcome.overturning_time_s
        else:
            fall_time = azimuth_sweep.motion.start_s + time if fallen else None
        gave_up = bool(verdicts.gave_up[row])
        ratio = 0.0 if gave_up else float(verdicts.max_rotation_ratio[row])
        direction = ("+x" if verdicts.direction[row] > 0 else "-x") if fallen else None
        directions.append(RockAzimuth(azimuth, fallen, direction, fall_time, ratio, block.slenderness, gave_up))
    return sorted(directions, key=_severity, reverse=True)


def _severity(direction: RockAzimuth) -> tuple[bool, float]:
    """Return what makes one direction worse than another."""
    if direction.gave_up:
        return False, -1.0
    if direction.overturned:
        return True, -(direction.overturning_time_s if direction.overturning_time_s is not None else np.inf)
    return False, round(direction.max_rotation_ratio, 12)

"""Rocking of one block in every horizontal direction of a record.

NS and EW are the axes of the sensor, not of the body: an object of unknown orientation may have met the worst azimuth.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from seisblock.bodies.block import Block
from seisblock.bodies.block_array import to_block_array
from seisblock.bodies.scan.body import ScannedBody
from seisblock.core._display import DisplayMixin
from seisblock.models.rock.options import RockOptions
from seisblock.models.rock.params import rock_batch_params
from seisblock.models.rock.solve import solve_rock
from seisblock.records import Record
from seisblock.records.motion import motion_toward
from seisblock.studies.azimuths import STEP_DEG, make_azimuth_sweep
from seisblock.studies.rocking.verdicts import parallel_verdicts


@dataclass(frozen=True, repr=False)
class RockAzimuth(DisplayMixin):
    """Rocking of a block with its +x axis at one azimuth.

    Parameters
    ----------
    azimuth_deg : float
        Clockwise from north.
    overturned : bool
        During the record or, by its energy, afterwards.
    overturned_towards : str or None
    overturning_time_s : float or None
        Time of overturning, from the record's first sample.
    max_rotation_ratio : float
        Peak tilt over alpha of the side concerned.
    slenderness_rad : float
        Smaller alpha of the two sides.
    gave_up : bool
        True for a run that was stopped without a result; the peak tilt is then 0.
    overturning_probability : float or None
        Share of the samples that overturn; None without samples.
    """

    azimuth_deg: float
    overturned: bool
    overturned_towards: str | None
    overturning_time_s: float | None
    max_rotation_ratio: float
    slenderness_rad: float
    gave_up: bool = False
    overturning_probability: float | None = None

    @property
    def moves(self) -> bool:
        """True if the block rocks."""
        return self.max_rotation_ratio > 0.0


def rock_directions(
    body: Block | ScannedBody,
    record: Record,
    options: RockOptions = RockOptions(),
    *,
    step_deg: float = STEP_DEG,
) -> list[RockAzimuth]:
    """Return the rocking of a block, or of a scan, in every direction of a record, the worst direction first.

    Directions are those of :func:`~seisblock.studies.azimuths.make_azimuth_sweep`; all are integrated in one batch. Order:
    overturning (the earlier, the worse), then peak tilt over alpha. Directions without a result come last.

    Parameters
    ----------
    body : Block or ScannedBody
    record : Record
        With two horizontal components of known azimuths.
    options : RockOptions
    step_deg : float
        Step between directions, degrees.

    Returns
    -------
    list of RockAzimuth
        Worst direction first.

    Examples
    --------
    >>> from seisblock.studies import rock_directions
    >>> from seisblock.readers import read
    >>> worst = rock_directions(Block(0.24, 0.72), read("synthetic_jma.csv"), step_deg=45.0)[0]
    >>> worst.azimuth_deg, worst.overturned
    (90.0, True)
    """
    azimuth_sweep = make_azimuth_sweep(body, record, step_deg=step_deg, vertical=options.vertical)
    params = rock_batch_params(to_block_array(azimuth_sweep.blocks), azimuth_sweep.motion, options)
    verdicts = parallel_verdicts(params, azimuth_sweep.motion, azimuth_sweep.gains)
    directions = []
    for row, (azimuth, block) in enumerate(zip(azimuth_sweep.azimuths.tolist(), azimuth_sweep.blocks, strict=True)):
        fallen, time = bool(verdicts.overturned[row]), float(verdicts.overturning_time_s[row])
        if fallen and np.isnan(time):  # falls after the record: energy decides, and a single run gives the time
            fall_time = solve_rock(block, motion_toward(record, azimuth), **options.keywords()).outcome.overturning_time_s
        else:
            fall_time = azimuth_sweep.motion.start_s + time if fallen else None
        gave_up = bool(verdicts.gave_up[row])
        ratio = 0.0 if gave_up else float(verdicts.max_rotation_ratio[row])
        direction = ("+x" if verdicts.direction[row] > 0 else "-x") if fallen else None
        directions.append(RockAzimuth(azimuth, fallen, direction, fall_time, ratio, block.slenderness, gave_up))
    return sorted(directions, key=_severity, reverse=True)


def _severity(direction: RockAzimuth) -> tuple[bool, float]:
    """Return the sort key of a direction: overturning, then peak tilt."""
    if direction.gave_up:
        return False, -1.0
    if direction.overturned:
        return True, -(direction.overturning_time_s if direction.overturning_time_s is not None else np.inf)
    # rounding: round-off in the tilt of mirrored directions must not decide the order
    return False, round(direction.max_rotation_ratio, 12)

"""Full response of one body in every horizontal direction of a record.

NS and EW are the axes of the sensor, not of the body: an object of unknown orientation may have met the worst azimuth.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from seisblock.bodies.block import Block
from seisblock.bodies.scan.body import ScannedBody
from seisblock.core._display import DisplayMixin
from seisblock.core.i18n import lazy_gettext
from seisblock.models.respond.batch import RespondBatchResult, respond_many
from seisblock.models.respond.options import RespondOptions
from seisblock.models.respond.solve import respond_params
from seisblock.records import Record
from seisblock.studies.azimuths import STEP_DEG, make_azimuth_sweep


@dataclass(frozen=True, repr=False)
class RespondAzimuth(DisplayMixin):
    """Response of the body with its +x axis at one azimuth.

    Parameters
    ----------
    azimuth_deg : float
        Clockwise from north.
    overturned : bool
    overturned_towards : str or None
    max_rotation_rad, final_displacement_m, max_displacement_m : float
    end_s : float
        Time of rest or of overturning, from the record's first sample.
    max_rotation_ratio : float
        Peak tilt over alpha of the side with the smaller alpha.
    gave_up : bool
        True for a run that was stopped without a result; the numbers are those of that instant.
    """

    azimuth_deg: float
    overturned: bool
    overturned_towards: str | None
    max_rotation_rad: float
    final_displacement_m: float
    max_displacement_m: float
    end_s: float
    max_rotation_ratio: float
    gave_up: bool = False


def left_out_directions(directions: Sequence[Any]) -> list[str]:
    """Return one sentence naming the directions without a result; an empty list if every direction has one."""
    sorted_directions = sorted(directions, key=lambda direction: direction.azimuth_deg)
    azimuths = [f"{direction.azimuth_deg:g}" for direction in sorted_directions if direction.gave_up]
    if not azimuths:
        return []
    text = "no result in {count} of {all} azimuths (run stopped): {azimuths} deg"
    return [lazy_gettext(text, count=len(azimuths), all=len(directions), azimuths=", ".join(azimuths))]


def respond_directions(
    block: Block | ScannedBody, record: Record, options: RespondOptions, *, step_deg: float = STEP_DEG
) -> list[RespondAzimuth]:
    """Return the response of a body in every direction of a record, the worst direction first.

    Directions are those of :func:`~seisblock.studies.azimuths.make_azimuth_sweep`; all are integrated in one batch. Order:
    overturning (the earlier, the worse), then peak tilt, then, without tilt, maximum displacement. Directions without a result
    come last.

    Parameters
    ----------
    block : Block or ScannedBody
    record : Record
        With two horizontal components.
    options : RespondOptions
    step_deg : float
        Step between directions, degrees.

    Raises
    ------
    SolverError
        If no direction has a result.

    Examples
    --------
    >>> from seisblock.studies import respond_directions
    >>> from seisblock.bodies.factory import load_block
    >>> from seisblock.readers import read
    >>> worst = respond_directions(load_block("gravestone"), read("synthetic_jma.csv"), RespondOptions(mu=0.5), step_deg=45.0)[0]
    >>> worst.azimuth_deg
    135.0
    """
    azimuth_sweep = make_azimuth_sweep(block, record, step_deg=step_deg, vertical=options.vertical)
    settings = [respond_params(oriented_block, options) for oriented_block in azimuth_sweep.blocks]
    result = respond_many(settings, azimuth_sweep.motion, gains=azimuth_sweep.gains, settle_s=options.settle_s)
    if result.gave_up.all():
        result.require_complete()
    start_s = azimuth_sweep.motion.start_s
    directions = [
        _direction(azimuth, block, result, row, start_s)
        for row, (azimuth, block) in enumerate(zip(azimuth_sweep.azimuths.tolist(), azimuth_sweep.blocks, strict=True))
    ]
    return sorted(directions, key=_severity, reverse=True)


def _severity(direction: RespondAzimuth) -> tuple[float, float, float]:
    """Return the sort key of a direction: overturning, then peak tilt, then displacement."""
    if direction.gave_up:
        return -1.0, 0.0, 0.0
    if direction.overturned:
        return 1.0, -direction.end_s, direction.max_displacement_m
    # rounding: round-off in the tilt of mirrored directions must not decide before the displacement does
    return 0.0, round(direction.max_rotation_rad, 12), direction.max_displacement_m


def _direction(azimuth: float, block: Block, result: RespondBatchResult, row: int, start_s: float) -> RespondAzimuth:
    fallen = bool(result.overturned[row])
    return RespondAzimuth(
        azimuth,
        fallen,
        ("+x" if result.direction[row] > 0 else "-x") if fallen else None,
        float(result.max_rotation_rad[row]),
        float(result.final_displacement_m[row]),
        float(result.max_displacement_m[row]),
        start_s + float(result.end_s[row]),
        float(result.max_rotation_rad[row]) / block.slenderness,
        bool(result.gave_up[row]),
    )

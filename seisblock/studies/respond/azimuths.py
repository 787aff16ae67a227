"""Every direction: NS and EW are the sensor's axes, and the worst azimuth is what the object may have met."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from seisblock.bodies.block import Block
from seisblock.bodies.scan.body import ScannedBody
from seisblock.core.i18n import lazy_gettext
from seisblock.models.respond.batch import RespondBatchResult, respond_many
from seisblock.models.respond.solve import respond_params
from seisblock.records import Record
from seisblock.records._validation import Gain
from seisblock.studies.azimuths import STEP_DEG, make_azimuth_sweep


@dataclass(frozen=True)
class RespondAzimuth:
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
    max_rotation_ratio : float
        Largest lean over alpha of the side to which it falls more easily.
    gave_up : bool
        Whether the run was given up, so that there is no answer in this direction; numbers are those of that instant.
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


def left_out_directions(found: Sequence[Any]) -> list[str]:
    """Return a sentence that names the directions without an answer, none where each has one."""
    azimuths = [f"{each.azimuth_deg:g}" for each in sorted(found, key=lambda each: each.azimuth_deg) if each.gave_up]
    if not azimuths:
        return []
    text = "{count} of {all} directions have no answer, for the run was given up: {azimuths} deg"
    return [lazy_gettext(text, count=len(azimuths), all=len(found), azimuths=", ".join(azimuths))]


def respond_directions(
    block: Block | ScannedBody, record: Record, *, vertical: Gain | None = None, step_deg: float = STEP_DEG, **options: Any
) -> list[RespondAzimuth]:
    """Return what becomes of a body in every direction of a record, the worst first.

    Directions are those of :func:`~seisblock.studies.azimuths.make_azimuth_sweep`; all of them go through the record side by side. A
    body that falls
    is worse than one that leans, one that falls sooner worse than one that falls later, one that leans further worse than one that leans
    less, and of two that do not lean the one that moves further is worse. Directions without an answer come last.

    Parameters
    ----------
    block : Block or ScannedBody
    record : Record
        With two horizontal components.
    vertical : bool, float or None
        Whether the vertical motion acts, or a factor on it; None: where the record has one.
    step_deg : float
        Degrees between directions.
    options
        ``mu``, ``mu_kinetic``, ``restitution``, ``rocking_restitution``, ``gravity``, ``tenon`` as in
        :func:`~seisblock.models.respond.solve.solve_respond`, and ``settle_s``.

    Raises
    ------
    SolverError
        If no direction has an answer.

    Examples
    --------
    >>> from seisblock.bodies.factory import load_block
    >>> from seisblock.readers import read
    >>> worst = respond_directions(load_block("gravestone"), read("synthetic_jma.csv"), mu=0.5, step_deg=45.0)[0]
    >>> worst.azimuth_deg
    135.0
    """
    settle_s = options.pop("settle_s", 60.0)
    azimuth_sweep = make_azimuth_sweep(block, record, step_deg=step_deg, vertical=vertical)
    settings = [respond_params(oriented_block, **options) for oriented_block in azimuth_sweep.blocks]
    result = respond_many(settings, azimuth_sweep.motion, gains=azimuth_sweep.gains, settle_s=settle_s)
    if result.gave_up.all():
        result.require_complete()
    start_s = azimuth_sweep.motion.start_s
    directions = [
        _direction(azimuth, block, result, row, start_s)
        for row, (azimuth, block) in enumerate(zip(azimuth_sweep.azimuths.tolist(), azimuth_sweep.blocks, strict=True))
    ]
    return sorted(directions, key=_severity, reverse=True)


def _severity(direction: RespondAzimuth) -> tuple[float, float, float]:
    """Return what makes one direction worse than another."""
    if direction.gave_up:
        return -1.0, 0.0, 0.0
    if direction.overturned:
        return 1.0, -direction.end_s, direction.max_displacement_m
    return 0.0, round(direction.max_rotation_rad, 12), direction.max_displacement_m


def _direction(azimuth: float, block: Block, result: RespondBatchResult, row: int, start_s: float) -> RespondAzimuth:
    """Return the fate of one direction."""
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

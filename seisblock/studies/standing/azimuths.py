"""Every direction: NS and EW are the sensor's axes, and the worst azimuth is what the object may have met."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from seisblock.bodies.block import Block
from seisblock.bodies.scan.body import ScannedBody
from seisblock.records import Record
from seisblock.records.given import Factor
from seisblock.solvers.respond.many import Fates, respond_many
from seisblock.solvers.respond.solve import make_setting
from seisblock.studies.azimuths import STEP_DEG, sweep
from seisblock.words import said


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
    return [said(text, count=len(azimuths), all=len(found), azimuths=", ".join(azimuths))]


def respond_directions(
    block: Block | ScannedBody, record: Record, *, vertical: Factor | None = None, step_deg: float = STEP_DEG, **options: Any
) -> list[AzimuthFate]:
    """Return what becomes of a body in every direction of a record, the worst first.

    Directions are those of :func:`~seisblock.studies.azimuths.sweep`; all of them go through the record side by side. A body that falls
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
        :func:`~seisblock.solvers.respond.solve.solve_respond`, and ``settle_s``.

    Raises
    ------
    SolverError
        If no direction has an answer.

    Examples
    --------
    >>> from seisblock.bodies.library import load_block
    >>> from seisblock.readers import read
    >>> worst = respond_directions(load_block("gravestone"), read("synthetic_jma.csv"), mu=0.5, step_deg=45.0)[0]
    >>> worst.azimuth_deg
    135.0
    """
    settle_s = options.pop("settle_s", 60.0)
    around = sweep(block, record, step_deg=step_deg, vertical=vertical)
    settings = [make_setting(each, **options) for each in around.blocks]
    fates = respond_many(settings, around.motion, gains=around.gains, settle_s=settle_s)
    if fates.gave_up.all():
        fates.answered()
    start_s = around.motion.start_s
    found = [
        _direction(azimuth, block, fates, row, start_s)
        for row, (azimuth, block) in enumerate(zip(around.azimuths.tolist(), around.blocks, strict=True))
    ]
    return sorted(found, key=_severity, reverse=True)


def _severity(each: AzimuthFate) -> tuple[float, float, float]:
    """Return what makes one direction worse than another."""
    if each.gave_up:
        return -1.0, 0.0, 0.0
    if each.overturned:
        return 1.0, -each.end_s, each.max_displacement_m
    return 0.0, round(each.max_rotation_rad, 12), each.max_displacement_m


def _direction(azimuth: float, block: Block, fates: Fates, row: int, start_s: float) -> AzimuthFate:
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
        float(fates.max_rotation_rad[row]) / block.slenderness,
        bool(fates.gave_up[row]),
    )

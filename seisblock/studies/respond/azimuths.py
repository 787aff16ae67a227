"""Full response of one body in every horizontal direction of a record.

NS and EW are the axes of the sensor, not of the body: an object of unknown orientation may have met the worst azimuth.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from seisblock.bodies.block import Block
from seisblock.bodies.convex import convex_body
from seisblock.bodies.scan.body import ScannedBody
from seisblock.bodies.scan.polygon import nearest_edge
from seisblock.core._display import DisplayMixin
from seisblock.core.i18n import lazy_gettext
from seisblock.models.respond.batch import RespondBatchResult, respond_many
from seisblock.models.respond.options import RespondOptions
from seisblock.models.respond.solve import respond_params
from seisblock.models.rigid3d.options import Rigid3dOptions
from seisblock.models.rigid3d.solve import Body, solve_rigid3d
from seisblock.records import Record
from seisblock.records.motion import motion_toward
from seisblock.records.rotation import oriented_pair
from seisblock.studies.azimuths import STEP_DEG, make_azimuth_sweep
from seisblock.studies.parallel import map_threads


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
    overturning_probability : float or None
        Share of the samples that overturn; None without samples.
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
    overturning_probability: float | None = None

    @property
    def moves(self) -> bool:
        """True if the body tilts or slides."""
        return self.max_rotation_ratio > 0.0 or self.max_displacement_m > 0.0


def left_out_directions(directions: Sequence[Any]) -> list[str]:
    """Return one sentence naming the directions without a result; an empty list if every direction has one."""
    sorted_directions = sorted(directions, key=lambda direction: direction.azimuth_deg)
    azimuths = [f"{direction.azimuth_deg:g}" for direction in sorted_directions if direction.gave_up]
    if not azimuths:
        return []
    text = "no result in {count} of {all} azimuths (run stopped): {azimuths}°"
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

    Returns
    -------
    list of RespondAzimuth
        Worst direction first.

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
    90.0
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
        float(result.max_rotation_ratio[row]),
        bool(result.gave_up[row]),
    )


@dataclass(frozen=True, repr=False)
class Rigid3dAzimuth(DisplayMixin):
    """Response in three dimensions of the body with its +x axis at one azimuth.

    Parameters
    ----------
    azimuth_deg : float
        Clockwise from north.
    overturned : bool
    fell_azimuth_deg : float or None
    max_tilt_rad, twist_deg, final_displacement_m, max_displacement_m : float
        Displacements are distances, m.
    max_rotation_ratio : float
        Largest tilt over the smallest slenderness angle of the base.
    """

    azimuth_deg: float
    overturned: bool
    fell_azimuth_deg: float | None
    max_tilt_rad: float
    twist_deg: float
    final_displacement_m: float
    max_displacement_m: float
    max_rotation_ratio: float
    gave_up: bool = False

    @property
    def overturned_towards(self) -> str | None:
        """Sense of +x that the azimuth stands for, where the body overturned."""
        return "+x" if self.overturned else None

    @property
    def moves(self) -> bool:
        """True if the body tilts or slides."""
        return self.max_rotation_ratio > 0.0 or self.max_displacement_m > 0.0


def rigid3d_directions(body: Body, record: Record, options: Rigid3dOptions, *, step_deg: float = STEP_DEG) -> list[Rigid3dAzimuth]:
    """Return the response in three dimensions with +x of a body at every azimuth of the full circle, the worst first.

    All components act in each run; a scan is turned instead of facing one azimuth. Runs are done in threads.

    Parameters
    ----------
    body : Block, Scan, ScannedBody or ConvexBody
    record : Record
        With two horizontal components of known azimuths.
    options : Rigid3dOptions
    step_deg : float
        Step between directions, degrees.
    """
    solid = convex_body(body)
    polygon = solid.support_polygon - np.array(solid.centre[:2])
    alpha = math.atan2(nearest_edge(polygon, (0.0, 0.0))[0], solid.centre[2] - float(solid.points[:, 2].min()))
    oriented_pair(record)

    def work(azimuth: float) -> Rigid3dAzimuth:
        outcome = solve_rigid3d(solid, motion_toward(record, azimuth), **options.keywords()).outcome
        return Rigid3dAzimuth(
            azimuth,
            outcome.overturned,
            outcome.fell_azimuth_deg,
            outcome.max_tilt_rad,
            outcome.twist_deg,
            math.hypot(*outcome.final_displacement_m),
            outcome.max_displacement_m,
            outcome.max_tilt_rad / alpha,
        )

    results = map_threads(work, np.arange(0.0, 360.0, step_deg).tolist())
    return sorted(results, key=lambda result: (result.overturned, round(result.max_tilt_rad, 12), result.max_displacement_m), reverse=True)

"""Outcome of a run in three dimensions."""

from __future__ import annotations

import math
from dataclasses import dataclass

from seisblock.core._display import DisplayMixin
from seisblock.models.rigid3d import buffers
from seisblock.models.rigid3d.buffers import Q, Workspace, X


@dataclass(frozen=True, repr=False)
class Rigid3dOutcome(DisplayMixin):
    """Result of a run in three dimensions.

    Times are in s from the record's first sample; displacements are those of the centre of gravity relative to the ground.

    Parameters
    ----------
    overturned : bool
        True if the centre of gravity passed an edge of the base for good, and the body reached a tilt of pi/2 or landed on another side.
    overturning_time_s : float or None
        Time of that tilt or landing.
    final_displacement_m : list of two floats
        Displacement along x and y at the end.
    twist_deg : float
        Rotation about the vertical at the end, counter-clockwise seen from above, from -180 to 180.
    max_tilt_rad : float
        Largest angle between the body's axis and the vertical.
    fell_azimuth_deg : float or None
        Azimuth of the fall, clockwise from north; from +x, counted clockwise, where the azimuth of +x is unknown.
    max_displacement_m : float
        Largest horizontal displacement.
    impacts : int
        Number of impacts of vertices.
    energy_contacts_j, energy_ground_j, created_j : float
        Energy that contacts dissipated, work of the ground motion, and energy that impacts and contacts created, 0 but for round-off.
    settled : bool
        True if the body is at rest at the end.
    end_s : float
        Time at which it came to rest, or at which the run was abandoned.
    moved : bool
        True if the body left its rest.
    """

    overturned: bool
    overturning_time_s: float | None
    final_displacement_m: tuple[float, float]
    twist_deg: float
    max_tilt_rad: float
    fell_azimuth_deg: float | None
    max_displacement_m: float
    impacts: int
    energy_contacts_j: float
    energy_ground_j: float
    created_j: float
    settled: bool
    end_s: float
    moved: bool


def build_outcome(scratch: Workspace, start_s: float, dt: float, azimuth_deg: float | None) -> Rigid3dOutcome:
    """Return the outcome of a run that started at a time."""
    ledger, state = scratch.ledger, scratch.state
    time = float(ledger[buffers.OVERTURNING_TIME])
    overturned = math.isfinite(time)
    settled = bool(scratch.counters[buffers.AT_REST])
    end = float(ledger[buffers.REST_TIME]) if settled else int(scratch.counters[buffers.SAMPLE]) * dt
    direction = math.degrees(math.atan2(ledger[buffers.UP_Y], ledger[buffers.UP_X]))
    twist = 2.0 * math.atan2(float(state[Q + 3]), float(state[Q]))
    return Rigid3dOutcome(
        overturned=overturned,
        overturning_time_s=start_s + time if overturned else None,
        final_displacement_m=(float(state[X] - ledger[buffers.START_X]), float(state[X + 1] - ledger[buffers.START_Y])),
        twist_deg=math.degrees(math.remainder(twist, 2.0 * math.pi)),
        max_tilt_rad=float(ledger[buffers.MAX_TILT]),
        fell_azimuth_deg=((azimuth_deg or 0.0) - direction) % 360.0 if overturned else None,
        max_displacement_m=float(ledger[buffers.MAX_DISTANCE]),
        impacts=int(ledger[buffers.IMPACTS]),
        energy_contacts_j=float(ledger[buffers.DISSIPATED]),
        energy_ground_j=float(ledger[buffers.WORK]),
        created_j=float(ledger[buffers.CREATED]),
        settled=settled,
        end_s=start_s + end,
        moved=math.isfinite(float(ledger[buffers.LIFT_TIME])) or float(ledger[buffers.MAX_DISTANCE]) > 0.0,
    )

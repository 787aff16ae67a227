"""Studies of sliding."""

from __future__ import annotations

import math

import numpy as np

from seisblock.bodies.sliding_base import SlidingBase
from seisblock.core.registry import SolverBody
from seisblock.core.typing import BoolArray, FloatArray
from seisblock.dynamics import integrate_many
from seisblock.models.slide.final_slip import slip_at_rest
from seisblock.models.slide.model import SLIDE, STICK, UNDEFINED, parameters
from seisblock.models.slide.options import SlideOptions
from seisblock.models.slide.solve import motion_gains, raise_lift_off
from seisblock.records import Motion, Record
from seisblock.records._validation import vertical_gain
from seisblock.records.motion import motion_toward
from seisblock.studies.azimuths import sweep_azimuths
from seisblock.studies.batch.directions import DIRECTIONS, Worst
from seisblock.studies.fragility.damage_states import SLIP, EndStates
from seisblock.studies.fragility.runners import Draws
from seisblock.studies.parallel import map_batches
from seisblock.studies.sliding import slide_study, worst_directions
from seisblock.studies.solvers import SolverStudies

BATCH_SIZE = 64
"""Runs per thread and batch."""


def _end_states(solver_body: SolverBody, motion: Motion, factors: FloatArray, draws: Draws) -> EndStates:
    """Return the end states of a sliding object: maximum slip, including that after the motion, on ground at rest."""
    base = solver_body.body if isinstance(solver_body.body, SlidingBase) else SlidingBase(solver_body.body)
    options: SlideOptions = solver_body.options
    unit = np.array(motion_gains(motion, options.vertical))
    p = parameters(base, options.gravity)

    def solve_batch(part: slice) -> tuple[FloatArray, BoolArray]:
        """Return the maximum slips of some runs, and the failed ones."""
        gains = factors[part][:, None] * unit
        runs = integrate_many(SLIDE, motion, [p] * len(gains), np.zeros(4), STICK, gains=gains, allow_failures=True)
        for row in np.flatnonzero(runs.final_mode == UNDEFINED)[:1]:
            raise_lift_off(motion, float(runs.end_time[row]))
        ends: list[float] = [
            math.nan if failed else abs(slip_at_rest(state, mode, p))
            for state, mode, failed in zip(runs.final.tolist(), runs.final_mode.tolist(), runs.failed.tolist(), strict=True)
        ]
        return np.maximum(np.maximum(runs.extrema[:, 0, 0], -runs.extrema[:, 0, 2]), ends), runs.failed

    slips, failed = zip(*map_batches(solve_batch, factors.size, size=BATCH_SIZE), strict=True)
    return EndStates(slip_m=np.concatenate(slips), gave_up=np.concatenate(failed))


def _worst_azimuth(solver_body: SolverBody, record: Record, runs: int, seed: int) -> Worst:
    """Return the worst direction of a sliding object."""
    base = solver_body.body if isinstance(solver_body.body, SlidingBase) else SlidingBase(solver_body.body)
    motions = [motion_toward(record, azimuth) for azimuth in sweep_azimuths(base)]
    points = slide_study(
        base.mu,
        motions=motions,
        mu_kinetic=base.kinetic,
        slope_deg=base.slope_deg,
        slope_length=base.slope_length,
        one_way=base.one_way,
        vertical=vertical_gain(motions[0], solver_body.options.vertical),
        gravity=solver_body.options.gravity,
        workers=1,
    )
    return worst_directions(points)[0].component, {DIRECTIONS: len(points)}, []


STUDIES = SolverStudies(end_states=_end_states, limits=(SLIP,), worst_azimuth=_worst_azimuth)

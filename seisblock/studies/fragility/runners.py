"""Batch runs of one body under many factors on one motion, for each solver of a fragility."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from seisblock.core.errors import SolverError
from seisblock.core.registry import Solver, SolverBody
from seisblock.core.typing import FloatArray
from seisblock.records import Motion
from seisblock.studies.fragility.damage_states import OVERTURN, SLIP, EndStates
from seisblock.studies.parallel import map_threads
from seisblock.studies.sampling import ParameterVariation, draw_samples

Draws = FloatArray | None
"""Draws of the samples of a body, (v, 8), each uniform in [-1, 1]; None for the nominal body."""

VERSIONS = ParameterVariation(amplitude=0.0, azimuth_deg=0.0)
"""Half widths of a body as everywhere, without the shaking, whose intensity is the abscissa of the curve."""


def single_end_states(solver_body: SolverBody, motion: Motion, factors: FloatArray, draws: Draws, *, solver: Solver) -> EndStates:
    """Return the end states of a solver that solves run by run: overturning, and the largest displacement of its outcome."""

    def run_one(factor: float) -> tuple[bool, float]:
        """Return the end state of one run; NaN slip if stopped."""
        scaled_motion = Motion(motion.acceleration * factor, motion.dt, motion.name, motion.start_s, motion.record)
        try:
            outcome = solver.solve(solver_body.body, scaled_motion, **solver_body.options.keywords()).outcome
        except SolverError:
            return False, math.nan
        overturned = OVERTURN in solver.damage_states and bool(getattr(outcome, solver.damage_states[OVERTURN]))
        slip = getattr(outcome, solver.damage_states[SLIP]) if SLIP in solver.damage_states else 0.0
        return overturned, math.inf if overturned else max(map(abs, slip.values())) if isinstance(slip, Mapping) else abs(slip)

    ends = list(map_threads(run_one, factors.tolist()))
    slips = np.array([slip for _, slip in ends])
    return EndStates(overturned=np.array([fell for fell, _ in ends]), slip_m=slips, gave_up=np.isnan(slips))


def version_draws(runs: int, seed: int) -> Draws:
    """Return the draws of the samples of a body, the same for every motion and level; None for none."""
    return draw_samples(runs, seed) if runs else None

"""Many factors on one motion, and what becomes of one body at each: the runs behind a fragility, without Python between them."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from seisblock.bodies.block import Block
from seisblock.bodies.sliding_base import SlidingBase
from seisblock.dynamics import follow_many
from seisblock.errors import ParameterError, SolverError
from seisblock.records import Motion
from seisblock.records.given import vertical_gain
from seisblock.solvers.respond.many import respond_many
from seisblock.solvers.respond.setting import stand
from seisblock.solvers.respond.solve import make_setting
from seisblock.solvers.rock.rocker import Rocker, Rockers, rocker
from seisblock.solvers.slide.model import SLIDE, STICK, UNDEFINED, parameters
from seisblock.solvers.slide.rest import slip_at_rest
from seisblock.solvers.slide.solve import check, refuse_lift_off
from seisblock.solvers.stack.solve import solve_stack
from seisblock.studies.batch.models import Placed
from seisblock.studies.fragility.limits import Ends
from seisblock.studies.rocking.perturb import Spread, changed_rockers, draws_of
from seisblock.studies.rocking.verdicts import all_verdicts
from seisblock.studies.runs import in_batches, in_threads
from seisblock.studies.standing.probability import Versions, changed_settings
from seisblock.typing import BoolArray, FloatArray

Draws = FloatArray | None
"""Draws of the samples of a body, (v, 7), each uniform in [-1, 1]; None for the body as it is."""

Follow = Callable[[Placed, Motion, FloatArray, Draws], Ends]
"""``follow(placed, motion, factors, draws)``: the ends of all versions at the first factor, then at the next."""

SPREAD = Spread(amplitude=0.0, azimuth_deg=0.0)
"""How far versions of a rocking block differ: as `perturb` does, but for the shaking, whose intensity the curve is drawn over."""

VERSIONS = Versions(amplitude=0.0, azimuth_deg=0.0)
"""The same for `respond`."""

ROWS = 64
"""Runs of sliding that one thread takes at a time."""


def _rock(placed: Placed, motion: Motion, factors: FloatArray, draws: Draws) -> Ends:
    """Return the ends of a rocking block."""
    options = placed.options
    bodies: Rockers | list[Rocker]
    if draws is None:
        bodies = [rocker(placed.body, motion, **options)]
    else:
        some = changed_rockers(placed.body, motion, SPREAD, draws, **options)
        rows = np.tile(np.arange(len(draws)), factors.size)
        bodies = some[rows]
    unit = np.array(bodies.gains() if isinstance(bodies, Rockers) else bodies[0].gains())
    gains = np.repeat(factors, 1 if draws is None else len(draws))[:, None] * unit
    found = all_verdicts(bodies, motion, gains)
    return Ends(overturned=found.overturned, lean=found.max_rotation_ratio, gave_up=found.gave_up)


def _respond(placed: Placed, motion: Motion, factors: FloatArray, draws: Draws) -> Ends:
    """Return the ends of a free-standing body; one that fell was moved without end."""
    options = dict(placed.options)
    unit = np.array([1.0, 0.0, vertical_gain(motion, options.pop("vertical", None))])
    settle = options.pop("settle_s", 60.0)
    alphas: float | FloatArray = min(stand(placed.body).slendernesses)
    if draws is None:
        settings: Any = [make_setting(placed.body, **options)] * factors.size
    else:
        if not isinstance(placed.body, Block):
            raise ParameterError("{name}: versions are made of blocks alone; leave `perturb` out", name=placed.name)
        every = np.tile(draws, (factors.size, 1))
        settings = changed_settings(placed.body, VERSIONS, every, **options)
        alphas = settings.blocks.slendernesses.min(axis=1)
    gains = np.repeat(factors, 1 if draws is None else len(draws))[:, None] * unit
    fates = respond_many(settings, motion, gains=gains, settle_s=settle)
    slip = np.where(fates.overturned, np.inf, np.abs(fates.final_displacement_m))
    return Ends(fates.overturned, fates.max_rotation_rad / alphas, slip, fates.gave_up)


def _slide(placed: Placed, motion: Motion, factors: FloatArray, draws: Draws) -> Ends:
    """Return the ends of a sliding object: its largest slip, also after the motion, on ground at rest."""
    base = placed.body if isinstance(placed.body, SlidingBase) else SlidingBase(placed.body)
    options: Mapping[str, Any] = placed.options
    gravity = options.get("gravity", 9.80665)
    unit = np.array(check(motion, options.get("vertical", False), gravity))
    p = parameters(base, gravity)

    def some(part: slice) -> tuple[FloatArray, BoolArray]:
        """Return the largest slips of some runs, and which were given up."""
        gains = factors[part][:, None] * unit
        many = follow_many(SLIDE, motion, [p] * len(gains), np.zeros(4), STICK, gains=gains, allow_failures=True)
        for row in np.flatnonzero(many.final_mode == UNDEFINED)[:1]:
            refuse_lift_off(motion, float(many.end_time[row]))
        ends: list[float] = [
            math.nan if failed else abs(slip_at_rest(state, mode, p))
            for state, mode, failed in zip(many.final.tolist(), many.final_mode.tolist(), many.failed.tolist(), strict=True)
        ]
        return np.maximum(np.maximum(many.extrema[:, 0, 0], -many.extrema[:, 0, 2]), ends), many.failed

    slips, failed = zip(*in_batches(some, factors.size, size=ROWS), strict=True)
    return Ends(slip_m=np.concatenate(slips), gave_up=np.concatenate(failed))


def _stack(placed: Placed, motion: Motion, factors: FloatArray, draws: Draws) -> Ends:
    """Return the ends of a pile: whether a stone fell, and how far the one that slid most lies from its place."""

    def one(factor: float) -> tuple[bool, float]:
        """Return the end of one run; its slip is NaN where it was given up."""
        scaled = Motion(motion.acceleration * factor, motion.dt, motion.name, motion.start_s, motion.record)
        try:
            outcome = solve_stack(placed.body, scaled, **placed.options).outcome
        except SolverError:
            return False, math.nan
        return outcome.overturned_any, math.inf if outcome.overturned_any else max(outcome.residual_slip_m.values())

    ends = list(in_threads(one, factors.tolist()))
    slips = np.array([slip for _, slip in ends])
    return Ends(overturned=np.array([fell for fell, _ in ends]), slip_m=slips, gave_up=np.isnan(slips))


FOLLOWERS: dict[str, Follow] = {"respond": _respond, "rock": _rock, "slide": _slide, "stack": _stack}
"""By the names of the solvers."""

PERTURBED = ("respond", "rock")
"""Those whose bodies have versions."""


def version_draws(runs: int, seed: int) -> Draws:
    """Return what tells so many versions of a body apart, the same for every motion and level; None for none."""
    return draws_of(runs, seed) if runs else None

"""Restraint of an object: horizontal force and moment that prevent uplift and sliding, from equilibrium over the record."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np

from seisblock.bodies.block import Block
from seisblock.core.registry import SolverBody
from seisblock.core.typing import BoolArray, FloatArray
from seisblock.records._validation import Gain, vertical_gain
from seisblock.records.motion import Motion
from seisblock.studies.sampling import ParameterVariation, sample_gains
from seisblock.studies.scenario.runs import Pairs, case_params


@dataclass(frozen=True)
class RestraintDemand:
    """Largest actions on a horizontal restraint during a motion, per mass of the object.

    Parameters
    ----------
    moment : float, m^2/s^2
        Moment about the edge of the base that prevents uplift, over the mass.
    force : float, m/s^2
        Horizontal force that prevents uplift and sliding, over the mass.
    foot_slides : bool
        Whether no force at this height alone holds the object at some instant: its foot slides away and requires a stop of its own.
    foot_force : float, m/s^2
        Horizontal force on such a stop, over the mass; the restraint then prevents uplift alone.
    """

    moment: float
    force: float
    foot_slides: bool
    foot_force: float


@dataclass(frozen=True, eq=False)
class CaseDemands:
    """Actions on a restraint in many runs, the larger ones of both horizontals; arrays (records, cases), see :class:`RestraintDemand`.

    Parameters
    ----------
    moment : m^2/s^2
    force, foot_force : m/s^2
    foot_slides : bool
    """

    moment: FloatArray
    force: FloatArray
    foot_slides: BoolArray
    foot_force: FloatArray


def restraint_demand(
    block: Block, motion: Motion, *, height_m: float, mu: float, gravity: float, vertical: Gain | None = None
) -> RestraintDemand:
    """Return the largest actions on the restraint of a rigid object that stays in place.

    While the object moves with the floor its inertia force m a acts at the centre of gravity. Moments about the edge of its base
    give F z = m (abs(a) h - (g + a_v) b), horizontal forces F >= m (abs(a) - mu (g + a_v)); both are taken at each sample, between which
    the motion is linear, and not below 0. Friction at the base takes the rest, m (abs(a) - F), as long as it can, and the reaction of the
    floor lies within the base as long as F z <= m (abs(a) h + (g + a_v) b). Beside a stop at the foot the restraint bears the first of both
    forces alone, and the stop abs(m abs(a) - F) - m mu (g + a_v). Derived here; quasi-static: the restraint is stiff and has no slack.

    Parameters
    ----------
    block : Block
    motion : Motion
    height_m : float, m
        Height of the restraint above the floor.
    mu : float
        Static friction.
    gravity : float, m/s^2
    vertical : bool, float or None
        As in ``respond``.

    Examples
    --------
    >>> motion = Motion.from_arrays([0.0, 5.0, 0.0], 0.01)
    >>> demand = restraint_demand(Block(0.4, 1.2), motion, height_m=1.2, mu=0.3, gravity=10.0)
    >>> round(demand.moment, 12), demand.force, demand.foot_slides, round(demand.foot_force, 12)
    (1.0, 2.0, False, 1.166666666667)
    >>> restraint_demand(Block(0.4, 1.2), motion, height_m=0.1, mu=0.3, gravity=10.0).foot_slides
    True
    """
    weight = gravity + vertical_gain(motion, vertical) * motion.vertical
    return _demand(block.arms, block.centre, mu, motion.horizontal, weight, height_m)


def case_demands(body: SolverBody, pairs: Pairs, draws: FloatArray, *, height_m: float, variation: ParameterVariation) -> CaseDemands:
    """Return the actions on the restraint in all runs, per mass of the object.

    Parameters
    ----------
    body : SolverBody
        With a block.
    pairs, draws, variation
        As in :func:`~seisblock.studies.scenario.runs.run_cases`.
    height_m : float, m
    """
    options = body.options
    _, rows = case_params(body, pairs, draws, variation)
    shape = draws.shape[:2]
    result = CaseDemands(np.zeros(shape), np.zeros(shape), np.zeros(shape, bool), np.zeros(shape))
    for r, motions in enumerate(pairs):
        for c, motion in enumerate(motions):
            gains = sample_gains(motion, variation, draws[r], options.vertical)
            for k, (gain, column) in enumerate(zip(gains, rows[:, r, :, c].T.tolist(), strict=True)):
                right, left, centre, _, mu, *_ = column
                along = gain[0] * motion.horizontal + gain[1] * motion.transverse
                demand = _demand((right, left), centre, mu, along, options.gravity + gain[2] * motion.vertical, height_m)
                for field in fields(CaseDemands):
                    values = getattr(result, field.name)
                    values[r, k] = max(values[r, k], getattr(demand, field.name))
    return result


def _demand(arms: Sequence[float], centre: float, mu: float, a: FloatArray, weight: FloatArray, height_m: float) -> RestraintDemand:
    right, left = arms
    size = np.abs(a)
    # a ground that accelerates to +x pushes the object to -x, about its left edge
    near_arm, far_arm = np.where(a > 0.0, left, right), np.where(a > 0.0, right, left)
    moment = np.maximum(size * centre - weight * near_arm, 0.0)
    force = np.maximum(np.maximum(moment / height_m, size - mu * weight), 0.0)
    largest = np.minimum(size + mu * weight, (size * centre + weight * far_arm) / height_m)
    # below the centre of gravity the restraint may take more than the inertia force: the foot then slides to the other side
    foot_force = np.maximum(np.abs(size - moment / height_m) - mu * weight, 0.0)
    return RestraintDemand(float(moment.max()), float(force.max()), bool((force > largest).any()), float(foot_force.max()))

"""Outcome, phases, events and warnings of a rocking run."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import NamedTuple

import numpy as np

from seisblock.bodies.body_name import body_name
from seisblock.core._display import DisplayMixin
from seisblock.core.i18n import Message, lazy_gettext
from seisblock.core.results import Phase, make_phases
from seisblock.dynamics import GuardEvent, Trajectory
from seisblock.models.rock import model
from seisblock.models.rock.forces import FrictionDemand, friction_demand
from seisblock.models.rock.free_rocking import FreeRockingOutcome
from seisblock.models.rock.params import RockParams
from seisblock.records import Motion

NO_OVERTURNING = FreeRockingOutcome(False, 0, (0.0, 0.0))
"""No motion after the record."""


@dataclass(frozen=True, repr=False)
class RockOutcome(DisplayMixin):
    """Result of a rocking run; times in s from the record's first sample, None without the event.

    Parameters
    ----------
    rocks : bool
        True if rocking started.
    rocking_start_s : float or None
        First start of rocking.
    max_rotation_rad, max_rotation_ratio : float
        Peak tilt, and its ratio to alpha of the corner concerned, including free rocking after the record; pi/2 for overturning.
    max_rotation_s : float or None
        Time of the peak tilt; None if after the end of the record.
    impacts : int
        Impacts during the record, down to intervals of 1e-8 s.
    overturned : bool
        Overturning during the record or, from the energy, afterwards.
    overturning_time_s : float or None
        Time of a tilt of pi/2, exact also after the end of the record.
    alpha_passed_s : float or None
        Time at which alpha is exceeded for good.
    overturned_towards : str
        ``+x``, ``-x``, or empty.
    decided_after_record : bool
        True if the block was rocking at the end of the record, so that the energy decides.
    slenderness_rad, frequency_parameter_rad_s, restitution : float, 1
        alpha, p and e for the direction of easier overturning.
    threshold_m_s2 : float
        Rocking threshold: horizontal ground acceleration that starts rocking without vertical motion.
    max_friction_demand, max_friction_demand_s : float or None
        Largest abs(H/N) before alpha is exceeded for good, and its time; a smaller friction coefficient would permit slip. None if contact
        is lost.
    contact_lost, contact_lost_s : bool, float or None
        Loss of contact (N <= 0, jump), and its first time.
    verdict_flips_within_2_percent : bool or None
        True if a factor of 0.98 to 1.02 on the record changes the verdict; None: not tested.
    flips_at_factor : float or None
        Factor nearest to 1 that changes the verdict; None without a change, or if not tested.
    """

    rocks: bool
    rocking_start_s: float | None
    max_rotation_rad: float
    max_rotation_ratio: float
    max_rotation_s: float | None
    impacts: int
    overturned: bool
    overturning_time_s: float | None
    alpha_passed_s: float | None
    overturned_towards: str
    decided_after_record: bool
    slenderness_rad: float
    frequency_parameter_rad_s: float
    restitution: float
    threshold_m_s2: float
    max_friction_demand: float | None
    max_friction_demand_s: float | None
    contact_lost: bool
    contact_lost_s: float | None
    verdict_flips_within_2_percent: bool | None = None
    flips_at_factor: float | None = None


def friction_suffices(outcome: RockOutcome, mu: float, gravity: float) -> bool:
    """Return whether the friction coefficient `mu` permits the computed rocking without slip ([Ishiyama1982]_).

    The block slides instead of rocking for mu < b/h, and slips where abs(H/N) of rocking exceeds mu; for a block at rest the demand is
    that of the ground acceleration.
    """
    if outcome.rocks and mu < outcome.threshold_m_s2 / gravity:
        return False
    return outcome.max_friction_demand is not None and outcome.max_friction_demand <= mu


class RockRun(NamedTuple):
    """Result of an integration of a rocking block; times in s after sample 0, NaN without the event.

    Parameters
    ----------
    final_mode : int
    final_theta, end_time : float, rad, s
    extrema : four floats
        Largest tilt, its time, smallest tilt, its time.
    first_start, last_alpha : float, s
        First start of rocking from rest, and last time at which alpha is exceeded.
    starts_in_motion : bool
    impacts : int
    friction_need : FrictionDemand
    """

    final_mode: int
    final_theta: float
    end_time: float
    extrema: Sequence[float]
    first_start: float
    last_alpha: float
    starts_in_motion: bool
    impacts: int
    friction_need: FrictionDemand


def summarize(params: RockParams, motion: Motion, trajectory: Trajectory, free_outcome: FreeRockingOutcome | None) -> RockRun:
    """Return the result of a single integration."""
    changes = trajectory.events
    source, target = changes.source, changes.target
    starts = changes.time[source == model.REST]
    impacts = ((source == model.TO_RIGHT) | (source == model.TO_LEFT)) & (changes.guard == model.LOWER_BOUND)
    alpha_times = changes.time[(target == model.BEYOND_RIGHT) | (target == model.BEYOND_LEFT)]
    last_alpha = float(alpha_times[-1]) if alpha_times.size else math.nan
    mode = trajectory.final_mode
    falls_in_record = mode == model.OVERTURNED or (
        free_outcome is not None and free_outcome.overturns and mode not in (model.TO_RIGHT, model.TO_LEFT)
    )
    until_s = (last_alpha if alpha_times.size else 0.0) if falls_in_record else math.inf
    return RockRun(
        mode,
        float(trajectory.final[model.THETA]),
        trajectory.end_time,
        trajectory.extrema[model.THETA].tolist(),
        float(starts[0]) if starts.size else math.nan,
        last_alpha,
        bool(changes.source[0] if changes else mode != model.REST),
        int(np.count_nonzero(impacts)),
        friction_demand(params, motion, trajectory, until_s=until_s),
    )


def build_outcome(params: RockParams, motion: Motion, run: RockRun, free_outcome: FreeRockingOutcome | None) -> RockOutcome:
    """Return the outcome from the result of the integration over the record and the free rocking after it."""
    aftermath = free_outcome or NO_OVERTURNING
    overturned = run.final_mode == model.OVERTURNED or aftermath.overturns
    alpha_time = None
    if overturned:
        alpha_time = 0.0 if math.isnan(run.last_alpha) else run.last_alpha
        if aftermath.overturns and run.final_mode in (model.TO_RIGHT, model.TO_LEFT):
            alpha_time = run.end_time + (aftermath.passes_alpha_s or 0.0)
    high, high_s, low, low_s = run.extrema
    max_leans = (max(high, aftermath.max_leans[0]), max(-low, aftermath.max_leans[1]))
    lean = max(max_leans)
    max_time = high_s if lean == high else low_s if lean == -low else None
    has_rocked = run.starts_in_motion or not math.isnan(run.first_start)

    def absolute_time(moment: float | None) -> float | None:
        return None if moment is None else motion.start_s + moment

    direction = ""
    if overturned:
        direction = "+x" if (aftermath.direction if free_outcome else run.final_theta) > 0 else "-x"
    friction_need = run.friction_need
    return RockOutcome(
        rocks=has_rocked,
        rocking_start_s=absolute_time(0.0 if math.isnan(run.first_start) else run.first_start) if has_rocked else None,
        max_rotation_rad=lean,
        max_rotation_ratio=max(lean / alpha for lean, alpha in zip(max_leans, params.alphas, strict=True)),
        max_rotation_s=absolute_time(max_time) if has_rocked else None,
        impacts=run.impacts,
        overturned=overturned,
        overturning_time_s=absolute_time(run.end_time + (aftermath.overturns_s or 0.0)) if overturned else None,
        alpha_passed_s=absolute_time(alpha_time),
        overturned_towards=direction,
        decided_after_record=free_outcome is not None,
        slenderness_rad=params.alphas[params.weak_corner],
        frequency_parameter_rad_s=math.sqrt(params.gravity * params.levers[params.weak_corner]),
        restitution=params.restitutions[1 - params.weak_corner],
        threshold_m_s2=params.gravity * params.thresholds[params.weak_corner],
        max_friction_demand=friction_need.friction if math.isfinite(friction_need.friction) else None,
        max_friction_demand_s=absolute_time(friction_need.friction_s),
        contact_lost=friction_need.contact_lost_s is not None,
        contact_lost_s=absolute_time(friction_need.contact_lost_s),
    )


class RockEvent(StrEnum):
    """Names of the events."""

    ROCKING_STARTS = "rocking starts"
    IMPACT = "impact"
    PASSES_ALPHA = "passes alpha"
    COMES_BACK = "comes back over alpha"
    COMES_TO_REST = "comes to rest"
    OVERTURNS = "overturns"


def event_name(change: GuardEvent) -> RockEvent:
    """Return the name of an event."""
    if change.source == model.REST:
        return RockEvent.ROCKING_STARTS
    if change.target == model.OVERTURNED:
        return RockEvent.OVERTURNS
    if change.target in (model.BEYOND_RIGHT, model.BEYOND_LEFT):
        return RockEvent.PASSES_ALPHA
    if change.source in (model.BEYOND_RIGHT, model.BEYOND_LEFT):
        return RockEvent.COMES_BACK
    return RockEvent.COMES_TO_REST if change.target == model.REST else RockEvent.IMPACT


def phases(trajectory: Trajectory, start_s: float) -> Sequence[Phase]:
    """Return the phases of one mode each."""
    changes = trajectory.events
    modes = np.append(changes.source[:1] if changes else trajectory.final_mode, changes.target)
    # OVERTURNED is an end, not a phase
    count = modes.size - int(modes[-1] == model.OVERTURNED)
    edges = np.concatenate([[0.0], changes.time, [trajectory.end_time]])
    return make_phases(start_s + edges[: count + 1], modes[:count], model.MODES.__getitem__)


def warnings(params: RockParams, outcome: RockOutcome) -> tuple[Message, ...]:
    """Return the warnings of a run."""
    messages = []
    name, threshold = body_name(params.block.name), outcome.threshold_m_s2 / params.gravity
    if threshold > 1.0:
        messages.append(
            lazy_gettext("{name}: wider than tall; rocking threshold {level:.2f} g, sliding is more likely", name=name, level=threshold)
        )
    if outcome.contact_lost:
        messages.append(
            lazy_gettext(
                "{name}: contact with the ground lost at {time:.3f} s; the pure rocking model is not valid from that time on",
                name=name,
                time=outcome.contact_lost_s,
            )
        )
    return tuple(messages)

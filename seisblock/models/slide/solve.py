"""Sliding of an object on a level or sloping base that an earthquake shakes ([Fujino1978]_); the model is in ``slide_model``."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from typing import NoReturn

import numpy as np

from seisblock.bodies.sliding_base import SlidingBase
from seisblock.core import checks
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_, Message, lazy_gettext
from seisblock.core.results import Channel, Histories, Phase, Response, Status, make_events, make_phases
from seisblock.core.typing import BoolArray, FloatArray, IntArray
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.dynamics import GuardEvent, Trajectory, integrate
from seisblock.models.slide.final_slip import slip_at_rest
from seisblock.models.slide.model import BACKWARD, FLIGHT, FOOT, FORWARD, LEVEL, SLIDE, SLIP, SPEED, STICK, UNDEFINED, parameters
from seisblock.models.slide.path_length import path_length
from seisblock.records._validation import Gain, validate_inputs, vertical_gain
from seisblock.records.motion import UP, Motion
from seisblock.references import papers

SLIDING_PHASES = (N_("slip forward"), N_("slip backward"))
"""Names of the phases in which the object slides; forward is the component's positive direction, downhill on a positive slope."""


_FRICTION_SIGN = np.zeros(LEVEL)
_FRICTION_SIGN[[FORWARD, BACKWARD]] = -1.0, 1.0
"""Which way kinetic friction pushes in each mode."""


@dataclass(frozen=True)
class SlideOutcome:
    """How an object slid; displacements are relative to the base, along it, positive in the component's positive direction.

    Parameters
    ----------
    slips : bool
        Whether the object moved relative to the base at all.
    slip_start_s, slip_end_s : float or None, s
        Start of the first and end of the last slip; the end is None while it still slides at the record's end.
    max_slip_m, max_slip_time_s : float, m and s
        Largest absolute displacement up to the record's last sample, and its time.
    residual_slip_m : float, m
        Displacement at the record's last sample, signed.
    final_slip_m : float or None, m
        Displacement once the object has come to rest on ground that stopped shaking with the last sample; None when it never stops.
    slip_count : int
        Stretches of sliding in one direction, as [Fujino1978]_ counts them: a slip lasts until the relative velocity changes its sign.
    reversals : int
        Slips that follow another one without a rest between.
    path_m : float, m
        Length of the path slid, up to the record's last sample.
    fell_off_slope : bool
        Whether the object passed the foot of the slope.
    lifted_off : bool
        Whether it lost contact with the base.
    slides_at_end : bool
        Whether it still moves at the record's last sample.
    """

    slips: bool
    slip_start_s: float | None
    slip_end_s: float | None
    max_slip_m: float
    max_slip_time_s: float
    residual_slip_m: float
    final_slip_m: float | None
    slip_count: int
    reversals: int
    path_m: float
    fell_off_slope: bool
    lifted_off: bool
    slides_at_end: bool


def solve_slide(
    base: SlidingBase | float, motion: Motion, *, vertical: Gain | None = False, gravity: float = STANDARD_GRAVITY
) -> Response[SlideOutcome]:
    """Follow an object that slides on a shaken base, exactly for the piecewise linear record.

    Rigid object and base, Coulomb friction, no rocking. [Fujino1978]_ eqs. (1)-(13), corrected; equality sticks, and static friction is
    tested whenever the relative velocity is zero. Where the base falls away faster than the object (normal force zero) it flies,
    and lands plastically: our extension, flagged in the outcome.

    Parameters
    ----------
    base : SlidingBase or float
        Friction and slope; a number is the friction coefficient of a level base, static and kinetic.
    motion : Motion
        Its horizontal row acts along the slope's direction.
    vertical : bool, float or None
        Whether the vertical ground motion acts, too, or a factor on it, the paper's gamma; None: where the record has one.
    gravity : float, m/s^2

    Returns
    -------
    Response of SlideOutcome
        Channels ``ground_acceleration`` (along the base), ``lower_limit`` and ``upper_limit`` (between which static friction holds),
        ``acceleration``, ``velocity``, ``displacement`` of the object, and ``ground_velocity``; SI.

    Raises
    ------
    ParameterError
        If a number lies outside its range, or the base falls away from an object that may slide one way only.
    ComponentError
        If the vertical motion is asked of a record without one.

    Notes
    -----
    Relative to the base, u'' = g sin th - a -/+ mu_k N with N = g cos th + b per unit mass while it slides forward/backward; a and b
    are the ground's acceleration along and normal to the base.

    References
    ----------
    [Fujino1978]_, [Newmark1965]_

    Examples
    --------
    >>> import numpy as np
    >>> pulse = np.concatenate([np.full(101, 4.0), np.zeros(200)])
    >>> response = solve_slide(0.2, Motion.from_arrays(pulse, 0.01))
    >>> round(response.outcome.residual_slip_m, 4)
    -2.0997
    """
    if isinstance(base, (int, float)):
        base = SlidingBase(base)
    validate_inputs(base, SlidingBase, motion)
    gains = motion_gains(motion, vertical, gravity)
    p = parameters(base, gravity)
    trajectory = integrate(SLIDE, motion, p, np.zeros(4), STICK, gains=gains)
    if trajectory.final_mode == UNDEFINED:
        raise_lift_off(motion, trajectory.end_time)
    outcome = _outcome(trajectory, motion, p)
    options = {
        "mu": base.mu,
        "mu_kinetic": base.kinetic,
        "kappa": base.kappa,
        "vertical": gains[UP],
        "slope_deg": base.slope_deg,
        "slope_length_m": base.slope_length,
        "one_way": base.one_way,
        "gravity_m_s2": gravity,
    }
    return Response(
        "slide",
        outcome,
        motion,
        base,
        partial(_curves, motion, base, gains[UP], gravity, trajectory),
        _phases(trajectory, motion),
        make_events(trajectory.events, motion.start_s, _event_name),
        options,
        Status(trajectory.status),
        tuple(_warnings(outcome, motion)),
        papers("sliding", *(("one-way sliding",) if base.one_way else ())),
    )


def motion_gains(motion: Motion, vertical: Gain | None, gravity: float) -> tuple[float, float, float]:
    """Return the factors on the motion's three rows, or refuse what cannot act."""
    checks.gravity(gravity)
    return 1.0, 0.0, vertical_gain(motion, vertical)


def raise_lift_off(motion: Motion, time: float) -> NoReturn:
    """Refuse an object that can slide one way only and loses contact, s after sample 0; [Newmark1965]_ says nothing of it."""
    raise ParameterError(
        "{name}: at {time:.3f} s the base falls away faster than the object; sliding in one direction only is not defined in "
        "the air: leave the vertical motion out, or let it slide both ways",
        name=motion.name or lazy_gettext("motion"),
        time=motion.start_s + time,
    )


def _outcome(trajectory: Trajectory, motion: Motion, p: tuple[float, ...]) -> SlideOutcome:
    """Return the numbers of a trajectory."""
    changes = trajectory.events
    highest, highest_time, lowest, lowest_time = (float(value) for value in trajectory.extrema[0])
    slip, time = (highest, highest_time) if highest >= -lowest else (-lowest, lowest_time)
    start_modes = changes.source[(changes.guard != FOOT) & _is_sliding(changes.target)]
    is_moving = trajectory.final_mode % LEVEL != STICK
    rest_slip = slip_at_rest(trajectory.final.tolist(), trajectory.final_mode, p)
    return SlideOutcome(
        slips=bool(changes),
        slip_start_s=motion.start_s + changes[0].time if changes else None,
        slip_end_s=motion.start_s + changes[-1].time if changes and not is_moving else None,
        max_slip_m=slip,
        max_slip_time_s=motion.start_s + time,
        residual_slip_m=float(trajectory.final[SLIP]),
        final_slip_m=rest_slip if math.isfinite(rest_slip) else None,
        slip_count=len(start_modes),
        reversals=int(np.count_nonzero(_is_sliding(start_modes))),
        path_m=path_length(trajectory),
        fell_off_slope=bool(((changes.source < LEVEL) & (changes.target >= LEVEL)).any()),  # beyond its foot, and was not before
        lifted_off=bool((changes.target % LEVEL == FLIGHT).any()),
        slides_at_end=is_moving,
    )


def _is_sliding(modes: IntArray) -> BoolArray:
    """Return whether the object slides, in contact, in some modes."""
    kinds = modes % LEVEL
    return (kinds == FORWARD) | (kinds == BACKWARD)


def _warnings(outcome: SlideOutcome, motion: Motion) -> list[Message]:
    """Return what a user should know before believing the numbers."""
    name = motion.name or "x"
    messages = []
    if outcome.lifted_off:
        messages.append(
            lazy_gettext(
                "{name}: the base falls away from the object, which flies and lands plastically; the paper is silent on this", name=name
            )
        )
    if outcome.final_slip_m is None:
        messages.append(lazy_gettext("{name}: kinetic friction does not hold on this slope: once in motion it slides for ever", name=name))
    elif outcome.slides_at_end:
        messages.append(
            lazy_gettext(
                "{name}: still sliding at the record's end: max and residual slip stand for the record, and the final one for where it "
                "would stop on ground at rest",
                name=name,
            )
        )
    return messages


def _phases(trajectory: Trajectory, motion: Motion) -> Sequence[Phase]:
    """Return the stretches of stick, slip and flight; passing the foot does not end a slip."""
    changes = trajectory.events
    is_start = (changes.guard != FOOT) | (changes.source % LEVEL != changes.target % LEVEL)
    edges = np.concatenate([[0.0], changes.time[is_start], [trajectory.end_time]])
    return make_phases(motion.start_s + edges, np.append(STICK, changes.target[is_start]), SLIDE.modes.__getitem__)


def _event_name(change: GuardEvent) -> str:
    """Say what an event was."""
    source, target = change.source % LEVEL, change.target % LEVEL
    if change.guard == FOOT:
        return "foot passed downhill" if change.target > LEVEL else "foot passed uphill"
    if source == FLIGHT:
        return "landing"
    if target == FLIGHT:
        return "lift-off"
    if source == STICK:
        return "slip start"
    return "stop" if target == STICK else "reversal"


def _curves(motion: Motion, base: SlidingBase, gain: float, gravity: float, trajectory: Trajectory) -> Histories:
    """Return the curves on the trajectory's own time axis, both limits at each event."""
    path = trajectory.path
    time, modes = path.times_and_modes()
    horizontal = path.interpolate(motion.horizontal)
    vertical = gain * path.interpolate(motion.vertical) if gain else 0.0
    sine: float | FloatArray = math.sin(base.angle)
    cosine: float | FloatArray = math.cos(base.angle)
    phase = modes
    if modes.max() >= LEVEL:
        level = modes >= LEVEL
        sine, cosine, phase = np.where(level, 0.0, sine), np.where(level, 1.0, cosine), modes % LEVEL
    base_acceleration = horizontal * cosine - vertical * sine if base.slope_deg or gain else horizontal
    normal = (gravity + vertical) * cosine + (horizontal * sine if base.slope_deg else 0.0)
    pull = gravity * sine
    friction_sign = _FRICTION_SIGN[phase]
    acceleration = np.where(phase == STICK, 0.0, (pull - base_acceleration) + friction_sign * (base.kinetic * normal))
    velocity = np.zeros_like(time)
    np.cumsum(0.5 * np.diff(time) * (base_acceleration[1:] + base_acceleration[:-1]), out=velocity[1:])
    unit, speed = "m/s^2", "m/s"
    channels = (
        Channel("ground_acceleration", unit, base_acceleration, "z''"),
        Channel("lower_limit", unit, np.broadcast_to(pull - base.mu * normal, time.shape), ""),
        Channel("upper_limit", unit, np.broadcast_to(pull + base.mu * normal, time.shape), ""),
        Channel("acceleration", unit, acceleration, "x'' - z''"),
        Channel("velocity", speed, path.values(SPEED), "x' - z'"),
        Channel("displacement", "m", path.values(SLIP), "x - z"),
        Channel("ground_velocity", speed, velocity, "z'"),
    )
    return Histories(motion.start_s + time, channels)

"""Sliding solver of an object on a level or sloping base ([Fujino1978]_): `solve_slide`, outcome and warnings."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import NamedTuple, NoReturn

import numpy as np

from seisblock.bodies.sliding_base import SlidingBase
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import Message, lazy_gettext
from seisblock.core.options import keywords_of
from seisblock.core.results import Channel, Histories, Phase, Response, Status, make_events, make_phases
from seisblock.core.typing import BoolArray, FloatArray, IntArray
from seisblock.dynamics import GuardEvent, Trajectory, integrate
from seisblock.models.slide.final_slip import slip_at_rest
from seisblock.models.slide.model import BACKWARD, FLIGHT, FOOT, FORWARD, LEVEL, SLIDE, SLIP, SPEED, STICK, UNDEFINED, parameters
from seisblock.models.slide.options import SlideOptions
from seisblock.records._validation import Gain, validate_inputs, vertical_gain
from seisblock.records.motion import UP, Motion
from seisblock.references import papers


def path_length(trajectory: Trajectory) -> float:
    """Return the length of the slip path, m.

    Without flight the slip reverses at events only, so that its values there suffice; with flight all samples are used.
    """
    # in flight the velocity along the base may change its sign without an event
    changes = trajectory.events
    if (changes.target % LEVEL == FLIGHT).any():
        return _length_between_samples(trajectory)
    slip = np.append(changes.before[:, SLIP], trajectory.final[SLIP])
    return math.fsum(np.abs(np.diff(slip, prepend=0.0)).tolist())


def _length_between_samples(trajectory: Trajectory) -> float:
    """Return the length of the path over all samples and events, m; `math.fsum` makes it independent of the chunks of the trajectory."""
    increments, last_slip = list[FloatArray](), np.empty(0)
    for path in trajectory.iter_paths():
        slip = np.concatenate([last_slip, path.values(SLIP)])
        increment, last_slip = np.abs(np.diff(slip)), slip[-1:]
        increments.append(increment[increment > 0.0])
    return math.fsum(distance for part in increments for distance in part.tolist())


_FRICTION_SIGN = np.zeros(LEVEL)
_FRICTION_SIGN[[FORWARD, BACKWARD]] = -1.0, 1.0
"""Sign of the kinetic friction force in each mode."""


@dataclass(frozen=True, repr=False)
class SlideOutcome(DisplayMixin):
    """Result of a sliding run; displacements relative to the base, along it, positive in the component's positive direction.

    Parameters
    ----------
    slips : bool
        True if the object moved relative to the base.
    slip_start_s, slip_end_s : float or None, s
        Start of the first and end of the last slip; the end is None if the object slides at the end of the record.
    max_slip_m, max_slip_time_s : float, m and s
        Maximum absolute displacement during the record, and its time.
    residual_slip_m : float, m
        Displacement at the record's last sample, signed.
    final_slip_m : float or None, m
        Displacement at rest on ground that is at rest after the last sample; None if the object never stops.
    slip_count : int
        Number of slips in one direction ([Fujino1978]_): a slip lasts until the relative velocity changes its sign.
    reversals : int
        Slips that follow another slip without a rest.
    path_m : float, m
        Length of the slip path during the record.
    fell_off_slope : bool
        True if the object passed the foot of the slope.
    lifted_off : bool
        True if contact with the base was lost.
    slides_at_end : bool
        True if the object moves at the record's last sample.
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


@keywords_of(SlideOptions)
def solve_slide(base: SlidingBase | float, motion: Motion, options: SlideOptions) -> Response[SlideOutcome]:
    """Solve the sliding of an object on a base, exactly for the piecewise linear record.

    Rigid object and base, Coulomb friction, no rocking. [Fujino1978]_ eqs. (1)-(13), corrected; equality sticks, and static friction is
    tested whenever the relative velocity is zero. Where the normal force becomes zero the object is in flight and lands plastically:
    an extension of the paper, flagged in the outcome.

    Parameters
    ----------
    base : SlidingBase or float
        Friction and slope; a number is the friction coefficient of a level base, static and kinetic.
    motion : Motion
        The horizontal row acts in the direction of the slope.
    options : keyword arguments
        Fields of :class:`~seisblock.models.slide.options.SlideOptions`; the factor on the vertical component is
        gamma of the paper.

    Returns
    -------
    Response of SlideOutcome
        Channels ``ground_acceleration`` (along the base), ``lower_limit`` and ``upper_limit`` (between which static friction holds),
        ``acceleration``, ``velocity``, ``displacement`` of the object, and ``ground_velocity``; SI.

    Raises
    ------
    ParameterError
        If a number lies outside its range, or contact is lost in one-way sliding.
    ComponentError
        If `vertical` is on for a record without a vertical component.

    Notes
    -----
    Relative to the base, u'' = g sin th - a -/+ mu_k N with N = g cos th + b per unit mass in forward/backward slip ([Fujino1978]_
    eqs. (6), (11)); a and b are the ground accelerations along and normal to the base.

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
    if isinstance(base, (int, float, np.floating)):
        base = SlidingBase(float(base))
    validate_inputs(base, SlidingBase, motion)
    gravity, gains = options.gravity, motion_gains(motion, options.vertical)
    p = parameters(base, gravity)
    trajectory = integrate(SLIDE, motion, p, np.zeros(4), STICK, gains=gains)
    if trajectory.final_mode == UNDEFINED:
        raise_lift_off(motion, trajectory.end_time)
    outcome = build_outcome(_slide_run(trajectory), motion.start_s, p)
    return Response(
        "slide",
        outcome,
        motion,
        base,
        partial(_curves, motion, base, gains[UP], gravity, trajectory),
        _phases(trajectory, motion),
        make_events(trajectory.events, motion.start_s, _event_name),
        replace(options, vertical=gains[UP]),
        Status(trajectory.status),
        tuple(warnings(outcome, motion)),
        papers("sliding", *(("one-way sliding",) if base.one_way else ())),
    )


def motion_gains(motion: Motion, vertical: Gain | None) -> tuple[float, float, float]:
    """Return the gains of the motion's three rows."""
    return 1.0, 0.0, vertical_gain(motion, vertical)


def raise_lift_off(motion: Motion, time: float) -> NoReturn:
    """Raise ParameterError for loss of contact in one-way sliding, not defined by [Newmark1965]_; `time` in s after sample 0."""
    raise ParameterError(
        "{name}: contact lost at {time:.3f} s (normal force zero); one-way sliding is not defined there. Solve without vertical "
        "motion, or allow sliding in both directions",
        name=motion.name or lazy_gettext("motion"),
        time=motion.start_s + time,
    )


class SlideRun(NamedTuple):
    """Numbers of a run; times in s after the first sample, NaN without an event.

    Parameters
    ----------
    final : (n_states,) sequence
        State at the end.
    final_mode : int
    extrema : (4,) sequence
        Of the displacement: maximum, its time, minimum, its time.
    first_event, last_event : float, s
    slip_count, reversals : int
    path_m : float, m
    fell_off_slope, lifted_off : bool
    """

    final: Sequence[float]
    final_mode: int
    extrema: Sequence[float]
    first_event: float
    last_event: float
    slip_count: int
    reversals: int
    path_m: float
    fell_off_slope: bool
    lifted_off: bool


def _slide_run(trajectory: Trajectory) -> SlideRun:
    """Return the numbers of a trajectory."""
    changes = trajectory.events
    # passing the foot continues a slip
    start_modes = changes.source[(changes.guard != FOOT) & _is_sliding(changes.target)]
    first, last = (changes[0].time, changes[-1].time) if changes else (math.nan, math.nan)
    return SlideRun(
        trajectory.final.tolist(),
        trajectory.final_mode,
        trajectory.extrema[SLIP].tolist(),
        first,
        last,
        len(start_modes),
        int(np.count_nonzero(_is_sliding(start_modes))),
        path_length(trajectory),
        bool(((changes.source < LEVEL) & (changes.target >= LEVEL)).any()),
        bool((changes.target % LEVEL == FLIGHT).any()),
    )


def build_outcome(run: SlideRun, start_s: float, p: Sequence[float]) -> SlideOutcome:
    """Return the outcome of a run of a motion that starts at `start_s`, s."""
    highest, highest_time, lowest, lowest_time = run.extrema
    # the largest displacement of either sign
    slip, time = (highest, highest_time) if highest >= -lowest else (-lowest, lowest_time)
    # any event begins with the end of stick
    slips = not math.isnan(run.first_event)
    is_moving = run.final_mode % LEVEL != STICK
    rest_slip = slip_at_rest(run.final, run.final_mode, p)
    return SlideOutcome(
        slips=slips,
        slip_start_s=start_s + run.first_event if slips else None,
        slip_end_s=start_s + run.last_event if slips and not is_moving else None,
        max_slip_m=slip,
        max_slip_time_s=start_s + time,
        residual_slip_m=run.final[SLIP],
        final_slip_m=rest_slip if math.isfinite(rest_slip) else None,
        slip_count=run.slip_count,
        reversals=run.reversals,
        path_m=run.path_m,
        fell_off_slope=run.fell_off_slope,
        lifted_off=run.lifted_off,
        slides_at_end=is_moving,
    )


def _is_sliding(modes: IntArray) -> BoolArray:
    """Return which modes are slip in contact."""
    kinds = modes % LEVEL
    return (kinds == FORWARD) | (kinds == BACKWARD)


def warnings(outcome: SlideOutcome, motion: Motion) -> list[Message]:
    """Return the warnings of a run."""
    name = motion.name or "x"
    messages = []
    if outcome.lifted_off:
        messages.append(
            lazy_gettext(
                "{name}: contact with the base is lost; flight and plastic landing are an extension of Fujino et al. (1978)", name=name
            )
        )
    if outcome.final_slip_m is None:
        messages.append(
            lazy_gettext("{name}: kinetic friction is too small for this slope; once in motion the object does not stop", name=name)
        )
    elif outcome.slides_at_end:
        messages.append(
            lazy_gettext(
                "{name}: still sliding at the end of the record; maximum and residual slip refer to the record, final slip to the stop on "
                "ground at rest",
                name=name,
            )
        )
    return messages


def _phases(trajectory: Trajectory, motion: Motion) -> Sequence[Phase]:
    """Return the phases of stick, slip and flight; passing the foot does not end a slip."""
    changes = trajectory.events
    is_start = (changes.guard != FOOT) | (changes.source % LEVEL != changes.target % LEVEL)
    edges = np.concatenate([[0.0], changes.time[is_start], [trajectory.end_time]])
    return make_phases(motion.start_s + edges, np.append(STICK, changes.target[is_start]), SLIDE.modes.__getitem__)


def _event_name(change: GuardEvent) -> str:
    """Return the name of an event."""
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
    """Return the time histories at samples and at both limits of each event."""
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
    # resolved along the base: a_h cos th - a_v sin th ([Fujino1978]_ eq. (5))
    base_acceleration = horizontal * cosine - vertical * sine if base.slope_deg else horizontal
    normal = (gravity + vertical) * cosine + (horizontal * sine if base.slope_deg else 0.0)
    pull = gravity * sine
    friction_sign = _FRICTION_SIGN[phase]
    acceleration = np.where(phase == STICK, 0.0, (pull - base_acceleration) + friction_sign * (base.kinetic * normal))
    velocity = np.zeros_like(time)
    # trapezoidal rule: exact for acceleration that is linear between samples
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

"""Jump solver of a two-layer block: chains of rocking, impact, flight, landing and rocking-sliding ([Sugimoto2017]_)."""

from __future__ import annotations

import functools
import math
import operator
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial

from seisblock.bodies.two_layer import Contact, TwoLayerBlock
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import ParameterError, SolverError
from seisblock.core.options import keywords_of
from seisblock.core.results import Response
from seisblock.core.status import STOPPED
from seisblock.dynamics import Instant, integrate
from seisblock.models.jump import modes as flying
from seisblock.models.jump import rocking
from seisblock.models.jump.chain import COMPLETE, Chain, ChainOutcome, ChainPath, summarise_chain
from seisblock.models.jump.flight import FLIGHT_MODEL
from seisblock.models.jump.free_response import continue_after_record
from seisblock.models.jump.impact import foot_rise, launch, spin_ratio
from seisblock.models.jump.options import DIRECTIONS, LANDINGS, JumpOptions
from seisblock.models.jump.segments import all_phases_and_events, chain_warnings, final_displacement, jump_histories, split_segments
from seisblock.records import Motion
from seisblock.records._validation import validate_inputs
from seisblock.references import papers


@dataclass(frozen=True, repr=False)
class JumpOutcome(DisplayMixin):
    """Result of a jump run under one component.

    Parameters
    ----------
    outcome : str
        Outcome of the last chain, "jumped" if the block stands after any chain with a jump, or "did not rock".
    chains : tuple of Chain
        In chronological order.
    total_displacement_m : float
        Sum over the chains, signed.
    final_displacement_m : float
        Residual displacement of the centroid; equal to the total unless the block overturned.
    landing : "paper", "friction" or "printed"
        Landing rule.
    friction_needed_at_landing : float or None, 1
        Largest P_x/P_y of the landings, infinite where a tensile ground force would be required; None without a landing.
    rocking_threshold_m_s2 : float
        [Sugimoto2017]_ eq. (2).
    spin_ratio : float
        theta'_2/theta'_1 at the impact.
    """

    outcome: str
    chains: tuple[Chain, ...]
    total_displacement_m: float
    final_displacement_m: float
    landing: str
    friction_needed_at_landing: float | None
    rocking_threshold_m_s2: float
    spin_ratio: float


SAMPLE_TOLERANCE = 1e-9
"""Distance of a window's start from a sample, over the sampling interval, below which it starts on the sample."""


@dataclass(frozen=True)
class _RunContext:
    """Inputs common to all chains of a run."""

    motion: Motion
    block: TwoLayerBlock
    contact: Contact
    spin_ratio: float
    gravity: float
    landing: str
    tenon: float


@keywords_of(JumpOptions)
def solve_jump(block: TwoLayerBlock, motion: Motion, options: JumpOptions) -> Response[JumpOutcome]:
    """Solve rocking, impact, jump and landing of a two-layer block ([Sugimoto2017]_ eqs. (1)-(15), corrected).

    Rocking starts where the piecewise linear horizontal acceleration exceeds g x_G/y_G, without slip of the foot before the impact;
    flight is ballistic; a chain ends when the tilt of the landed block returns to zero, and further chains may follow. A motion in progress
    at the end of the record is continued on ground at rest. The model has no vertical ground motion.

    Parameters
    ----------
    block : TwoLayerBlock
    motion : Motion
        Only the horizontal row acts.
    options : keyword arguments
        Fields of :class:`~seisblock.models.jump.options.JumpOptions`. The drop is that of [Sugimoto2017]_ eq. (11);
        spin and landing: see :func:`seisblock.models.jump.impact.spin_ratio` and :mod:`seisblock.models.jump.landing`. Of both
        directions, the mirror image is exact. After a landing the block stands on the ground, without a further drop; motion continues
        beyond the windows.

    Returns
    -------
    Response of JumpOutcome
        Channels ``rotation`` (rad, positive when the block leans to +x), ``displacement`` (m, of the centroid) and ``height`` (m,
        its height above the supporting level). Overturning is a result, not an error.

    Raises
    ------
    ParameterError
        If an option is outside its range.
    SolverError
        If the landed foot jams: rigid contact has no solution at this kinetic friction.

    References
    ----------
    [Sugimoto2017]_

    Examples
    --------
    >>> import numpy as np
    >>> block = TwoLayerBlock(2.08, 2.50, 1.06, 1.84, 1303.7, 160.0)
    >>> pulse = np.concatenate([6.0 * np.sin(np.pi * np.linspace(0, 1, 101)), np.zeros(200)])
    >>> response = solve_jump(block, Motion.from_arrays(pulse, 0.01), contact=Contact(0.18, 0.17, 0.95, 0.85))
    >>> response.outcome.outcome
    'jumped'
    """
    validate_inputs(block, TwoLayerBlock, motion)
    contact: Contact = checks.instance(options.contact, Contact)
    check_options(options.drop, options.direction, options.landing, options.gravity)
    gravity, landing = options.gravity, options.landing
    ratio = spin_ratio(block, options.spin, contact.restitution_x, contact.restitution_y)
    run = _RunContext(motion, block, contact, ratio, gravity, landing, options.tenon)
    windows = [_window_instants(motion, *window) for window in options.windows or ((None, None),)]
    paths = _run_chains(run, options.direction, options.drop, options.first, windows)
    chains = tuple(summarise_chain(path) for path in paths)
    frictions = [chain.friction_needed_at_landing for chain in chains if chain.friction_needed_at_landing is not None]
    parts = split_segments(motion, paths)
    outcome = JumpOutcome(
        _final_outcome(chains),
        chains,
        # plain additions, as in the batch: sum() compensates round-off from Python 3.12 on
        functools.reduce(operator.add, (chain.total_displacement_m or 0.0 for chain in chains), 0.0),
        final_displacement(parts),
        landing,
        max(frictions, default=None),
        block.rocking_threshold(gravity),
        ratio,
    )
    return Response(
        "jump",
        outcome,
        motion,
        block,
        partial(jump_histories, motion, block, parts),
        *all_phases_and_events(motion, parts),
        options,
        warnings=chain_warnings(motion, chains, contact.mu),
        citations=papers("jump", *(("landing with friction",) if landing == "friction" else ())),
    )


def _final_outcome(chains: tuple[Chain, ...]) -> str:
    """Return the outcome of a run."""
    if not chains:
        return ChainOutcome.DID_NOT_ROCK
    last = chains[-1].outcome
    # a last chain without a jump does not undo an earlier jump
    for outcome in (ChainOutcome.JUMPED, ChainOutcome.IN_MORTISES):
        if last in (ChainOutcome.NO_JUMP, ChainOutcome.IN_MORTISES) and any(chain.outcome == outcome for chain in chains):
            return outcome
    return last


def leaves_mortise(response: Response[JumpOutcome]) -> bool | None:
    """Return whether the tenons leave their mortises in any chain; None without tenons."""
    if not response.options.tenon:
        return None
    return any(chain.foot_rise_m is not None and chain.outcome != ChainOutcome.IN_MORTISES for chain in response.outcome.chains)


def check_options(drop: float, direction: str, landing: str, gravity: float) -> None:
    """Raise ParameterError for an option outside its range."""
    checks.gravity(gravity)
    checks.non_negative("`drop`", drop, "m")
    if direction not in DIRECTIONS:
        raise ParameterError("`direction` must be one of {known}, found {found}", known=DIRECTIONS, found=repr(direction))
    if landing not in LANDINGS:
        raise ParameterError("`landing` must be one of {known}, found {found}", known=LANDINGS, found=repr(landing))


def _window_instants(motion: Motion, first: float | None, last: float | None) -> tuple[Instant, float]:
    """Return the first instant of a window, and its end, s after sample 0."""
    end = motion.dt * (motion.samples - 1)
    begin = 0.0 if first is None else max(first - motion.start_s, 0.0)
    finish = math.inf if last is None else last - motion.start_s
    if begin > end or finish < 0.0 or not begin < finish:
        label = ":".join("" if edge is None else f"{edge:g}" for edge in (first, last))
        raise ParameterError(
            "window {window} does not overlap the motion, which lasts from {start:g} to {end:g} s",
            window=label,
            start=motion.start_s,
            end=motion.start_s + end,
        )
    # times given in decimals miss the sample by round-off; such a window starts on the sample
    sample = min(int(begin / motion.dt + SAMPLE_TOLERANCE), motion.samples - 1)
    tau = max(begin - sample * motion.dt, 0.0)
    return Instant(sample, tau if tau > SAMPLE_TOLERANCE * motion.dt else 0.0), finish


def _run_chains(run: _RunContext, direction: str, drop: float, first: bool, windows: Sequence[tuple[Instant, float]]) -> list[ChainPath]:
    """Solve chain by chain, or the first chain of each window only."""
    paths: list[ChainPath] = []
    current_instant, floor_drop = Instant(), drop
    for begin, finish in sorted(windows, key=lambda window: (window[0].sample, window[0].tau)):
        # a chain that still moves when a window opens ends first
        current_instant = max(current_instant, begin, key=lambda instant: (instant.sample, instant.tau))
        # a chain may end beyond the record: nothing starts rocking after it
        while current_instant.sample < run.motion.samples - 1 and (onset := _next_onset(run, direction, current_instant)) is not None:
            if onset[0].sample * run.motion.dt + onset[0].tau > finish:
                break
            paths.append(_run_chain(run, floor_drop, *onset))
            path = paths[-1]
            # a block that has overturned, or still moves at the time limit, has no further chain
            if not path.is_complete or summarise_chain(path).outcome not in COMPLETE:
                return paths
            # after a landing the block stands on the ground: no further drop, no mortises
            current_instant = path.end
            if path.first_landing is not None and not path.held:
                floor_drop, run = 0.0, replace(run, tenon=0.0)
            if first:
                break
    return paths


def _next_onset(run: _RunContext, direction: str, start: Instant) -> tuple[Instant, float] | None:
    """Return the next onset of rocking and the sign of its acceleration, None without one."""
    thresholds = rocking.rocking_parameters(run.block, run.gravity, direction)
    # the model at rest stops at its first event, which is the onset
    search = integrate(rocking.ROCKING_MODEL, run.motion, thresholds, [0.0, 0.0], rocking.REST, start=start, keep_path=False)
    if search.status != STOPPED:
        return None
    return search.end, 1.0 if search.final_mode == rocking.ROSE_FORWARD else -1.0


def _run_chain(run: _RunContext, drop: float, start: Instant, sign: float) -> ChainPath:
    """Solve one chain from its onset, in the frame of its forward direction."""
    motion, block, contact, gains = run.motion, run.block, run.contact, (sign, 0.0, 0.0)
    make_path = partial(ChainPath, motion=motion, block=block, gravity=run.gravity, drop=drop, start=start, sign=sign)
    # the direction restricts onsets only; rocking itself reads no threshold
    parameters = rocking.rocking_parameters(block, run.gravity, "both")
    rocking_run = continue_after_record(rocking.ROCKING_MODEL, motion, parameters, [0.0, 0.0], rocking.ROCK, gains=gains, start=start)
    if rocking_run.final_mode != rocking.IMPACT:
        return make_path(rocking_path=rocking_run, launch=None, flight_path=None)
    takeoff = launch(block, float(rocking_run.final[rocking.OMEGA]), run.spin_ratio, contact.restitution_x, contact.restitution_y)
    if not takeoff.jumps:
        return make_path(rocking_path=rocking_run, launch=takeoff, flight_path=None)
    # the tenons leave their mortises only if the lower foot clears their depth
    is_held = run.tenon > 0.0 and foot_rise(block, takeoff, run.gravity) <= run.tenon
    # inside the mortises the block falls back onto its pedestal
    drop = 0.0 if is_held else drop
    make_path = partial(make_path, drop=drop, held=is_held)
    parameters = flying.flight_parameters(block, run.gravity, contact.mu, contact.kinetic, drop, motion.dt, run.landing)
    # the impact happens upright, at the place and height of rest
    initial_state = [0.0, takeoff.spin, 0.0, takeoff.horizontal, 0.0, takeoff.vertical, *[0.0] * 4]
    flight_run = continue_after_record(FLIGHT_MODEL, motion, parameters, initial_state, flying.FLIGHT, gains=gains, start=rocking_run.end)
    if flight_run.final_mode == flying.JAMMED:
        raise SolverError(
            "jump: the foot landing at {time:.3f} s jams; rigid contact has no solution at kinetic friction {kinetic}: use a smaller value",
            time=motion.start_s + flight_run.end_time,
            kinetic=contact.kinetic,
        )
    return make_path(rocking_path=rocking_run, launch=takeoff, flight_path=flight_run)

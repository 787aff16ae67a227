"""Batch solver of the rocking block: overturning and peak tilt of many runs under one motion, without time histories."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from seisblock.bodies.block import LEFT, RIGHT, Block
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.typing import ArrayLike, BoolArray, FloatArray, IntArray
from seisblock.dynamics import Instant, integrate, integrate_many
from seisblock.dynamics.events import BEGINNING
from seisblock.models.rock import model
from seisblock.models.rock.free_rocking import ENDLESS, STANDS, raise_if_endless, trace_free_rocking_batch
from seisblock.models.rock.options import RockOptions
from seisblock.models.rock.outcome import NO_OVERTURNING
from seisblock.models.rock.params import RockBatchParams, RockParams, rock_params
from seisblock.models.rock.simd import ROCKING_SIMD_MODEL
from seisblock.models.rock.solve import outcome_after_record
from seisblock.records import Motion


@dataclass(frozen=True, repr=False)
class Verdict(DisplayMixin):
    """Overturning and peak tilt over alpha of one run."""

    overturned: bool
    max_rotation_ratio: float


@dataclass(frozen=True, eq=False)
class Verdicts:
    """Overturning and peak tilt of m runs; arrays of shape (m,).

    Parameters
    ----------
    overturned : bool
    max_rotation_ratio : 1
        Peak tilt over alpha.
    direction : int
        +1 or -1 for overturning to +x or -x, else 0.
    overturning_time_s : s
        After the motion's first sample; NaN without overturning before the last sample.
    gave_up : bool
        Runs without a result: failed integration, or endless rocking at a restitution of 1. They count neither as overturned nor as
        stable; their peak tilt is NaN.
    """

    overturned: BoolArray
    max_rotation_ratio: FloatArray
    direction: IntArray
    overturning_time_s: FloatArray
    gave_up: BoolArray

    def require_complete(self) -> Verdicts:
        """Return these verdicts if every run is complete.

        Raises
        ------
        SolverError
            If a run has no result.
        """
        raise_if_endless(bool(self.gave_up.any()))
        return self


def rock_verdict(block: Block, motion: Motion, *, scale: float = 1.0, options: RockOptions = RockOptions()) -> Verdict:
    """Return overturning and peak tilt of a block, without time histories.

    Parameters
    ----------
    block, motion
        See :func:`~seisblock.models.rock.solve.solve_rock`.
    scale : float
        Factor on the ground acceleration.
    options : RockOptions

    Returns
    -------
    Verdict
        The ratio is pi/2 over alpha for an overturned block.

    Examples
    --------
    >>> from seisblock.models import rock_verdict
    >>> import numpy as np
    >>> pulse = Motion.from_arrays(4.0 * np.sin(np.linspace(0.0, np.pi, 101)), 0.01)
    >>> [rock_verdict(Block(0.24, 0.8), pulse, scale=scale).overturned for scale in (0.5, 1.0)]
    [False, True]
    """
    checks.finite("the scale factor", scale)
    params = rock_params(block, motion, options)
    p, gains = model.parameters(params, motion.dt), params.gains(scale)
    run = integrate(model.ROCKING, motion, p, np.zeros(2), model.REST, gains=gains, keep_path=False, keep_events=False)
    aftermath = outcome_after_record(run.final_mode, run.final, params) or NO_OVERTURNING
    highest, _, lowest, _ = run.extrema[model.THETA].tolist()
    leans = max(highest, aftermath.max_leans[RIGHT]), max(-lowest, aftermath.max_leans[LEFT])
    ratio = max(lean / alpha for lean, alpha in zip(leans, params.alphas, strict=True))
    return Verdict(run.final_mode == model.OVERTURNED or aftermath.overturns, ratio)


def rock_verdicts(
    params: RockBatchParams | Sequence[RockParams], motion: Motion, gains: ArrayLike, *, min_hop: float = model.REST_HOP
) -> Verdicts:
    """Return the verdicts of many blocks, or of one block under many gains.

    Parameters
    ----------
    params : RockBatchParams or sequence of RockParams
        One per run, or a single one for all.
    motion : Motion
    gains : (3,) or (m, 3) array
        Factors on the motion's rows; the rows along and across are summed, so that (cos(a), -sin(a), 1) rotates the motion by a clockwise.
    min_hop : float, s
        Time between two impacts below which rocking ends; weakly shaken blocks make most of their impacts within such times.

    Returns
    -------
    Verdicts
        In the order of the runs; a block in motion at the end of the record continues in free rocking.
    """
    rows = np.atleast_2d(np.asarray(gains, dtype=np.float64))
    groups = [params] if isinstance(params, RockBatchParams) else params
    p = np.concatenate([np.atleast_2d(model.parameters(group, motion.dt, min_hop)) for group in groups])
    runs = max(len(p), len(rows))
    # one block under many gains shares its parameters; the engine expects a row per run
    p = np.repeat(p, runs, axis=0) if len(p) == 1 else p
    # a single run fills no lanes: the plain model gives the same bits sooner, and its kernels are smaller
    solver = model.ROCKING if runs == 1 else ROCKING_SIMD_MODEL
    ensemble = integrate_many(solver, motion, p, np.zeros(2), model.REST, gains=rows, allow_failures=True)
    endings, free_leans = np.empty(runs, dtype=np.int64), np.zeros((runs, 2))
    # failed rows enter free rocking as blocks at rest, so that their states, possibly NaN, are not used
    final, mode = np.where(ensemble.failed[:, None], 0.0, ensemble.final), np.where(ensemble.failed, model.REST, ensemble.final_mode)
    trace_free_rocking_batch(p, final, mode, endings, free_leans, np.empty((0, 4)))
    gave_up = ensemble.failed | (endings == ENDLESS)
    highest, _, lowest, _ = ensemble.extrema[:, model.THETA].T
    to_right = np.maximum(highest, free_leans[:, RIGHT]) / p[:, model.ALPHA_RIGHT]
    to_left = np.maximum(-lowest, free_leans[:, LEFT]) / p[:, model.ALPHA_LEFT]
    overturning_times = np.where(ensemble.final_mode == model.OVERTURNED, ensemble.end_time, np.nan)
    # a run without a result counts neither as overturned nor as stable
    endings[gave_up] = STANDS
    return Verdicts(endings != STANDS, np.where(gave_up, np.nan, np.maximum(to_right, to_left)), endings, overturning_times, gave_up)


SAFETY = 0.99
"""Share of the potential barrier below which a block stands for certain: round-off is far smaller than the rest."""

STOPS = (0.9, 0.7, 0.5, 0.3, 0.1)
"""Rest of the motion, as a share of the barrier of a typical block, at which runs are examined."""


def rock_overturned(params: RockBatchParams, motion: Motion, gains: FloatArray, *, min_hop: float = model.REST_HOP) -> BoolArray:
    """Return which blocks overturn, as :func:`rock_verdicts`; runs end as soon as the rest of the motion cannot overturn the block.

    With E = theta'^2/2 + V(theta), per moment of inertia, the ground changes (2 E)^1/2 by at most lever (abs(a) + abs(a_v)) per second, and
    impacts only reduce it. A block below alpha stands for certain while (2 E)^1/2 plus lever times the integral of the rest of the motion
    is smaller than (2 V(alpha))^1/2 (derived here).

    Parameters
    ----------
    params : RockBatchParams
        One block per run, not linear.
    motion : Motion
    gains : (m, 3) array
    min_hop : float, s
        See :func:`rock_verdicts`.

    Raises
    ------
    SolverError
        If a run has no result.
    """
    if motion.is_long:
        return rock_verdicts(params, motion, gains, min_hop=min_hop).require_complete().overturned
    acceleration, p = motion.acceleration, model.parameters(params, motion.dt, min_hop)
    potentials, cosines = params.gravity * params.levers, np.cos(params.alphas)
    barriers = np.sqrt(2.0 * potentials * (1.0 - cosines)).min(axis=1)
    scales = np.abs(gains) * params.levers.max(axis=1, keepdims=True)
    # between samples a straight line stays below the absolute values at its ends; nothing remains after the last sample
    steps = 0.5 * motion.dt * (np.abs(acceleration[:, 1:]) + np.abs(acceleration[:, :-1]))
    remaining = np.append(np.cumsum(steps[:, ::-1], axis=1)[:, ::-1], np.zeros((3, 1)), axis=1)
    typical = np.median(scales / barriers[:, None], axis=0) @ remaining
    stops = {int((typical < share).argmax()) for share in STOPS} - {0}
    overturned = np.zeros(len(p), dtype=np.bool_)
    rows, final, mode = np.arange(len(p)), np.zeros((len(p), 2)), np.full(len(p), model.REST)
    start = BEGINNING
    for stop in sorted(stops | {motion.samples - 1}):
        part = Motion(acceleration[:, : stop + 1], motion.dt)
        ensemble = integrate_many(ROCKING_SIMD_MODEL, part, p[rows], final, mode, gains=gains[rows], start=start, allow_failures=True)
        raise_if_endless(bool(ensemble.failed.any()))
        final, mode, start = ensemble.final, ensemble.final_mode, Instant(stop, 0.0)
        overturned[rows[mode == model.OVERTURNED]] = True
        lean, corner = np.abs(final[:, model.THETA]), np.where(mode == model.TO_LEFT, LEFT, RIGHT)
        rise = potentials[rows, corner] * (np.cos(params.alphas[rows, corner] - lean) - cosines[rows, corner])
        speed = np.sqrt(np.maximum(final[:, model.OMEGA] ** 2 + 2.0 * rise, 0.0)) + scales[rows] @ remaining[:, stop]
        is_below = np.isin(mode, (model.REST, model.TO_RIGHT, model.TO_LEFT))
        is_open = (mode != model.OVERTURNED) & ~(is_below & (speed < SAFETY * barriers[rows]))
        rows, final, mode = rows[is_open], final[is_open], mode[is_open]
    endings = np.empty(len(rows), dtype=np.int64)
    trace_free_rocking_batch(p[rows], final, mode, endings, np.zeros((len(rows), 2)), np.empty((0, 4)))
    raise_if_endless(bool((endings == ENDLESS).any()))
    overturned[rows] = endings != STANDS
    return overturned

"""Only whether blocks overturn and how far they lean at most: many runs through one motion, without Python between them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Unpack

import numpy as np

from seisblock.bodies.block import LEFT, RIGHT, Block
from seisblock.core import checks
from seisblock.core.typing import ArrayLike, BoolArray, FloatArray, IntArray
from seisblock.dynamics import integrate_many
from seisblock.models.rock import model
from seisblock.models.rock.free_rocking import raise_if_endless
from seisblock.models.rock.free_rocking_kernels import ENDLESS, STANDS, trace_free_rocking_batch
from seisblock.models.rock.params import RockBatchParams, RockOptions, RockParams, rock_params
from seisblock.models.rock.simd import ROCKING_SIMD_MODEL
from seisblock.records import Motion


@dataclass(frozen=True)
class Verdict:
    """What an ensemble keeps of one run."""

    overturned: bool
    max_rotation_ratio: float


@dataclass(frozen=True, eq=False)
class Verdicts:
    """What an ensemble keeps of its runs, (m,) each.

    Parameters
    ----------
    overturned : bool
    max_rotation_ratio : 1
        Largest lean over alpha.
    direction : int
        +1 or -1 where it falls to +x or to -x, else 0.
    overturning_time_s : s
        After the motion's first sample, where it falls before the last one; else NaN.
    gave_up : bool
        Runs without an answer: their motion could not be followed, or rocks on for ever at a restitution of 1. They count as standing
        nowhere; their largest lean is NaN.
    """

    overturned: BoolArray
    max_rotation_ratio: FloatArray
    direction: IntArray
    overturning_time_s: FloatArray
    gave_up: BoolArray

    def answered(self) -> Verdicts:
        """Return these verdicts, all of them answers.

        Raises
        ------
        SolverError
            If one was given up.
        """
        raise_if_endless(bool(self.gave_up.any()))
        return self


def rock_verdict(block: Block, motion: Motion, *, scale: float = 1.0, **options: Unpack[RockOptions]) -> Verdict:
    """Return only whether a block overturns and its largest lean over alpha.

    Parameters
    ----------
    block, motion
        As for :func:`~seisblock.models.rock.solve.solve_rock`.
    scale : float
        Factor on the ground acceleration.
    options
        Its ``restitution``, ``linear``, ``vertical`` and ``gravity``.

    Returns
    -------
    Verdict
        The ratio is pi/2 over alpha when it overturns.

    Examples
    --------
    >>> import numpy as np
    >>> pulse = Motion.from_arrays(4.0 * np.sin(np.linspace(0.0, np.pi, 101)), 0.01)
    >>> [rock_verdict(Block(0.24, 0.8), pulse, scale=scale).overturned for scale in (0.5, 1.0)]
    [False, True]
    """
    checks.finite("the scale factor", scale)
    params = rock_params(block, motion, **options)
    verdicts = rock_verdicts([params], motion, params.gains(scale)).answered()
    return Verdict(bool(verdicts.overturned[0]), float(verdicts.max_rotation_ratio[0]))


def rock_verdicts(params: RockBatchParams | Sequence[RockParams], motion: Motion, gains: ArrayLike) -> Verdicts:
    """Return the verdicts of several blocks, or of one under several gains, as fast as possible.

    Parameters
    ----------
    params : Rockers or sequence of Rocker
        One for each run, or a single one for all.
    motion : Motion
    gains : (3,) or (m, 3) array
        Factors on the motion's rows; those along and across +x add up, so that (cos, -sin, 1) is the motion turned clockwise.

    Returns
    -------
    Verdicts
        In the order of the runs: whatever still rocks at the record's end then rocks on freely.
    """
    rows = np.atleast_2d(np.asarray(gains, dtype=np.float64))
    groups = [params] if isinstance(params, RockBatchParams) else params
    p = np.concatenate([np.atleast_2d(model.parameters(group, motion.dt)) for group in groups])
    runs = max(len(p), len(rows))
    p = np.repeat(p, runs, axis=0) if len(p) == 1 else p
    ensemble = integrate_many(ROCKING_SIMD_MODEL, motion, p, np.zeros(2), model.REST, gains=rows, allow_failures=True)
    endings, free_leans = np.empty(runs, dtype=np.int64), np.zeros((runs, 2))
    # rows that were given up are not followed on: they rest
    final, mode = np.where(ensemble.failed[:, None], 0.0, ensemble.final), np.where(ensemble.failed, model.REST, ensemble.final_mode)
    trace_free_rocking_batch(p, final, mode, endings, free_leans)
    gave_up = ensemble.failed | (endings == ENDLESS)
    highest, _, lowest, _ = ensemble.extrema[:, model.THETA].T
    to_right = np.maximum(highest, free_leans[:, RIGHT]) / p[:, model.ALPHA_RIGHT]
    to_left = np.maximum(-lowest, free_leans[:, LEFT]) / p[:, model.ALPHA_LEFT]
    overturning_times = np.where(ensemble.final_mode == model.OVERTURNED, ensemble.end_time, np.nan)
    endings[gave_up] = STANDS
    return Verdicts(endings != STANDS, np.where(gave_up, np.nan, np.maximum(to_right, to_left)), endings, overturning_times, gave_up)

"""Only whether blocks overturn and how far they lean at most: many runs through one motion, without Python between them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Unpack

import numpy as np

from seisblock import checks
from seisblock.bodies.block import LEFT, RIGHT, Block
from seisblock.dynamics import follow_many
from seisblock.records import Motion
from seisblock.solvers.rock import model
from seisblock.solvers.rock.aftermath import refuse_endless
from seisblock.solvers.rock.free import ENDLESS, STANDS, rock_on
from seisblock.solvers.rock.rocker import Rocker, Rockers, RockOptions, rocker
from seisblock.solvers.rock.stride import ROCKING_TOGETHER
from seisblock.typing import ArrayLike, BoolArray, FloatArray, IntArray


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
    towards : int
        +1 or -1 where it falls to +x or to -x, else 0.
    lies_down_s : s
        After the motion's first sample, where it falls before the last one; else NaN.
    gave_up : bool
        Runs without an answer: their motion could not be followed, or rocks on for ever at a restitution of 1. They count as standing
        nowhere; their largest lean is NaN.
    """

    overturned: BoolArray
    max_rotation_ratio: FloatArray
    towards: IntArray
    lies_down_s: FloatArray
    gave_up: BoolArray

    def answered(self) -> Verdicts:
        """Return these verdicts, all of them answers.

        Raises
        ------
        SolverError
            If one was given up.
        """
        refuse_endless(bool(self.gave_up.any()))
        return self


def rock_verdict(block: Block, motion: Motion, *, scale: float = 1.0, **options: Unpack[RockOptions]) -> Verdict:
    """Return only whether a block overturns and its largest lean over alpha.

    Parameters
    ----------
    block, motion
        As for :func:`~seisblock.solvers.rock.solve.solve_rock`.
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
    one = rocker(block, motion, **options)
    found = rock_verdicts([one], motion, one.gains(scale)).answered()
    return Verdict(bool(found.overturned[0]), float(found.max_rotation_ratio[0]))


def rock_verdicts(blocks: Rockers | Sequence[Rocker], motion: Motion, gains: ArrayLike) -> Verdicts:
    """Return the verdicts of several blocks, or of one under several gains, as fast as possible.

    Parameters
    ----------
    blocks : Rockers or sequence of Rocker
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
    given = [blocks] if isinstance(blocks, Rockers) else blocks
    p = np.concatenate([np.atleast_2d(model.parameters(some, motion.dt)) for some in given])
    runs = max(len(p), len(rows))
    p = np.repeat(p, runs, axis=0) if len(p) == 1 else p
    shaken = follow_many(ROCKING_TOGETHER, motion, p, np.zeros(2), model.REST, gains=rows, allow_failures=True)
    ends, late = np.empty(runs, dtype=np.int64), np.zeros((runs, 2))
    # rows that were given up are not followed on: they rest
    final, mode = np.where(shaken.failed[:, None], 0.0, shaken.final), np.where(shaken.failed, model.REST, shaken.final_mode)
    rock_on(p, final, mode, ends, late)
    gave_up = shaken.failed | (ends == ENDLESS)
    highest, _, lowest, _ = shaken.extrema[:, model.THETA].T
    to_right = np.maximum(highest, late[:, RIGHT]) / p[:, model.ALPHA_RIGHT]
    to_left = np.maximum(-lowest, late[:, LEFT]) / p[:, model.ALPHA_LEFT]
    lies_down = np.where(shaken.final_mode == model.OVERTURNED, shaken.end_time, np.nan)
    ends[gave_up] = STANDS
    return Verdicts(ends != STANDS, np.where(gave_up, np.nan, np.maximum(to_right, to_left)), ends, lies_down, gave_up)

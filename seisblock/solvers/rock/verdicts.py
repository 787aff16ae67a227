"""Only whether blocks overturn and how far they lean at most: many runs through one motion, without Python between them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Unpack

import numpy as np

from seisblock import checks
from seisblock.bodies.block import Block
from seisblock.dynamics import follow, follow_many
from seisblock.records import Motion
from seisblock.solvers.rock import model
from seisblock.solvers.rock.aftermath import fate, sides
from seisblock.solvers.rock.rocker import Rocker, RockOptions, rocker
from seisblock.typing import ArrayLike, BoolArray, FloatArray


@dataclass(frozen=True)
class Verdict:
    """What an ensemble keeps of one run."""

    overturned: bool
    max_rotation_ratio: float


@dataclass(frozen=True, eq=False)
class Verdicts:
    """What an ensemble keeps of its runs: whether each overturned, and its largest lean over alpha, (m,) each."""

    overturned: BoolArray
    max_rotation_ratio: FloatArray


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
    p = model.parameters(one, motion.dt)
    end = follow(model.ROCKING, motion, p, (0.0, 0.0), model.REST, gains=one.gains(scale), keep_path=False, keep_events=False)
    return _verdict(one, end.extrema[model.THETA], end.final_mode, end.final)


def rock_verdicts(rockers: Sequence[Rocker], motion: Motion, gains: ArrayLike) -> Verdicts:
    """Return the verdicts of several blocks, or of one under several gains, as fast as possible.

    Parameters
    ----------
    rockers : sequence of Rocker
        One for each run, or a single one for all.
    motion : Motion
    gains : (3,) or (m, 3) array
        Factors on the motion's rows; those along and across +x add up, so that (cos, -sin, 1) is the motion turned clockwise.

    Returns
    -------
    Verdicts
        In the order of the runs.
    """
    rows = np.atleast_2d(np.asarray(gains, dtype=np.float64))
    runs = max(len(rockers), len(rows))
    p = np.array([model.parameters(each, motion.dt) for each in rockers])
    ends = follow_many(model.ROCKING, motion, np.broadcast_to(p, (runs, p.shape[1])), np.zeros(2), model.REST, gains=rows)
    found = [
        _verdict(rockers[run if len(rockers) > 1 else 0], ends.extrema[run, model.THETA], ends.final_mode[run], ends.final[run])
        for run in range(runs)
    ]
    return Verdicts(np.array([v.overturned for v in found]), np.array([v.max_rotation_ratio for v in found]))


def _verdict(block: Rocker, extrema: FloatArray, mode: int, state: FloatArray) -> Verdict:
    """Return the verdict of a run from its largest leans and its end: whatever still rocks then rocks on freely."""
    to_right, _, to_left, _ = extrema
    overturned, late = mode == model.OVERTURNED, (0.0, 0.0)
    if mode not in (model.REST, model.OVERTURNED):
        afterwards = fate(sides(block), float(state[model.THETA]), float(state[model.OMEGA]), timed=False)
        overturned, late = afterwards.overturns, afterwards.largest
    right, left = block.alphas
    return Verdict(bool(overturned), float(max(max(to_right, late[0]) / right, max(-to_left, late[1]) / left)))

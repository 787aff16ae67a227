"""How sure it is: the same run many times with small changes of what is never known exactly."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Unpack

import numpy as np

from seisblock.bodies.block import Block
from seisblock.bodies.block_array import samples
from seisblock.bodies.uncertainty import ParameterRanges
from seisblock.core import checks
from seisblock.core.i18n import N_
from seisblock.core.limits import check_limit
from seisblock.core.typing import FloatArray, Progress
from seisblock.models.rock.params import RockBatchParams, RockOptions, rock_batch_params
from seisblock.records import Motion
from seisblock.records._validation import validate_inputs
from seisblock.studies.intervals import wilson_interval
from seisblock.studies.rocking.verdicts import parallel_verdicts

MODEL_SCATTER = N_("this model's own scatter")
"""What a share of perturbed runs, and its interval, are of."""

AMPLITUDE, AZIMUTH = 3, 4
"""Columns of the draws that change the shaking."""


@dataclass(frozen=True)
class Spread:
    """Half widths of the uniform changes: shares of the value, and degrees for the azimuth.

    Parameters
    ----------
    size, slenderness, restitution, amplitude : float
        Shares, in [0, 1).
    inset : float
        Half width of a known inset, a share of itself, in [0, 1): sharp edges stay sharp. Edges that nobody has measured are drawn from
        the range of the block's kind instead; 0 takes them as known exactly.
    azimuth_deg : float
        Degrees; without effect where the record's second horizontal is unknown.
    """

    size: float = 0.05
    slenderness: float = 0.05
    restitution: float = 0.05
    amplitude: float = 0.05
    azimuth_deg: float = 5.0
    inset: float = 0.1

    def __post_init__(self) -> None:
        checks.in_interval("the spread of the size, a share,", self.size, "[0, 1)")
        checks.in_interval("the spread of the slenderness, a share,", self.slenderness, "[0, 1)")
        checks.in_interval("the spread of the restitution, a share,", self.restitution, "[0, 1)")
        checks.in_interval("the spread of the amplitude, a share,", self.amplitude, "[0, 1)")
        checks.in_interval("the spread of the azimuth", self.azimuth_deg, "[0, 180]", "degrees")
        checks.in_interval("the spread of the inset, a share,", self.inset, "[0, 1)")


@dataclass(frozen=True)
class Perturbation:
    """How often the block overturned: a share among versions of it, not the chance of the stone itself.

    On fitted shaking-table runs of real rocks the share is well calibrated between its ends, but 3 % fell where no version did, and 2 %
    stood where all fell.

    Parameters
    ----------
    runs, overturned : int
    probability : float
        Their ratio.
    probability_interval : (float, float), 1
        Wilson's interval at 95 %: what so few runs leave open of this model's own scatter, and no more.
    spread : Spread
    seed : int
    ranges : Ranges or None
        Prior of the worn edges of the block's kind, from which they were drawn instead of varying by a share.
    no_answer : tuple of int
        Numbers, from 1, of the versions that were given up, which are not among `runs`.
    """

    runs: int
    overturned: int
    probability: float
    probability_interval: tuple[float, float]
    spread: Spread
    seed: int
    interval_of: str = MODEL_SCATTER
    ranges: ParameterRanges | None = None
    no_answer: tuple[int, ...] = ()


def perturb(
    block: Block,
    motion: Motion,
    runs: int,
    *,
    spread: Spread = Spread(),
    seed: int = 0,
    progress: Progress | None = None,
    **options: Unpack[RockOptions],
) -> Perturbation:
    """Return how often a block overturns when size, slenderness, edges, restitution, amplitude and azimuth change a little.

    Parameters
    ----------
    block, motion : Block, Motion
    runs : int
        How many, at least 1.
    spread : Spread
        Of the changes, each uniform and independent of the others.
    seed : int
        The same seed gives the same runs.
    progress : callable
        Told the number of runs done and the number in all.
    options
        ``restitution``, ``linear``, ``vertical``, ``gravity`` of :func:`~seisblock.models.rock.solve.solve_rock`; the restitution is the
        middle value, that of each changed block's angular momentum when left out, and never above 1.

    Raises
    ------
    ParameterError
        If there are no runs, or an option is out of range.

    Examples
    --------
    >>> import numpy as np
    >>> pulse = Motion.from_arrays(4.0 * np.sin(np.linspace(0.0, np.pi, 101)), 0.01)
    >>> found = perturb(Block(0.24, 0.8), pulse, 20)
    >>> found.runs, found.overturned
    (20, 20)
    """
    checks.instance(spread, Spread)
    checks.integer("the number of runs", runs, minimum=1)
    check_limit(N_("versions"), runs, "SEISBLOCK_RUNS")
    validate_inputs(block, Block, motion)
    azimuth_width = spread.azimuth_deg if motion.transverse.any() else 0.0
    draws = draw_samples(runs, checks.seed(seed))
    params = perturbed_rock_params(block, motion, spread, draws, **options)
    factor, angle = 1.0 + spread.amplitude * draws[:, AMPLITUDE], np.radians(azimuth_width * draws[:, AZIMUTH])
    # +x turned clockwise, seen from above
    gains = np.column_stack([factor * np.cos(angle), -factor * np.sin(angle), factor * params.vertical])
    verdicts = parallel_verdicts(params, motion, gains, progress=progress)
    count, answered = int(verdicts.overturned.sum()), int((~verdicts.gave_up).sum())
    return Perturbation(
        answered,
        count,
        count / answered,
        wilson_interval(count, answered),
        spread,
        seed,
        ranges=block.ranges and block.ranges.without("width_m", "height_m", "mu"),
        no_answer=tuple((np.flatnonzero(verdicts.gave_up) + 1).tolist()),
    )


def draw_samples(runs: int, seed: int) -> FloatArray:
    """Return the draws of so many samples of a block and its shaking, (runs, 7), uniform in [-1, 1]."""
    rng = np.random.default_rng(seed)
    return np.column_stack([rng.uniform(-1.0, 1.0, (runs, 5)), rng.uniform(-1.0, 1.0, runs), rng.uniform(-1.0, 1.0, runs)])


def perturbed_rock_params(
    block: Block, motion: Motion, spread: Spread, draws: FloatArray, **options: Unpack[RockOptions]
) -> RockBatchParams:
    """Return the samples of a block as they rock, by draws of each parameter within its spread.

    Parameters
    ----------
    block, motion, spread, options
        As of :func:`perturb`.
    draws : (m, 7) array
        Of :func:`draw_samples`.
    """
    size, slenderness, bounce, _, _, wear, _ = draws.T
    larger = 1.0 + spread.size * size
    blocks = samples(block, spread.inset, wide=larger * (1.0 + spread.slenderness * slenderness), tall=larger, worn=wear)
    params = rock_batch_params(blocks, motion, **options)
    return replace(params, restitutions=np.minimum(params.restitutions * (1.0 + spread.restitution * bounce[:, None]), 1.0))

"""Overturning probability of a pile of stones: samples of the pile and its shaking, and the share in which each stone falls.

A pile is more sensitive to its input than a block: a slightly earlier impact changes the direction of a fall, or prevents it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from seisblock.bodies.pile.pile import Pile
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.typing import Progress
from seisblock.models.stack.options import StackOptions
from seisblock.models.stack.outcome import StoneOutcome
from seisblock.records.motion import Motion
from seisblock.studies.intervals import clopper_pearson
from seisblock.studies.sampling import MOVED_M, ParameterVariation, Samples, sample


@dataclass(frozen=True, repr=False)
class StoneProbability(DisplayMixin):
    """Overturning probability of one stone of a pile, and the direction of its falls.

    Parameters
    ----------
    name : str
    overturned : float
        Share of the samples.
    interval : (float, float), 1
        Clopper-Pearson, 95 %, of `overturned`.
    moved : float
        Share with a residual displacement above `moved_m` on the stone below, or a fall.
    fell_towards_deg, fell_azimuth_deg : float or None
        Mean direction of its falls, from +x counter-clockwise and from north clockwise; None without a fall, or if north is unknown.
    fell_alike_ratio : float or None, 1
        Length of the mean unit vector of its falls: 1 if all fall to one side, near 0 if they scatter over all directions.
    """

    name: str
    overturned: float
    interval: tuple[float, float]
    moved: float
    fell_towards_deg: float | None
    fell_azimuth_deg: float | None
    fell_alike_ratio: float | None


@dataclass(frozen=True, repr=False)
class PileProbability(DisplayMixin):
    """Overturning probability of a pile and of each of its stones.

    Parameters
    ----------
    runs, left_out_count : int
        Completed samples, and samples that were stopped because they created energy.
    overturned, moved : float
        Shares in which any stone falls, and in which any has a residual displacement above `moved_m`, or falls.
    interval : (float, float), 1
        Clopper-Pearson, 95 %, of `overturned`: sampling interval only, model error not included.
    moved_m : float, m
    stones : tuple of StoneProbability
        From below upwards.
    versions : ParameterVariation
        Half widths in use; the inset is 0 on a grid of contact points, and reduced where the pile would not stand at rest. The
        restitution of joints does not vary.
    seed : int
    """

    runs: int
    overturned: float
    moved: float
    interval: tuple[float, float]
    moved_m: float
    stones: tuple[StoneProbability, ...]
    versions: ParameterVariation
    seed: int
    left_out_count: int = 0


def stack_probability(
    body: Pile,
    motion: Motion,
    *,
    runs: int,
    moved_m: float = MOVED_M,
    versions: ParameterVariation = ParameterVariation(),
    seed: int = 0,
    progress: Progress | None = None,
    workers: int | None = None,
    options: StackOptions = StackOptions(),
) -> PileProbability:
    """Compute overturning probabilities of a pile and of each of its stones, from samples of the pile and its shaking.

    Parameters
    ----------
    body, motion
        As in :func:`~seisblock.models.stack.solve.solve_stack`; the centre of the samples.
    runs : int
        Number of samples, at least 1.
    moved_m : float, m
        Residual displacement above which a stone counts as moved.
    versions : ParameterVariation
    seed : int
        The same seed gives the same samples, on any number of threads.
    progress : callable
        Called with the number of finished runs and the total.
    workers : int
        Threads; default: the number of cores.
    options : StackOptions

    Returns
    -------
    PileProbability

    Raises
    ------
    ParameterError
        If there are no runs, or a number lies outside its range.
    SolverError
        If no sample completes.

    Examples
    --------
    >>> from seisblock.uncertainty import stack_probability
    >>> from seisblock import PileStone
    >>> import numpy as np
    >>> pulse = Motion.from_arrays(4.0 * np.sin(np.linspace(0.0, np.pi, 101)), 0.01)
    >>> result = stack_probability(Pile("grave", (PileStone("post", 0.2, 0.2, 1.2),)), pulse, runs=4)
    >>> result.overturned, [stone.name for stone in result.stones if stone.overturned]
    (1.0, ['post'])
    """
    checks.positive("the residual displacement that counts as moved", moved_m, "m")
    samples = sample("stack", body, motion, options, runs, versions, seed=seed, progress=progress, workers=workers)
    return summarize(samples, motion.azimuth_deg, moved_m)


def summarize(samples: Samples, azimuth: float | None, moved_m: float = MOVED_M) -> PileProbability:
    """Return the probability of samples of a pile and of each of its stones.

    Parameters
    ----------
    samples : Samples
    azimuth : float or None
        Of +x, degrees clockwise from north.
    moved_m : float, m
        Residual displacement above which a stone counts as moved.
    """
    fates = [outcome.stones for outcome in samples.outcomes]
    displaced = np.array([[stone.state == "fallen" or stone.residual_slip_m > moved_m for stone in stones] for stones in fates])
    return PileProbability(
        samples.completed,
        samples.probability,
        float(displaced.any(axis=1).mean()),
        samples.interval,
        moved_m,
        tuple(_stone_probability([stones[i] for stones in fates], float(displaced[:, i].mean()), azimuth) for i in range(len(fates[0]))),
        samples.variation,
        samples.seed,
        len(samples.stopped),
    )


def _stone_probability(fates: Sequence[StoneOutcome], moved_share: float, azimuth: float | None) -> StoneProbability:
    fell = [math.radians(fate.fell_towards_deg) for fate in fates if fate.fell_towards_deg is not None]
    share, interval = len(fell) / len(fates), clopper_pearson(len(fell), len(fates))
    if not fell:
        return StoneProbability(fates[0].name, share, interval, moved_share, None, None, None)
    # circular mean: the resultant's length measures how far the directions agree
    mean = complex(np.exp(1j * np.array(fell)).mean())
    direction = math.degrees(math.atan2(mean.imag, mean.real))
    return StoneProbability(
        fates[0].name,
        share,
        interval,
        moved_share,
        direction,
        None if azimuth is None else (azimuth - direction) % 360.0,
        min(abs(mean), 1.0),
    )

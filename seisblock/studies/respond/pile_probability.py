"""Overturning probability of a pile of stones: samples of the pile and its shaking, and the share in which each stone falls.

A pile is more sensitive to its input than a block: a slightly earlier impact changes the direction of a fall, or prevents it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from seisblock.bodies.pile.edge_wear import widest_wear, worn_to
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import PileStone
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import SolverError
from seisblock.core.i18n import N_
from seisblock.core.limits import MAX_RUNS, check_limit
from seisblock.core.typing import FloatArray, Progress
from seisblock.models.stack.options import EDGES, StackOptions
from seisblock.models.stack.outcome import StackOutcome, StoneOutcome
from seisblock.models.stack.solve import solve_stack
from seisblock.records._validation import validate_inputs
from seisblock.records.motion import Motion
from seisblock.studies.intervals import clopper_pearson
from seisblock.studies.parallel import map_threads
from seisblock.studies.respond.probability import MOVED_M

SIZE, AMPLITUDE, AZIMUTH, INSET, FRICTION = range(5)
"""Columns of the draws; from ``FRICTION`` on, one column per stone."""


@dataclass(frozen=True, repr=False)
class PileVariation(DisplayMixin):
    """Half widths of the samples of a pile; each parameter varies uniformly and independently.

    Parameters
    ----------
    size, amplitude : float, 1
        Relative half widths: of all lengths of the pile, and of the shaking.
    inset : float, 1
        Relative half width of the insets, common to all stones: sharp edges stay sharp. No effect on a grid of contact points.
    mu : float, 1
        Relative half width of the friction under each stone, independent from stone to stone.
    azimuth_deg : float
        Half width of the direction of the shaking, degrees; no effect if the record's second horizontal is unknown.

    Raises
    ------
    ParameterError
        If a width is negative, or a relative width is 1 or more.
    """

    size: float = 0.05
    inset: float = 0.1
    mu: float = 0.2
    amplitude: float = 0.1
    azimuth_deg: float = 10.0

    def __post_init__(self) -> None:
        checks.in_interval("the relative spread of the size", self.size, "[0, 1)")
        checks.in_interval("the relative spread of the edge wear", self.inset, "[0, 1)")
        checks.in_interval("the relative spread of the friction", self.mu, "[0, 1)")
        checks.in_interval("the relative spread of the amplitude", self.amplitude, "[0, 1)")
        checks.in_interval("the spread of the azimuth", self.azimuth_deg, "[0, 180]", "degrees")


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
    versions : PileVariation
        Half widths in use; the inset is 0 on a grid of contact points, and reduced where the pile would not stand at rest.
    seed : int
    """

    runs: int
    overturned: float
    moved: float
    interval: tuple[float, float]
    moved_m: float
    stones: tuple[StoneProbability, ...]
    versions: PileVariation
    seed: int
    left_out_count: int = 0


def stack_probability(
    body: Pile,
    motion: Motion,
    *,
    runs: int,
    moved_m: float = MOVED_M,
    versions: PileVariation = PileVariation(),
    seed: int = 0,
    progress: Progress | None = None,
    workers: int | None = None,
    options: StackOptions = StackOptions(),
) -> PileProbability:
    """Return the overturning probability of a pile and of each of its stones, from samples of the pile and its shaking.

    Parameters
    ----------
    body, motion
        As in :func:`~seisblock.models.stack.solve.solve_stack`; the centre of the samples.
    runs : int
        Number of samples, at least 1.
    moved_m : float, m
        Residual displacement above which a stone counts as moved.
    versions : PileVariation
    seed : int
        The same seed gives the same samples, on any number of threads.
    progress : callable
        Called with the number of finished runs and the total.
    workers : int
        Threads; default: the number of cores.
    options : StackOptions

    Raises
    ------
    ParameterError
        If there are no runs, or a number lies outside its range.
    SolverError
        If no sample completes.

    Examples
    --------
    >>> from seisblock.uncertainty import stack_probability
    >>> import numpy as np
    >>> pulse = Motion.from_arrays(4.0 * np.sin(np.linspace(0.0, np.pi, 101)), 0.01)
    >>> result = stack_probability(Pile("grave", (PileStone("post", 0.2, 0.2, 1.2),)), pulse, runs=4)
    >>> result.overturned, [stone.name for stone in result.stones if stone.overturned]
    (1.0, ['post'])
    """
    validate_inputs(body, Pile, motion)
    checks.instance(versions, PileVariation)
    checks.integer("the number of runs", runs, minimum=1)
    check_limit(N_("Monte Carlo samples"), runs, MAX_RUNS)
    checks.positive("the residual displacement that counts as moved", moved_m, "m")
    if options.mu_kinetic is not None:
        body = body.with_kinetic_friction(options.mu_kinetic)
        options = replace(options, mu_kinetic=None)
    # wear that would tip a stone at rest is excluded before the draws, so that every sample starts from rest
    versions = replace(versions, inset=widest_wear(body, versions.inset) if options.points == EDGES else 0.0)
    # all draws before the runs: the samples do not depend on the number of threads
    draws = np.random.default_rng(checks.seed(seed)).uniform(-1.0, 1.0, (runs, FRICTION + len(body.stones)))

    def work(draw: FloatArray) -> StackOutcome | SolverError:
        try:
            return solve_stack(perturb_pile(body, versions, draw), perturb_motion(motion, versions, draw), **options.keywords()).outcome
        except SolverError as error:
            return error

    results = list(map_threads(work, list(draws), progress=progress, workers=workers))
    outcomes = [result for result in results if isinstance(result, StackOutcome)]
    if not outcomes:
        raise next(result for result in results if isinstance(result, SolverError))
    fates = [outcome.stones for outcome in outcomes]
    displaced = np.array([[stone.state == "fallen" or stone.residual_slip_m > moved_m for stone in stones] for stones in fates])
    fell = sum(outcome.overturned_any for outcome in outcomes)
    return PileProbability(
        len(outcomes),
        fell / len(outcomes),
        float(displaced.any(axis=1).mean()),
        clopper_pearson(fell, len(outcomes)),
        moved_m,
        tuple(
            _stone_probability([stones[i] for stones in fates], float(displaced[:, i].mean()), motion.azimuth_deg)
            for i in range(len(body.stones))
        ),
        versions,
        seed,
        runs - len(outcomes),
    )


def perturb_pile(body: Pile, versions: PileVariation, draw: FloatArray) -> Pile:
    """Return one sample of a pile: one factor on all lengths, one on all edge wear, one on the friction under each stone.

    Parameters
    ----------
    body, versions
        As in :func:`stack_probability`.
    draw : (4 + stones,) array
        In [-1, 1].
    """
    size, friction_factors = 1.0 + versions.size * draw[SIZE], 1.0 + versions.mu * draw[FRICTION:]
    worn = worn_to(body, versions.inset, float(draw[INSET]))
    return replace(
        body, stones=tuple(_perturb_stone(stone, size, friction_factors[i], *body.friction(stone)) for i, stone in enumerate(worn.stones))
    )


def _perturb_stone(stone: PileStone, size: float, friction_factor: float, mu: float, mu_kinetic: float) -> PileStone:
    return replace(
        stone,
        width=size * stone.width,
        depth=size * stone.depth,
        height=size * stone.height,
        offset=(size * stone.offset[0], size * stone.offset[1]),
        bottom=None if stone.bottom is None else size * stone.bottom,
        inset=replace(stone.inset, length_m=size * stone.inset.length_m),
        mu=friction_factor * mu,
        mu_kinetic=friction_factor * mu_kinetic,
    )


def perturb_motion(motion: Motion, versions: PileVariation, draw: FloatArray) -> Motion:
    """Return one sample of the shaking: scaled, and rotated about the vertical if both horizontals are known.

    Parameters
    ----------
    motion, versions
        As in :func:`stack_probability`.
    draw : (4 + stones,) array
        In [-1, 1].

    Examples
    --------
    >>> pulse = Motion.from_arrays([0.0, 1.0, 0.0], 0.01)
    >>> perturb_motion(pulse, PileVariation(amplitude=0.5), np.ones(4)).horizontal.tolist()
    [0.0, 1.5, 0.0]
    """
    factor = 1.0 + versions.amplitude * draw[AMPLITUDE]
    # no rotation if the transverse motion is unknown (zero)
    angle = math.radians(versions.azimuth_deg * draw[AZIMUTH]) * bool(motion.transverse.any())
    c, s = factor * math.cos(angle), factor * math.sin(angle)
    # one copy of the motion per thread; released with its run
    longitudinal, transverse = motion.horizontal, motion.transverse
    rows = (c * longitudinal - s * transverse, s * longitudinal + c * transverse, factor * motion.vertical)
    return Motion(rows, motion.dt, name=motion.name, start_s=motion.start_s, record=motion.record)


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

"""How sure the fate of a pile is: plausible versions of its stones and the shaking, and the share of them in which each stone falls.

A pile is chaotic sooner than a block: a stone that strikes a little earlier falls to another side, or stays. One run is an anecdote.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from seisblock.bodies.pile.edge_wear import widest_wear, worn_to
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import PileStone
from seisblock.core import checks
from seisblock.core.errors import SolverError
from seisblock.core.i18n import N_
from seisblock.core.limits import check_limit
from seisblock.core.typing import FloatArray, Progress
from seisblock.models.stack.outcome import StackOutcome, StoneOutcome
from seisblock.models.stack.solve import EDGE_POINTS, solve_stack
from seisblock.records._validation import validate_inputs
from seisblock.records.motion import Motion
from seisblock.studies.intervals import clopper_pearson
from seisblock.studies.parallel import map_threads
from seisblock.studies.respond.probability import MOVED_M

SIZE, AMPLITUDE, AZIMUTH, INSET, FRICTION = range(5)
"""Columns of the draws; from the last one on there is one for each stone."""


@dataclass(frozen=True)
class PileVariation:
    """How far plausible versions of a pile differ from what was given; each change uniform and independent of the others.

    Parameters
    ----------
    size, amplitude : float
        Half widths as shares: of all lengths of the pile, and of the shaking.
    inset : float
        Half width of the insets of all stones alike, a share of each: sharp edges stay sharp. On a grid of points without effect.
    mu : float
        Half width as a share, of the friction under each stone by itself.
    azimuth_deg : float
        Half width of the direction of the shaking, degrees; without effect where the record's second horizontal is unknown.

    Raises
    ------
    ParameterError
        If a width is negative, or a share 1 or more.
    """

    size: float = 0.05
    inset: float = 0.1
    mu: float = 0.2
    amplitude: float = 0.1
    azimuth_deg: float = 10.0

    def __post_init__(self) -> None:
        checks.in_interval("the spread of the size, a share,", self.size, "[0, 1)")
        checks.in_interval("the spread of the inset, a share,", self.inset, "[0, 1)")
        checks.in_interval("the spread of the friction, a share,", self.mu, "[0, 1)")
        checks.in_interval("the spread of the amplitude, a share,", self.amplitude, "[0, 1)")
        checks.in_interval("the spread of the azimuth", self.azimuth_deg, "[0, 180]", "degrees")


@dataclass(frozen=True)
class StoneProbability:
    """In which share of the versions one stone falls, and to which side.

    Parameters
    ----------
    name : str
    overturned : float
        A share.
    interval : (float, float), 1
        Clopper-Pearson's, 95 %, of the former.
    moved : float
        Share in which it ends more than `moved_m` from its place on the stone below, or falls.
    fell_towards_deg, fell_azimuth_deg : float or None
        Mean direction of its falls, from +x counter-clockwise and from north clockwise; None where it never falls, or north is not known.
    fell_alike_ratio : float or None, 1
        Length of the mean of unit vectors along its falls: 1 where all go to one side, near 0 where they go to all.
    """

    name: str
    overturned: float
    interval: tuple[float, float]
    moved: float
    fell_towards_deg: float | None
    fell_azimuth_deg: float | None
    fell_alike_ratio: float | None


@dataclass(frozen=True)
class PileProbability:
    """In which share of the versions of a pile a stone falls, and which.

    Parameters
    ----------
    runs, left_out_count : int
        Versions that were followed, and those that were not to their end, for they created energy.
    overturned, moved : float
        Shares in which any stone falls, and in which one ends more than `moved_m` from its place, or falls.
    interval : (float, float), 1
        Clopper-Pearson's, 95 %, of the former: what so many runs leave open, not what is not known of the pile.
    moved_m : float, m
    stones : tuple of StoneChance
        From below upwards.
    versions : PileVersions
        What was varied, and how far; its inset 0 on a grid of points, and less than asked where the pile would no longer stand at rest.
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
    **options: Any,
) -> PileProbability:
    """Return in which share of the plausible versions of a pile and its shaking each stone falls, and any of them.

    Parameters
    ----------
    body, motion
        As of :func:`~seisblock.models.stack.solve.solve_stack`; the middle of the versions.
    runs : int
        How many versions, at least 1.
    moved_m : float, m
        Distance beyond which a stone counts as moved.
    versions : PileVersions
    seed : int
        The same seed gives the same versions, on any number of threads.
    progress : callable
        Told the number of runs done and the number in all.
    workers : int
        Threads; as many as there are cores when left out.
    options
        The others of :func:`~seisblock.models.stack.solve.solve_stack`.

    Raises
    ------
    ParameterError
        If there are no runs, or a number lies outside its range.
    SolverError
        If no version can be followed.

    Examples
    --------
    >>> import numpy as np
    >>> pulse = Motion.from_arrays(4.0 * np.sin(np.linspace(0.0, np.pi, 101)), 0.01)
    >>> found = stack_probability(Pile("grave", (PileStone("post", 0.2, 0.2, 1.2),)), pulse, runs=4)
    >>> found.overturned, [stone.name for stone in found.stones if stone.overturned]
    (1.0, ['post'])
    """
    validate_inputs(body, Pile, motion)
    checks.instance(versions, PileVariation)
    checks.integer("the number of runs", runs, minimum=1)
    check_limit(N_("versions"), runs, "SEISBLOCK_RUNS")
    checks.positive("the displacement that counts as moved", moved_m, "m")
    if (mu_kinetic := options.pop("mu_kinetic", None)) is not None:
        body = body.with_kinetic_friction(mu_kinetic)
    versions = replace(versions, inset=widest_wear(body, versions.inset) if options.get("points", EDGE_POINTS) == EDGE_POINTS else 0.0)
    draws = np.random.default_rng(checks.seed(seed)).uniform(-1.0, 1.0, (runs, FRICTION + len(body.stones)))

    def work(draw: FloatArray) -> StackOutcome | SolverError:
        """Follow one version as far as it can be."""
        try:
            return solve_stack(perturb_pile(body, versions, draw), perturb_motion(motion, versions, draw), **options).outcome
        except SolverError as error:
            return error

    results = list(map_threads(work, list(draws), progress=progress, workers=workers))
    outcomes = [answer for answer in results if isinstance(answer, StackOutcome)]
    if not outcomes:
        raise next(answer for answer in results if isinstance(answer, SolverError))
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
    """Return one version of a pile: all its lengths by one factor, its edges worn alike, and the friction under each stone by its own.

    Parameters
    ----------
    body, versions
        As of :func:`stack_probability`.
    draw : (4 + stones,) array
        In [-1, 1].
    """
    size, friction_factors = 1.0 + versions.size * draw[SIZE], 1.0 + versions.mu * draw[FRICTION:]
    worn = worn_to(body, versions.inset, float(draw[INSET]))
    return replace(
        body, stones=tuple(_perturb_stone(stone, size, friction_factors[i], *body.friction(stone)) for i, stone in enumerate(worn.stones))
    )


def _perturb_stone(stone: PileStone, size: float, friction_factor: float, mu: float, mu_kinetic: float) -> PileStone:
    """Return a stone of another size, on another friction."""
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
    """Return one version of the shaking: scaled, and turned about the vertical where both its horizontals are known.

    Parameters
    ----------
    motion, versions
        As of :func:`stack_probability`.
    draw : (4 + stones,) array
        In [-1, 1].

    Examples
    --------
    >>> pulse = Motion.from_arrays([0.0, 1.0, 0.0], 0.01)
    >>> perturb_motion(pulse, PileVariation(amplitude=0.5), np.ones(4)).horizontal.tolist()
    [0.0, 1.5, 0.0]
    """
    factor = 1.0 + versions.amplitude * draw[AMPLITUDE]
    angle = math.radians(versions.azimuth_deg * draw[AZIMUTH]) * bool(motion.transverse.any())
    c, s = factor * math.cos(angle), factor * math.sin(angle)
    # a copy per thread and no more: it ends with its run
    longitudinal, transverse = motion.horizontal, motion.transverse
    rows = (c * longitudinal - s * transverse, s * longitudinal + c * transverse, factor * motion.vertical)
    return Motion(rows, motion.dt, name=motion.name, start_s=motion.start_s, record=motion.record)


def _stone_probability(fates: Sequence[StoneOutcome], moved_share: float, azimuth: float | None) -> StoneProbability:
    """Return how often one stone falls, and to which side."""
    fell = [math.radians(fate.fell_towards_deg) for fate in fates if fate.fell_towards_deg is not None]
    share, interval = len(fell) / len(fates), clopper_pearson(len(fell), len(fates))
    if not fell:
        return StoneProbability(fates[0].name, share, interval, moved_share, None, None, None)
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

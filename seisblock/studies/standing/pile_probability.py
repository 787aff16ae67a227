"""How sure the fate of a pile is: plausible versions of its stones and the shaking, and the share of them in which each stone falls.

A pile is chaotic sooner than a block: a stone that strikes a little earlier falls to another side, or stays. One run is an anecdote.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from seisblock import checks
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import PileStone
from seisblock.bodies.pile.wear import widest_wear, worn_to
from seisblock.errors import SolverError
from seisblock.limits import check_budget
from seisblock.records.given import check_call
from seisblock.records.motion import Motion
from seisblock.solvers.stack.outcome import StackOutcome, StoneFate
from seisblock.solvers.stack.solve import EDGES, solve_stack
from seisblock.studies.intervals import clopper_pearson
from seisblock.studies.runs import in_threads
from seisblock.studies.standing.probability import MOVED_M
from seisblock.typing import FloatArray, Progress
from seisblock.words import noted

SIZE, AMPLITUDE, AZIMUTH, INSET, FRICTION = range(5)
"""Columns of the draws; from the last one on there is one for each stone."""


@dataclass(frozen=True)
class PileVersions:
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
        checks.within("the spread of the size, a share,", self.size, "[0, 1)")
        checks.within("the spread of the inset, a share,", self.inset, "[0, 1)")
        checks.within("the spread of the friction, a share,", self.mu, "[0, 1)")
        checks.within("the spread of the amplitude, a share,", self.amplitude, "[0, 1)")
        checks.within("the spread of the azimuth", self.azimuth_deg, "[0, 180]", "degrees")


@dataclass(frozen=True)
class StoneChance:
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
    stones: tuple[StoneChance, ...]
    versions: PileVersions
    seed: int
    left_out_count: int = 0


def stack_probability(
    body: Pile,
    motion: Motion,
    *,
    runs: int,
    moved_m: float = MOVED_M,
    versions: PileVersions = PileVersions(),
    seed: int = 0,
    progress: Progress | None = None,
    workers: int | None = None,
    **options: Any,
) -> PileProbability:
    """Return in which share of the plausible versions of a pile and its shaking each stone falls, and any of them.

    Parameters
    ----------
    body, motion
        As of :func:`~seisblock.solvers.stack.solve.solve_stack`; the middle of the versions.
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
        The others of :func:`~seisblock.solvers.stack.solve.solve_stack`.

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
    check_call(body, Pile, motion)
    checks.instance(versions, PileVersions)
    checks.whole("the number of runs", runs, least=1)
    check_budget(noted("versions"), runs, "SEISBLOCK_RUNS")
    checks.positive("the displacement that counts as moved", moved_m, "m")
    if (mu_kinetic := options.pop("mu_kinetic", None)) is not None:
        body = body.sliding_at(mu_kinetic)
    versions = replace(versions, inset=widest_wear(body, versions.inset) if options.get("points", EDGES) == EDGES else 0.0)
    draws = np.random.default_rng(checks.seed(seed)).uniform(-1.0, 1.0, (runs, FRICTION + len(body.stones)))

    def work(draw: FloatArray) -> StackOutcome | SolverError:
        """Follow one version as far as it can be."""
        try:
            return solve_stack(changed_pile(body, versions, draw), changed_motion(motion, versions, draw), **options).outcome
        except SolverError as error:
            return error

    answers = list(in_threads(work, list(draws), progress=progress, workers=workers))
    outcomes = [answer for answer in answers if isinstance(answer, StackOutcome)]
    if not outcomes:
        raise next(answer for answer in answers if isinstance(answer, SolverError))
    fates = [outcome.stones for outcome in outcomes]
    moved = np.array([[stone.state == "fallen" or stone.residual_slip_m > moved_m for stone in stones] for stones in fates])
    fell = sum(outcome.overturned_any for outcome in outcomes)
    return PileProbability(
        len(outcomes),
        fell / len(outcomes),
        float(moved.any(axis=1).mean()),
        clopper_pearson(fell, len(outcomes)),
        moved_m,
        tuple(_chance([stones[i] for stones in fates], float(moved[:, i].mean()), motion.azimuth_deg) for i in range(len(body.stones))),
        versions,
        seed,
        runs - len(outcomes),
    )


def changed_pile(body: Pile, versions: PileVersions, draw: FloatArray) -> Pile:
    """Return one version of a pile: all its lengths by one factor, its edges worn alike, and the friction under each stone by its own.

    Parameters
    ----------
    body, versions
        As of :func:`stack_probability`.
    draw : (4 + stones,) array
        In [-1, 1].
    """
    size, rough = 1.0 + versions.size * draw[SIZE], 1.0 + versions.mu * draw[FRICTION:]
    worn = worn_to(body, versions.inset, float(draw[INSET]))
    return replace(body, stones=tuple(_changed(stone, size, rough[i], *body.friction(stone)) for i, stone in enumerate(worn.stones)))


def _changed(stone: PileStone, size: float, rough: float, clings: float, slides: float) -> PileStone:
    """Return a stone of another size, on another friction."""
    return replace(
        stone,
        width=size * stone.width,
        depth=size * stone.depth,
        height=size * stone.height,
        offset=(size * stone.offset[0], size * stone.offset[1]),
        bottom=None if stone.bottom is None else size * stone.bottom,
        inset=replace(stone.inset, length_m=size * stone.inset.length_m),
        mu=rough * clings,
        mu_kinetic=rough * slides,
    )


def changed_motion(motion: Motion, versions: PileVersions, draw: FloatArray) -> Motion:
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
    >>> changed_motion(pulse, PileVersions(amplitude=0.5), np.ones(4)).horizontal.tolist()
    [0.0, 1.5, 0.0]
    """
    factor = 1.0 + versions.amplitude * draw[AMPLITUDE]
    angle = math.radians(versions.azimuth_deg * draw[AZIMUTH]) * bool(motion.transverse.any())
    c, s = factor * math.cos(angle), factor * math.sin(angle)
    # a copy per thread and no more: it ends with its run
    along, across = motion.horizontal, motion.transverse
    rows = (c * along - s * across, s * along + c * across, factor * motion.vertical)
    return Motion(rows, motion.dt, name=motion.name, start_s=motion.start_s, record=motion.record)


def _chance(fates: Sequence[StoneFate], moved: float, azimuth: float | None) -> StoneChance:
    """Return how often one stone falls, and to which side."""
    fell = [math.radians(fate.fell_towards_deg) for fate in fates if fate.fell_towards_deg is not None]
    share, interval = len(fell) / len(fates), clopper_pearson(len(fell), len(fates))
    if not fell:
        return StoneChance(fates[0].name, share, interval, moved, None, None, None)
    mean = complex(np.exp(1j * np.array(fell)).mean())
    towards = math.degrees(math.atan2(mean.imag, mean.real))
    return StoneChance(
        fates[0].name, share, interval, moved, towards, None if azimuth is None else (azimuth - towards) % 360.0, min(abs(mean), 1.0)
    )

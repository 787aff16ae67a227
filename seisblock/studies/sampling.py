"""Uncertainty engine: samples of an object and its shaking, solved by any of the models that tell whether the object overturns.

All commands draw their samples here. The nominal object is the median of its samples in every parameter: a given value varies by its own
tolerance (:class:`ParameterVariation`); unmeasured edge wear and friction are drawn from the prior of the kind of object
(:class:`~seisblock.bodies.uncertainty.ParameterRanges`), whose median is the nominal value. The same seed gives the same samples whatever
the model and the direction, so that samples of several directions can be joined one by one.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from seisblock.bodies.block import Block
from seisblock.bodies.block_array import BlockArray, samples, wear_shares, within
from seisblock.bodies.convex import ConvexBody, convex_body
from seisblock.bodies.pile.edge_wear import worn_to
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import PileStone
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import ParameterError, SolverError
from seisblock.core.i18n import N_
from seisblock.core.limits import MAX_RUNS, check_limit
from seisblock.core.registry import solver_names
from seisblock.core.results import Status
from seisblock.core.typing import BoolArray, FloatArray, Progress
from seisblock.models.respond.options import RespondOptions
from seisblock.models.respond.params import RespondBatchParams
from seisblock.models.rigid3d.options import Rigid3dOptions
from seisblock.models.rigid3d.outcome import Rigid3dOutcome, build_outcome
from seisblock.models.rigid3d.solve import Body as RigidBody
from seisblock.models.rigid3d.solve import facing_body, ground_acceleration
from seisblock.models.rigid3d.solve import run as run_rigid3d
from seisblock.models.rock.options import RockOptions
from seisblock.models.rock.params import RockBatchParams, rock_batch_params
from seisblock.models.stack.options import StackOptions
from seisblock.records import Motion
from seisblock.records._validation import Gain, vertical_gain
from seisblock.studies.intervals import clopper_pearson
from seisblock.studies.parallel import map_threads
from seisblock.studies.solvers import solver_studies, solvers_with

RUNS = 200
"""Default number of samples of a block."""

PILE_RUNS = 20
"""Default number of samples of a pile, each of which costs as much as the run itself."""

MOVED_M = 0.01
"""Default residual displacement above which an object has moved, m."""

MAX_RESTITUTION = 0.95
"""Upper limit of sampled restitutions: near 1 a body bounces without end."""

MAX_ROCKING_RESTITUTION = 0.9999
"""Upper limit of sampled ratios of angular velocities of a rocking block: with 1, hops of 1e-7 s go on to the end of the record."""

HEIGHT, INSET, MU, RESTITUTION, AMPLITUDE, AZIMUTH, WIDTH, SLENDERNESS, STONES = range(9)
"""Columns of the draws; from ``STONES`` on, one column per stone of a pile, for its friction."""


@dataclass(frozen=True, repr=False)
class ParameterVariation(DisplayMixin):
    """Half widths of the samples around the nominal values; each parameter varies uniformly and independently.

    Parameters
    ----------
    size, mu, amplitude : float, 1
        Relative half widths; size applies to the lengths along the ground and, independently, to the heights.
    inset : float, 1
        Relative half width of a known inset, as far as a fifth of the base remains: sharp edges stay sharp. Unmeasured edges are
        drawn from the prior of the body's kind instead; 0 takes them as known exactly, and likewise for `mu`.
    restitution : float, 1
        Half width of the restitution of an impact. Below 0 it continues as a share of the angular velocity of rocking that an impact
        without restitution leaves: -0.05 stands for 0.95 of Housner's ratio, as measured on concrete. A ratio of angular velocities
        (`rock`, `rocking_restitution`) varies by this share of itself.
    azimuth_deg : float
        Half width, degrees; no effect if the record's second horizontal is unknown.
    slenderness : float, 1
        Relative half width of a further factor on the lengths along the ground alone.

    Raises
    ------
    ParameterError
        If a width is negative, or a relative width is 1 or more.
    """

    size: float = 0.05
    inset: float = 0.1
    mu: float = 0.2
    restitution: float = 0.1
    amplitude: float = 0.1
    azimuth_deg: float = 10.0
    slenderness: float = 0.0

    def __post_init__(self) -> None:
        checks.in_interval("the relative spread of the size", self.size, "[0, 1)")
        checks.in_interval("the relative spread of the edge wear", self.inset, "[0, 1)")
        checks.in_interval("the relative spread of the friction", self.mu, "[0, 1)")
        checks.in_interval("the spread of the restitution", self.restitution, "[0, 1)")
        checks.in_interval("the relative spread of the amplitude", self.amplitude, "[0, 1)")
        checks.in_interval("the spread of the azimuth", self.azimuth_deg, "[0, 180]", "degrees")
        checks.in_interval("the relative spread of the slenderness", self.slenderness, "[0, 1)")


@dataclass(frozen=True, eq=False, repr=False)
class Samples(DisplayMixin):
    """Results of the samples of one object in one direction; arrays of shape (runs,).

    Parameters
    ----------
    solver : str
    overturned : bool
    displacement_m : m
        Residual displacement: in a plane signed, in three dimensions the distance, of a pile the largest of its stones, infinite for one
        that fell.
    no_answer : bool
        Samples stopped without a result; they neither overturn nor stand.
    variation : ParameterVariation
        Half widths in use.
    seed : int
    outcomes : tuple
        Outcome of each sample with a result in three dimensions or of a pile.
    """

    solver: str
    overturned: BoolArray
    displacement_m: FloatArray
    no_answer: BoolArray
    variation: ParameterVariation
    seed: int
    outcomes: tuple[Any, ...] = ()

    @property
    def completed(self) -> int:
        """Number of samples with a result."""
        return int(np.count_nonzero(~self.no_answer))

    @property
    def probability(self) -> float:
        """Share of the samples with a result that overturn."""
        return int(self.overturned.sum()) / self.completed

    @property
    def interval(self) -> tuple[float, float]:
        """Clopper-Pearson interval of the probability, 95 %; stratified samples scatter less than it assumes, model error not included."""
        return clopper_pearson(int(self.overturned.sum()), self.completed)

    @property
    def stopped(self) -> tuple[int, ...]:
        """Numbers, from 1, of the samples without a result."""
        return tuple((np.flatnonzero(self.no_answer) + 1).tolist())

    def moved_probability(self, moved_m: float = MOVED_M) -> float:
        """Return the share of the samples with a result that overturn or end further than `moved_m` (m) from their place."""
        return float(self.moves(moved_m)[~self.no_answer].mean())

    def moves(self, moved_m: float) -> BoolArray:
        """Return whether each sample overturns or ends further than `moved_m` (m) from its place, (runs,)."""
        moved: BoolArray = ~self.no_answer & (self.overturned | (np.abs(self.displacement_m) > moved_m))
        return moved


@dataclass(frozen=True, eq=False)
class Sampling:
    """Task of a solver: samples of one object in one direction, with the arguments of :func:`sample` and its draws."""

    solver: str
    body: Any
    motion: Motion
    options: Any
    draws: FloatArray
    variation: ParameterVariation
    seed: int
    progress: Progress | None
    workers: int | None

    def results(self, overturned: BoolArray, displacement_m: FloatArray, no_answer: BoolArray, outcomes: tuple[Any, ...] = ()) -> Samples:
        """Return the samples with their results."""
        return Samples(self.solver, overturned, displacement_m, no_answer, self.variation, self.seed, outcomes)


def sample(
    solver: str,
    body: RigidBody | Pile,
    motion: Motion,
    options: RespondOptions | RockOptions | Rigid3dOptions | StackOptions,
    runs: int = RUNS,
    priors: ParameterVariation = ParameterVariation(),
    *,
    seed: int = 0,
    progress: Progress | None = None,
    workers: int | None = None,
) -> Samples:
    """Solve samples of an object and its shaking.

    Parameters
    ----------
    solver : str
        One whose outcome includes overturning.
    body : Block, Scan, ScannedBody, ConvexBody or Pile
        Median of the samples, with the prior of its kind (``body.ranges``); only `rigid3d` takes scans and convex bodies.
    motion : Motion
    options : options of the solver
    runs : int
        Number of samples, at least 1.
    priors : ParameterVariation
        Half widths of what is known.
    seed : int
        The same seed gives the same samples, on any number of threads.
    progress : callable
        Called with the number of finished runs and the total.
    workers : int or None
        Threads of a pile or in three dimensions; default: the number of cores.

    Returns
    -------
    Samples

    Raises
    ------
    ParameterError
        If there are no runs, the solver tells of no overturning, or a number lies outside its range.
    SolverError
        If no sample has a result.

    Examples
    --------
    >>> import numpy as np
    >>> from seisblock.uncertainty import sample
    >>> pulse = Motion.from_arrays(5.0 * np.sin(np.linspace(0.0, np.pi, 101)), 0.01)
    >>> result = sample("respond", Block(0.24, 0.8), pulse, RespondOptions(mu=0.5), 20)
    >>> result.probability, result.completed
    (1.0, 20)
    """
    run = solver_studies(solver).sample if solver in solver_names() else None
    if run is None:
        raise ParameterError("{solver!r} cannot be sampled; available: {known}", solver=str(solver)[:100], known=solvers_with("sample"))
    checks.instance(priors, ParameterVariation)
    checks.integer("the number of runs", runs, minimum=1)
    check_limit(N_("Monte Carlo samples"), runs, MAX_RUNS)
    stones = len(body.stones) if isinstance(body, Pile) else 0
    return run(Sampling(solver, body, motion, options, draw_samples(runs, seed, stones=stones), priors, seed, progress, workers))


def draw_samples(runs: int, seed: int, *, stones: int = 0) -> FloatArray:
    """Return the draws of samples, uniform in [-1, 1], (runs, 8 + stones): Latin hypercube, one draw per stratum of each column."""
    rng = np.random.default_rng(checks.seed(seed))
    # independent draws of one seed err alike for every object: over 32 objects of medium probability by up to .03
    # a seed must give the same block, whatever the number of stones, so that models can be compared sample by sample
    # one block of columns after the other, so that those of a block do not depend on what is drawn after them
    widths = (AZIMUTH + 1, 1, 1, stones)
    return np.column_stack([_stratified(rng, runs, width) for width in widths])


def _stratified(rng: np.random.Generator, runs: int, columns: int) -> FloatArray:
    """Return draws in [-1, 1] with one of each column in each of `runs` equal strata, (runs, columns)."""
    strata = rng.permuted(np.broadcast_to(np.arange(runs)[:, None], (runs, columns)), axis=0)
    return 2.0 * (strata + rng.uniform(size=(runs, columns))) / runs - 1.0


def sample_blocks(block: Block, variation: ParameterVariation, draws: FloatArray) -> BlockArray:
    """Return the samples of a block: width, height and edge wear.

    Parameters
    ----------
    block : Block
    variation : ParameterVariation
    draws : (m, 8) array
        From :func:`draw_samples`.
    """
    # one factor scales the plan, a second one changes the slenderness alone
    wide = (1.0 + variation.size * draws[:, WIDTH]) * (1.0 + variation.slenderness * draws[:, SLENDERNESS])
    return samples(block, variation.inset, wide=wide, tall=1.0 + variation.size * draws[:, HEIGHT], worn=draws[:, INSET])


def sample_gains(motion: Motion, variation: ParameterVariation, draws: FloatArray, vertical: Gain | None) -> FloatArray:
    """Return the gains on the rows along, across and up that scale and rotate the shaking of each sample, (m, 3).

    Parameters
    ----------
    motion : Motion
    variation : ParameterVariation
    draws : (m, 8) array
    vertical : bool, float or None
        As in the options of a solver.
    """
    # the amplitude acts on all components alike: it stands for the scatter of a site, not of a direction
    amplitude = 1.0 + variation.amplitude * draws[:, AMPLITUDE]
    # no rotation if the transverse motion is unknown (zero): it would only reduce the amplitude
    angle = np.radians(variation.azimuth_deg) * draws[:, AZIMUTH] * bool(motion.transverse.any())
    return np.column_stack([amplitude * np.cos(angle), -amplitude * np.sin(angle), amplitude * vertical_gain(motion, vertical)])


def sample_respond_params(block: Block, variation: ParameterVariation, draws: FloatArray, options: RespondOptions) -> RespondBatchParams:
    """Return the samples of a free-standing body and its contact.

    Parameters
    ----------
    block, variation, draws
        As in :func:`sample_blocks`.
    options : RespondOptions
    """
    mu, restitution, rocking_restitution = options.mu, options.restitution, options.rocking_restitution
    # one factor on both coefficients keeps kinetic below static friction
    friction_factor = sample_friction_factors(block, variation, draws, mu)
    change = variation.restitution * draws[:, RESTITUTION]
    bounce = restitution + change
    # continuous through 0: a restitution below it is a loss beyond a plastic impact
    loss_factor = 1.0 + np.minimum(bounce, 0.0)
    if rocking_restitution is not None:
        loss_factor = np.minimum(rocking_restitution * (1.0 + change), max(rocking_restitution, 1.0))
    return RespondBatchParams(
        sample_blocks(block, variation, draws),
        mu * friction_factor,
        (mu if options.mu_kinetic is None else options.mu_kinetic) * friction_factor,
        np.clip(bounce, 0.0, max(restitution, MAX_RESTITUTION)),
        loss_factor,
        rocking_restitution is not None,
        options.gravity,
        options.tenon,
    )


def sample_friction_factors(body: RigidBody, variation: ParameterVariation, draws: FloatArray, mu: float) -> FloatArray:
    """Return the factors on the friction of the samples, (m,).

    Unmeasured friction: the prior of the kind, its median at the nominal value, replaces the relative width.

    Parameters
    ----------
    body, variation, draws
        As in :func:`sample_blocks`.
    mu : float, 1
        Nominal friction.
    """
    ranges = body.ranges if isinstance(body, Block) else None
    if variation.mu > 0.0 and ranges is not None and ranges.mu is not None:
        return within(ranges.mu, mu, draws[:, MU]) / mu if mu > 0.0 else np.ones(len(draws))
    return 1.0 + variation.mu * draws[:, MU]


def sample_solids(body: RigidBody, variation: ParameterVariation, draws: FloatArray) -> list[ConvexBody]:
    """Return the samples of a body in three dimensions: one factor on all lengths along the ground, one on heights, edge wear of a block.

    Parameters
    ----------
    body : Block, Scan, ScannedBody or ConvexBody
    variation : ParameterVariation
    draws : (m, 8) array
        From :func:`draw_samples`.
    """
    plan = (1.0 + variation.size * draws[:, WIDTH]) * (1.0 + variation.slenderness * draws[:, SLENDERNESS])
    factors = list(zip(plan.tolist(), (1.0 + variation.size * draws[:, HEIGHT]).tolist(), strict=True))
    if not isinstance(body, Block):
        solid = convex_body(body)
        return [solid.scaled(*pair) for pair in factors]
    worn = wear_shares(body, variation.inset, draws[:, INSET]).tolist()
    return [convex_body(replace(body, inset=share * body.width)).scaled(*pair) for share, pair in zip(worn, factors, strict=True)]


def sample_rock_params(
    block: Block, motion: Motion, variation: ParameterVariation, draws: FloatArray, options: RockOptions = RockOptions()
) -> RockBatchParams:
    """Return the samples of a rocking block.

    Parameters
    ----------
    block, variation, draws
        As in :func:`sample_blocks`.
    motion : Motion
    options : RockOptions
    """
    params = rock_batch_params(sample_blocks(block, variation, draws), motion, options)
    factor = 1.0 + variation.restitution * draws[:, RESTITUTION, None]
    limit = np.maximum(params.restitutions, MAX_ROCKING_RESTITUTION)
    return replace(params, restitutions=np.minimum(params.restitutions * factor, limit))


def sample_pile(body: Pile, variation: ParameterVariation, draw: FloatArray) -> Pile:
    """Return one sample of a pile: common factors on its plan, heights and edge wear, and a factor on the friction under each stone.

    Parameters
    ----------
    body : Pile
    variation : ParameterVariation
    draw : (8 + stones,) array
        Row of :func:`draw_samples`.
    """
    plan = (1.0 + variation.size * draw[WIDTH]) * (1.0 + variation.slenderness * draw[SLENDERNESS])
    tall = 1.0 + variation.size * draw[HEIGHT]
    friction_factors = 1.0 + variation.mu * draw[STONES:]
    worn = worn_to(body, variation.inset, float(draw[INSET]))
    stones = [
        _scale_stone(stone, plan, tall, factor, body.friction(stone))
        for stone, factor in zip(worn.stones, friction_factors.tolist(), strict=True)
    ]
    return replace(body, stones=tuple(stones))


def _scale_stone(stone: PileStone, plan: float, tall: float, friction_factor: float, friction: tuple[float, float]) -> PileStone:
    return replace(
        stone,
        width=plan * stone.width,
        depth=plan * stone.depth,
        height=tall * stone.height,
        offset=(plan * stone.offset[0], plan * stone.offset[1]),
        bottom=None if stone.bottom is None else tall * stone.bottom,
        inset=replace(stone.inset, length_m=plan * stone.inset.length_m),
        mu=friction_factor * friction[0],
        mu_kinetic=friction_factor * friction[1],
    )


def sample_motion(motion: Motion, variation: ParameterVariation, draw: FloatArray) -> Motion:
    """Return one sample of a shaking in three dimensions: scaled, and rotated about the vertical if both horizontals are known.

    Parameters
    ----------
    motion : Motion
    variation : ParameterVariation
    draw : (8 + stones,) array

    Examples
    --------
    >>> pulse = Motion.from_arrays([0.0, 1.0, 0.0], 0.01)
    >>> sample_motion(pulse, ParameterVariation(amplitude=0.5), np.ones(8)).horizontal.tolist()
    [0.0, 1.5, 0.0]
    """
    factor = 1.0 + variation.amplitude * draw[AMPLITUDE]
    angle = math.radians(variation.azimuth_deg * draw[AZIMUTH]) * bool(motion.transverse.any())
    # a rotation of the ground motion stands for an unknown orientation of the object
    c, s = factor * math.cos(angle), factor * math.sin(angle)
    # one copy of the motion per thread; released with its run
    longitudinal, transverse = motion.horizontal, motion.transverse
    rows = (c * longitudinal - s * transverse, s * longitudinal + c * transverse, factor * motion.vertical)
    return Motion(rows, motion.dt, name=motion.name, start_s=motion.start_s, record=motion.record)


def rigid3d_outcomes(
    body: RigidBody,
    motion: Motion,
    options: Rigid3dOptions,
    draws: FloatArray,
    variation: ParameterVariation,
    *,
    scales: FloatArray | None = None,
    progress: Progress | None = None,
    workers: int | None = None,
) -> list[Rigid3dOutcome | None]:
    """Return the outcome of each sample in three dimensions, None for one that diverged.

    The run of a body that has overturned ends when nothing can return it to its base: verdict, time and azimuth of the fall are final.

    Parameters
    ----------
    body, motion, options
        As in :func:`~seisblock.models.rigid3d.solve.solve_rigid3d`.
    draws : (m, 8) array
        From :func:`draw_samples`.
    variation : ParameterVariation
    scales : (m,) array or None
        Further factors on the motion.
    progress, workers
        As in :func:`sample`.
    """
    factors = sample_friction_factors(body, variation, draws, options.mu)
    # a plastic impact is the lossiest there is
    bounces = np.clip(options.restitution + variation.restitution * draws[:, RESTITUTION], 0.0, max(options.restitution, MAX_RESTITUTION))
    gains = np.array([1.0, float(options.across), vertical_gain(motion, options.vertical)])
    solids = sample_solids(body if isinstance(body, Block) else facing_body(body, motion), variation, draws)

    def work(row: int) -> Rigid3dOutcome | None:
        shaken = sample_motion(motion, variation, draws[row])
        sample_options = replace(options, mu=options.mu * float(factors[row]), restitution=float(bounces[row]))
        along, across, up = (gains if scales is None else scales[row] * gains).tolist()
        acceleration = ground_acceleration(shaken, (along, across, up))
        scratch, _, status = run_rigid3d(solids[row], acceleration, motion.dt, sample_options, until_decided=True)
        return None if status == Status.NOT_FINITE else build_outcome(scratch, motion.start_s, motion.dt, motion.azimuth_deg)

    return list(map_threads(work, range(len(draws)), progress=progress, workers=workers))


def rigid3d_samples(results: Sequence[Rigid3dOutcome | None], body: RigidBody, variation: ParameterVariation, seed: int) -> Samples:
    """Return the samples of outcomes in three dimensions, None for one that diverged.

    Raises
    ------
    SolverError
        If all of them diverged.
    """
    outcomes = tuple(result for result in results if result is not None)
    if not outcomes:
        raise SolverError("the motion of {name} diverged", name=convex_body(body).name)
    shifts = np.array([math.nan if result is None else math.hypot(*result.final_displacement_m) for result in results])
    fallen = np.array([result is not None and result.overturned for result in results])
    return Samples("rigid3d", fallen, shifts, np.array([result is None for result in results]), variation, seed, outcomes)


def join_directions(parts: Sequence[Samples]) -> Samples:
    """Return the samples of an object under any of several directions: a sample overturns if it does so in one of them.

    Parameters
    ----------
    parts : sequence of Samples
        Of the same draws.

    Examples
    --------
    >>> def part(falls, stopped=(False, False)):
    ...     return Samples("rock", np.array(falls), np.zeros(2), np.array(stopped), ParameterVariation(), 0)
    >>> join_directions([part([True, False]), part([False, False], (True, True))]).probability
    1.0
    """
    falls = np.any([part.overturned for part in parts], axis=0)
    # the fate of a sample that fell in one direction is known, whatever happened in the others
    unknown = np.any([part.no_answer for part in parts], axis=0) & ~falls
    shifts = np.max([np.where(part.no_answer, 0.0, np.abs(part.displacement_m)) for part in parts], axis=0)
    first = parts[0]
    return Samples(first.solver, falls, shifts, unknown, first.variation, first.seed)

"""How sure it is: plausible versions of an object and its shaking, and the share of them that fall or move.

Nobody knows an object to the last per cent. Each version differs in what cannot be known: size, worn edges, friction,
restitution, amplitude and direction of the shaking. What comes out is of this model's own scatter: on shaking tables 3 % of two
granite rocks fell where none of 20 such versions did, and 2 % stood where all fell.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seisblock import checks
from seisblock.bodies.block import Block
from seisblock.bodies.blocks import Blocks, versions_within, wear_range
from seisblock.bodies.blocks import versions as resized_versions
from seisblock.bodies.inset import HALF
from seisblock.bodies.ranges import Ranges, within
from seisblock.errors import ParameterError
from seisblock.limits import check_budget
from seisblock.records import Motion
from seisblock.records.given import Factor, check_call, vertical_gain
from seisblock.solvers.respond.many import Fates, no_answer, respond_many
from seisblock.solvers.respond.settings import Settings
from seisblock.solvers.respond.solve import make_setting
from seisblock.studies.intervals import clopper_pearson
from seisblock.typing import FloatArray, Progress
from seisblock.units import STANDARD_GRAVITY
from seisblock.words import noted

RUNS = 200
MOVED_M = 0.01
QUANTILES = (0.05, 0.25, 0.5, 0.75, 0.95)
ROUGHEST = 0.95
"""Restitutions of versions stay below this: hops near 1 have no end."""

AT_ONCE = 100
"""Versions handed over at a time, so that progress can be told."""


@dataclass(frozen=True)
class Versions:
    """How far plausible versions differ from what was given; each change uniform and independent of the others.

    Parameters
    ----------
    size, mu, amplitude : float
        Half widths as shares of the value.
    inset : float
        Largest inset per side, a share of the width: versions are worn from sharp edges to this. Where the body is itself worn by
        more, from its own less to its own plus half of it, as far as a fifth of the base is left.
    restitution : float, 1
        How much more than the given one it may be.
    azimuth_deg : float
        Half width, degrees; without effect where the record's second horizontal is unknown.

    Raises
    ------
    ParameterError
        If a width is negative, or a share 1 or more.
    """

    size: float = 0.05
    inset: float = 0.1
    mu: float = 0.2
    restitution: float = 0.1
    amplitude: float = 0.1
    azimuth_deg: float = 10.0

    def __post_init__(self) -> None:
        checks.within("the spread of the size, a share,", self.size, "[0, 1)")
        checks.within("the spread of the inset, a share of the width,", self.inset, f"[0, {HALF})")
        checks.within("the spread of the friction, a share,", self.mu, "[0, 1)")
        checks.within("the spread of the restitution", self.restitution, "[0, 1)")
        checks.within("the spread of the amplitude, a share,", self.amplitude, "[0, 1)")
        checks.within("the spread of the azimuth", self.azimuth_deg, "[0, 180]", "degrees")


@dataclass(frozen=True)
class Probability:
    """Which share of the versions falls, and which moves.

    Parameters
    ----------
    runs : int
        Versions that have an answer.
    overturned, moved : float
        Shares that fall, and that end more than `moved_m` from where they stood, or fall.
    interval : (float, float), 1
        Clopper-Pearson's, 95 %, of the former: what so many runs leave open, not what is not known of the object.
    moved_m : float, m
    final_displacement_m : dict
        Quantiles of the displacement of those that stand, signed, by their share; empty where all fall.
    versions : Versions
        What was varied, and how far.
    seed : int
    ranges : Ranges or None
        Of the body's own kind, where its file tells them: in these lie its versions, instead of differing by shares.
    no_answer : tuple of int
        Numbers, from 1, of the versions that were given up. They are not among `runs`: whether they would fall is not known.
    """

    runs: int
    overturned: float
    moved: float
    interval: tuple[float, float]
    moved_m: float
    final_displacement_m: dict[str, float]
    versions: Versions
    seed: int
    ranges: Ranges | None = None
    no_answer: tuple[int, ...] = ()


def respond_probability(
    block: Block,
    motion: Motion,
    *,
    mu: float,
    mu_kinetic: float | None = None,
    restitution: float = 0.0,
    rocking_restitution: float | None = None,
    vertical: Factor | None = None,
    gravity: float = STANDARD_GRAVITY,
    settle_s: float = 60.0,
    tenon: float = 0.0,
    runs: int = RUNS,
    moved_m: float = MOVED_M,
    versions: Versions = Versions(),
    seed: int = 0,
    progress: Progress | None = None,
) -> Probability:
    """Return which share of the plausible versions of a body and its shaking falls, and which share moves.

    Parameters
    ----------
    block, motion, mu, mu_kinetic, restitution, rocking_restitution, vertical, gravity, settle_s, tenon
        As in :func:`~seisblock.solvers.respond.solve.solve_respond`; the middle of the versions, but where the body knows the ranges of
        its kind.
    runs : int
        How many versions, at least 1.
    moved_m : float, m
        Displacement beyond which a body counts as moved.
    versions : Versions
    seed : int
        The same seed gives the same versions, on any number of threads.
    progress : callable
        Told the number of runs done and the number in all.

    Raises
    ------
    ParameterError
        If there are no runs, or a number lies outside its range.
    SolverError
        If every version hops without end.

    Examples
    --------
    >>> import numpy as np
    >>> pulse = Motion.from_arrays(4.0 * np.sin(np.linspace(0.0, np.pi, 101)), 0.01)
    >>> respond_probability(Block(0.24, 0.8), pulse, mu=0.5, runs=20).overturned
    1.0
    """
    check_call(block, Block, motion)
    checks.instance(versions, Versions)
    checks.whole("the number of runs", runs, least=1)
    check_budget(noted("versions"), runs, "SEISBLOCK_RUNS")
    if not (math.isfinite(moved_m) and moved_m > 0.0):
        raise ParameterError("the displacement that counts as moved must be positive, found {found} m", found=moved_m)
    make_setting(
        block,
        mu=mu,
        mu_kinetic=mu_kinetic,
        restitution=restitution,
        rocking_restitution=rocking_restitution,
        gravity=gravity,
        tenon=tenon,
    )
    dice = np.random.default_rng(checks.seed(seed))
    draws = np.column_stack([dice.uniform(-1.0, 1.0, (runs, 6)), dice.uniform(-1.0, 1.0, runs)])
    settings = changed_settings(
        block,
        versions,
        draws,
        mu=mu,
        mu_kinetic=mu_kinetic,
        restitution=restitution,
        rocking_restitution=rocking_restitution,
        gravity=gravity,
        tenon=tenon,
    )
    gains = _gains(motion, versions, draws, vertical)
    parts: list[Fates] = []
    for first in range(0, runs, AT_ONCE):
        part = slice(first, first + AT_ONCE)
        parts.append(respond_many(settings[part], motion, gains=gains[part], settle_s=settle_s))
        if progress is not None:
            progress(min(first + AT_ONCE, runs), runs)
    gave_up, fallen, shifts = (
        np.concatenate([getattr(fates, name) for fates in parts]) for name in ("gave_up", "overturned", "final_displacement_m")
    )
    if gave_up.all():
        raise no_answer(runs, runs, min(int(fates.impacts.min()) for fates in parts))
    falls, shift = fallen[~gave_up], shifts[~gave_up]
    standing = np.quantile(shift[~falls], QUANTILES) if not falls.all() else ()
    count = int(falls.sum())
    return Probability(
        falls.size,
        count / falls.size,
        float(np.mean(falls | (np.abs(shift) > moved_m))),
        clopper_pearson(count, falls.size),
        moved_m,
        {f"q{round(100 * share):02d}": float(value) for share, value in zip(QUANTILES, standing, strict=False)},
        versions,
        seed,
        block.ranges,
        tuple((np.flatnonzero(gave_up) + 1).tolist()),
    )


def changed_settings(
    block: Block,
    versions: Versions,
    draws: FloatArray,
    *,
    mu: float,
    mu_kinetic: float | None = None,
    restitution: float = 0.0,
    rocking_restitution: float | None = None,
    gravity: float = STANDARD_GRAVITY,
    tenon: float = 0.0,
) -> Settings:
    """Return the versions of a body and its contact: changed by the shares that the draws say, each as far as versions may differ.

    Parameters
    ----------
    block, versions, mu, mu_kinetic, restitution, rocking_restitution, gravity, tenon
        As of :func:`respond_probability`.
    draws : (m, 7) array
        In [-1, 1].
    """
    rough = 1.0 + versions.mu * draws[:, 2]
    if block.ranges is not None and block.ranges.mu is not None:
        rough = within(block.ranges.mu, draws[:, 2]) / mu
    bouncy = restitution + versions.restitution * 0.5 * (1.0 + draws[:, 3])
    return Settings(
        _bodies(block, versions, draws),
        mu * rough,
        (mu if mu_kinetic is None else mu_kinetic) * rough,
        np.maximum(restitution, np.minimum(bouncy, ROUGHEST)),
        rocking_restitution,
        gravity,
        tenon,
    )


def _bodies(block: Block, versions: Versions, draws: FloatArray) -> Blocks:
    """Return the versions of a body: their size, and how far their edges are worn."""
    low, high = wear_range(block, versions.inset)
    worn = np.maximum(0.5 * (low + high) + 0.5 * (high - low) * draws[:, 1], 0.0)
    if block.ranges is not None:
        drawn = {"tall": draws[:, 0], "wide": draws[:, 6], "worn": draws[:, 1]}
        return versions_within(block, block.ranges, **drawn, size=versions.size, inset=worn)
    return resized_versions(block, size=1.0 + versions.size * draws[:, 0], slenderness=np.ones(len(draws)), inset_share=worn)


def _gains(motion: Motion, versions: Versions, draws: FloatArray, vertical: Factor | None) -> FloatArray:
    """Return the factors on the rows along, across and up that scale and turn the shaking of each version, (runs, 3)."""
    amplitude = 1.0 + versions.amplitude * draws[:, 4]
    angle = np.radians(versions.azimuth_deg) * draws[:, 5] * bool(motion.transverse.any())
    return np.column_stack([amplitude * np.cos(angle), -amplitude * np.sin(angle), amplitude * vertical_gain(motion, vertical)])

"""Overturning probability of a free-standing object by Monte Carlo sampling of the object and its shaking.

Samples vary around the nominal object, which is their median in every parameter: width, height, edge wear, friction, restitution,
amplitude and direction of the shaking. A given value varies by its own tolerance; unmeasured edge wear and friction are drawn from
the priors of the kind of object. The share covers parameter variation only: on shaking tables 3 % of two granite rocks overturned
in runs with 0 of 20 samples overturning, and 2 % did not in runs with 20 of 20.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seisblock.bodies.block import Block
from seisblock.bodies.block_array import samples, within
from seisblock.bodies.uncertainty import ParameterRanges
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_
from seisblock.core.limits import MAX_RUNS, check_limit
from seisblock.core.typing import FloatArray, Progress
from seisblock.models.respond.batch import RespondBatchResult, no_answer, respond_many
from seisblock.models.respond.options import RespondOptions
from seisblock.models.respond.params import RespondBatchParams
from seisblock.models.respond.solve import respond_params
from seisblock.records import Motion
from seisblock.records._validation import Gain, validate_inputs, vertical_gain
from seisblock.studies.intervals import clopper_pearson

RUNS = 200
MOVED_M = 0.01
QUANTILES = (0.05, 0.25, 0.5, 0.75, 0.95)
MAX_RESTITUTION = 0.95
"""Upper limit of sampled restitutions: near 1 a body hops without end."""

HEIGHT, INSET, MU, RESTITUTION, AMPLITUDE, AZIMUTH, WIDTH = range(7)
"""Columns of the draws."""

CHUNK_SIZE = 100
"""Samples between two progress reports."""


@dataclass(frozen=True, repr=False)
class ParameterVariation(DisplayMixin):
    """Half widths of the samples around the nominal values; each parameter varies uniformly and independently.

    Parameters
    ----------
    size, mu, amplitude : float, 1
        Relative half widths; size applies to the width and, independently, to the height.
    inset : float, 1
        Relative half width of a known inset, as far as a fifth of the base remains: sharp edges stay sharp. Unmeasured edges are
        drawn from the prior of the body's kind instead; 0 takes them as known exactly, and likewise for `mu`.
    restitution : float, 1
        Half width of the restitution. Below 0 it continues as a share of the angular velocity of rocking that an impact without
        restitution leaves: -0.05 stands for 0.95 of Housner's ratio, as measured on concrete. A given rocking restitution varies
        by this share of itself.
    azimuth_deg : float
        Half width, degrees; no effect if the record's second horizontal is unknown.

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

    def __post_init__(self) -> None:
        checks.in_interval("the relative spread of the size", self.size, "[0, 1)")
        checks.in_interval("the relative spread of the edge wear", self.inset, "[0, 1)")
        checks.in_interval("the relative spread of the friction", self.mu, "[0, 1)")
        checks.in_interval("the spread of the restitution", self.restitution, "[0, 1)")
        checks.in_interval("the relative spread of the amplitude", self.amplitude, "[0, 1)")
        checks.in_interval("the spread of the azimuth", self.azimuth_deg, "[0, 180]", "degrees")


@dataclass(frozen=True, repr=False)
class Probability(DisplayMixin):
    """Overturning probability, and probability of a residual displacement.

    Parameters
    ----------
    runs : int
        Samples with a result.
    overturned, moved : float
        Shares that overturn, and that end more than `moved_m` from their place or overturn.
    interval : (float, float), 1
        Clopper-Pearson, 95 %, of `overturned`: sampling interval only, model error not included.
    moved_m : float, m
    final_displacement_m : dict
        Quantiles of the signed residual displacement of samples that do not overturn, by their share; empty if all overturn.
    versions : ParameterVariation
        Half widths in use.
    seed : int
    ranges : ParameterRanges or None
        Priors of the body's kind (edge wear, friction) that replace the relative half widths.
    no_answer : tuple of int
        Numbers, from 1, of the samples that were stopped. They are not among `runs`: whether they overturn is unknown.
    """

    runs: int
    overturned: float
    moved: float
    interval: tuple[float, float]
    moved_m: float
    final_displacement_m: dict[str, float]
    versions: ParameterVariation
    seed: int
    ranges: ParameterRanges | None = None
    no_answer: tuple[int, ...] = ()


def respond_probability(
    block: Block,
    motion: Motion,
    options: RespondOptions,
    *,
    runs: int = RUNS,
    moved_m: float = MOVED_M,
    versions: ParameterVariation = ParameterVariation(),
    seed: int = 0,
    progress: Progress | None = None,
) -> Probability:
    """Return the overturning probability of a body, and the probability that it moves, from samples of the body and its shaking.

    Parameters
    ----------
    block, motion, options
        As in :func:`~seisblock.models.respond.solve.solve_respond`; the median of the samples.
    runs : int
        Number of samples, at least 1.
    moved_m : float, m
        Residual displacement above which a body counts as moved.
    versions : ParameterVariation
    seed : int
        The same seed gives the same samples, on any number of threads.
    progress : callable
        Called with the number of finished runs and the total.

    Raises
    ------
    ParameterError
        If there are no runs, or a number lies outside its range.
    SolverError
        If every sample hops without end.

    Examples
    --------
    >>> from seisblock.uncertainty import respond_probability
    >>> import numpy as np
    >>> pulse = Motion.from_arrays(4.0 * np.sin(np.linspace(0.0, np.pi, 101)), 0.01)
    >>> respond_probability(Block(0.24, 0.8), pulse, RespondOptions(mu=0.5), runs=20).overturned
    1.0
    """
    validate_inputs(block, Block, motion)
    checks.instance(versions, ParameterVariation)
    checks.integer("the number of runs", runs, minimum=1)
    check_limit(N_("Monte Carlo samples"), runs, MAX_RUNS)
    if not (math.isfinite(moved_m) and moved_m > 0.0):
        raise ParameterError("the residual displacement that counts as moved must be positive, found {found} m", found=moved_m)
    respond_params(block, options)  # validates the nominal values: perturbed ones are clipped into their ranges
    rng = np.random.default_rng(checks.seed(seed))
    # WIDTH is drawn last, so that the other columns keep their values for a seed
    draws = np.column_stack([rng.uniform(-1.0, 1.0, (runs, 6)), rng.uniform(-1.0, 1.0, runs)])
    settings = perturbed_respond_params(block, versions, draws, options)
    gains = _gains(motion, versions, draws, options.vertical)
    parts: list[RespondBatchResult] = []
    for first in range(0, runs, CHUNK_SIZE):
        part = slice(first, first + CHUNK_SIZE)
        parts.append(respond_many(settings[part], motion, gains=gains[part], settle_s=options.settle_s))
        if progress is not None:
            progress(min(first + CHUNK_SIZE, runs), runs)
    # stopped samples leave the statistics: their outcome is unknown, not stable
    gave_up, fallen, shifts = (
        np.concatenate([getattr(fates, name) for fates in parts]) for name in ("gave_up", "overturned", "final_displacement_m")
    )
    if gave_up.all():
        raise no_answer(runs, runs, min(int(fates.impacts.min()) for fates in parts))
    falls, shift = fallen[~gave_up], shifts[~gave_up]
    displacements = np.quantile(shift[~falls], QUANTILES) if not falls.all() else ()
    count = int(falls.sum())
    return Probability(
        falls.size,
        count / falls.size,
        float(np.mean(falls | (np.abs(shift) > moved_m))),
        clopper_pearson(count, falls.size),
        moved_m,
        {f"q{round(100 * share):02d}": float(value) for share, value in zip(QUANTILES, displacements, strict=False)},
        versions,
        seed,
        block.ranges and block.ranges.priors,
        tuple((np.flatnonzero(gave_up) + 1).tolist()),
    )


def perturbed_respond_params(block: Block, versions: ParameterVariation, draws: FloatArray, options: RespondOptions) -> RespondBatchParams:
    """Return the samples of a body and its contact, from draws of each parameter within its half width.

    Parameters
    ----------
    block, versions, options
        As in :func:`respond_probability`.
    draws : (m, 7) array
        In [-1, 1].
    """
    mu, restitution, rocking_restitution = options.mu, options.restitution, options.rocking_restitution
    # one factor on both coefficients keeps kinetic below static friction
    friction_factor = 1.0 + versions.mu * draws[:, MU]
    # unmeasured friction: the prior of the kind, its median at the nominal value, replaces the relative width
    if versions.mu > 0.0 and block.ranges is not None and block.ranges.mu is not None:
        friction_factor = within(block.ranges.mu, mu, draws[:, MU]) / mu if mu > 0.0 else np.ones(len(draws))
    change = versions.restitution * draws[:, RESTITUTION]
    bounce = restitution + change
    # continuous through 0: a restitution below it is a loss beyond a plastic impact
    loss_factor = 1.0 + np.minimum(bounce, 0.0)
    if rocking_restitution is not None:
        loss_factor = np.minimum(rocking_restitution * (1.0 + change), max(rocking_restitution, 1.0))
    return RespondBatchParams(
        samples(
            block,
            versions.inset,
            wide=1.0 + versions.size * draws[:, WIDTH],
            tall=1.0 + versions.size * draws[:, HEIGHT],
            worn=draws[:, INSET],
        ),
        mu * friction_factor,
        (mu if options.mu_kinetic is None else options.mu_kinetic) * friction_factor,
        np.clip(bounce, 0.0, max(restitution, MAX_RESTITUTION)),
        loss_factor,
        rocking_restitution is not None,
        options.gravity,
        options.tenon,
    )


def _gains(motion: Motion, versions: ParameterVariation, draws: FloatArray, vertical: Gain | None) -> FloatArray:
    """Return the gains on the rows along, across and up that scale and rotate the shaking of each sample, (runs, 3)."""
    amplitude = 1.0 + versions.amplitude * draws[:, AMPLITUDE]
    # no rotation if the transverse motion is unknown (zero): it would only reduce the amplitude
    angle = np.radians(versions.azimuth_deg) * draws[:, AZIMUTH] * bool(motion.transverse.any())
    return np.column_stack([amplitude * np.cos(angle), -amplitude * np.sin(angle), amplitude * vertical_gain(motion, vertical)])

"""Proposal of the importance sampler: a truncated mixture of Student's t around resampled points."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seisblock.core.typing import FloatArray

CENTRE_COUNT = 100
"""Components of the mixture."""

DEGREES_OF_FREEDOM = 4.0
"""Degrees of freedom of Student's t: tails heavy enough for bounded importance weights."""

TRIAL_SIZE = 8192
"""Points drawn at a time, and for the share of the mixture within the bounds."""

MIN_WIDTH = 1e-4
"""Smallest width of the mixture in each direction, relative to the bounds."""


@dataclass(frozen=True, eq=False)
class Proposal:
    """Mixture of Student's t of one shape around several centres, truncated to the unit cube.

    Parameters
    ----------
    centres : (k, d) array, 1
    root : (d, d) array, 1
        Cholesky factor of the shape matrix (lower triangle).
    inside_fraction : float, 1
        Share of the mixture within the cube.
    points : (n, d) array, 1
        Points drawn from the mixture, within the cube.
    """

    centres: FloatArray
    root: FloatArray
    inside_fraction: float
    points: FloatArray

    def log_density(self, unit_points: FloatArray) -> FloatArray:
        """Return the log density within the cube, (n,) (derived here from the density of Student's t)."""
        from scipy.linalg import solve_triangular
        from scipy.special import gammaln, logsumexp

        d = unit_points.shape[1]
        standardized = solve_triangular(self.root, (unit_points[:, None, :] - self.centres[None, :, :]).reshape(-1, d).T, lower=True)
        distance = (standardized**2).sum(axis=0).reshape(len(unit_points), -1)
        constant = (
            gammaln((DEGREES_OF_FREEDOM + d) / 2) - gammaln(DEGREES_OF_FREEDOM / 2) - 0.5 * d * math.log(DEGREES_OF_FREEDOM * math.pi)
        )
        constant -= float(np.log(np.diag(self.root)).sum()) + math.log(len(self.centres)) + math.log(self.inside_fraction)
        density: FloatArray = constant + logsumexp(-0.5 * (DEGREES_OF_FREEDOM + d) * np.log1p(distance / DEGREES_OF_FREEDOM), axis=1)
        return density


def make_proposal(unit_points: FloatArray, weights: FloatArray, count: int, rng: np.random.Generator) -> Proposal:
    """Return a proposal around weighted points of the unit cube, (n, d), with `count` points drawn from it ([Cornuet2012]_ section 3).

    Its shape is the points' covariance, narrowed like the kernel of a density estimate of the effective sample size.
    """
    d = unit_points.shape[1]
    share = weights / weights.sum()
    effective_size = 1.0 / float((share**2).sum())
    middle = share @ unit_points
    spread = (unit_points - middle).T @ (share[:, None] * (unit_points - middle)) * (effective_size / max(effective_size - 1.0, 1.0))
    # Silverman's factor for d dimensions
    bandwidth = (4.0 / ((d + 2.0) * effective_size)) ** (2.0 / (d + 4.0))
    # a minimum width keeps the shape positive definite with few effective points
    shape = bandwidth * spread + MIN_WIDTH**2 * np.eye(d)
    root = np.linalg.cholesky(shape)
    # systematic resampling: one random offset, equal steps; each point is a centre in proportion to its weight
    steps = (rng.random() + np.arange(CENTRE_COUNT)) / CENTRE_COUNT
    centres = unit_points[np.minimum(np.searchsorted(np.cumsum(share), steps), len(unit_points) - 1)]
    batches: list[FloatArray] = []
    trial_count = hits = 0
    # rejection outside the cube; the accepted share normalises the truncated density
    while hits < count or trial_count < TRIAL_SIZE:
        base_points = centres[rng.integers(CENTRE_COUNT, size=TRIAL_SIZE)]
        radial_scale = np.sqrt(DEGREES_OF_FREEDOM / rng.chisquare(DEGREES_OF_FREEDOM, size=TRIAL_SIZE))
        points = base_points + radial_scale[:, None] * (rng.normal(size=(TRIAL_SIZE, d)) @ root.T)
        accepted = points[((points > 0.0) & (points < 1.0)).all(axis=1)]
        batches.append(accepted)
        trial_count, hits = trial_count + TRIAL_SIZE, hits + len(accepted)
    return Proposal(centres, root, hits / trial_count, np.concatenate(batches)[:count])

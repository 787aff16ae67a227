"""Where to look next: a cloud of blocks like those that explained most, wider than they, inside the bounds."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seisblock.core.typing import FloatArray

CENTRE_COUNT = 100
"""Blocks around which the next ones are drawn."""

DEGREES_OF_FREEDOM = 4.0
"""Degrees of freedom of Student's t around each of them: so heavy that nothing that counts is beyond reach."""

TRIAL_SIZE = 8192
"""Points drawn to know which share of the cloud lies inside the bounds."""

MIN_WIDTH = 1e-4
"""Of the cloud in each direction, of the distance of the bounds."""


@dataclass(frozen=True, eq=False)
class Proposal:
    """A mixture of Student's t of one shape around several centres, cut off at the unit cube.

    Parameters
    ----------
    centres : (k, d) array, 1
    root : (d, d) array, 1
        Of the matrix of the shape (lower triangle).
    inside_fraction : float, 1
        Which share of the mixture lies in the cube.
    points : (n, d) array, 1
        Points drawn from it, in the cube.
    """

    centres: FloatArray
    root: FloatArray
    inside_fraction: float
    points: FloatArray

    def log_density(self, unit_points: FloatArray) -> FloatArray:
        """Return the logarithm of its density in the cube, (n,) (derived here from the density of Student's t)."""
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
    """Return a cloud around weighted points of the unit cube, (n, d), with `count` points drawn from it ([Cornuet2012]_ section 3).

    Its shape is the points' covariance, narrowed as for a density estimate of as many points as the weights amount to.
    """
    d = unit_points.shape[1]
    share = weights / weights.sum()
    effective_size = 1.0 / float((share**2).sum())
    middle = share @ unit_points
    spread = (unit_points - middle).T @ (share[:, None] * (unit_points - middle)) * (effective_size / max(effective_size - 1.0, 1.0))
    bandwidth = (4.0 / ((d + 2.0) * effective_size)) ** (2.0 / (d + 4.0))
    shape = bandwidth * spread + MIN_WIDTH**2 * np.eye(d)
    root = np.linalg.cholesky(shape)
    # one begin and equal steps: each centre stands as often as its weight says, without further dice
    steps = (rng.random() + np.arange(CENTRE_COUNT)) / CENTRE_COUNT
    centres = unit_points[np.minimum(np.searchsorted(np.cumsum(share), steps), len(unit_points) - 1)]
    batches: list[FloatArray] = []
    trial_count = hits = 0
    while hits < count or trial_count < TRIAL_SIZE:
        base_points = centres[rng.integers(CENTRE_COUNT, size=TRIAL_SIZE)]
        radial_scale = np.sqrt(DEGREES_OF_FREEDOM / rng.chisquare(DEGREES_OF_FREEDOM, size=TRIAL_SIZE))
        points = base_points + radial_scale[:, None] * (rng.normal(size=(TRIAL_SIZE, d)) @ root.T)
        accepted = points[((points > 0.0) & (points < 1.0)).all(axis=1)]
        batches.append(accepted)
        trial_count, hits = trial_count + TRIAL_SIZE, hits + len(accepted)
    return Proposal(centres, root, hits / trial_count, np.concatenate(batches)[:count])

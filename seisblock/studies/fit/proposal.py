"""Where to look next: a cloud of blocks like those that explained most, wider than they, inside the bounds."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seisblock.typing import FloatArray

CENTRES = 100
"""Blocks around which the next ones are drawn."""

TAILS = 4.0
"""Degrees of freedom of Student's t around each of them: so heavy that nothing that counts is beyond reach."""

TRIED = 8192
"""Points drawn to know which share of the cloud lies inside the bounds."""

LEAST_WIDTH = 1e-4
"""Of the cloud in each direction, of the distance of the bounds."""


@dataclass(frozen=True, eq=False)
class Cloud:
    """A mixture of Student's t of one shape around several centres, cut off at the unit cube.

    Parameters
    ----------
    centres : (k, d) array, 1
    root : (d, d) array, 1
        Of the matrix of the shape (lower triangle).
    inside : float, 1
        Which share of the mixture lies in the cube.
    points : (n, d) array, 1
        Points drawn from it, in the cube.
    """

    centres: FloatArray
    root: FloatArray
    inside: float
    points: FloatArray

    def log_density(self, places: FloatArray) -> FloatArray:
        """Return the logarithm of its density in the cube, (n,) (derived here from the density of Student's t)."""
        from scipy.linalg import solve_triangular
        from scipy.special import gammaln, logsumexp

        d = places.shape[1]
        apart = solve_triangular(self.root, (places[:, None, :] - self.centres[None, :, :]).reshape(-1, d).T, lower=True)
        distance = (apart**2).sum(axis=0).reshape(len(places), -1)
        constant = gammaln((TAILS + d) / 2) - gammaln(TAILS / 2) - 0.5 * d * math.log(TAILS * math.pi)
        constant -= float(np.log(np.diag(self.root)).sum()) + math.log(len(self.centres)) + math.log(self.inside)
        density: FloatArray = constant + logsumexp(-0.5 * (TAILS + d) * np.log1p(distance / TAILS), axis=1)
        return density


def cloud_around(places: FloatArray, weights: FloatArray, count: int, dice: np.random.Generator) -> Cloud:
    """Return a cloud around weighted points of the unit cube, (n, d), with `count` points drawn from it ([Cornuet2012]_ section 3).

    Its shape is the points' covariance, narrowed as for a density estimate of as many points as the weights amount to.
    """
    d = places.shape[1]
    share = weights / weights.sum()
    enough = 1.0 / float((share**2).sum())
    middle = share @ places
    spread = (places - middle).T @ (share[:, None] * (places - middle)) * (enough / max(enough - 1.0, 1.0))
    narrowed = (4.0 / ((d + 2.0) * enough)) ** (2.0 / (d + 4.0))
    shape = narrowed * spread + LEAST_WIDTH**2 * np.eye(d)
    root = np.linalg.cholesky(shape)
    # one begin and equal steps: each centre stands as often as its weight says, without further dice
    steps = (dice.random() + np.arange(CENTRES)) / CENTRES
    centres = places[np.minimum(np.searchsorted(np.cumsum(share), steps), len(places) - 1)]
    drawn: list[FloatArray] = []
    tried = hits = 0
    while hits < count or tried < TRIED:
        chosen = centres[dice.integers(CENTRES, size=TRIED)]
        stretch = np.sqrt(TAILS / dice.chisquare(TAILS, size=TRIED))
        points = chosen + stretch[:, None] * (dice.normal(size=(TRIED, d)) @ root.T)
        good = points[((points > 0.0) & (points < 1.0)).all(axis=1)]
        drawn.append(good)
        tried, hits = tried + TRIED, hits + len(good)
    return Cloud(centres, root, hits / tried, np.concatenate(drawn)[:count])

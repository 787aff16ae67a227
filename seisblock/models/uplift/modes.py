"""Natural modes of a rigid block on corner springs with all four corners in contact."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seisblock.bodies.spring_block import SpringBlock, mass_matrix, stiffness_matrix
from seisblock.core import checks
from seisblock.core.arrays import as_readonly
from seisblock.core.i18n import N_
from seisblock.core.typing import FloatArray

NAMES = (
    N_("first rocking in x-z"),
    N_("second rocking in x-z"),
    N_("first rocking in y-z"),
    N_("second rocking in y-z"),
    N_("vertical"),
    N_("torsion"),
)
"""Modes in the order of their computation."""

PAIRS = np.array([(0, 4), (1, 3)])
"""Coordinates that are coupled, of the four rocking modes; by symmetry of the base about both axes the other two are not."""


@dataclass(frozen=True, eq=False)
class Modes:
    """Natural modes in ascending order of frequency.

    Parameters
    ----------
    omega : (6,) array, rad/s
    shapes : (6, 6) array
        Columns in the coordinates of ``COORDINATES``, normalised to a unit modal mass.
    names : tuple of str
    first_rocking : int
        Index of the first rocking mode, whose frequency is omega_1.
    """

    omega: FloatArray
    shapes: FloatArray
    names: tuple[str, ...]
    first_rocking: int

    @property
    def frequencies_hz(self) -> tuple[float, ...]:
        """Natural frequencies, Hz, ascending."""
        return tuple(float(w) / (2.0 * math.pi) for w in self.omega)

    @property
    def omega_1(self) -> float:
        """Circular frequency of the first rocking mode, rad/s."""
        return float(self.omega[self.first_rocking])


def natural_modes(body: SpringBlock) -> Modes:
    """Return the six natural modes of a block on corner springs.

    Linear model: small rotations and all corners in contact.

    Parameters
    ----------
    body : SpringBlock

    Returns
    -------
    Modes

    Notes
    -----
    K q = omega^2 M q of [Okumura1987]_ eqs. (3) to (5), solved in each of the four uncoupled groups of coordinates,
    so that equal frequencies of a square base do not mix the directions.

    Examples
    --------
    >>> from seisblock.models import natural_modes
    >>> modes = natural_modes(SpringBlock.from_ratios(alpha=1.0, beta=3**0.5 / 2))
    >>> modes.names[-1], round(modes.frequencies_hz[-1], 12)
    ('second rocking in y-z', 1.732050807569)
    """
    checks.instance(body, SpringBlock)
    # M is diagonal: a symmetric problem in the coordinates M^1/2 q
    scale = np.sqrt(np.diag(mass_matrix(body)))
    scaled = stiffness_matrix(body) / np.outer(scale, scale)
    squares, vectors = np.linalg.eigh(scaled[PAIRS[:, :, None], PAIRS[:, None, :]])
    omega = np.sqrt([*squares.ravel(), scaled[2, 2], scaled[5, 5]])
    shapes = np.zeros((6, 6))
    for pair, vector_pair in enumerate(vectors):
        shapes[np.ix_(PAIRS[pair], (2 * pair, 2 * pair + 1))] = vector_pair
    shapes[2, 4] = shapes[5, 5] = 1.0
    shapes /= scale[:, None]
    # the largest component is positive
    shapes *= np.copysign(1.0, shapes[np.abs(shapes).argmax(axis=0), np.arange(6)])
    order = np.argsort(omega, kind="stable")
    names = tuple(NAMES[mode] for mode in order)
    first = min(index for index, name in enumerate(names) if name.startswith("first"))
    return Modes(as_readonly(omega[order]), as_readonly(shapes[:, order]), names, first)

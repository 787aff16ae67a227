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

UNCOUPLED_COORDINATES = {
    (N_("first rocking in x-z"), N_("second rocking in x-z")): (0, 4),
    (N_("first rocking in y-z"), N_("second rocking in y-z")): (1, 3),
    (N_("vertical"),): (2,),
    (N_("torsion"),): (5,),
}
"""Uncoupled groups of coordinates, by symmetry of the base about both axes."""


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
    masses, stiffness = np.diag(mass_matrix(body)), stiffness_matrix(body)
    # M is diagonal: a symmetric problem in the coordinates M^1/2 q
    scale = np.sqrt(masses)
    scaled = stiffness / np.outer(scale, scale)
    modes: list[tuple[float, str, FloatArray]] = []
    for labels, members in UNCOUPLED_COORDINATES.items():
        squares, vectors = np.linalg.eigh(scaled[np.ix_(members, members)])
        for rank, (square, scaled_vector) in enumerate(zip(squares, vectors.T, strict=True)):
            vector, shape = scaled_vector / scale[list(members)], np.zeros(6)
            shape[list(members)] = vector * np.copysign(1.0, vector[np.argmax(np.abs(vector))])
            modes.append((math.sqrt(square), labels[rank], shape))
    modes.sort(key=lambda mode: mode[0])
    names = tuple(name for _, name, _ in modes)
    first = min(index for index, name in enumerate(names) if name.startswith("first"))
    return Modes(as_readonly([w for w, _, _ in modes]), as_readonly(np.array([shape for *_, shape in modes]).T), names, first)

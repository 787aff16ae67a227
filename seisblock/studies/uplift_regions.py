"""Parameter studies of harmonic uplift: one region per combination of block and direction ([Okumura1987]_ figs. 3 to 11)."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from seisblock.bodies.spring_block import REFERENCE_MASS, SpringBlock
from seisblock.bodies.spring_factory import spring_block
from seisblock.core.arrays import as_readonly
from seisblock.core.errors import BodyError
from seisblock.core.i18n import N_
from seisblock.core.limits import MAX_CELLS, check_limit
from seisblock.core.typing import ArrayLike, FloatArray, Progress
from seisblock.models.uplift.harmonic import uplift_thresholds
from seisblock.models.uplift.minima import UpliftMinimum, lowest_uplift_threshold, uplift_minima
from seisblock.models.uplift.modes import Modes, natural_modes

PAPER_RATIOS: dict[str, tuple[float, ...]] = {
    "alpha": (1.0,),
    "gamma": (1.0,),
    "beta": (0.707,),
    "damping": (0.05,),
    "phi": (0.0,),
    "rho": (90.0,),
}
"""Reference block and direction of figs. 6 to 11 of [Okumura1987]_: square, shaken along x."""

DEFAULT_RATIOS = tuple(i / 100.0 for i in range(1, 601))
"""theta/omega_1 of a curve, on the paper's grid of 0.01."""

PAPER_FIGURES: dict[int, dict[str, tuple[float, ...]]] = {
    3: {"alpha": (0.5, 1.0, 2.0, 3.0)},
    4: {"beta": (0.5, 0.707, 0.8660254037844386, 1.0, 2.0)},
    6: {"damping": (0.0, 0.02, 0.05, 0.10, 0.20)},
    7: {"alpha": (0.5, 1.0, 1.5, 2.0, 2.5, 3.0)},
    8: {"beta": (0.5, 0.6, 0.707, 0.8, 1.0, 2.0)},
    9: {"phi": (0.0, 15.0, 30.0, 45.0)},
    10: {"rho": (0.0, 30.0, 60.0, 75.0, 90.0)},
    11: {"phi": (45.0,), "rho": (0.0, 30.0, 60.0, 75.0, 90.0)},
}
"""Varied parameters of each figure of [Okumura1987]_; values of figs. 3, 4, 9 to 11 are not printed, and chosen here."""


@dataclass(frozen=True, eq=False)
class UpliftRegion:
    """Uplift region of one block: acceleration of harmonic shaking at uplift against frequency.

    Parameters
    ----------
    body : SpringBlock
    phi_deg, rho_deg : float, degrees
        Direction of the shaking: azimuth from x towards y, angle from the vertical.
    corner : int or None
        The corner considered; None for the first of the four to lift.
    modes : Modes
    frequency_ratio, acceleration_ratio : (n,) arrays
        theta/omega_1, and the smallest A/g with uplift.
    minimum : UpliftMinimum
        Global minimum of A/g.
    minima : tuple of UpliftMinimum
        All local minima.
    """

    body: SpringBlock
    phi_deg: float
    rho_deg: float
    corner: int | None
    modes: Modes
    frequency_ratio: FloatArray
    acceleration_ratio: FloatArray
    minimum: UpliftMinimum
    minima: tuple[UpliftMinimum, ...]

    @property
    def ratios(self) -> dict[str, float]:
        """Parameters of the paper of this region, by name."""
        body = self.body
        return {
            "alpha": body.alpha,
            "gamma": body.gamma,
            "beta": body.beta,
            "damping": body.damping,
            "phi": self.phi_deg,
            "rho": self.rho_deg,
        }


def uplift_region(
    body: SpringBlock,
    frequency_ratio: ArrayLike,
    *,
    phi_deg: float = 0.0,
    rho_deg: float = 90.0,
    corner: int | None = None,
    between: tuple[float, float] | None = None,
) -> UpliftRegion:
    """Return the uplift region of one block and direction ([Okumura1987]_ section 5).

    Parameters
    ----------
    body : SpringBlock
    frequency_ratio : (n,) array
        theta/omega_1 of the curve.
    phi_deg, rho_deg : float, degrees
    corner : int or None
        One corner alone (4 in the paper's figures), or the first to lift.
    between : (low, high) or None
        Range of theta/omega_1 of the minima.

    Returns
    -------
    UpliftRegion
    """
    ratio = as_readonly(np.atleast_1d(np.asarray(frequency_ratio, dtype=np.float64)))
    thresholds = uplift_thresholds(body, ratio, phi_deg=phi_deg, rho_deg=rho_deg)
    lowest = thresholds.min(axis=0) if corner is None else thresholds[corner - 1]
    return UpliftRegion(
        body,
        phi_deg,
        rho_deg,
        corner,
        natural_modes(body),
        ratio,
        as_readonly(lowest),
        lowest_uplift_threshold(body, phi_deg=phi_deg, rho_deg=rho_deg, corner=corner, frequency_range=between),
        uplift_minima(body, phi_deg=phi_deg, rho_deg=rho_deg, corner=corner, frequency_range=between),
    )


def uplift_regions(
    blocks: Iterable[tuple[SpringBlock, float, float]],
    frequency_ratio: ArrayLike,
    *,
    corner: int | None = None,
    between: tuple[float, float] | None = None,
    progress: Progress | None = None,
) -> list[UpliftRegion]:
    """Return the uplift regions of several blocks and directions, see :func:`uplift_region`.

    Parameters
    ----------
    blocks : iterable of (SpringBlock, phi, rho)
        As from :func:`harmonic_blocks`, degrees.
    frequency_ratio, corner, between
        Common to all.
    progress : callable
        Called with the number of finished regions and the total.

    Raises
    ------
    ParameterError
        If the curves have more points than the limit.

    Examples
    --------
    >>> regions = uplift_regions(harmonic_blocks({"alpha": [1.0, 2.0]}), [0.5, 1.0])
    >>> [round(region.minimum.acceleration_ratio, 3) for region in regions]
    [0.087, 0.047]
    """
    block_list, ratio = list(blocks), np.atleast_1d(np.asarray(frequency_ratio, dtype=np.float64))
    check_limit(N_("curve points"), len(block_list) * ratio.size, MAX_CELLS)
    regions = []
    for body, phi, rho in block_list:
        regions.append(uplift_region(body, ratio, phi_deg=phi, rho_deg=rho, corner=corner, between=between))
        if progress is not None:
            progress(len(regions), len(block_list))
    return regions


def harmonic_blocks(
    ratios: Mapping[str, Sequence[float] | None],
    *,
    sizes: Mapping[str, Any] | None = None,
    figure: int | None = None,
    frequency_vertical: float = 1.0,
    mass: float = REFERENCE_MASS,
) -> Iterator[tuple[SpringBlock, float, float]]:
    """Yield each combination of block, phi and rho, degrees, of lists of the paper's parameters.

    Parameters
    ----------
    ratios : mapping
        Values of ``alpha``, ``gamma``, ``beta``, ``damping``, ``phi`` and ``rho``; missing or None: as in the paper.
    sizes : mapping
        Arguments of :func:`seisblock.bodies.spring_factory.spring_block`, instead of alpha and gamma.
    figure : int or None
        Figure of [Okumura1987]_ for the missing parameters.
    frequency_vertical, mass : float, Hz, kg
        Of blocks given by ratios.

    Raises
    ------
    BodyError
        If sizes come together with alpha or gamma, or a block is not possible.
    ParameterError
        If there are more combinations than the limit.
    """
    overrides = {name: values for name, values in ratios.items() if values is not None}
    grid = {**PAPER_RATIOS, **(PAPER_FIGURES[figure] if figure is not None else {}), **overrides}
    if sizes:
        if "alpha" in overrides or "gamma" in overrides:
            raise BodyError("`alpha` and `gamma` are ratios of the sizes; give sizes or ratios, not both")
        # sizes give alpha and gamma: a placeholder keeps the combinations of the others
        grid["alpha"] = grid["gamma"] = (float("nan"),)
    check_limit(N_("combinations"), math.prod(len(values) for values in grid.values()), MAX_CELLS)
    for values in itertools.product(*grid.values()):
        combination = dict(zip(grid, values, strict=True))
        alpha, gamma, phi, rho = (combination.pop(name) for name in ("alpha", "gamma", "phi", "rho"))
        if sizes:
            # with stiffnesses beta follows from these, unless it is given
            beta = None if sizes.get("stiffness") is not None and "beta" not in overrides else combination["beta"]
            yield spring_block(**sizes, beta=beta, damping=combination["damping"]), phi, rho
        else:
            yield SpringBlock.from_ratios(alpha, gamma=gamma, frequency_vertical=frequency_vertical, mass=mass, **combination), phi, rho


def modal_frequencies_against(name: str, values: ArrayLike, *, alpha: float, beta: float, gamma: float = 1.0) -> dict[str, FloatArray]:
    """Return omega_i / omega_V of each mode against `alpha` or `beta` ([Okumura1987]_ figs. 3, 4).

    Parameters
    ----------
    name : "alpha" or "beta"
        Parameter that varies over `values`, (n,).
    alpha, beta, gamma : float
        The others.

    Returns
    -------
    dict
        Name of the mode: (n,) array.
    """
    columns: dict[str, list[float]] = {}
    for value in np.asarray(values, dtype=np.float64):
        body = SpringBlock.from_ratios(**{"alpha": alpha, "beta": beta, name: float(value)}, gamma=gamma)
        modes = natural_modes(body)
        for mode, omega in zip(modes.names, modes.omega, strict=True):
            columns.setdefault(mode, []).append(float(omega) / body.omega[2])
    return {mode: as_readonly(column) for mode, column in columns.items()}

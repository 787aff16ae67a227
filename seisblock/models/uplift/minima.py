"""Minima of the harmonic uplift threshold over frequency, located by root search."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from seisblock.bodies.spring_block import SpringBlock
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import ParameterError
from seisblock.core.typing import FloatArray
from seisblock.models.uplift.harmonic import lifting_amplitude, participation, shaking_direction, transfer
from seisblock.models.uplift.modes import Modes, natural_modes

SEARCH_LIMIT = 3.0
"""Upper end of the default search range over the highest natural frequency."""

RESONANCE_TOLERANCE = 1e-6
"""Relative distance from a natural frequency below which an undamped maximum is the resonance itself."""

RELATIVE_TOLERANCE = 1e-9
"""Relative difference below which frequencies or thresholds are equal."""


@dataclass(frozen=True, repr=False)
class UpliftMinimum(DisplayMixin):
    """Local minimum of the uplift threshold over frequency.

    Parameters
    ----------
    frequency_ratio : float
        theta/omega_1.
    acceleration_ratio : float
        Smallest A/g that lifts a corner at this frequency.
    corners : tuple of int
        Corners that lift at this amplitude, 1 to 4.
    mode : str
        Nearest natural mode that moves a corner; empty at an end of the range.
    """

    frequency_ratio: float
    acceleration_ratio: float
    corners: tuple[int, ...]
    mode: str


@dataclass(frozen=True, eq=False)
class _Amplitudes:
    """Corner amplitudes as functions of the circular frequency of the shaking."""

    modes: Modes
    damping: float
    parts: FloatArray

    def thresholds(self, omega: FloatArray) -> FloatArray:
        """Return A/g of each corner, (4, n)."""
        return lifting_amplitude(self.parts @ transfer(self.modes, self.damping, omega))

    def slopes(self, omega: FloatArray) -> FloatArray:
        """Return a quantity with the sign of the derivative of the corner amplitudes, (4, n) (derived here)."""
        t = transfer(self.modes, self.damping, omega)
        # derivative of the transfer function of each mode with respect to the frequency, up to a factor that all
        # modes share
        rate = t * t * (2.0 * omega - 2j * self.damping * self.modes.omega[:, None])
        v = self.parts @ t
        # division by |v|^2 leaves the sign and avoids an overflow next to a resonance
        slopes: FloatArray = np.real(np.conj(v) * (self.parts @ rate)) / np.maximum(np.abs(v) ** 2, 1e-300)
        return slopes

    def slope_at(self, omega: float) -> float:
        """Return the slope of the first corner at one frequency."""
        return float(self.slopes(np.array([omega]))[0, 0])

    def resonances(self) -> FloatArray:
        """Return which modes are undamped resonances of each corner, (4, 6); modes of equal frequency are added first.

        Modes that a corner does not take part in have amplitudes of round-off.
        """
        w = self.modes.omega
        same_frequency = np.abs(w[:, None] - w) <= RELATIVE_TOLERANCE * w
        amplitude: FloatArray = np.abs(self.parts @ same_frequency)
        return amplitude > 1e-12 * amplitude.max()


def uplift_minima(
    body: SpringBlock,
    *,
    phi_deg: float = 0.0,
    rho_deg: float = 90.0,
    corner: int | None = None,
    frequency_range: tuple[float, float] | None = None,
) -> tuple[UpliftMinimum, ...]:
    """Return all local minima of the uplift threshold over frequency, in ascending order.

    Parameters
    ----------
    body : SpringBlock
        Its damping is the modal damping ratio h.
    phi_deg, rho_deg : float, degrees
        Direction of the shaking.
    corner : int or None
        Corner 1 to 4; None: the corner that lifts first.
    frequency_range : (low, high) or None
        Range of theta/omega_1; None: from zero to three times the highest natural frequency.

    Returns
    -------
    tuple of UpliftMinimum
        Zeros of the derivative of the governing corner's amplitude, by Brent's method. Without damping the minima are natural
        frequencies, at A/g = 0.

    Raises
    ------
    ParameterError
        If `corner` is not 1 to 4 or an angle is not a number.

    Notes
    -----
    [Okumura1987]_ section 6, statements 1) to 5), refer to these minima. Where the governing corner changes the threshold has a peak,
    never a minimum, so that each corner is searched separately.

    Examples
    --------
    >>> from seisblock.models import uplift_minima
    >>> block = SpringBlock.from_ratios(alpha=1.0, beta=0.6**0.5, damping=0.05)
    >>> second = uplift_minima(block)[-1]
    >>> round(second.frequency_ratio, 5), round(second.acceleration_ratio, 6), second.mode
    (2.78225, 0.676683, 'second rocking in x-z')
    """
    amplitudes, low, high = _amplitudes_in_range(body, phi_deg, rho_deg, corner, frequency_range)
    minima: list[UpliftMinimum] = []
    for omega in sorted(_candidates(amplitudes, low, high, corner)):
        minimum = _minimum_at(amplitudes, omega, corner)
        if minimum is not None and not (
            minima and minimum.frequency_ratio - minima[-1].frequency_ratio <= RELATIVE_TOLERANCE * minimum.frequency_ratio
        ):
            minima.append(minimum)
    return tuple(minima)


def lowest_uplift_threshold(
    body: SpringBlock,
    *,
    phi_deg: float = 0.0,
    rho_deg: float = 90.0,
    corner: int | None = None,
    frequency_range: tuple[float, float] | None = None,
) -> UpliftMinimum:
    """Return the global minimum of the uplift threshold, ends of the range included ([Okumura1987]_ section 6).

    Parameters are those of :func:`uplift_minima`.
    """
    amplitudes, low, high = _amplitudes_in_range(body, phi_deg, rho_deg, corner, frequency_range)
    # an end of the range may lie lower than any local minimum
    selection = slice(None) if corner is None else slice(corner - 1, corner)
    ends = np.array([low, high])
    at_ends = amplitudes.thresholds(ends)[selection].min(axis=0)
    minima = uplift_minima(body, phi_deg=phi_deg, rho_deg=rho_deg, corner=corner, frequency_range=frequency_range)
    best = min(minima, key=lambda minimum: minimum.acceleration_ratio, default=None)
    end = int(np.argmin(at_ends))
    if best is not None and best.acceleration_ratio <= at_ends[end]:
        return best
    return _make_minimum(amplitudes, float(ends[end]), corner, "")


def _amplitudes_in_range(
    body: SpringBlock, phi_deg: float, rho_deg: float, corner: int | None, frequency_range: tuple[float, float] | None
) -> tuple[_Amplitudes, float, float]:
    """Return the corner amplitudes and the range, rad/s."""
    if corner not in (None, 1, 2, 3, 4):
        raise ParameterError("`corner` must be 1, 2, 3 or 4, found {corner}", corner=corner)
    modes = natural_modes(body)
    parts = participation(body, modes, shaking_direction(phi_deg, rho_deg))
    # round-off must not make a mode participate: at an undamped resonance it would give a false minimum
    parts[np.abs(parts) < 1e-14 * np.abs(parts).max()] = 0.0
    low, high = frequency_range or (0.0, SEARCH_LIMIT * float(modes.omega[-1]) / modes.omega_1)
    return _Amplitudes(modes, body.damping, parts), low * modes.omega_1, high * modes.omega_1


def _candidates(amplitudes: _Amplitudes, low: float, high: float, corner: int | None) -> list[float]:
    """Return the frequencies of maximum amplitude of any single corner, rad/s."""
    grid = _search_grid(amplitudes, low, high)
    slopes = amplitudes.slopes(grid)
    omega = amplitudes.modes.omega
    undamped = amplitudes.damping == 0.0
    peaks: list[float] = []
    for i in range(4) if corner is None else (corner - 1,):
        single_corner = _Amplitudes(amplitudes.modes, amplitudes.damping, amplitudes.parts[i : i + 1])
        # a maximum of the amplitude is a change of the slope from rising to falling
        for k in np.flatnonzero((slopes[i, :-1] > 0.0) & (slopes[i, 1:] <= 0.0)):
            root = _root(single_corner.slope_at, float(grid[k]), float(grid[k + 1]))
            # without damping the amplitude has poles instead of maxima: they are added below, from the modes
            if not (undamped and np.abs(root / omega - 1.0).min() < RESONANCE_TOLERANCE):
                peaks.append(root)
        if undamped:
            peaks += [float(w) for w in omega[amplitudes.resonances()[i]] if low <= w <= high]
    return peaks


def _root(function: Callable[[float], float], low: float, high: float) -> float:
    """Return the root between two frequencies by Brent's method; without a sign change, by round-off, the end nearer to zero."""
    from scipy.optimize import brentq

    value_low, value_high = function(low), function(high)
    if value_low * value_high >= 0.0:
        return low if abs(value_low) < abs(value_high) else high
    return float(brentq(function, low, high, xtol=1e-14 * low))


def _search_grid(amplitudes: _Amplitudes, low: float, high: float) -> FloatArray:
    """Return a grid of frequencies, refined around each natural frequency to separate all maxima."""
    omega = amplitudes.modes.omega
    # the width of a resonance is its damping ratio; undamped ones need any small width
    width = amplitudes.damping or 0.01
    offsets = np.concatenate([-np.geomspace(20.0, 0.01, 40), np.geomspace(0.01, 20.0, 40)]) * width
    clustered = (omega[:, None] * (1.0 + offsets)).ravel()
    even = np.geomspace(max(low, 1e-3 * omega[0]), max(high, 1e-3 * omega[0]), 400)
    grid = np.unique(np.concatenate([clustered, even, [low, high]]))
    return grid[(grid >= low) & (grid <= high)]


def _minimum_at(amplitudes: _Amplitudes, omega: float, corner: int | None) -> UpliftMinimum | None:
    """Return the minimum at a frequency if it belongs to the governing corner there, else None."""
    if corner is None:
        # the corner with the maximum may not govern there: the threshold of all corners must have its minimum at the
        # same frequency
        neighbours = omega * (1.0 + 1e-6 * np.array([-1.0, 0.0, 1.0]))
        left_value, value, right_value = amplitudes.thresholds(neighbours).min(axis=0)
        if value > min(left_value, right_value) * (1.0 + 1e-10):
            return None
    w = amplitudes.modes.omega
    active_modes = np.flatnonzero(np.abs(amplitudes.parts).max(axis=0) > 0.0)
    name = amplitudes.modes.names[int(active_modes[np.argmin(np.abs(w[active_modes] - omega))])]
    return _make_minimum(amplitudes, omega, corner, name)


def _make_minimum(amplitudes: _Amplitudes, omega: float, corner: int | None, mode: str) -> UpliftMinimum:
    """Return the threshold at a frequency with the corners that lift."""
    thresholds = amplitudes.thresholds(np.array([omega]))[:, 0]
    threshold = float(thresholds.min()) if corner is None else float(thresholds[corner - 1])
    lifting = (
        (corner,) if corner is not None else tuple(int(i) + 1 for i in np.flatnonzero(thresholds <= threshold * (1.0 + RELATIVE_TOLERANCE)))
    )
    return UpliftMinimum(omega / amplitudes.modes.omega_1, threshold, lifting, mode)

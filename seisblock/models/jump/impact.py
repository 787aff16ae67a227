"""Impact from rocking into flight: launch velocities, spin, and jump condition ([Sugimoto2017]_ sections 3.6, 3.7)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, TypeAlias

from seisblock.bodies.two_layer import TwoLayerBlock
from seisblock.core.errors import ParameterError
from seisblock.core.typing import FloatArray

Number: TypeAlias = "float | FloatArray"


@dataclass(frozen=True)
class Launch:
    """Velocities of the centroid just after the impact, in the paper's frame (x right, y up, counter-clockwise positive).

    Parameters
    ----------
    horizontal, vertical : float, m/s
        [Sugimoto2017]_ eq. (10a), (10b).
    spin : float, rad/s
        [Sugimoto2017]_ eq. (10c).
    jumps : bool
        True if both lower corners leave the support ([Sugimoto2017]_ eq. (8b) in the limit of small time).
    """

    horizontal: float
    vertical: float
    spin: float
    jumps: bool


def spin_ratio(block: TwoLayerBlock, rule: str, restitution_x: float, restitution_y: float) -> float:
    """Return theta'_2 / theta'_1, the ratio of the spin after the impact to the angular velocity before ([Sugimoto2017]_ eq. (7a)).

    Both are counter-clockwise. Before a forward jump theta'_1 is negative; a positive ratio is therefore a clockwise spin with a landing
    on the right corner, a negative ratio leads to a landing on the left corner.

    Parameters
    ----------
    block : TwoLayerBlock
    rule : str
        ``momentum``: angular momentum about the centroid of the velocity field of [Sugimoto2017]_ eq. (6),
        (e_x Ixx - e_y Iyy)/I_G, which is [Sugimoto2017]_ eq. (7a) with its misprints corrected;
        ``printed``: [Sugimoto2017]_ eq. (7a) as printed, with the missing depth W supplied (differs: y_G instead of h_2 in its first
        brace, and mixed signs); ``tables``: its first brace as printed with e_x m_1 h_1^2/12 as the second, inferred from the tables
        of the paper (hypothesis, see :mod:`seisblock.validation.sugimoto`); ``ratio=Q``: the number Q, for calibration against them.
    restitution_x, restitution_y : float
        Ratios of velocities, horizontal and vertical.

    Raises
    ------
    ParameterError
        If `rule` is not one of these.

    Examples
    --------
    >>> block = TwoLayerBlock(2.5, 2.08, 1.06, 1.84, 1303.7, 160.0)
    >>> round(spin_ratio(block, "momentum", 0.95, 0.85), 4)
    -0.1664
    """
    if rule == "momentum":
        return (restitution_x * block.height_moment - restitution_y * block.width_moment) / block.centroid_inertia
    if rule == "printed":
        first, second = _printed_braces(block)
        return (restitution_x * second - restitution_y * first) / block.centroid_inertia
    # hypothesis: inferred from the tables of the paper, not from mechanics
    if rule == "tables":
        upper_inertia = block.upper_mass * block.upper_height**2 / 12
        return (restitution_y * _printed_braces(block)[0] - restitution_x * upper_inertia) / block.centroid_inertia
    if rule.startswith("ratio="):
        try:
            ratio = float(rule.removeprefix("ratio="))
        except ValueError:
            ratio = math.nan
        if math.isfinite(ratio):
            return ratio
    raise ParameterError("`spin` must be momentum, printed, tables or ratio=NUMBER, found {rule!r}", rule=rule)


def _printed_braces(block: TwoLayerBlock) -> tuple[float, float]:
    """Return both braces of [Sugimoto2017]_ eq. (7a) as printed with their factors and the missing depth, kg m^2."""
    b, h, h2, y = block.width, block.height, block.lower_height, block.centroid_height
    area = block.width * block.depth
    rho1 = block.upper_mass / (area * block.upper_height)
    rho2 = block.lower_mass / (area * h2)
    first = b * ((h - y) * rho1 + y * rho2) * (2 * b - 3 * b / 2)
    second = rho1 * (2 * h**3 - 2 * h2**3 - 3 * h**2 * y + 3 * h2**2 * y) + rho2 * h2**2 * (2 * h2 - 3 * y)
    return first * b * block.depth / 6, second * b * block.depth / 6


def launch(block: TwoLayerBlock, omega: float, ratio: float, restitution_x: float, restitution_y: float) -> Launch:
    """Return the velocities after an impact ([Sugimoto2017]_ eqs. (6), (8b), (10)).

    Parameters
    ----------
    block : TwoLayerBlock
    omega : float, rad/s
        theta'_1, counter-clockwise, negative at an impact on the right corner.
    ratio : float
        theta'_2/theta'_1, see :func:`spin_ratio`.
    restitution_x, restitution_y : float

    Notes
    -----
    The lower corners rise at -e_y theta'_1 B/2 +- theta'_2 B/2, so that both leave the support exactly for e_y > abs(ratio), at any
    amplitude. Differs from the paper, which samples eq. (8b) every 1e-4 s and obtains no jump in its case 1.
    """
    horizontal, vertical, spin = launch_velocities(omega, ratio, restitution_x, restitution_y, block.centroid_height, block.width)
    return Launch(horizontal, vertical, spin, jumps=omega < 0.0 and restitution_y > abs(ratio))


def launch_velocities(
    omega: Number, ratio: Number, restitution_x: Number, restitution_y: Number, height: Number, width: Number
) -> tuple[Any, Any, Any]:
    """Return horizontal velocity, vertical velocity and spin after an impact, of one or many blocks ([Sugimoto2017]_ eqs. (6), (10))."""
    return -restitution_x * omega * height, -restitution_y * omega * width / 2, ratio * omega


def centroid_rise(speed: float, gravity: float, flight_s: float) -> float:
    """Return the largest rise of the centroid within `flight_s` after launch at vertical velocity `speed`, m ([Sugimoto2017]_ eq. (9b))."""
    # the top of the parabola, unless a landing ends the flight before
    top = min(speed / gravity, flight_s)
    return speed * top - gravity * top**2 / 2


def foot_rise(block: TwoLayerBlock, takeoff: Launch, gravity: float) -> float:
    """Return the largest height of the lower of both lower corners, m ([Sugimoto2017]_ eq. (8a))."""
    # the sign of the spin only exchanges the two corners
    y, half, spin = block.centroid_height, block.width / 2, abs(takeoff.spin)
    low, high = 0.0, takeoff.vertical / gravity
    # bisection for the zero of the corner's vertical velocity
    for _ in range(60):
        t = 0.5 * (low + high)
        rate = takeoff.vertical - gravity * t - spin * (half * math.cos(spin * t) - y * math.sin(spin * t))
        low, high = (t, high) if rate > 0.0 else (low, t)
    return takeoff.vertical * low - gravity * low**2 / 2 + y * (1 - math.cos(spin * low)) - half * math.sin(spin * low)

"""Closed-form overturning criteria: threshold accelerations and velocities of a rigid block."""

from __future__ import annotations

import math

from seisblock.core import checks
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_
from seisblock.core.units import STANDARD_GRAVITY


def static_acceleration(width: float, height: float, gravity: float = STANDARD_GRAVITY) -> float:
    """Return g B/H, m/s^2: West's acceleration, the rocking threshold ([Furukawa2009]_ eq. (2)).

    Exceeding it is necessary for overturning, but not sufficient.

    Parameters
    ----------
    width, height : float, m
        B and H of a homogeneous block, or twice the lever arm and twice the height of its centre of gravity.
    gravity : float, m/s^2

    Returns
    -------
    float, m/s^2

    Raises
    ------
    ParameterError
        If a size is not positive.

    Examples
    --------
    >>> from seisblock.criteria import static_acceleration
    >>> round(static_acceleration(1.0, 4.0, 9.8), 12)
    2.45
    """
    _check_sizes(width, height, gravity)
    return gravity * width / height


def housner_acceleration(slenderness: float, frequency_parameter: float, frequency: float, gravity: float = STANDARD_GRAVITY) -> float:
    """Return g alpha sqrt(1 + (omega/p)^2), m/s^2: the first form of [Furukawa2009]_ eq. (6), where 4 R/(3 g) = 1/p^2.

    Differs from the exact threshold of a half-sine pulse (:func:`~seisblock.criteria.pulses.half_sine_ratio`): it requires that alpha is
    reached at the end of the pulse and neglects the free rocking afterwards; up to 55 % too high at omega = 5 p.

    Parameters
    ----------
    slenderness : float, rad
        alpha.
    frequency_parameter : float, rad/s
        p; sqrt(3 g/(4 R)) of a rectangle.
    frequency : float, Hz
        Frequency of the sine.
    gravity : float, m/s^2

    Returns
    -------
    float, m/s^2

    Raises
    ------
    ParameterError
        If a parameter is not positive.

    Examples
    --------
    >>> from seisblock.criteria import housner_acceleration
    >>> round(housner_acceleration(0.3, 4.0, 1.0), 3)
    5.478
    """
    _check_positive(slenderness=slenderness, frequency_parameter=frequency_parameter, frequency=frequency, gravity=gravity)
    return gravity * slenderness * math.hypot(1.0, 2 * math.pi * frequency / frequency_parameter)


def housner_acceleration_as_printed(width: float, height: float, frequency: float, gravity: float = STANDARD_GRAVITY) -> float:
    """Return g atan(B/H) sqrt(1 + sqrt(B^2 + H^2) omega^2/(3 g)), m/s^2: the second form of [Furukawa2009]_ eq. (6), as printed.

    Differs from the first form: with R = sqrt(B^2 + H^2)/2 the term under the root should be 2 sqrt(B^2 + H^2) omega^2/(3 g).

    Parameters
    ----------
    width, height : float, m
    frequency : float, Hz
    gravity : float, m/s^2

    Returns
    -------
    float, m/s^2

    Raises
    ------
    ParameterError
        If a parameter is not positive.

    Examples
    --------
    >>> from seisblock.criteria import housner_acceleration_as_printed
    >>> round(housner_acceleration_as_printed(0.3, 0.9, 1.0), 3)
    4.757
    """
    _check_sizes(width, height, gravity)
    _check_positive(frequency=frequency)
    omega = 2 * math.pi * frequency
    return gravity * math.atan2(width, height) * math.sqrt(1.0 + math.hypot(width, height) * omega**2 / (3 * gravity))


def tsutsui_velocity(width: float, height: float, gravity: float = STANDARD_GRAVITY, *, cosine: bool = False) -> float:
    """Return the overturning velocity sqrt(b lambda g), m/s, lambda = b/h ([Tsutsui]_ eq. (2)).

    With a restoring force that decreases as a cosine: sqrt(b lambda g 2/pi) ([Tsutsui]_ eq. (4), 4 to 8 % below the exact value for
    a velocity step).

    Parameters
    ----------
    width, height : float, m
        b and h.
    gravity : float, m/s^2
    cosine : bool
        True for eq. (4).

    Returns
    -------
    float, m/s

    Raises
    ------
    ParameterError
        If a size is not positive.

    Examples
    --------
    >>> from seisblock.criteria import tsutsui_velocity
    >>> round(tsutsui_velocity(0.242, 0.726, 9.8, cosine=True), 3)
    0.709
    """
    _check_sizes(width, height, gravity)
    return math.sqrt(width * width / height * gravity * (2 / math.pi if cosine else 1.0))


def tsutsui_sine_velocity(acceleration: float, frequency: float) -> float:
    """Return a/(pi f), m/s: the velocity of a half-sine pulse ([Tsutsui]_ eq. (3)).

    Parameters
    ----------
    acceleration : float, m/s^2
    frequency : float, Hz

    Returns
    -------
    float, m/s

    Raises
    ------
    ParameterError
        If a parameter is not positive.

    Examples
    --------
    >>> from seisblock.criteria import tsutsui_sine_velocity
    >>> round(tsutsui_sine_velocity(3.0, 1.0), 3)
    0.955
    """
    _check_positive(acceleration=acceleration, frequency=frequency)
    return acceleration / (math.pi * frequency)


def velocity_step(slenderness: float, frequency_parameter: float, gravity: float = STANDARD_GRAVITY) -> float:
    """Return the minimum sudden ground velocity that overturns a block, m/s (nonlinear, exact).

    The step gives the angular velocity m v h/I_O, whose energy must reach the barrier p^2 (1 - cos(alpha)):
    v = (g/p) sqrt(2 (1 - cos(alpha)))/cos(alpha); for a rectangle sqrt((8/3) g R (1 - cos(alpha)))/cos(alpha). [Tsutsui]_
    eqs. (2) and (4) approximate this value.

    Parameters
    ----------
    slenderness : float, rad
        alpha, below pi/2.
    frequency_parameter : float, rad/s
        p.
    gravity : float, m/s^2

    Returns
    -------
    float, m/s

    Raises
    ------
    ParameterError
        If a parameter is out of range.

    Examples
    --------
    >>> import math
    >>> from seisblock.criteria import velocity_step
    >>> block_of_1_by_4 = velocity_step(math.atan(0.25), math.sqrt(3 * 9.8 / (4 * math.hypot(0.5, 2.0))), 9.8)
    >>> round(block_of_1_by_4, 4)
    1.3073
    """
    _check_positive(slenderness=slenderness, frequency_parameter=frequency_parameter, gravity=gravity)
    if slenderness >= math.pi / 2:
        raise ParameterError("the slenderness must be below pi/2 rad, found {found}", found=slenderness)
    # sqrt(2 (1 - cos(alpha))) = 2 sin(alpha/2), without cancellation for slender blocks
    return gravity / frequency_parameter * 2 * math.sin(slenderness / 2) / math.cos(slenderness)


def ishiyama_acceleration(width: float, height: float, gravity: float = STANDARD_GRAVITY) -> float:
    """Return g B/H, m/s^2, to be exceeded together with the velocity limit ([Ishiyama1982]_ criterion).

    Parameters
    ----------
    width, height : float, m
    gravity : float, m/s^2

    Returns
    -------
    float, m/s^2

    Raises
    ------
    ParameterError
        If a parameter is not positive.

    Examples
    --------
    >>> from seisblock.criteria import ishiyama_acceleration
    >>> round(ishiyama_acceleration(0.3, 0.9), 3)
    3.269
    """
    return static_acceleration(width, height, gravity)


def ishiyama_velocity(width: float, height: float) -> float:
    """Return 10 B/sqrt(H) cm/s with B and H in cm, that is B/sqrt(H) m/s with B and H in m ([Ishiyama1982]_ criterion).

    Lower limit from experiments and simulations, about 0.4 times the velocity step of a slender block at g = 980 cm/s^2.

    Parameters
    ----------
    width, height : float, m

    Returns
    -------
    float, m/s

    Raises
    ------
    ParameterError
        If a size is not positive.

    Examples
    --------
    >>> from seisblock.criteria import ishiyama_velocity
    >>> ishiyama_velocity(0.25, 1.0)
    0.25
    """
    _check_sizes(width, height, STANDARD_GRAVITY)
    return width / math.sqrt(height)


_QUANTITIES = {
    "width": (N_("the width"), "m"),
    "height": (N_("the height"), "m"),
    "slenderness": (N_("the slenderness"), "rad"),
    "frequency_parameter": (N_("the frequency parameter"), "rad/s"),
    "frequency": (N_("the frequency"), "Hz"),
    "acceleration": (N_("the acceleration"), "m/s^2"),
    "gravity": (N_("gravity"), "m/s^2"),
}


def _check_sizes(width: float, height: float, gravity: float) -> None:
    _check_positive(width=width, height=height, gravity=gravity)


def _check_positive(**values: float) -> None:
    for name, value in values.items():
        quantity, unit = _QUANTITIES[name]
        checks.positive(quantity, value, unit)

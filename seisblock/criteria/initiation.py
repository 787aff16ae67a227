"""Initiation of motion of a rigid block: rest, sliding, rocking, slide-rocking; derived here ([Shenton1996]_).

Coulomb friction. Let A be the horizontal ground acceleration over the weight per unit mass, g + a_y; b the horizontal distance from
the centre of gravity to the corner of rotation; h the height of the centre and k the radius of gyration. The block is at rest while A <= mu
and A <= b/h. If A reaches one of these limits slowly, the block slides for mu < b/h and rocks otherwise. If A is applied suddenly, it
rocks without slip only if friction holds the corner: with the angular acceleration g q, the centre accelerates by h g q horizontally and
b g q upwards, so that the corner needs the friction (A - h q)/(1 + b q). With less friction it slides for mu < b/h and slide-rocks
otherwise.
"""

from __future__ import annotations

import math

import numpy as np

from seisblock.bodies.block import Block
from seisblock.core import checks
from seisblock.core.i18n import N_, Term
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.records import Motion
from seisblock.records._validation import Gain, vertical_gain
from seisblock.records.motion import ALONG, UP


class Mode(Term):
    """Modes of motion in tables, JSON and figures; the last two do not occur at the initiation."""

    REST = N_("rest")
    SLIDE = N_("slide")
    ROCK = N_("rock")
    SLIDE_ROCK = N_("slide-rock")
    FLIGHT = N_("flight")
    OVERTURNED = N_("overturned")


def peak_loading_ratio(motion: Motion, *, vertical: Gain | None = None, gravity: float = STANDARD_GRAVITY) -> tuple[float, float]:
    """Return the maximum of A = abs(a)/(g + a_y) of a motion, 1, and its time, s (derived here, as in [Shenton1996]_).

    A block remains at rest if and only if neither mu nor b/h is below this maximum, because both sides of the conditions of rest
    are linear between samples. Infinite if the ground accelerates downwards faster than gravity.

    Parameters
    ----------
    motion : Motion
    vertical : bool, float or None
        Apply the vertical component, or a factor on it; None: apply it if the record has one.
    gravity : float, m/s^2

    Returns
    -------
    two floats, 1 and s

    Examples
    --------
    >>> from seisblock.criteria import peak_loading_ratio
    >>> peak_loading_ratio(Motion.from_arrays([0.0, 2.0, -3.0], 0.1, vertical=[0.0, 0.0, -4.0]), gravity=10.0)
    (0.5, 0.2)
    """
    checks.gravity(gravity)
    # without weight on the base (downward acceleration above g) the ratio is infinite
    weight = gravity + motion.vertical * vertical_gain(motion, vertical)
    with np.errstate(divide="ignore"):
        ratio = np.where(weight > 0.0, np.abs(motion.horizontal) / weight, math.inf)
    peak_index = int(np.argmax(ratio))
    return float(ratio[peak_index]), float(motion.time[peak_index])


def onset_factor(towards: tuple[float, float], motion: Motion, *, gravity: float, vertical: float = 0.0) -> float:
    """Return the smallest scale factor at which a body moves; infinite if none does.

    Motion to +x begins at -a = c (g + a_v) with ground acceleration a to +x; a and a_v are both scaled (derived here).

    Parameters
    ----------
    towards : (float, float), 1
        Ratio c of horizontal to vertical acceleration at which motion to +x and to -x begins; infinite if impossible.
    motion : Motion
    gravity : float, m/s^2
    vertical : float, 1
        Factor on the vertical motion.

    Examples
    --------
    >>> onset_factor((0.1, 0.2), Motion.from_arrays([0.0, 1.6, -0.5], 0.01), gravity=10.0)
    1.25
    """
    max_ratio = 0.0
    for stretch in motion.segments((True, False, vertical != 0.0)):
        along, up = stretch.acceleration[ALONG], vertical * stretch.acceleration[UP]
        for sense, share in zip((-1.0, 1.0), towards, strict=True):
            if 0.0 < share < np.inf:
                max_ratio = max(max_ratio, float(np.max(sense * along - share * up)) / share)
    return gravity / max_ratio if max_ratio > 0.0 else np.inf


def friction_to_rock(block: Block, ratio: float) -> float | None:
    """Return the friction needed to rock without slip under a sudden A, 1; None if the block does not rock ([Shenton1996]_).

    Derived here: (A - h q)/(1 + b q) with q = (h A - b)/(k^2 + h^2 + b^2), for the nearer corner; it increases from b/h to
    (k^2 + b^2)/(b h).

    Parameters
    ----------
    block : Block
    ratio : float
        Acceleration ratio A, 1.

    Returns
    -------
    float or None, 1

    Examples
    --------
    >>> from seisblock.criteria import friction_to_rock
    >>> block = Block(0.3, 1.0)
    >>> friction_to_rock(block, 0.2), round(friction_to_rock(block, 0.6), 4)
    (None, 0.3706)
    """
    ratio = checks.non_negative("the acceleration ratio A", ratio)
    b, h = min(block.arms), block.centre
    if ratio <= b / h:
        return None
    # angular acceleration over g: moment h A - b about the corner over the inertia about it, both per unit mass
    q = (h * ratio - b) / (block.gyration_squared + h * h + b * b)
    return (ratio - h * q) / (1.0 + b * q)


def first_mode(block: Block, mu: float, ratio: float) -> Mode:
    """Return the mode initiated by a sudden A: rest, slide, rock or slide-rock ([Shenton1996]_).

    Static and kinetic friction are equal.

    Parameters
    ----------
    block : Block
    mu : float
        Friction coefficient, 0 or more.
    ratio : float
        Acceleration ratio A, 1.

    Returns
    -------
    Mode

    Examples
    --------
    >>> from seisblock.criteria import first_mode
    >>> [first_mode(Block(0.3, 1.0), mu, 0.6) for mu in (0.2, 0.31, 0.5, 0.7)]
    ['slide', 'slide-rock', 'rock', 'rock']
    """
    mu = checks.non_negative("the friction coefficient mu", mu)
    required_mu = friction_to_rock(block, ratio)
    if required_mu is None:
        return Mode.REST if ratio <= mu else Mode.SLIDE
    if mu >= required_mu:
        return Mode.ROCK
    return Mode.SLIDE if mu * block.centre <= min(block.arms) else Mode.SLIDE_ROCK

"""One way to name a direction, in texts, figures, films and pages: +EW and -EW along a component, else an azimuth."""

from __future__ import annotations

import math

from seisblock.present.scales import told_size
from seisblock.records import Motion
from seisblock.words import noted, tell

PHASES = {
    "rocks to +x": (noted("rocks to {side}"), 1),
    "rocks to -x": (noted("rocks to {side}"), -1),
    "beyond +alpha": (noted("beyond alpha to {side}"), 1),
    "beyond -alpha": (noted("beyond alpha to {side}"), -1),
    "slip forward": (noted("slides to {side}"), 1),
    "slip backward": (noted("slides to {side}"), -1),
}
"""Phases that have a direction: how they are told, and which side it is."""

EIGHTH = 45.0
"""Degrees to which a direction in the plane is told where no azimuth is known."""

POINTS = noted("N NNE NE ENE E ESE SE SSE S SSW SW WSW W WNW NW NNW")
"""Points of the compass, clockwise from north."""


def side(name: str, sign: float | str | None) -> str:
    """Return a direction: +EW or -EW of a component, the azimuth of an azimuth, +x or -x of what has no name.

    Parameters
    ----------
    name : str
        Of the motion: which direction of the record +x is.
    sign : float or str
        Its sign decides; or ``+x`` or ``-x``, ``+`` or ``-``, as in a document.

    Examples
    --------
    >>> side("EW", -0.2), side("37", "-x"), side("", 1.0)
    ('-EW', 'azimuth 217', '+x')
    """
    ahead = sign.startswith("+") if isinstance(sign, str) else sign is not None and sign > 0.0
    try:
        azimuth = float(name)
    except ValueError:
        return f"{'+' if ahead else '-'}{name or 'x'}"
    return tell("azimuth {degrees:g}", degrees=(azimuth + (0.0 if ahead else 180.0)) % 360.0)


def moved(length: str, name: str, sign: float) -> str:
    """Return how far and where to, as in ``44.8 cm to -NS``; a length that is written as nothing has no direction.

    Examples
    --------
    >>> moved("44.8 cm", "NS", -1.0), moved("0.00 mm", "NS", -1e-9)
    ('44.8 cm to -NS', '0.00 mm')
    """
    nothing = not any(digit in length for digit in "123456789")
    return length if nothing else tell("{path} to {towards}", path=length, towards=side(name, sign))


def moved_by(length: float, name: str, *, gal: bool = True) -> str:
    """Return a displacement, m, told by itself: how far, and where to.

    Examples
    --------
    >>> moved_by(-0.448, "NS"), moved_by(0.0, "NS"), moved_by(1e-6, "NS")
    ('44.8 cm to -NS', '0.0 cm', 'less than 0.01 mm to +NS')
    """
    return moved(told_size(length, gal=gal), name, length)


def towards(degrees: float, motion: Motion) -> str:
    """Return a direction in the plane: an azimuth where that of +x is known, else the nearest of eight along the axes, as in -x+y.

    Parameters
    ----------
    degrees : float
        From +x, counter-clockwise seen from above.
    motion : Motion
        Across +x lies a component of its record, or +y where none is known to.
    """
    if motion.azimuth_deg is not None:
        return side(str(round((motion.azimuth_deg - degrees) % 360.0) % 360), 1.0)
    eighth = math.radians(EIGHTH * round(degrees / EIGHTH))
    along, (aside_name, turn) = round(math.cos(eighth), 1), across(motion)
    aside = turn * round(math.sin(eighth), 1)
    return "".join(side(name, part) for name, part in ((motion.name, along), (aside_name, aside)) if part)


def pointed(degrees: float, motion: Motion) -> str:
    """Return the same with the nearest of sixteen points of the compass beside an azimuth, as in ``azimuth 214 (SW)``."""
    told = towards(degrees, motion)
    if motion.azimuth_deg is None:
        return told
    points = tell(POINTS).split()
    return tell("{side} ({point})", side=told, point=points[round((motion.azimuth_deg - degrees) / 360.0 * len(points)) % len(points)])


def phase(name: str, direction: str) -> str:
    """Return what a phase of a response to a motion in a direction is called.

    Examples
    --------
    >>> phase("rocks to -x", "EW"), phase("rest", "EW")
    ('rocks to -EW', 'rest')
    """
    if name not in PHASES:
        return tell(name)
    text, sign = PHASES[name]
    return tell(text, side=side(direction, sign))


def across(motion: Motion) -> tuple[str, float]:
    """Return the component that lies across +x, and whether +y, 90 degrees counter-clockwise of +x, is its positive side."""
    parts = {part.code: part.azimuth_deg for part in motion.record.horizontals} if motion.record is not None else {}
    own = parts.pop(motion.name, None)
    for code, azimuth in parts.items():
        if own is not None and azimuth is not None:
            return code, round(math.sin(math.radians(own - azimuth)))
    return "y", 1.0

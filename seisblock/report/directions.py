"""One way to name a direction, in texts, figures, films and pages: +EW and -EW along a component, else an azimuth."""

from __future__ import annotations

import math

from seisblock.core.i18n import N_, gettext
from seisblock.records import Motion
from seisblock.report.units_display import format_size

PHASES = {
    "rocks to +x": (N_("rocks to {side}"), 1),
    "rocks to -x": (N_("rocks to {side}"), -1),
    "beyond +alpha": (N_("beyond alpha to {side}"), 1),
    "beyond -alpha": (N_("beyond alpha to {side}"), -1),
    "slip forward": (N_("slides to {side}"), 1),
    "slip backward": (N_("slides to {side}"), -1),
}
"""Phases that have a direction: how they are told, and which side it is."""

OCTANT_DEG = 45.0
"""Degrees to which a direction in the plane is told where no azimuth is known."""

COMPASS_POINTS = N_("N NNE NE ENE E ESE SE SSE S SSW SW WSW W WNW NW NNW")
"""Points of the compass, clockwise from north."""


def direction_label(name: str, sign: float | str | None) -> str:
    """Return a direction: +EW or -EW of a component, the azimuth of an azimuth, +x or -x of what has no name.

    Parameters
    ----------
    name : str
        Of the motion: which direction of the record +x is.
    sign : float or str
        Its sign decides; or ``+x`` or ``-x``, ``+`` or ``-``, as in a document.

    Examples
    --------
    >>> direction_label("EW", -0.2), direction_label("37", "-x"), direction_label("", 1.0)
    ('-EW', 'azimuth 217', '+x')
    """
    positive = sign.startswith("+") if isinstance(sign, str) else sign is not None and sign > 0.0
    try:
        azimuth = float(name)
    except ValueError:
        return f"{'+' if positive else '-'}{name or 'x'}"
    return gettext("azimuth {degrees:g}", degrees=(azimuth + (0.0 if positive else 180.0)) % 360.0)


def with_direction(length: str, name: str, sign: float) -> str:
    """Return how far and where to, as in ``44.8 cm to -NS``; a length that is written as nothing has no direction.

    Examples
    --------
    >>> with_direction("44.8 cm", "NS", -1.0), with_direction("0.00 mm", "NS", -1e-9)
    ('44.8 cm to -NS', '0.00 mm')
    """
    is_zero = not any(digit in length for digit in "123456789")
    return length if is_zero else gettext("{path} to {towards}", path=length, towards=direction_label(name, sign))


def format_displacement(length: float, name: str, *, gal: bool = True) -> str:
    """Return a displacement, m, told by itself: how far, and where to.

    Examples
    --------
    >>> format_displacement(-0.448, "NS"), format_displacement(0.0, "NS"), format_displacement(1e-6, "NS")
    ('44.8 cm to -NS', '0.0 cm', 'less than 0.01 mm to +NS')
    """
    return with_direction(format_size(length, gal=gal), name, length)


def direction_in_plane(degrees: float, motion: Motion) -> str:
    """Return a direction in the plane: an azimuth where that of +x is known, else the nearest of eight along the axes, as in -x+y.

    Parameters
    ----------
    degrees : float
        From +x, counter-clockwise seen from above.
    motion : Motion
        Across +x lies a component of its record, or +y where none is known to.
    """
    if motion.azimuth_deg is not None:
        return direction_label(str(round((motion.azimuth_deg - degrees) % 360.0) % 360), 1.0)
    angle = math.radians(OCTANT_DEG * round(degrees / OCTANT_DEG))
    x, (transverse, turn) = round(math.cos(angle), 1), transverse_component(motion)
    y = turn * round(math.sin(angle), 1)
    return "".join(direction_label(name, part) for name, part in ((motion.name, x), (transverse, y)) if part)


def direction_with_compass(degrees: float, motion: Motion) -> str:
    """Return the same with the nearest of sixteen points of the compass beside an azimuth, as in ``azimuth 214 (SW)``."""
    text = direction_in_plane(degrees, motion)
    if motion.azimuth_deg is None:
        return text
    points = gettext(COMPASS_POINTS).split()
    return gettext("{side} ({point})", side=text, point=points[round((motion.azimuth_deg - degrees) / 360.0 * len(points)) % len(points)])


def phase_label(name: str, direction: str) -> str:
    """Return what a phase of a response to a motion in a direction is called.

    Examples
    --------
    >>> phase_label("rocks to -x", "EW"), phase_label("rest", "EW")
    ('rocks to -EW', 'rest')
    """
    if name not in PHASES:
        return gettext(name)
    text, sign = PHASES[name]
    return gettext(text, side=direction_label(direction, sign))


def transverse_component(motion: Motion) -> tuple[str, float]:
    """Return the component that lies across +x, and whether +y, 90 degrees counter-clockwise of +x, is its positive side."""
    parts = {part.code: part.azimuth_deg for part in motion.record.horizontals} if motion.record is not None else {}
    azimuth_x = parts.pop(motion.name, None)
    for code, azimuth in parts.items():
        if azimuth_x is not None and azimuth is not None:
            return code, round(math.sin(math.radians(azimuth_x - azimuth)))
    return "y", 1.0

"""Labels of directions in texts, figures, animations and pages: +EW or -EW along a component, else an azimuth."""

from __future__ import annotations

import math

from seisblock.core.i18n import N_, gettext
from seisblock.output.units_display import Unit, format_size
from seisblock.records import Motion

PHASES = {
    "rocks to +x": (N_("rocking to {side}"), 1),
    "rocks to -x": (N_("rocking to {side}"), -1),
    "beyond +alpha": (N_("beyond alpha to {side}"), 1),
    "beyond -alpha": (N_("beyond alpha to {side}"), -1),
    "slip forward": (N_("sliding to {side}"), 1),
    "slip backward": (N_("sliding to {side}"), -1),
}
"""Message and sign of the phases that have a direction."""

OCTANT_DEG = 45.0
"""Resolution of a direction in plan without known azimuth, degrees."""

COMPASS_POINTS = N_("N NNE NE ENE E ESE SE SSE S SSW SW WSW W WNW NW NNW")
"""Sixteen compass points, clockwise from north."""


def direction_label(name: str, sign: float | str | None) -> str:
    """Return the label of a direction: +EW or -EW of a component, an azimuth, or +x or -x without a name.

    Parameters
    ----------
    name : str
        Name of the motion: component or azimuth that is +x.
    sign : float or str
        A number whose sign decides, or ``+x``, ``-x``, ``+``, ``-`` as in a JSON document.

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
    """Return a length with its direction, as in ``44.8 cm to -NS``; a length rounded to zero has no direction.

    Examples
    --------
    >>> with_direction("44.8 cm", "NS", -1.0), with_direction("0.00 mm", "NS", -1e-9)
    ('44.8 cm to -NS', '0.00 mm')
    """
    is_zero = not any(digit in length for digit in "123456789")
    return length if is_zero else gettext("{path} to {towards}", path=length, towards=direction_label(name, sign))


def format_displacement(length: float, name: str, unit: Unit | None = None) -> str:
    """Return a displacement, m, as size, unit and direction; `unit` is that of the other lengths of the text.

    Examples
    --------
    >>> format_displacement(-0.448, "NS"), format_displacement(0.0, "NS"), format_displacement(1e-6, "NS")
    ('44.8 cm to -NS', '0.0 cm', 'less than 0.01 mm to +NS')
    """
    return with_direction(format_size(length, unit), name, length)


def direction_in_plane(degrees: float, motion: Motion) -> str:
    """Return a direction in plan: an azimuth if that of +x is known, else the nearest of eight directions, as in -x+y.

    Parameters
    ----------
    degrees : float
        From +x, counter-clockwise seen from above.
    motion : Motion
        The transverse axis is a component of its record, else +y.
    """
    if motion.azimuth_deg is not None:
        return direction_label(str(round((motion.azimuth_deg - degrees) % 360.0) % 360), 1.0)
    angle = math.radians(OCTANT_DEG * round(degrees / OCTANT_DEG))
    x, (transverse, turn) = round(math.cos(angle), 1), transverse_component(motion)
    y = turn * round(math.sin(angle), 1)
    return "".join(direction_label(name, part) for name, part in ((motion.name, x), (transverse, y)) if part)


def direction_with_compass(degrees: float, motion: Motion) -> str:
    """Return a direction in plan with its compass point if the azimuth is known, as in ``azimuth 214 (SW)``."""
    text = direction_in_plane(degrees, motion)
    if motion.azimuth_deg is None:
        return text
    points = gettext(COMPASS_POINTS).split()
    return gettext("{side} ({point})", side=text, point=points[round((motion.azimuth_deg - degrees) / 360.0 * len(points)) % len(points)])


def phase_label(name: str, direction: str) -> str:
    """Return the display name of a phase of a response in a direction.

    Examples
    --------
    >>> phase_label("rocks to -x", "EW"), phase_label("rest", "EW")
    ('rocking to -EW', 'rest')
    """
    if name not in PHASES:
        return gettext(name)
    text, sign = PHASES[name]
    return gettext(text, side=direction_label(direction, sign))


def transverse_component(motion: Motion) -> tuple[str, float]:
    """Return the component transverse to +x, and the sign of +y (90 degrees counter-clockwise of +x) on it."""
    parts = {part.code: part.azimuth_deg for part in motion.record.horizontals} if motion.record is not None else {}
    azimuth_x = parts.pop(motion.name, None)
    for code, azimuth in parts.items():
        if azimuth_x is not None and azimuth is not None:
            return code, round(math.sin(math.radians(azimuth_x - azimuth)))
    return "y", 1.0

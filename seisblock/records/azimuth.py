"""Azimuths from surveyors' bearings (N45E) and from text in degrees."""

from __future__ import annotations

import re

_BEARING = re.compile(r"([NS])(\d{1,2}(?:\.\d{1,9})?)?([EW])", re.IGNORECASE)
_DEGREES = re.compile(r"(\d{1,3}(?:\.\d{1,9})?)(?:°|度|deg)", re.IGNORECASE)


def bearing_to_azimuth(start: str, angle: float, end: str) -> float:
    """Return the azimuth, degrees clockwise from north, of an angle measured from N or S towards E or W.

    Examples
    --------
    >>> bearing_to_azimuth("S", 30.5, "W")
    210.5
    """
    return {"NE": angle, "SE": 180.0 - angle, "SW": 180.0 + angle, "NW": 360.0 - angle}[(start + end).upper()]


def parse_bearing(name: str) -> float | None:
    """Return the azimuth, degrees clockwise from north, of a bearing or of text in degrees, else None.

    Examples
    --------
    >>> [parse_bearing(name) for name in ("N45E", "S30.5W", "NW", "45°", "EW")]
    [45.0, 210.5, 315.0, 45.0, None]
    """
    if degrees := _DEGREES.fullmatch(name.strip()):
        return float(degrees[1]) if float(degrees[1]) <= 360.0 else None
    match = _BEARING.fullmatch(name.strip())
    if match is None or float(match[2] or 45.0) > 90.0:
        return None
    return bearing_to_azimuth(match[1], float(match[2] or 45.0), match[3])

"""Whether the headers of two records tell of one earthquake, and which that is."""

from __future__ import annotations

from datetime import datetime, timedelta

from seisblock.records.site import Earthquake, great_circle_km
from seisblock.words import said

APART_KM = 100.0
"""Epicentres further apart than any two solutions of one earthquake are those of two."""

A_DAY = timedelta(days=1)
"""Records that begin further apart are hardly of one earthquake, whatever the clocks of their instruments."""

APART = timedelta(minutes=3)
"""Origin times further apart are those of two earthquakes; old headers tell the minute."""


def are_two(one: Earthquake, other: Earthquake) -> bool:
    """Return whether two headers tell of two earthquakes, by what both of them tell.

    Parameters
    ----------
    one, other : Earthquake

    Examples
    --------
    >>> are_two(Earthquake(latitude_deg=35.0, longitude_deg=139.0), Earthquake(latitude_deg=37.0, longitude_deg=139.0))
    True
    """
    if one.origin_time is not None and other.origin_time is not None and abs(one.origin_time - other.origin_time) > APART:
        return True
    return one.place is not None and other.place is not None and great_circle_km(one.place, other.place) > APART_KM


def words_of(earthquake: Earthquake) -> str:
    """Return an earthquake in words: its time, else its place or name.

    Parameters
    ----------
    earthquake : Earthquake

    Examples
    --------
    >>> words_of(Earthquake(latitude_deg=35.0, longitude_deg=139.0))
    '35, 139'
    """
    moment: datetime | None = earthquake.origin_time
    if moment is not None:
        return f"{moment:%Y-%m-%d %H:%M} UTC"
    if earthquake.latitude_deg is not None and earthquake.longitude_deg is not None:
        return f"{earthquake.latitude_deg:g}, {earthquake.longitude_deg:g}"
    return earthquake.name or said("one that tells no place")

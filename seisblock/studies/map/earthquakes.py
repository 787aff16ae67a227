"""Comparison of earthquake headers of records."""

from __future__ import annotations

from datetime import datetime, timedelta

from seisblock.core.i18n import lazy_gettext
from seisblock.records.site import Earthquake, great_circle_km

MAX_EPICENTRE_DISTANCE_KM = 100.0
"""Largest distance between epicentre solutions of one earthquake, km."""

ONE_DAY = timedelta(days=1)
"""Largest difference between start times of records of one earthquake."""

MAX_ORIGIN_TIME_DIFFERENCE = timedelta(minutes=3)
"""Largest difference between origin times of one earthquake; old headers give minutes only."""


def are_different_earthquakes(first: Earthquake, second: Earthquake) -> bool:
    """Return whether two headers contradict each other on the earthquake.

    Parameters
    ----------
    first, second : Earthquake

    Examples
    --------
    >>> are_different_earthquakes(Earthquake(latitude_deg=35.0, longitude_deg=139.0), Earthquake(latitude_deg=37.0, longitude_deg=139.0))
    True
    """
    if (
        first.origin_time is not None
        and second.origin_time is not None
        and abs(first.origin_time - second.origin_time) > MAX_ORIGIN_TIME_DIFFERENCE
    ):
        return True
    return first.place is not None and second.place is not None and great_circle_km(first.place, second.place) > MAX_EPICENTRE_DISTANCE_KM


def describe_earthquake(earthquake: Earthquake) -> str:
    """Return an earthquake in words: its time, else its place or name.

    Parameters
    ----------
    earthquake : Earthquake

    Examples
    --------
    >>> describe_earthquake(Earthquake(latitude_deg=35.0, longitude_deg=139.0))
    '35, 139'
    """
    origin_time: datetime | None = earthquake.origin_time
    if origin_time is not None:
        return f"{origin_time:%Y-%m-%d %H:%M} UTC"
    if earthquake.latitude_deg is not None and earthquake.longitude_deg is not None:
        return f"{earthquake.latitude_deg:g}, {earthquake.longitude_deg:g}"
    return earthquake.name or lazy_gettext("location unknown")

"""Where and when a record was made, and of what earthquake, as far as its file says."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime, timedelta

from seisblock.records.record import Record

CLOCKS = {
    "UTC": timedelta(0),
    "GMT": timedelta(0),
    "JST": timedelta(hours=9),
    "PST": timedelta(hours=-8),
    "PDT": timedelta(hours=-7),
    "MST": timedelta(hours=-7),
    "MDT": timedelta(hours=-6),
    "AKST": timedelta(hours=-9),
    "AKDT": timedelta(hours=-8),
    "HST": timedelta(hours=-10),
}
"""Clocks of the networks whose files tell local time, ahead of UTC; a reader names it in ``metadata["clock"]``."""


HALF_A_SECOND = timedelta(seconds=0.5)


@dataclass(frozen=True)
class Site:
    """Where a record was made.

    Parameters
    ----------
    code, name : str
        Empty where the file has none.
    latitude_deg, longitude_deg : float or None
        Degrees north and east.
    height_m : float or None
        Above the sea.
    """

    code: str = ""
    name: str = ""
    latitude_deg: float | None = None
    longitude_deg: float | None = None
    height_m: float | None = None

    @property
    def label(self) -> str:
        """Code and name, as far as they are known."""
        return " ".join(dict.fromkeys(part for part in (self.code, self.name) if part))


@dataclass(frozen=True)
class Earthquake:
    """What shook.

    Parameters
    ----------
    origin_time : datetime or None
        UTC.
    latitude_deg, longitude_deg : float or None
        Epicentre, degrees north and east.
    depth_km : float or None
    magnitude : float or None
    """

    origin_time: datetime | None = None
    latitude_deg: float | None = None
    longitude_deg: float | None = None
    depth_km: float | None = None
    magnitude: float | None = None


def site_of(record: Record) -> Site:
    """Return where a record was made."""
    name = record.metadata.get("station_name")
    latitude, longitude, height = (_number(record, f"station_{key}") for key in ("latitude_deg", "longitude_deg", "height_m"))
    return Site(record.station, name if isinstance(name, str) else "", latitude, longitude, height)


def earthquake_of(record: Record) -> Earthquake | None:
    """Return what shook, or None where the file does not say, or has zeros for all it might."""
    origin = record.metadata.get("origin_time")
    latitude, longitude, depth = (_number(record, f"event_{key}") for key in ("latitude_deg", "longitude_deg", "depth_km"))
    magnitude = _number(record, "magnitude")
    if not any((latitude, longitude, depth, magnitude)):
        return None
    return Earthquake(origin if isinstance(origin, datetime) else None, latitude, longitude, depth, magnitude)


def told_time(record: Record, moment: datetime | None) -> str:
    """Return a moment as the record's own network tells time, to the second, with the name of the clock; empty where it is unknown."""
    if moment is None:
        return ""
    clock = str(record.metadata.get("clock", "UTC"))
    return f"{moment + CLOCKS.get(clock, timedelta(0)) + HALF_A_SECOND:%Y-%m-%d %H:%M:%S} {clock}"


def _number(record: Record, key: str) -> float | None:
    """Return a number of the header, or None."""
    value = record.metadata.get(key)
    return float(value) if isinstance(value, int | float) else None

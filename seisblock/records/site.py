"""Where and when a record was made, and of what earthquake, as far as its file says."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime, timedelta
from math import asin, cos, radians, sin, sqrt

from seisblock.records.record import Record

UTC_OFFSETS = {
    "UTC": timedelta(0),
    "GMT": timedelta(0),
    "JST": timedelta(hours=9),
    "GMT+08": timedelta(hours=8),
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

MAX_LATITUDE, MAX_LONGITUDE = 90.0, 360.0
"""Degrees beyond which nothing lies on the Earth; longitudes are told from -180 as well as to 360."""

EARTH_RADIUS_KM = 6371.0
"""Mean radius of the Earth."""


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

    @property
    def place(self) -> tuple[float, float] | None:
        """Latitude and longitude, None where they are not known or not on the Earth."""
        return valid_coordinates(self.latitude_deg, self.longitude_deg)


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
    name : str
        As the file calls it, empty where it does not.
    """

    origin_time: datetime | None = None
    latitude_deg: float | None = None
    longitude_deg: float | None = None
    depth_km: float | None = None
    magnitude: float | None = None
    name: str = ""

    @property
    def place(self) -> tuple[float, float] | None:
        """Latitude and longitude of the epicentre, None where they are not known or not on the Earth."""
        return valid_coordinates(self.latitude_deg, self.longitude_deg)


def get_site(record: Record) -> Site:
    """Return where a record was made."""
    name = record.metadata.get("station_name")
    latitude, longitude, height = (_metadata_number(record, f"station_{key}") for key in ("latitude_deg", "longitude_deg", "height_m"))
    if not latitude and not longitude:
        latitude = longitude = None  # zeros for both are how some networks say that they do not know
    return Site(record.station, name if isinstance(name, str) else "", latitude, longitude, height)


def matches_station(record: Record, station: str) -> bool:
    """Return whether a record is of a station, by its code or its name, in capitals or not.

    Examples
    --------
    >>> from seisblock.readers import read
    >>> matches_station(read("hanmer_springs_2016"), "hses")
    True
    """
    return station.strip().lower() in (record.station.lower(), get_site(record).name.lower())


def source_name(record: Record) -> str:
    """Return the name of a record's file without its folder, as it stands in what is printed for others; empty where there is none.

    Examples
    --------
    >>> import numpy as np
    >>> from seisblock.records import Component
    >>> source_name(Record((Component("NS", np.zeros(3), 0.0),), 0.01, source="records/kobe.csv"))
    'kobe.csv'
    """
    return record.source.rsplit("/", 1)[-1]


def get_earthquake(record: Record) -> Earthquake | None:
    """Return what shook, or None where the file does not say, or has zeros for all it might."""
    origin = record.metadata.get("origin_time")
    latitude, longitude, depth = (_metadata_number(record, f"event_{key}") for key in ("latitude_deg", "longitude_deg", "depth_km"))
    magnitude = _metadata_number(record, "magnitude")
    if not any((latitude, longitude, depth, magnitude)):
        return None
    name = record.metadata.get("event_name")
    moment = origin if isinstance(origin, datetime) else None
    return Earthquake(moment, latitude, longitude, depth, magnitude, name if isinstance(name, str) else "")


def epicentral_distance_km(record: Record) -> float | None:
    """Return how far the station is from the epicentre, km: as the file says, else along the great circle between their coordinates."""
    distance = _metadata_number(record, "epicentral_distance_km")
    if distance is not None:
        return distance
    site, earthquake = get_site(record), get_earthquake(record)
    if earthquake is None or site.place is None or earthquake.place is None:
        return None
    return great_circle_km(site.place, earthquake.place)


def valid_coordinates(latitude: float | None, longitude: float | None) -> tuple[float, float] | None:
    """Return latitude and longitude, degrees, None where one is missing or they are not on the Earth.

    Examples
    --------
    >>> valid_coordinates(-37.6, 181.0), valid_coordinates(99.9, 139.0)
    ((-37.6, 181.0), None)
    """
    if latitude is None or longitude is None or not (abs(latitude) <= MAX_LATITUDE and abs(longitude) <= MAX_LONGITUDE):
        return None
    return latitude, longitude


def unwrap_longitude(longitude: float, reference: float) -> float:
    """Return a longitude by the name, turns of 360 degrees away, that lies nearest to another: a map may cross the date line.

    Examples
    --------
    >>> unwrap_longitude(-179.5, 178.0), unwrap_longitude(139.0, 178.0)
    (180.5, 139.0)
    """
    return longitude - 360.0 * round((longitude - reference) / 360.0)


def great_circle_km(start: tuple[float, float], end: tuple[float, float]) -> float:
    """Return how far two places are apart on a sphere of the Earth's mean radius, km; places are latitude and longitude, degrees.

    Examples
    --------
    >>> round(great_circle_km((0.0, 0.0), (0.0, 90.0)))
    10008
    """
    (lat_1, lon_1), (lat_2, lon_2) = ([radians(degrees) for degrees in place] for place in (start, end))
    haversine = sin((lat_2 - lat_1) / 2.0) ** 2 + cos(lat_1) * cos(lat_2) * sin((lon_2 - lon_1) / 2.0) ** 2
    return 2.0 * EARTH_RADIUS_KM * asin(min(sqrt(haversine), 1.0))


def format_local_time(record: Record, moment: datetime | None) -> str:
    """Return a moment as the record's own network tells time, to the second, with the name of the clock; empty where it is unknown."""
    if moment is None:
        return ""
    clock = str(record.metadata.get("clock", "UTC"))
    return f"{moment + UTC_OFFSETS.get(clock, timedelta(0)) + HALF_A_SECOND:%Y-%m-%d %H:%M:%S} {clock}"


def _metadata_number(record: Record, key: str) -> float | None:
    """Return a number of the header, or None."""
    value = record.metadata.get(key)
    return float(value) if isinstance(value, int | float) else None

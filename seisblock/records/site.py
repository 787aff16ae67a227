"""Site and earthquake of a record, from header metadata."""

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
"""Offsets from UTC of the clocks in headers; readers store the name in ``metadata["clock"]``."""


HALF_A_SECOND = timedelta(seconds=0.5)

MAX_LATITUDE, MAX_LONGITUDE = 90.0, 360.0
"""Limits of valid coordinates, degrees; longitudes run from -180 or to 360."""

EARTH_RADIUS_KM = 6371.0
"""Mean radius of the Earth, km."""


@dataclass(frozen=True)
class Site:
    """Recording site.

    Parameters
    ----------
    code, name : str
        Empty if not in the file.
    seed_id : str
        Network, station, location and channels; empty without a network.
    latitude_deg, longitude_deg : float or None
        Latitude north and longitude east, degrees.
    height_m : float or None
        Height above sea level.
    """

    code: str = ""
    name: str = ""
    latitude_deg: float | None = None
    longitude_deg: float | None = None
    height_m: float | None = None
    seed_id: str = ""

    @property
    def label(self) -> str:
        """SEED id or code, and name, as far as known."""
        return " ".join(dict.fromkeys(part for part in (self.seed_id or self.code, self.name) if part))

    @property
    def place(self) -> tuple[float, float] | None:
        """Latitude and longitude, degrees; None if unknown or invalid."""
        return valid_coordinates(self.latitude_deg, self.longitude_deg)


@dataclass(frozen=True)
class Earthquake:
    """Source earthquake of a record.

    Parameters
    ----------
    origin_time : datetime or None
        UTC.
    latitude_deg, longitude_deg : float or None
        Epicentre, degrees north and east.
    depth_km : float or None
    magnitude : float or None
    name : str
        Name in the file; may be empty.
    """

    origin_time: datetime | None = None
    latitude_deg: float | None = None
    longitude_deg: float | None = None
    depth_km: float | None = None
    magnitude: float | None = None
    name: str = ""

    @property
    def place(self) -> tuple[float, float] | None:
        """Latitude and longitude of the epicentre, degrees; None if unknown or invalid."""
        return valid_coordinates(self.latitude_deg, self.longitude_deg)


def get_site(record: Record) -> Site:
    """Return the recording site."""
    name = record.metadata.get("station_name")
    latitude, longitude, height = (_metadata_number(record, f"station_{key}") for key in ("latitude_deg", "longitude_deg", "height_m"))
    if not latitude and not longitude:
        latitude = longitude = None  # some networks write zeros for unknown coordinates
    return Site(record.station, name if isinstance(name, str) else "", latitude, longitude, height, record.seed_id)


def matches_station(record: Record, station: str) -> bool:
    """Return whether `station` is the code, with or without network, or the name of a record's station, ignoring case.

    Examples
    --------
    >>> from seisblock.readers import read
    >>> matches_station(read("hanmer_springs_2016"), "hses")
    True
    """
    names = (record.station, f"{record.network}.{record.station}", get_site(record).name)
    return station.strip().lower() in (name.lower() for name in names)


def source_name(record: Record) -> str:
    """Return the file name of a record without its folder; may be empty.

    Examples
    --------
    >>> import numpy as np
    >>> from seisblock.records import Component
    >>> source_name(Record((Component("NS", np.zeros(3), 0.0),), 0.01, source="records/kobe.csv"))
    'kobe.csv'
    """
    return record.source.rsplit("/", 1)[-1]


def get_earthquake(record: Record) -> Earthquake | None:
    """Return the source earthquake; None if the header has no nonzero coordinates, depth or magnitude."""
    origin = record.metadata.get("origin_time")
    latitude, longitude, depth = (_metadata_number(record, f"event_{key}") for key in ("latitude_deg", "longitude_deg", "depth_km"))
    magnitude = _metadata_number(record, "magnitude")
    if not any((latitude, longitude, depth, magnitude)):
        return None
    name = record.metadata.get("event_name")
    moment = origin if isinstance(origin, datetime) else None
    return Earthquake(moment, latitude, longitude, depth, magnitude, name if isinstance(name, str) else "")


def epicentral_distance_km(record: Record) -> float | None:
    """Return the epicentral distance, km, from the header or else from the coordinates; None if unknown."""
    distance = _metadata_number(record, "epicentral_distance_km")
    if distance is not None:
        return distance
    site, earthquake = get_site(record), get_earthquake(record)
    if earthquake is None or site.place is None or earthquake.place is None:
        return None
    return great_circle_km(site.place, earthquake.place)


def valid_coordinates(latitude: float | None, longitude: float | None) -> tuple[float, float] | None:
    """Return latitude and longitude, degrees; None if missing or out of range.

    Examples
    --------
    >>> valid_coordinates(-37.6, 181.0), valid_coordinates(99.9, 139.0)
    ((-37.6, 181.0), None)
    """
    if latitude is None or longitude is None or not (abs(latitude) <= MAX_LATITUDE and abs(longitude) <= MAX_LONGITUDE):
        return None
    return latitude, longitude


def unwrap_longitude(longitude: float, reference: float) -> float:
    """Return a longitude shifted by multiples of 360 degrees to be nearest to `reference`.

    Examples
    --------
    >>> unwrap_longitude(-179.5, 178.0), unwrap_longitude(139.0, 178.0)
    (180.5, 139.0)
    """
    return longitude - 360.0 * round((longitude - reference) / 360.0)


def great_circle_km(start: tuple[float, float], end: tuple[float, float]) -> float:
    """Return the great-circle distance, km, of two points (latitude, longitude), degrees.

    Examples
    --------
    >>> round(great_circle_km((0.0, 0.0), (0.0, 90.0)))
    10008
    """
    (lat_1, lon_1), (lat_2, lon_2) = ([radians(degrees) for degrees in place] for place in (start, end))
    # haversine formula: accurate for small distances, unlike the arc cosine
    haversine = sin((lat_2 - lat_1) / 2.0) ** 2 + cos(lat_1) * cos(lat_2) * sin((lon_2 - lon_1) / 2.0) ** 2
    return 2.0 * EARTH_RADIUS_KM * asin(min(sqrt(haversine), 1.0))


def format_local_time(record: Record, moment: datetime | None) -> str:
    """Return a time in the clock of the record's network, to the second, with the clock's name; may be empty."""
    return "" if moment is None else format_clock_time(moment, str(record.metadata.get("clock", "UTC")))


def format_clock_time(moment: datetime, clock: str) -> str:
    """Return a UTC time in a clock, to the second, with its name (``JST``)."""
    # strftime truncates: half a second more rounds to the nearest second
    return f"{moment + UTC_OFFSETS.get(clock, timedelta(0)) + HALF_A_SECOND:%Y-%m-%d %H:%M:%S} {clock}"


def _metadata_number(record: Record, key: str) -> float | None:
    value = record.metadata.get(key)
    return float(value) if isinstance(value, int | float) else None

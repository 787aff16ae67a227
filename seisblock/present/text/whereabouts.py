"""Where a record was made, and of what earthquake, in a line each."""

from __future__ import annotations

from seisblock.records import Record
from seisblock.records.site import Earthquake, earthquake_of, epicentral_distance_km, site_of, told_time
from seisblock.words import listed, tell


def whereabouts(record: Record) -> list[str]:
    """Return what is known of station and earthquake, a line each: where it stands; magnitude, name, depth, epicentre, distance, time."""
    return [told for told in (_station(record), _earthquake(record)) if told]


def place(latitude_deg: float, longitude_deg: float) -> str:
    """Return a place in degrees, with the letters of its hemispheres.

    Examples
    --------
    >>> place(35.68, 139.77), place(-42.52, 172.83), place(37.7, -122.4)
    ('35.68 N 139.77 E', '42.52 S 172.83 E', '37.7 N 122.4 W')
    """
    north, east = abs(latitude_deg), abs(longitude_deg)
    if latitude_deg >= 0.0:
        return tell("{north:g} N {east:g} E", north=north, east=east) if longitude_deg >= 0.0 else tell(
            "{north:g} N {west:g} W", north=north, west=east)  # fmt: skip
    return tell("{south:g} S {east:g} E", south=north, east=east) if longitude_deg >= 0.0 else tell(
        "{south:g} S {west:g} W", south=north, west=east)  # fmt: skip


def _station(record: Record) -> str:
    """Return where the station is; empty where the file does not say."""
    site = site_of(record)
    if site.latitude_deg is None or site.longitude_deg is None:
        return ""
    return tell("station at {place}", place=place(site.latitude_deg, site.longitude_deg))


def _earthquake(record: Record) -> str:
    """Return what shook, as far as it is known."""
    earthquake = earthquake_of(record)
    return (
        "" if earthquake is None else earthquake_told(earthquake, told_time(record, earthquake.origin_time), epicentral_distance_km(record))
    )


def earthquake_told(earthquake: Earthquake, origin: str, distance_km: float | None = None) -> str:
    """Return an earthquake in a line.

    Parameters
    ----------
    earthquake : Earthquake
    origin : str
        Its time as a clock tells it, empty where it is unknown.
    distance_km : float or None
        From its epicentre to a station.

    Examples
    --------
    >>> earthquake_told(Earthquake(None, 36.25, -120.28, 9.0, 6.5), "", 36.0)
    'earthquake of magnitude 6.5, 9 km deep, 36.25 N 120.28 W, 36 km away'
    """
    parts = []
    if earthquake.magnitude is not None:
        parts.append(tell("earthquake of magnitude {magnitude:g}", magnitude=earthquake.magnitude))
    parts += [earthquake.name] if earthquake.name else []
    if earthquake.depth_km is not None:
        parts.append(tell("{depth:g} km deep", depth=earthquake.depth_km))
    if earthquake.latitude_deg is not None and earthquake.longitude_deg is not None:
        parts.append(place(earthquake.latitude_deg, earthquake.longitude_deg))
    if distance_km is not None:
        parts.append(tell("{distance:.3g} km away", distance=distance_km))
    parts += [origin] if origin else []
    return listed(parts)

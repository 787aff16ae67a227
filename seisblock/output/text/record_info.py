"""Station and earthquake of a record, one line each."""

from __future__ import annotations

from seisblock.core.i18n import Message, gettext, join_list
from seisblock.records import Record
from seisblock.records.site import Earthquake, epicentral_distance_km, format_local_time, get_earthquake, get_site


def record_info(record: Record) -> list[str]:
    """Return one line on the station and one on the earthquake, as far as the file contains them."""
    return [text for text in (_station(record), _earthquake(record)) if text]


def format_step(step: str) -> str:
    """Return a processing step with four digits of a scale factor; documents contain ten.

    Examples
    --------
    >>> from seisblock.core.i18n import lazy_gettext
    >>> format_step(lazy_gettext("scaled by {factor:.10g}", factor=2.012072435)), format_step("as recorded")
    ('scaled by 2.012', 'as recorded')
    """
    if isinstance(step, Message) and "factor" in step.values:
        return gettext(step.template, **{**step.values, "factor": float(f"{step.values['factor']:.4g}")})
    return gettext(step)


def format_position(latitude_deg: float, longitude_deg: float) -> str:
    """Return a position in degrees with hemisphere letters.

    Examples
    --------
    >>> format_position(35.68, 139.77), format_position(-42.52, 172.83), format_position(37.7, -122.4)
    ('35.68 N 139.77 E', '42.52 S 172.83 E', '37.7 N 122.4 W')
    """
    north, east = abs(latitude_deg), abs(longitude_deg)
    if latitude_deg >= 0.0:
        return gettext("{north:g} N {east:g} E", north=north, east=east) if longitude_deg >= 0.0 else gettext(
            "{north:g} N {west:g} W", north=north, west=east)  # fmt: skip
    return gettext("{south:g} S {east:g} E", south=north, east=east) if longitude_deg >= 0.0 else gettext(
        "{south:g} S {west:g} W", south=north, west=east)  # fmt: skip


def _station(record: Record) -> str:
    """Return the station position; empty if unknown."""
    site = get_site(record)
    if site.latitude_deg is None or site.longitude_deg is None:
        return ""
    return gettext("station at {place}", place=format_position(site.latitude_deg, site.longitude_deg))


def _earthquake(record: Record) -> str:
    """Return the earthquake line; empty if unknown."""
    earthquake = get_earthquake(record)
    return (
        ""
        if earthquake is None
        else describe_earthquake(earthquake, format_local_time(record, earthquake.origin_time), epicentral_distance_km(record))
    )


def describe_earthquake(earthquake: Earthquake, origin: str, distance_km: float | None = None) -> str:
    """Return magnitude, name, depth, epicentre, distance and time of an earthquake in one line.

    Parameters
    ----------
    earthquake : Earthquake
    origin : str
        Local origin time; empty if unknown.
    distance_km : float or None
        From its epicentre to a station.

    Examples
    --------
    >>> describe_earthquake(Earthquake(None, 36.25, -120.28, 9.0, 6.5), "", 36.0)
    'earthquake of magnitude 6.5, depth 9 km, 36.25 N 120.28 W, epicentral distance 36 km'
    """
    parts = []
    if earthquake.magnitude is not None:
        parts.append(gettext("earthquake of magnitude {magnitude:g}", magnitude=earthquake.magnitude))
    parts += [earthquake.name] if earthquake.name else []
    if earthquake.depth_km is not None:
        parts.append(gettext("depth {depth:g} km", depth=earthquake.depth_km))
    if earthquake.latitude_deg is not None and earthquake.longitude_deg is not None:
        parts.append(format_position(earthquake.latitude_deg, earthquake.longitude_deg))
    if distance_km is not None:
        parts.append(gettext("epicentral distance {distance:.3g} km", distance=distance_km))
    parts += [origin] if origin else []
    return join_list(parts)

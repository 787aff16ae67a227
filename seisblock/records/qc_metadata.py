"""Quality control of header metadata: coordinates, and record start against origin time."""

from __future__ import annotations

from collections.abc import Iterator
from datetime import timedelta

from seisblock.core.i18n import lazy_gettext
from seisblock.records.qc_flags import QCFlag
from seisblock.records.record import Record
from seisblock.records.site import MAX_LATITUDE, MAX_LONGITUDE, format_local_time, get_earthquake, get_site

ORIGIN_TIME_TOLERANCE = timedelta(seconds=60)
"""Old headers give the origin time to the minute."""

MAX_TRAVEL_TIME = timedelta(hours=1)
"""Longest plausible travel time of strong shaking."""


def check_metadata(record: Record) -> Iterator[QCFlag]:
    """Yield flags for coordinates out of range and for a record start that does not match the origin time."""
    site, earthquake = get_site(record), get_earthquake(record)
    locations = {lazy_gettext("station"): site} | ({lazy_gettext("epicentre"): earthquake} if earthquake else {})
    for label, location in locations.items():
        for degrees, limit in ((location.latitude_deg, MAX_LATITUDE), (location.longitude_deg, MAX_LONGITUDE)):
            if degrees is not None and abs(degrees) > limit:
                yield QCFlag(
                    "header",
                    lazy_gettext(
                        "{what} coordinate {degrees:g} degrees out of range (limit {most:g})", what=label, degrees=degrees, most=limit
                    ),
                )
    origin = earthquake.origin_time if earthquake else None
    if origin is None or record.start is None:
        return
    end = record.start + timedelta(seconds=record.samples * record.dt)
    # a recorder with memory starts before the origin time, but no record of the earthquake ends before it
    if end < origin - ORIGIN_TIME_TOLERANCE or record.start > origin + MAX_TRAVEL_TIME:
        text = lazy_gettext(
            "record start {start} and origin time {origin} do not match: one of them is wrong",
            start=format_local_time(record, record.start),
            origin=format_local_time(record, origin),
        )
        yield QCFlag("header", text)

"""What a header says against itself: a place that is not on the Earth, a record that is not of its earthquake."""

from __future__ import annotations

from collections.abc import Iterator
from datetime import timedelta

from seisblock.records.doubts import Doubt
from seisblock.records.record import Record
from seisblock.records.site import MOST_LATITUDE, MOST_LONGITUDE, earthquake_of, site_of, told_time
from seisblock.words import said

EARLIEST = timedelta(seconds=60)
"""Old headers tell the origin time to the minute."""

LATEST = timedelta(hours=1)
"""No strong shaking arrives later."""


def doubts_of_header(record: Record) -> Iterator[Doubt]:
    """Yield what the header of a record says that cannot be."""
    site, earthquake = site_of(record), earthquake_of(record)
    places = {said("the station"): site} | ({said("the epicentre"): earthquake} if earthquake else {})
    for what, place in places.items():
        for degrees, most in ((place.latitude_deg, MOST_LATITUDE), (place.longitude_deg, MOST_LONGITUDE)):
            if degrees is not None and abs(degrees) > most:
                yield Doubt("header", said("{what} lies at {degrees:g} degrees, beyond {most:g}", what=what, degrees=degrees, most=most))
    origin = earthquake.origin_time if earthquake else None
    if origin is None or record.start is None:
        return
    end = record.start + timedelta(seconds=record.samples * record.dt)
    if end < origin - EARLIEST or record.start > origin + LATEST:
        text = said(
            "the record begins at {start}, its earthquake at {origin}: one of the two is wrong",
            start=told_time(record, record.start),
            origin=told_time(record, origin),
        )
        yield Doubt("header", text)

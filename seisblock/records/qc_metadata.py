"""What a header says against itself: a place that is not on the Earth, a record that is not of its earthquake."""

from __future__ import annotations

from collections.abc import Iterator
from datetime import timedelta

from seisblock.core.i18n import lazy_gettext
from seisblock.records.qc_flags import QCFlag
from seisblock.records.record import Record
from seisblock.records.site import MAX_LATITUDE, MAX_LONGITUDE, format_local_time, get_earthquake, get_site

ORIGIN_TIME_TOLERANCE = timedelta(seconds=60)
"""Old headers tell the origin time to the minute."""

MAX_TRAVEL_TIME = timedelta(hours=1)
"""No strong shaking arrives later."""


def check_metadata(record: Record) -> Iterator[QCFlag]:
    """Yield what the header of a record says that cannot be."""
    site, earthquake = get_site(record), get_earthquake(record)
    locations = {lazy_gettext("the station"): site} | ({lazy_gettext("the epicentre"): earthquake} if earthquake else {})
    for label, location in locations.items():
        for degrees, limit in ((location.latitude_deg, MAX_LATITUDE), (location.longitude_deg, MAX_LONGITUDE)):
            if degrees is not None and abs(degrees) > limit:
                yield QCFlag(
                    "header", lazy_gettext("{what} lies at {degrees:g} degrees, beyond {most:g}", what=label, degrees=degrees, most=limit)
                )
    origin = earthquake.origin_time if earthquake else None
    if origin is None or record.start is None:
        return
    end = record.start + timedelta(seconds=record.samples * record.dt)
    if end < origin - ORIGIN_TIME_TOLERANCE or record.start > origin + MAX_TRAVEL_TIME:
        text = lazy_gettext(
            "the record begins at {start}, its earthquake at {origin}: one of the two is wrong",
            start=format_local_time(record, record.start),
            origin=format_local_time(record, origin),
        )
        yield QCFlag("header", text)

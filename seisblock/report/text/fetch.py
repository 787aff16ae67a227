"""Text report of a download: stations by distance."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from seisblock.core.i18n import gettext
from seisblock.core.units import GAL
from seisblock.measures import peak_acceleration
from seisblock.output.text.tables import DASH, format_number, styled_line, table
from seisblock.records.qc_report import qc_summary
from seisblock.studies.fetch import StationDownload


def tables(downloads: Sequence[StationDownload], directory: Path) -> Iterator[Any]:
    """Yield the count of usable records, the table of the stations, the reasons of missing ones, and the quality flags."""
    usable = [download.record for download in downloads if download.record is not None]
    yield styled_line(
        gettext("{directory}: {count} of {total} stations have a record", directory=directory, count=len(usable), total=len(downloads)),
        "bold",
    )
    yield table(
        "",
        (gettext("station"), gettext("channels"), gettext("distance (km)"), "PGA (gal)", gettext("status")),
        [_row(download) for download in downloads],
    )
    for download in downloads:
        if download.failure is not None:
            yield styled_line(gettext("{name}: {what}", name=download.sensor.name, what=download.failure.message), "yellow")
    for message in qc_summary(usable):
        yield styled_line(gettext("warning: {doubt}", doubt=message), "yellow")


def _row(download: StationDownload) -> tuple[str, ...]:
    record = download.record
    pga = DASH if record is None else format_number(max(peak_acceleration(c.acceleration)[0] for c in record.components) / GAL)
    return (
        download.sensor.name,
        " ".join(download.sensor.channels),
        DASH if download.distance_km is None else format_number(download.distance_km, 3),
        pga,
        gettext(download.status),
    )

"""JSON document of ``seisblock fetch``."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

from msgspec import Meta

from seisblock.measures import peak_acceleration
from seisblock.output.json.entries import entry_type, to_entry
from seisblock.output.json.schema import Document, DocumentSchema, Result, fill
from seisblock.studies.fetch import FetchRequest, StationDownload

FETCH_PARAMETERS = entry_type(
    "FetchParameters", FetchRequest, extra={"directory": Annotated[str, Meta(description="Folder of the files.")]}, bases=()
)


class FetchResult(Result, frozen=True, kw_only=True):
    """One station, nearest first.

    Parameters
    ----------
    network, station, location : str
    channels : list of str
    latitude_deg, longitude_deg : float
        Of the station, degrees north and east.
    epicentral_distance_km : float or None
    status : str
        ``new``, ``present``, ``no data``, ``not usable`` or ``failed``.
    file : str or None
        The miniSEED file, null if there is none.
    pga_m_s2 : dict
        PGA of each component; empty without a record.
    failure : str
        Reason of a missing record; empty if there is one.
    """

    network: str
    station: str
    location: str
    channels: list[str]
    latitude_deg: float
    longitude_deg: float
    epicentral_distance_km: float | None
    status: str
    file: str | None
    pga_m_s2: dict[str, float]
    failure: str


FETCH = DocumentSchema("fetch", FETCH_PARAMETERS, FetchResult)


def document(request: FetchRequest, downloads: Sequence[StationDownload], directory: Path) -> Document:
    """Return the document of a download; records are those of the stations that have one."""
    parameters = to_entry(FETCH_PARAMETERS, request, directory=str(directory))
    return FETCH.document(parameters, ((download.record, _result(download, directory)) for download in downloads))


def _result(download: StationDownload, directory: Path) -> FetchResult:
    sensor, record = download.sensor, download.record
    path = directory / f"{sensor.name}.mseed"
    return fill(
        FetchResult,
        download,
        sensor,
        channels=list(sensor.channels),
        epicentral_distance_km=download.distance_km,
        file=str(path) if path.exists() else None,
        pga_m_s2={} if record is None else {c.code: float(peak_acceleration(c.acceleration)[0]) for c in record.components},
        failure="" if download.failure is None else str(download.failure.message),
    )

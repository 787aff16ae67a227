"""Keys of a station in documents, tables and map points, in one order."""

from __future__ import annotations

from typing import Any

from seisblock.studies.map.stations import StationReport


def station_row(report: StationReport) -> dict[str, Any]:
    """Return the keys of a station with their values.

    Parameters
    ----------
    report : StationReport

    Examples
    --------
    >>> row = station_row(StationReport("a.csv", "ABC", latitude=35.0, longitude=139.0, pga_m_s2=1.5))
    >>> row["station"], row["latitude"], row["rate"]
    ('ABC', 35.0, None)
    """
    result = report.effect
    return {
        "record": report.record,
        "station": report.station,
        "seed_id": report.seed_id,
        "name": report.name,
        "latitude": report.latitude,
        "longitude": report.longitude,
        "epicentral_distance_km": report.epicentral_distance_km,
        "local_start": report.local_start,
        "pga_m_s2": report.pga_m_s2,
        "pgv_m_s": report.pgv_m_s,
        "jma_intensity": report.jma_intensity,
        "azimuth_deg": result.azimuth_deg,
        "rate": result.rate,
        "happened": result.happened,
        "overturned": result.overturned,
        "probability": result.probability,
        "max_slip_m": result.max_slip_m,
        "max_uplift_m": result.max_uplift_m,
        "failure": report.failure,
        "doubts": "; ".join(report.doubts) or None,
        "history": "; ".join(report.history) or None,
    }

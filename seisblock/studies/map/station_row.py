"""Keys of a station in documents, tables and map points, in one order."""

from __future__ import annotations

from typing import Any

from seisblock.studies.map.stations import StationReport

STATION_KEYS = (
    *("record", "station", "seed_id", "name", "latitude", "longitude", "epicentral_distance_km", "local_start"),
    *("pga_m_s2", "pgv_m_s", "jma_intensity"),
)
RESULT_KEYS = ("azimuth_deg", "rate", "happened", "overturned", "probability", "max_slip_m", "max_uplift_m")
"""Fields of a report, and of its result, that are keys."""


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
    return {
        **{key: getattr(report, key) for key in STATION_KEYS},
        **{key: getattr(report.effect, key) for key in RESULT_KEYS},
        "failure": report.failure,
        "doubts": "; ".join(report.doubts) or None,
        "history": "; ".join(report.history) or None,
    }

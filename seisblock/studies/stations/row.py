"""A station as a row: the keys of documents, tables and points on maps, in one order."""

from __future__ import annotations

from typing import Any

from seisblock.studies.stations.survey import StationAnswer


def row_of(answer: StationAnswer) -> dict[str, Any]:
    """Return the keys of a station and what stands under them.

    Parameters
    ----------
    answer : StationAnswer

    Examples
    --------
    >>> row = row_of(StationAnswer("a.csv", "ABC", latitude=35.0, longitude=139.0, pga_m_s2=1.5))
    >>> row["station"], row["latitude"], row["rate"]
    ('ABC', 35.0, None)
    """
    effect = answer.effect
    return {
        "record": answer.record,
        "station": answer.station,
        "name": answer.name,
        "latitude": answer.latitude,
        "longitude": answer.longitude,
        "epicentral_distance_km": answer.epicentral_distance_km,
        "local_start": answer.local_start,
        "pga_m_s2": answer.pga_m_s2,
        "pgv_m_s": answer.pgv_m_s,
        "jma_intensity": answer.jma_intensity,
        "azimuth_deg": effect.azimuth_deg,
        "rate": effect.rate,
        "happened": effect.happened,
        "overturned": effect.overturned,
        "probability": effect.probability,
        "max_slip_m": effect.max_slip_m,
        "max_uplift_m": effect.max_uplift_m,
        "failure": answer.failure,
        "doubts": "; ".join(answer.doubts) or None,
        "history": "; ".join(answer.history) or None,
    }

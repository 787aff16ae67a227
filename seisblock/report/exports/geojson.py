"""Stations as GeoJSON points (RFC 7946), longitude before latitude."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from seisblock.output.io.atomic import atomic_write
from seisblock.studies.map.station_row import station_row
from seisblock.studies.map.stations import Stations
from seisblock.studies.map.surveyed_places import SurveyComparison

DECIMALS = 6
"""Decimals of coordinates, degrees (0.1 m)."""


def feature_collection(stations: Stations, surveys: Sequence[SurveyComparison] = ()) -> dict[str, Any]:
    """Return the stations with known coordinates as a GeoJSON FeatureCollection; properties have the keys of the JSON document.

    Parameters
    ----------
    stations : Stations
    surveys : sequence of SurveyComparison
        Surveyed cemeteries, added as points whose properties begin with ``place``.
    """
    features = [
        {
            "type": "Feature",
            "geometry": {"type": "Point", "coordinates": _position(answer.longitude, answer.latitude)},
            "properties": {key: value for key, value in station_row(answer).items() if key not in ("latitude", "longitude")},
        }
        for answer in stations.mapped
    ]
    features += [
        {
            "type": "Feature",
            "geometry": {"type": "Point", "coordinates": _position(answer.surveyed.longitude, answer.surveyed.latitude)},
            "properties": {
                "place": answer.surveyed.place,
                "stones": answer.surveyed.stones,
                "fallen": answer.surveyed.fallen,
                "jma_intensity": answer.estimate.jma_intensity,
                "jma_intensity_interval": list(answer.estimate.jma_intensity_interval),
                "expected_jma_intensity": answer.expected_intensity,
                "residual_jma_intensity": answer.residual,
            },
        }
        for answer in surveys
    ]
    collection: dict[str, Any] = {"type": "FeatureCollection", "features": features}
    earthquake = stations.earthquake
    if earthquake is not None:
        # foreign member, ignored by other readers (RFC 7946 section 6.1)
        collection["earthquake"] = {
            "name": earthquake.name,
            "origin_time": earthquake.origin_time.isoformat() if earthquake.origin_time else None,
            "magnitude": earthquake.magnitude,
            "depth_km": earthquake.depth_km,
            "coordinates": None if earthquake.place is None else _position(earthquake.longitude_deg, earthquake.latitude_deg),
        }
    return collection


def write_geojson(path: Path, stations: Stations, surveys: Sequence[SurveyComparison] = ()) -> None:
    """Write the stations with known coordinates as GeoJSON.

    Parameters
    ----------
    path : Path
    stations : Stations
    surveys : sequence of SurveyComparison
    """
    with atomic_write(path) as temporary:
        text = json.dumps(feature_collection(stations, surveys), ensure_ascii=False, allow_nan=False)
        temporary.write_text(text + "\n", encoding="utf-8")


def _position(longitude: float | None, latitude: float | None) -> list[float]:
    """Return longitude and latitude, longitude wrapped to -180..180 degrees."""
    east = float(longitude or 0.0)
    return [round((east + 180.0) % 360.0 - 180.0 if abs(east) > 180.0 else east, DECIMALS), round(float(latitude or 0.0), DECIMALS)]

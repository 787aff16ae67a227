"""Station map page of an earthquake: interactive map, record and result of the selected station, table of stations."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from seisblock.core.i18n import gettext, join_list
from seisblock.core.typing import FloatArray
from seisblock.core.units import GAL
from seisblock.output.templating import render_page
from seisblock.output.text.record_info import describe_earthquake
from seisblock.output.units_display import acceleration_unit
from seisblock.report.coastline import coastlines
from seisblock.report.figures.probability import share_colour
from seisblock.report.figures.stations import (
    KM_PER_DEGREE,
    colour_values,
    epicentre_position,
    map_extent_points,
    map_position,
    map_title,
    survey_value,
)
from seisblock.report.text.map import preparation_texts, station_rows, survey_rows, verdict
from seisblock.studies.map.station_response import StationModel
from seisblock.studies.map.stations import StationReport, Stations
from seisblock.studies.map.surveyed_places import SurveyComparison, contradictions

MIN_MARGIN_DEG = 0.2
"""Smallest margin of the coastline around the stations, degrees."""

LEGEND = 9
"""Number of colours of the legend."""


def map_page(stations: Stations, model: StationModel | None, *, gal: bool = True, surveys: Sequence[SurveyComparison] = ()) -> str:
    """Return the self-contained map page in the language of the locale.

    Parameters
    ----------
    stations : Stations
    model : StationModel or None
    gal : bool
        Accelerations in gal if true, else m/s².
    surveys : sequence of SurveyComparison
        Surveyed cemeteries: squares on the map and a table.
    """
    answers = [answer for answer in stations.answers if answer.pga_m_s2 is not None]
    header, rows = station_rows(answers, model, gal=gal)
    values, label, max_value = colour_values(stations, model, gal=gal) if stations.mapped else (np.empty(0), "", 1.0)
    shares = {id(answer): value / max_value for answer, value in zip(stations.mapped, values.tolist(), strict=True)}
    centre = _map_centre(stations)
    points = [
        {
            "at": _offset_km(map_position(stations, answer.longitude, answer.latitude), centre),
            **_station_point(answer, row, header, share_colour(shares[id(answer)]), gal=gal),
        }
        for answer, row in zip(answers, rows, strict=True)
        if answer.is_mapped
    ]
    names, surveyed_rows = survey_rows(surveys)
    squares = [
        {
            "at": _offset_km(map_position(stations, survey.surveyed.longitude, survey.surveyed.latitude), centre),
            "name": survey.surveyed.place,
            "colour": share_colour(survey_value(survey, model, gal=gal) / max_value),
            "details": [[name, cell] for name, cell in zip(names[1:], row[1:], strict=True)],
            "failure": "",
            "outline": [],
        }
        for survey, row in zip(surveys, surveyed_rows, strict=True)
    ]
    earthquake = stations.earthquake
    frame = map_extent_points(stations, surveys) if points else np.empty((0, 2))
    coast = [[_offset_km(point, centre) for point in line.tolist()] for line in coastlines(*_surrounding_area(frame))] if points else []
    epicentre = epicentre_position(stations)
    star = None if epicentre is None else _offset_km(epicentre, centre)
    return render_page(
        "map.html",
        map_title(stations, model, between=" · ") or gettext("Stations"),
        subtitles=[describe_earthquake(earthquake, stations.origin_told)] if earthquake else [],
        lead=verdict(stations, model),
        processed=join_list(gettext(text) for text in preparation_texts(stations.preparation)),
        data={
            "points": points,
            "squares": squares,
            "epicentre": star,
            "framed": [_offset_km(at, centre) for at in frame.tolist()],
            "coast": coast,
            "named": gettext("epicentre"),
        },
        label=label,
        legend=[share_colour(i / (LEGEND - 1)) for i in range(LEGEND)],
        ends=["0", f"{max_value:.3g}"],
        heads=header,
        rows=rows,
        surveyed={"heads": names, "rows": surveyed_rows, "pairs": [gettext(pair) for pair in contradictions(surveys)]},
        missing=[f"{answer.label}: {gettext(answer.failure)}" for answer in stations.answers if answer.failure],
        unmapped=[answer.label for answer in answers if not answer.is_mapped],
    )


def _map_centre(stations: Stations) -> tuple[float, float]:
    """Return the centre of the stations, degrees east and north."""
    places = [map_position(stations, answer.longitude, answer.latitude) for answer in stations.mapped] or [(0.0, 0.0)]
    east, north = zip(*places, strict=True)
    return 0.5 * (min(east) + max(east)), 0.5 * (min(north) + max(north))


def _surrounding_area(places: FloatArray) -> tuple[float, float, float, float]:
    """Return the bounding box (west, east, south, north) of places, extended by its larger side on each side."""
    (west, south), (east, north) = places.min(axis=0).tolist(), places.max(axis=0).tolist()
    margin = max(east - west, north - south, MIN_MARGIN_DEG)
    return west - margin, east + margin, south - margin, north + margin


def _offset_km(at: Sequence[float], centre: tuple[float, float]) -> list[float]:
    """Return the offset of a place from the centre, both in degrees east and north, as km east and km south (SVG axes)."""
    narrowing = math.cos(math.radians(centre[1]))
    return [round((at[0] - centre[0]) * narrowing * KM_PER_DEGREE, 3), round((centre[1] - at[1]) * KM_PER_DEGREE, 3)]


def _station_point(answer: StationReport, row: list[str], header: list[str], colour: str, *, gal: bool) -> dict[str, Any]:
    """Return the data of one station for the map script."""
    unit = acceleration_unit(gal=gal)
    details = [[column_name, cell] for column_name, cell in zip(header[1:], row[1:], strict=True)]
    return {
        "name": answer.label,
        "colour": colour,
        "falls": answer.effect.likely_overturns,
        "details": [*details, [gettext("record"), answer.record], [gettext("start time"), answer.local_start]],
        "failure": gettext(answer.failure) if answer.failure else "",
        "outline": [[round(value / GAL, 1) for value in pair] for pair in answer.outline],
        "peak": f"±{(answer.pga_m_s2 or 0.0) / unit.size:.4g} {unit.name}",
        "end": f"{answer.duration_s:.4g} s",
    }

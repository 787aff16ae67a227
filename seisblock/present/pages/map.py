"""The page of an earthquake's stations: a map to move and to enlarge, a station's record and answer where it is touched, a table."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from seisblock.present.coast import coast_within
from seisblock.present.figures.stations import (
    KM_PER_DEGREE,
    epicentre_of,
    framed,
    located,
    shade,
    shown_values,
    surveyed_value,
    title,
)
from seisblock.present.page import page
from seisblock.present.scales import acceleration_unit
from seisblock.present.text.map import cells, survey_cells, verdict
from seisblock.present.text.whereabouts import earthquake_told
from seisblock.studies.stations.effects import WhatStands
from seisblock.studies.stations.survey import StationAnswer, Stations
from seisblock.studies.stations.surveys import SurveyAnswer, contradictions
from seisblock.typing import FloatArray
from seisblock.units import GAL
from seisblock.words import tell

LEAST_ROOM_DEG = 0.2
"""How far around one station the coast is drawn."""

LEGEND = 9
"""Colours of the scale."""


def map_page(found: Stations, subject: WhatStands | None, *, gal: bool = True, surveys: Sequence[SurveyAnswer] = ()) -> str:
    """Return the page, in the language spoken; it needs no network.

    Parameters
    ----------
    found : Stations
    subject : StandingBody, StandingStones or None
    gal : bool
        Whether accelerations are shown in gal.
    surveys : sequence of SurveyAnswer
        Squares on the map, and a table of their own.
    """
    answered = [answer for answer in found.answers if answer.pga_m_s2 is not None]
    heads, rows = cells(answered, subject, gal=gal)
    values, label, most = shown_values(found, subject, gal=gal) if found.mapped else (np.empty(0), "", 1.0)
    drawn = {id(answer): value / most for answer, value in zip(found.mapped, values.tolist(), strict=True)}
    centre = _centre(found)
    points = [
        {
            "at": _place(located(found, answer.longitude, answer.latitude), centre),
            **_point(answer, row, heads, shade(drawn[id(answer)]), gal=gal),
        }
        for answer, row in zip(answered, rows, strict=True)
        if answer.is_mapped
    ]
    names, told = survey_cells(surveys)
    squares = [
        {
            "at": _place(located(found, each.surveyed.longitude, each.surveyed.latitude), centre),
            "name": each.surveyed.place,
            "colour": shade(surveyed_value(each, subject, gal=gal) / most),
            "told": [[name, cell] for name, cell in zip(names[1:], row[1:], strict=True)],
            "failure": "",
            "outline": [],
        }
        for each, row in zip(surveys, told, strict=True)
    ]
    earthquake = found.earthquake
    shown = framed(found, surveys) if points else np.empty((0, 2))
    coast = [[_place(point, centre) for point in line.tolist()] for line in coast_within(*_around(shown))] if points else []
    epicentre = epicentre_of(found)
    star = None if epicentre is None else _place(epicentre, centre)
    return page(
        "map.html",
        title(found, subject, between=" · ") or tell("Stations"),
        subtitles=[earthquake_told(earthquake, found.origin_told)] if earthquake else [],
        lead=verdict(found, subject),
        data={
            "points": points,
            "squares": squares,
            "epicentre": star,
            "framed": [_place(at, centre) for at in shown.tolist()],
            "coast": coast,
            "named": tell("epicentre"),
        },
        label=label,
        legend=[shade(i / (LEGEND - 1)) for i in range(LEGEND)],
        ends=["0", f"{most:.3g}"],
        heads=heads,
        rows=rows,
        surveyed={"heads": names, "rows": told, "pairs": [tell(pair) for pair in contradictions(surveys)]},
        missing=[f"{answer.label}: {tell(answer.failure)}" for answer in found.answers if answer.failure],
        unmapped=[answer.label for answer in answered if not answer.is_mapped],
    )


def _centre(found: Stations) -> tuple[float, float]:
    """Return the middle of the stations, degrees east and north."""
    places = _places(found) or [(0.0, 0.0)]
    east, north = zip(*places, strict=True)
    return 0.5 * (min(east) + max(east)), 0.5 * (min(north) + max(north))


def _places(found: Stations) -> list[tuple[float, float]]:
    """Return where the stations lie on the map, degrees east and north."""
    return [located(found, answer.longitude, answer.latitude) for answer in found.mapped]


def _around(places: FloatArray) -> tuple[float, float, float, float]:
    """Return a part of the Earth with these places and as much room on each side: west, east, south and north."""
    (west, south), (east, north) = places.min(axis=0).tolist(), places.max(axis=0).tolist()
    room = max(east - west, north - south, LEAST_ROOM_DEG)
    return west - room, east + room, south - room, north + room


def _place(at: Sequence[float], centre: tuple[float, float]) -> list[float]:
    """Return how far a place is from the middle, km to the east and to the south, as a page counts; both in degrees east and north."""
    narrowing = math.cos(math.radians(centre[1]))
    return [round((at[0] - centre[0]) * narrowing * KM_PER_DEGREE, 3), round((centre[1] - at[1]) * KM_PER_DEGREE, 3)]


def _point(answer: StationAnswer, row: list[str], heads: list[str], colour: str, *, gal: bool) -> dict[str, Any]:
    """Return what the page's script draws of one station."""
    unit = acceleration_unit(gal=gal)
    told = [[head, cell] for head, cell in zip(heads[1:], row[1:], strict=True)]
    return {
        "name": answer.label,
        "colour": colour,
        "falls": answer.effect.falls_nominally,
        "told": [*told, [tell("record"), answer.record], [tell("begins"), answer.local_start]],
        "failure": tell(answer.failure) if answer.failure else "",
        "outline": [[round(value / GAL, 1) for value in pair] for pair in answer.outline],
        "peak": f"±{(answer.pga_m_s2 or 0.0) / unit.size:.4g} {unit.name}",
        "end": f"{answer.duration_s:.4g} s",
    }

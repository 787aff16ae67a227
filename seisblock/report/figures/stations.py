"""Map of the stations of an earthquake: result at each station, epicentre, coastline if installed."""

from __future__ import annotations

import math
import unicodedata
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke

from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_, gettext
from seisblock.core.typing import FloatArray
from seisblock.output.figures import style
from seisblock.output.units_display import acceleration_unit
from seisblock.records.site import EARTH_RADIUS_KM, great_circle_km, unwrap_longitude
from seisblock.report.coastline import coastlines
from seisblock.report.figures.probability import SHADES
from seisblock.report.text.map import EVENT_WORDS, preparation_texts
from seisblock.studies.map.station_response import StationBody, StationModel
from seisblock.studies.map.stations import StationReport, Stations
from seisblock.studies.map.surveyed_places import SurveyComparison

Box = tuple[float, float, float, float]
"""West, south, east and north limit, fractions of the map."""

SIDES = ((1, 1), (-1, 1), (1, -1), (-1, -1))
"""Candidate sides of a label (east, north), in order of preference."""

LETTER, LINE, LABEL_OFFSET = 0.034, 0.07, 0.03
"""Width of a Latin character (half a Japanese one), line height, and offset from the point, fractions of a 35 mm map."""

DOT = 0.012
"""Half width of a point, fraction of the map."""


@dataclass(frozen=True)
class Place:
    """A named point, fractions of the map."""

    name: str
    east: float
    north: float


def place_labels(places: Sequence[Place], occupied: Sequence[Box], dots: Sequence[Place] = ()) -> Iterator[tuple[Place, tuple[int, int]]]:
    """Yield the points whose labels fit, with the side; the first point always, on the side with least overlap.

    Parameters
    ----------
    places : sequence of Place
        In order of priority.
    occupied : sequence of Box
        Areas without labels.
    dots : sequence of Place
        Points that labels should not cover if avoidable.

    Examples
    --------
    >>> [side for _, side in place_labels([Place("A", 0.5, 0.5), Place("B", 0.505, 0.5), Place("C", 0.98, 0.2)], [])]
    [(1, 1), (-1, 1), (-1, 1)]
    """
    boxes_taken = list(occupied)
    dot_boxes = [(dot.east - DOT, dot.north - DOT, dot.east + DOT, dot.north + DOT) for dot in dots]
    for place in places:
        boxes = {side: label_box(place, side) for side in SIDES}
        hidden = {side: sum(overlap_area(box, obstacle) for obstacle in boxes_taken) + _area_off_map(box) for side, box in boxes.items()}
        covered = {side: sum(overlap_area(box, dot) for dot in dot_boxes) for side, box in boxes.items()}
        # labels and forbidden areas take precedence over points; ties keep the order of SIDES
        best = min(SIDES, key=lambda side: (hidden[side], covered[side]))
        if hidden[best] > 0.0 and place is not places[0]:
            continue
        boxes_taken.append(boxes[best])
        yield place, best


def label_box(place: Place, side: tuple[int, int]) -> Box:
    """Return the box of a label on one side of its point."""
    wide = LETTER * sum(2 if unicodedata.east_asian_width(letter) in "WF" else 1 for letter in place.name)
    west = place.east + LABEL_OFFSET if side[0] > 0 else place.east - LABEL_OFFSET - wide
    south = place.north if side[1] > 0 else place.north - LINE
    return west, south, west + wide, south + LINE


def overlap_area(a: Box, b: Box) -> float:
    """Return the overlap area of two boxes."""
    across, along = min(a[2], b[2]) - max(a[0], b[0]), min(a[3], b[3]) - max(a[1], b[1])
    return max(across, 0.0) * max(along, 0.0)


def _area_off_map(box: Box) -> float:
    """Return the area of a box outside the map."""
    return (box[2] - box[0]) * (box[3] - box[1]) - overlap_area(box, (0.0, 0.0, 1.0, 1.0))


COAST = "#5b7f95"

MAX_NAMES = 5
"""Labelled stations, in order of severity, and labelled surveyed places, at most."""

EDGE, RIM = ("0.25", 0.5), ("black", 1.5)
"""Colour and width of the rim of a station, and of one at which the body likely overturns."""

HALO = [withStroke(linewidth=2.0, foreground="white")]
KM_PER_DEGREE = EARTH_RADIUS_KM * math.pi / 180.0
MARGIN = 0.08
"""Margin around the outermost points over the extent."""

NORTH = 0.95
"""Horizontal position of the north arrow, fraction of the map."""

SCALE_AT = ((0.03, 0.02, 0.32, 0.15), (0.68, 0.02, 0.97, 0.15), (0.03, 0.85, 0.32, 0.98))
"""Candidate boxes of the scale bar (west, south, east, north), fractions of the map; the emptiest is used."""

NORTH_AT = (NORTH - 0.05, 0.75, NORTH + 0.05, 1.0)
"""Box of the north arrow, fractions of the map."""

STAR = (0.17, 0.16, 0.03)
"""Extent of the epicentre symbol with label to the sides, down and up, fractions of the map."""

HALF_TURN = 180.0
"""Longitude of the date line, degrees."""

MIN_EXTENT_KM = 10.0
"""Smallest extent of a map, km."""

MAX_DISTANCE_KM = 1000.0
"""Largest distance of epicentre and surveyed places from the centre of the stations to be included, km."""


def figure(stations: Stations, model: StationModel | None, *, gal: bool = True, surveys: Sequence[SurveyComparison] = ()) -> Figure:
    """Return the map: a point for each station with coordinates.

    Parameters
    ----------
    stations : Stations
    model : StationModel or None
        Model of the colours; PGA if None.
    gal : bool
        PGA in gal if true, else m/s².
    surveys : sequence of SurveyComparison
        Surveyed cemeteries: squares coloured by overturning rate, or by the PGA inferred from the stones.

    Raises
    ------
    ParameterError
        If no station has coordinates.
    """
    if not stations.mapped:
        raise ParameterError("cannot draw the map: no station has coordinates")
    fig = style.titled_figure(map_title(stations, model), width=7.2, height=6.4)
    axis = fig.add_subplot(1, 1, 1)
    values, label, max_value = colour_values(stations, model, gal=gal)
    places = np.array([map_position(stations, answer.longitude, answer.latitude) for answer in stations.mapped])
    order = np.arange(len(places))[::-1]  # most severe on top
    rims = [RIM if answer.effect.likely_overturns else EDGE for answer in stations.mapped[::-1]]
    points = axis.scatter(
        places[order, 0],
        places[order, 1],
        c=values[order],
        cmap=SHADES,
        norm=Normalize(0.0, max_value),
        s=34,
        edgecolors=[colour for colour, _ in rims],
        linewidths=[width for _, width in rims],
        zorder=3,
    )
    if surveys:
        squares = np.array([map_position(stations, survey.surveyed.longitude, survey.surveyed.latitude) for survey in surveys])
        colours = [survey_value(survey, model, gal=gal) for survey in surveys]
        norm = Normalize(0.0, max_value)
        axis.scatter(squares[:, 0], squares[:, 1], c=colours, cmap=SHADES, norm=norm, marker="s", s=52, edgecolor="black", zorder=3.5)
    _draw_epicentre(axis, stations)
    scale = _set_extent(axis, map_extent_points(stations, surveys))
    if coast := coastlines(*axis.get_xlim(), *axis.get_ylim()):
        axis.add_collection(LineCollection(coast, colors=COAST, linewidths=0.8, zorder=1.5))
    _draw_names(axis, stations, surveys, scale)
    fig.colorbar(points, ax=axis, label=label, shrink=0.8, pad=0.02)
    return fig


def map_position(stations: Stations, longitude: float | None, latitude: float | None) -> tuple[float, float]:
    """Return degrees east and north on the map; longitudes are unwrapped across the date line.

    Parameters
    ----------
    stations : Stations
    longitude, latitude : float, degrees
    """
    first = next((answer.longitude for answer in stations.answers if answer.is_mapped), None)
    return unwrap_longitude(longitude or 0.0, first or 0.0), latitude or 0.0


def epicentre_position(stations: Stations) -> tuple[float, float] | None:
    """Return the map position of the epicentre, degrees east and north, None if unknown.

    Parameters
    ----------
    stations : Stations
    """
    earthquake = stations.earthquake
    if earthquake is None or earthquake.place is None:
        return None
    return map_position(stations, earthquake.longitude_deg, earthquake.latitude_deg)


def map_extent_points(survey_map: Stations, surveys: Sequence[SurveyComparison] = ()) -> FloatArray:
    """Return the points that define the extent of the map: stations, and epicentre and surveyed places nearby.

    Parameters
    ----------
    survey_map : Stations
    surveys : sequence of SurveyComparison

    Returns
    -------
    (n, 2) array, degrees
        East and north.
    """
    stations = np.array([map_position(survey_map, answer.longitude, answer.latitude) for answer in survey_map.mapped])
    epicentre = epicentre_position(survey_map)
    further_points = [map_position(survey_map, survey.surveyed.longitude, survey.surveyed.latitude) for survey in surveys] + (
        [epicentre] if epicentre else []
    )
    east, north = 0.5 * (stations.min(axis=0) + stations.max(axis=0))
    nearby = [point for point in further_points if great_circle_km((point[1], point[0]), (north, east)) <= MAX_DISTANCE_KM]
    return np.vstack([stations, *nearby])


def colour_values(stations: Stations, model: StationModel | None, *, gal: bool) -> tuple[FloatArray, str, float]:
    """Return value of each station on the map, label with unit, and upper end of the colour scale."""
    if model is None:
        unit = acceleration_unit(gal=gal)
        values = np.array([(answer.pga_m_s2 or 0.0) / unit.size for answer in stations.mapped])
        return values, f"PGA ({unit.name})", float(values.max()) or 1.0
    if isinstance(model, StationBody):
        name = gettext("probability of overturning") if model.runs else gettext(EVENT_WORDS.get(model.event, N_("event")))
        if any(answer.effect.likely_overturns for answer in stations.mapped):
            name = gettext("probability of overturning; thick rim: likely overturns")
        return np.array([_overturned_share(answer) for answer in stations.mapped]), name, 1.0
    return np.array([answer.effect.rate or 0.0 for answer in stations.mapped]), gettext("overturning rate"), 1.0


def survey_value(answer: SurveyComparison, model: StationModel | None, *, gal: bool) -> float:
    """Return the value of a surveyed place on the scale of the stations: overturning rate, or PGA inferred from the stones.

    Parameters
    ----------
    answer : SurveyComparison
    model : StationModel or None
    gal : bool
    """
    if model is not None:
        return answer.surveyed.fallen / answer.surveyed.stones
    pga_values = (answer.estimate.pga_m_s2, *answer.estimate.pga_interval_m_s2)
    return next((pga for pga in pga_values if pga is not None), 0.0) / acceleration_unit(gal=gal).size


def _overturned_share(answer: StationReport) -> float:
    """Return the overturning probability at a station, or 0 or 1 without samples."""
    effect = answer.effect
    return float(effect.happened or False) if effect.probability is None else effect.probability


def map_title(stations: Stations, model: StationModel | None, *, between: str = style.SEPARATOR) -> str:
    """Return the title: magnitude, name and time of the earthquake, the body, and the scaling of the records.

    Parameters
    ----------
    stations : Stations
    model : StationModel or None
    between : str
        Separator of the parts.
    """
    earthquake = stations.earthquake
    parts = []
    if earthquake is not None:
        parts += [f"M {earthquake.magnitude:.2g}"] if earthquake.magnitude else []
        parts += [earthquake.name, stations.origin_told]
    parts += [gettext(model.name)] if model is not None else []
    parts += [gettext(text) for text in preparation_texts(stations.preparation)]
    return between.join(part for part in parts if part)


def _draw_epicentre(axis: Axes, stations: Stations) -> None:
    """Draw the epicentre as a labelled star."""
    at = epicentre_position(stations)
    if at is None:
        return
    axis.scatter(*at, marker="*", s=170, color="white", edgecolor="black", linewidth=1.0, zorder=4)
    axis.annotate(
        gettext("epicentre"),
        at,
        xytext=(0, -13),
        textcoords="offset points",
        ha="center",
        va="top",
        fontsize=8,
        path_effects=HALO,
        zorder=5,
    )


def _set_extent(axis: Axes, places: FloatArray) -> Box:
    """Set extent and aspect of the map, draw scale bar and north arrow; return the box of the scale bar."""
    (west, south), (east, north) = places.min(axis=0), places.max(axis=0)
    middle = 0.5 * (south + north)
    # equirectangular projection true to scale at the middle latitude
    narrowing = max(math.cos(math.radians(middle)), 0.01)
    km = np.array([(east - west) * narrowing, north - south]) * KM_PER_DEGREE
    half_width = 0.5 * max(float(km.max()) * (1.0 + 2.0 * MARGIN), MIN_EXTENT_KM) / KM_PER_DEGREE
    axis.set_xlim(0.5 * (west + east) - half_width / narrowing, 0.5 * (west + east) + half_width / narrowing)
    axis.set_ylim(middle - half_width, middle + half_width)
    axis.set_aspect(1.0 / narrowing)
    axis.set_xlabel(gettext("longitude (°)"))
    axis.set_ylabel(gettext("latitude (°)"))
    axis.ticklabel_format(useOffset=False)
    if max(abs(west), abs(east)) > HALF_TURN:
        axis.xaxis.set_major_formatter(lambda east, _: f"{unwrap_longitude(east, 0.0):g}".replace("-", "\N{MINUS SIGN}"))
    axis.locator_params(nbins=6)
    corner, extent = np.array([axis.get_xlim()[0], axis.get_ylim()[0]]), 2.0 * half_width * np.array([1.0 / narrowing, 1.0])
    east, north = ((places - corner) / extent).T
    at = min(SCALE_AT, key=lambda box: np.count_nonzero((east > box[0]) & (east < box[2]) & (north > box[1]) & (north < box[3])))
    _scale_bar(axis, 2.0 * half_width * KM_PER_DEGREE, at)
    arrow = {"arrowstyle": "-|>", "color": "black"}
    axis.annotate("", (NORTH, 0.97), xytext=(NORTH, 0.88), xycoords="axes fraction", arrowprops=arrow, zorder=5)
    axis.text(NORTH, 0.87, gettext("N"), transform=axis.transAxes, ha="center", va="top", fontsize=9, path_effects=HALO, zorder=5)
    return at


def _scale_bar(axis: Axes, across_km: float, at: Box) -> None:
    """Draw a scale bar of round length, at most a quarter of the map."""
    quarter = across_km / 4.0
    step = 10.0 ** math.floor(math.log10(quarter))
    length = next(factor * step for factor in (5.0, 2.0, 1.0) if factor * step <= quarter * 1.001)
    share = length / across_km
    style: dict[str, Any] = {"transform": axis.transAxes, "zorder": 5}
    x, y = at[0] + 0.02, at[1] + 0.03
    axis.plot([x, x + share], [y, y], color="black", linewidth=2.5, solid_capstyle="butt", path_effects=HALO, **style)
    axis.text(x + 0.5 * share, y + 0.01, f"{length:g} km", ha="center", va="bottom", fontsize=8, path_effects=HALO, **style)


def _draw_names(axis: Axes, stations: Stations, surveys: Sequence[SurveyComparison], scale: Box) -> None:
    """Label the most severe station, then surveyed places and the next stations as far as labels fit."""
    (left, right), (bottom, top) = axis.get_xlim(), axis.get_ylim()

    def to_place(name: str, at: tuple[float, float]) -> Place:
        return Place(name, (at[0] - left) / (right - left), (at[1] - bottom) / (top - bottom))

    points = [
        to_place(answer.station or answer.record, map_position(stations, answer.longitude, answer.latitude)) for answer in stations.mapped
    ]
    squares = [
        to_place(answer.surveyed.place, map_position(stations, answer.surveyed.longitude, answer.surveyed.latitude)) for answer in surveys
    ]
    epicentre, occupied = epicentre_position(stations), [scale, NORTH_AT]
    if epicentre is not None:
        star = to_place("", epicentre)
        occupied.append((star.east - STAR[0], star.north - STAR[1], star.east + STAR[0], star.north + STAR[2]))
    for place, (east, north) in place_labels([*points[:1], *squares[:MAX_NAMES], *points[1:MAX_NAMES]], occupied, [*points, *squares]):
        at = (left + place.east * (right - left), bottom + place.north * (top - bottom))
        axis.annotate(
            place.name, at, xytext=(6 * east, 4 * north), textcoords="offset points", fontsize=8, path_effects=HALO, zorder=6,
            ha="left" if east > 0 else "right", va="baseline" if north > 0 else "top",
        )  # fmt: skip

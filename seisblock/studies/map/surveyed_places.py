"""Ground motion inferred from fallen gravestones, compared with surrounding stations."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import combinations
from os import PathLike
from pathlib import Path

from seisblock.bodies.cemetery.cemetery import Cemetery
from seisblock.core.errors import BodyError
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.io.csv_table import parse_heading
from seisblock.core.io.spreadsheet import read_sheet
from seisblock.records.site import great_circle_km, valid_coordinates
from seisblock.studies.map.stations import StationReport, Stations
from seisblock.studies.survey.estimate import ShakingEstimate, estimate_shaking
from seisblock.studies.survey.likelihood import counted_survey

COLUMNS = {
    "place": ("place", "場所", "地点"),
    "latitude": ("latitude", "緯度"),
    "longitude": ("longitude", "経度"),
    "stones": ("stones", "墓石", "墓石数"),
    "fallen": ("fallen", "転倒", "転倒数"),
}
"""Column headings of a list of surveys."""

_HEADINGS = {word: key for key, words in COLUMNS.items() for word in words}

STATION_CONTRADICTION = N_(
    "{place} and station {station} ({distance:.1f} km) are inconsistent: JMA intensity {low:.1f} to {high:.1f} from the stones, "
    "{intensity:.1f} measured"
)
PLACE_CONTRADICTION = N_(
    "{one} and {other} ({distance:.1f} km) are inconsistent: JMA intensity {low:.1f} to {high:.1f} and {lower:.1f} to "
    "{higher:.1f} from the stones"
)

MAX_NEIGHBOURS = 3
"""Number of stations used for interpolation by inverse distance."""

MAX_NEIGHBOUR_KM = 100.0
"""Largest distance of a station used for interpolation, km."""

MAX_COMPARISON_KM = 10.0
"""Largest distance at which shaking is comparable, km."""

INTENSITY_TOLERANCE = 0.5
"""Tolerance of the intensity of a station against the interval of the stones: half a JMA class."""


@dataclass(frozen=True)
class SurveyedPlace:
    """Observed counts of a cemetery.

    Parameters
    ----------
    place : str
    latitude, longitude : float, degrees
        North and east.
    stones, fallen : int
    """

    place: str
    latitude: float
    longitude: float
    stones: int
    fallen: int


@dataclass(frozen=True)
class Neighbour:
    """A station near a surveyed place.

    Parameters
    ----------
    station : str
    distance_km : float
    jma_intensity : float, 1
    """

    station: str
    distance_km: float
    jma_intensity: float


@dataclass(frozen=True)
class SurveyComparison:
    """Inferred ground motion of a surveyed place with the stations around it.

    Parameters
    ----------
    surveyed : SurveyedPlace
    estimate : ShakingEstimate
        Of the fallen stones alone.
    neighbours : tuple of Neighbour
        Stations with an intensity, nearest first, within ``MAX_NEIGHBOUR_KM``.
    expected_intensity : float or None, 1
        Mean of the stations, weighted by inverse distance.
    residual : float or None, 1
        Estimated minus expected intensity; None for one-sided estimates.
    """

    surveyed: SurveyedPlace
    estimate: ShakingEstimate
    neighbours: tuple[Neighbour, ...]
    expected_intensity: float | None
    residual: float | None


def read_surveys(name: str | PathLike[str]) -> tuple[SurveyedPlace, ...]:
    """Return the surveyed places of a table (CSV, .xlsx).

    Columns: ``place``, ``latitude``, ``longitude``, ``stones``, ``fallen`` (場所, 緯度, 経度, 墓石, 転倒).

    Raises
    ------
    BodyError
        If the file cannot be read, a column is missing, or a row is invalid; the message names the line.
    """
    sheet = read_sheet(Path(name), str(name))
    (_, header), rows = sheet.split_header(_HEADINGS) if sheet.rows else ((0, []), ())
    columns = [parse_heading(cell, _HEADINGS)[0] for cell in header]
    missing = [key for key in COLUMNS if key not in columns]
    if missing:
        raise BodyError(
            "{name}: a list of surveys requires the columns {columns}; missing: {missing}",
            name=name,
            columns=list(COLUMNS),
            missing=missing,
        )
    if not rows:
        raise BodyError("{name}: the list of surveys is empty", name=name)
    return tuple(sheet.parse_rows(columns, rows, _place))


def _place(row: dict[str, str], line: int) -> SurveyedPlace:
    place, *numbers = cells = [row.get(key, "") for key in COLUMNS]
    try:
        latitude, longitude = map(float, numbers[:2])
        stones, fallen = map(int, numbers[2:])
    except ValueError:
        raise BodyError("expected degrees and whole numbers of stones, found {found}", found=cells) from None
    if valid_coordinates(latitude, longitude) is None:
        raise BodyError("{place}: {latitude}, {longitude} is not a valid position", place=place, latitude=latitude, longitude=longitude)
    if not 0 <= fallen <= stones or stones == 0:
        raise BodyError("{fallen} of {stones} stones overturned is impossible", fallen=fallen, stones=stones)
    return SurveyedPlace(place or lazy_gettext("line {line}", line=line), latitude, longitude, stones, fallen)


def compare_surveys(places: Iterable[SurveyedPlace], station_survey: Stations, cemetery: Cemetery) -> tuple[SurveyComparison, ...]:
    """Return the comparison of each surveyed place, in the given order.

    Parameters
    ----------
    places : iterable of SurveyedPlace
    station_survey : Stations
    cemetery : Cemetery
        Population of stones, sampled by each survey.
    """
    stations = [answer for answer in station_survey.mapped if answer.jma_intensity is not None]
    return tuple(_compare_place(place, stations, cemetery) for place in places)


def _compare_place(place: SurveyedPlace, stations: Sequence[StationReport], cemetery: Cemetery) -> SurveyComparison:
    estimate = estimate_shaking(counted_survey(cemetery, place.fallen, place.stones), None)
    neighbours = (
        Neighbour(station.station or station.record, _distance_km(place, station), station.jma_intensity)
        for station in stations
        if station.jma_intensity is not None
    )
    nearest = sorted(
        (station for station in neighbours if station.distance_km <= MAX_NEIGHBOUR_KM), key=lambda station: station.distance_km
    )[:MAX_NEIGHBOURS]
    if not nearest:
        return SurveyComparison(place, estimate, (), None, None)
    weights = [1.0 / max(station.distance_km, 0.1) for station in nearest]
    expected = sum(weight * station.jma_intensity for weight, station in zip(weights, nearest, strict=True)) / sum(weights)
    residual = None if estimate.jma_intensity is None else estimate.jma_intensity - expected
    return SurveyComparison(place, estimate, tuple(nearest), expected, residual)


def _distance_km(place: SurveyedPlace, station: StationReport) -> float:
    return great_circle_km((place.latitude, place.longitude), (station.latitude or 0.0, station.longitude or 0.0))


def contradictions(answers: Sequence[SurveyComparison]) -> list[str]:
    """Return a sentence for each inconsistent pair of nearby places, or of a place and a station.

    Two surveyed places are inconsistent if their intensity intervals are disjoint, a place and a station if the intensity of the station
    lies more than ``INTENSITY_TOLERANCE`` outside the interval; pairs more than ``MAX_COMPARISON_KM`` apart are not compared.

    Parameters
    ----------
    answers : sequence of SurveyComparison
    """
    messages: list[str] = []
    for answer in answers:
        low, high = _interval(answer)
        for item in answer.neighbours:
            if item.distance_km <= MAX_COMPARISON_KM and not low - INTENSITY_TOLERANCE <= item.jma_intensity <= high + INTENSITY_TOLERANCE:
                values = {"low": low, "high": high, "distance": item.distance_km, "intensity": item.jma_intensity}
                messages.append(lazy_gettext(STATION_CONTRADICTION, place=answer.surveyed.place, station=item.station, **values))
    for first, second in combinations(answers, 2):
        (low, high), (lower, higher) = _interval(first), _interval(second)
        coordinates = [(item.surveyed.latitude, item.surveyed.longitude) for item in (first, second)]
        distance = great_circle_km(coordinates[0], coordinates[1])
        if distance <= MAX_COMPARISON_KM and (low > higher or lower > high):
            values = {"low": low, "high": high, "lower": lower, "higher": higher, "distance": distance}
            messages.append(lazy_gettext(PLACE_CONTRADICTION, one=first.surveyed.place, other=second.surveyed.place, **values))
    return messages


def _interval(answer: SurveyComparison) -> tuple[float, float]:
    """Return the intensity interval of a survey; one-sided estimates are limited by 0 and 7.5."""
    low, high = answer.estimate.jma_intensity_interval
    return 0.0 if low is None else low, 7.5 if high is None else high

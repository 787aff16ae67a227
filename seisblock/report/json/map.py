"""JSON document of ``seisblock map``: stations of an earthquake with their results."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated

from msgspec import Meta, Struct

from seisblock.core.i18n import N_, lazy_gettext
from seisblock.output.json.schema import Document, DocumentSchema, EarthquakeEntry, Result, earthquake_entry, fill
from seisblock.references import papers
from seisblock.report.json.assessment import AssessmentEntry, assessment_entry
from seisblock.studies.map.earthquakes import ONE_DAY
from seisblock.studies.map.station_response import StationBody, StationModel
from seisblock.studies.map.station_row import station_row
from seisblock.studies.map.stations import StationReport, Stations
from seisblock.studies.map.surveyed_places import Neighbour, SurveyComparison, contradictions


class MapParameters(Struct, frozen=True, kw_only=True):
    """Parameters of the command.

    Parameters
    ----------
    subject : str
        Body or cemetery at each station; empty for measures only.
    solver : str
        Solver of a body, ``gravestones`` for a cemetery; empty for none.
    runs, seed : int
        Number of samples, and their seed.
    step_deg : float
        Step of the azimuths; 0 for components only (``jump``, ``uplift``).
    scale : float
        Factor on the records.
    target_pga_m_s2, target_jma_intensity : float or None
        To which each record is scaled.
    """

    subject: str
    solver: str
    runs: int
    seed: int
    step_deg: float
    scale: float
    target_pga_m_s2: float | None
    target_jma_intensity: float | None


class StationEntry(Result, frozen=True, kw_only=True):
    """One station.

    Parameters
    ----------
    record : str
        File name.
    station, seed_id, name : str
        Code, network.station.location.channels, and name; empty if not in the file.
    latitude, longitude : float or None
        Degrees north and east; null if not in the file.
    epicentral_distance_km : float or None
    local_start : str
        Local time of the first sample.
    pga_m_s2, pgv_m_s : float or None
        The larger of the horizontal components.
    jma_intensity : float or None, 1
    azimuth_deg : float or None
        The worst direction, clockwise from north.
    rate : float or None
        Share of the cemetery's stones that fall.
    happened : bool or None
        Whether the event of the solver occurred: overturning (respond, rock), sliding, jump, uplift.
    overturned : bool or None
        Null for solvers without overturning.
    probability : float or None
        Overturning probability under any horizontal component.
    max_slip_m : float or None
        Maximum displacement of the body.
    max_uplift_m : float or None
        Maximum uplift of a corner of a body on springs.
    failure : str or None
        Reason of a missing result.
    doubts : str or None
        Quality flags of the record.
    history : str or None
        Processing steps, including floor motion.
    assessment : AssessmentEntry or None
        Of the body under any horizontal component; null without samples.
    """

    record: str
    station: str
    seed_id: str
    name: str
    latitude: float | None
    longitude: float | None
    epicentral_distance_km: float | None
    local_start: str
    pga_m_s2: float | None
    pgv_m_s: float | None
    jma_intensity: float | None
    azimuth_deg: float | None
    rate: float | None
    happened: bool | None
    overturned: bool | None
    probability: float | None
    max_slip_m: float | None
    max_uplift_m: float | None
    failure: str | None
    doubts: str | None
    history: str | None
    assessment: AssessmentEntry | None


class SurveyEntry(Struct, frozen=True, kw_only=True):
    """A surveyed place with the stations around it.

    Parameters
    ----------
    place : str
    latitude, longitude : float
        Degrees north and east.
    stones_count, fallen_count : int
    pga_m_s2 : float or None
        From the fallen stones; null for one-sided estimates.
    pga_interval_m_s2 : two floats or None
    jma_intensity : float or None, 1
    jma_intensity_interval : two floats or None, 1
    neighbours : list of Neighbour
        The nearest stations.
    expected_jma_intensity : float or None, 1
        Mean of the stations, weighted by inverse distance.
    residual_jma_intensity : float or None, 1
        Estimate minus expected value.
    """

    place: str
    latitude: float
    longitude: float
    stones_count: int
    fallen_count: int
    pga_m_s2: float | None
    pga_interval_m_s2: tuple[float | None, float | None]
    jma_intensity: float | None
    jma_intensity_interval: tuple[float | None, float | None]
    neighbours: tuple[Neighbour, ...]
    expected_jma_intensity: float | None
    residual_jma_intensity: float | None


EXTRA_KEYS = {
    "earthquake": Annotated[EarthquakeEntry | None, Meta(description="Earthquake.")],
    "surveys": Annotated[tuple[SurveyEntry, ...], Meta(description="Surveyed cemeteries with nearby stations.")],
    "contradictions": Annotated[tuple[str, ...], Meta(description="Inconsistent pairs of places, or of a place and a station.")],
}
MAP = DocumentSchema("map", MapParameters, StationEntry, EXTRA_KEYS)

_SURVEY_CITATIONS = papers("gravestones as fitted", "intensity of a velocity")

UNMAPPED = N_("{station}: no coordinates in the file; listed, not on the map")
FAILED = N_("{station}: {failure}")
QC_FLAGGED = N_("{count} record(s) with warnings; {station}: {doubt}")

DATES_APART = N_("the records begin {days:.0f} days apart, {first} ({one}) and {last} ({other}); a map requires records of one earthquake")


def document(
    stations: Stations, model: StationModel | None, surveys: Sequence[SurveyComparison] = (), *, has_floor_motion: bool = False
) -> Document:
    """Return the document of the stations of an earthquake, largest response first.

    Parameters
    ----------
    stations : Stations
    model : StationBody, StationCemetery or None
    surveys : sequence of SurveyComparison
    has_floor_motion : bool
        Whether the motions are floor motions.
    """
    body = model if isinstance(model, StationBody) else None
    parameters = MapParameters(
        subject=model.name if model else "",
        solver="" if model is None else body.solver if body else "gravestones",
        runs=getattr(model, "runs", 0),
        seed=getattr(model, "seed", 0),
        step_deg=getattr(model, "step_deg", 0.0) if body is None or body.is_directional else 0.0,
        scale=stations.preparation.scale,
        target_pga_m_s2=stations.preparation.target_pga,
        target_jma_intensity=stations.preparation.target_jma,
    )
    return MAP.document(
        parameters,
        [(None, _station_entry(answer)) for answer in stations.answers],
        citations=tuple(dict.fromkeys((*papers("measures"), *(model.citations if model else ()), *(_SURVEY_CITATIONS if surveys else ())))),
        warnings=warnings(stations),
        has_floor_motion=has_floor_motion,
        earthquake=None if stations.earthquake is None else earthquake_entry(stations.earthquake),
        surveys=tuple(map(survey_entry, surveys)),
        contradictions=tuple(contradictions(surveys)),
    )


def survey_entry(answer: SurveyComparison) -> SurveyEntry:
    """Return the entry of a surveyed place."""
    survey, estimate = answer.surveyed, answer.estimate
    return fill(
        SurveyEntry,
        survey,
        estimate,
        stones_count=survey.stones,
        fallen_count=survey.fallen,
        neighbours=answer.neighbours,
        expected_jma_intensity=answer.expected_intensity,
        residual_jma_intensity=answer.residual,
    )


def _station_entry(report: StationReport) -> StationEntry:
    assessment = report.effect.assessment
    return StationEntry(**station_row(report), assessment=None if assessment is None else assessment_entry(assessment))


def warnings(stations: Stations) -> list[str]:
    """Return warnings on stations: no result, no coordinates, different dates, number of records with warnings."""
    texts: list[str] = _date_warnings(stations)
    texts += [_failure_text(answer) for answer in stations.answers if answer.failure]
    texts += [
        lazy_gettext(UNMAPPED, station=answer.label) for answer in stations.answers if answer.pga_m_s2 is not None and not answer.is_mapped
    ]
    flagged = [answer for answer in stations.answers if answer.doubts]
    return (
        [*texts, lazy_gettext(QC_FLAGGED, count=len(flagged), station=flagged[0].label, doubt=flagged[0].doubts[0])] if flagged else texts
    )


def _date_warnings(stations: Stations) -> list[str]:
    """Return a warning if records without earthquake header begin on different days."""
    starts = sorted(((answer.start, answer) for answer in stations.answers if answer.start is not None), key=lambda pair: pair[0])
    if not starts or starts[-1][0] - starts[0][0] <= ONE_DAY:
        return []
    (start, earliest), (end, latest) = starts[0], starts[-1]
    days = (end - start) / ONE_DAY
    return [
        lazy_gettext(DATES_APART, days=days, first=earliest.local_start, one=earliest.label, last=latest.local_start, other=latest.label)
    ]


def _failure_text(answer: StationReport) -> str:
    """Return the reason of a missing result, prefixed by station or file once."""
    failure = answer.failure or ""
    return failure if answer.record in failure else lazy_gettext(FAILED, station=answer.label, failure=failure)

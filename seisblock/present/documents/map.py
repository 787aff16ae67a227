"""What ``seisblock map`` answers: an earthquake's stations, and what each did."""

from __future__ import annotations

from typing import Annotated

from msgspec import Meta, Struct

from seisblock.present.documents.kind import Document, EarthquakeEntry, Kind, Result, entry_of_earthquake
from seisblock.references import papers
from seisblock.studies.stations.effects import StandingBody, WhatStands
from seisblock.studies.stations.row import row_of
from seisblock.studies.stations.survey import StationAnswer, Stations
from seisblock.words import noted, said


class MapParameters(Struct, frozen=True, kw_only=True):
    """What was chosen.

    Parameters
    ----------
    subject : str
        What stands at each station; empty where only the shaking was asked for.
    solver : str
        Which model follows it: ``respond`` of a body, ``gravestones`` of a cemetery; empty for none.
    runs, seed : int
        Plausible versions behind a probability, and their seed.
    step_deg : float
        Between the directions that are looked in.
    """

    subject: str
    solver: str
    runs: int
    seed: int
    step_deg: float


class StationEntry(Result, frozen=True, kw_only=True):
    """One station.

    Parameters
    ----------
    record : str
        File name.
    station, name : str
        Empty where the file has none.
    latitude, longitude : float or None
        Degrees north and east; null where the file does not say.
    epicentral_distance_km : float or None
    local_start : str
        Time of the first sample on the network's own clock.
    pga_m_s2, pgv_m_s : float or None
        The larger of the horizontal components.
    jma_intensity : float or None, 1
    azimuth_deg : float or None
        The worst direction, clockwise from north.
    rate : float or None
        Share of the cemetery's stones that fall.
    overturned : bool or None
    probability : float or None
        Share of the plausible versions of body and shaking that fall.
    max_slip_m : float or None
    failure : str or None
        Why there is no answer.
    doubts : str or None
        What a careful reader notices about the record.
    """

    record: str
    station: str
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
    overturned: bool | None
    probability: float | None
    max_slip_m: float | None
    failure: str | None
    doubts: str | None


MAP = Kind("map", MapParameters, StationEntry, {"earthquake": Annotated[EarthquakeEntry | None, Meta(description="What shook.")]})

UNMAPPED = noted("{station}: its file does not say where it is: it is listed, and on no map")
FAILED = noted("{station}: {failure}")
DOUBTED = noted("{count} record(s) are doubtful; {station}: {doubt}")


def document(found: Stations, subject: WhatStands | None) -> Document:
    """Return the document of an earthquake's stations, the worst first.

    Parameters
    ----------
    found : Stations
    subject : StandingBody, StandingStones or None
    """
    body = isinstance(subject, StandingBody)
    parameters = MapParameters(
        subject=subject.name if subject else "",
        solver="" if subject is None else "respond" if body else "gravestones",
        runs=getattr(subject, "runs", 0),
        seed=getattr(subject, "seed", 0),
        step_deg=getattr(subject, "step_deg", 0.0),
    )
    return MAP.document(
        parameters,
        [(None, StationEntry(**row_of(answer))) for answer in found.answers],
        citations=(*papers("measures"), *(subject.citations if subject else ())),
        warnings=warnings(found),
        earthquake=None if found.earthquake is None else entry_of_earthquake(found.earthquake),
    )


def warnings(found: Stations) -> list[str]:
    """Return what is to be known of some stations, a sentence each: no answer, no place; of doubts how many records have them."""
    told: list[str] = [_failure(each) for each in found.answers if each.failure]
    told += [said(UNMAPPED, station=each.label) for each in found.answers if each.pga_m_s2 is not None and not each.is_mapped]
    doubted = [each for each in found.answers if each.doubts]
    return [*told, said(DOUBTED, count=len(doubted), station=doubted[0].label, doubt=doubted[0].doubts[0])] if doubted else told


def _failure(answer: StationAnswer) -> str:
    """Return why a station has no answer, its file or its name said once."""
    failure = answer.failure or ""
    return failure if answer.record in failure else said(FAILED, station=answer.label, failure=failure)

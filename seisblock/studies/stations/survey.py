"""Station by station: what was measured, what it did, and where that is; the worst first."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from datetime import datetime
from functools import partial
from itertools import groupby
from os import PathLike
from typing import Any, TypeAlias

import numpy as np

from seisblock import checks
from seisblock.errors import ComponentError, KindError, ParameterError, SeisblockError
from seisblock.measures.baseline import ground_history
from seisblock.measures.intensity import jma_intensity
from seisblock.measures.peaks import peak_acceleration, peak_velocity
from seisblock.readers.dispatch import Options
from seisblock.readers.gather import Recording, gather
from seisblock.readers.source import Location
from seisblock.records import Preparation, Record
from seisblock.records.doubtful import refuse_doubtful, sentences
from seisblock.records.site import Earthquake, earthquake_of, epicentral_distance_km, is_of_station, place_of, site_of, told_time
from seisblock.studies.runs import RECORDS, in_threads
from seisblock.studies.stations.earthquakes import are_two, words_of
from seisblock.studies.stations.effects import StandingBody, StationEffect, WhatStands
from seisblock.typing import FloatArray, Progress

AS_READ = Preparation()
"""Nothing is done to a record but what its format needs."""

STRETCHES = 160
"""Of an outline."""


@dataclass(frozen=True)
class StationAnswer:
    """One station.

    Parameters
    ----------
    record : str
        File name.
    station, name : str
        Empty where the file has none.
    latitude, longitude : float or None
        Degrees north and east; None where the file does not say: the station is listed, and on no map.
    epicentral_distance_km : float or None
    local_start : str
        Time of the first sample on the network's own clock.
    pga_m_s2, pgv_m_s : float or None
        The larger of the horizontal components.
    jma_intensity : float or None, 1
        None where it needs components, or samples, that are not there.
    effect : StationEffect
    failure : str or None
        Why there is no answer, or no effect.
    doubts : tuple of str
        What a careful reader notices about the record, and which directions or versions of the body have no answer.
    history : tuple of str
        What was done to it, the storey on which a body stands among it.
    earthquake : Earthquake or None
    origin_told : str
        When that was on the network's own clock.
    outline : tuple of pairs of float, m/s^2
        Least and largest acceleration of the horizontal of the larger peak, in equal stretches of the record.
    duration_s : float
        That of the record.
    start : datetime or None
        Of the record, UTC.
    """

    record: str
    station: str = ""
    name: str = ""
    latitude: float | None = None
    longitude: float | None = None
    epicentral_distance_km: float | None = None
    local_start: str = ""
    pga_m_s2: float | None = None
    pgv_m_s: float | None = None
    jma_intensity: float | None = None
    effect: StationEffect = field(default_factory=StationEffect)
    failure: str | None = None
    doubts: tuple[str, ...] = ()
    history: tuple[str, ...] = ()
    earthquake: Earthquake | None = None
    origin_told: str = ""
    outline: tuple[tuple[float, float], ...] = ()
    duration_s: float = 0.0
    start: datetime | None = None

    @property
    def is_mapped(self) -> bool:
        """Whether it is known where the station is, and what was measured there."""
        return place_of(self.latitude, self.longitude) is not None and self.pga_m_s2 is not None

    @property
    def label(self) -> str:
        """Code and name of the station, else the file's name."""
        return " ".join(part for part in (self.station, self.name) if part) or self.record


@dataclass(frozen=True)
class Stations:
    """The stations of one earthquake, the worst first, those without an answer last.

    Parameters
    ----------
    answers : tuple of StationAnswer
    earthquake : Earthquake or None
    origin_told : str
        When that was on the clock of the network that tells it.
    """

    answers: tuple[StationAnswer, ...]
    earthquake: Earthquake | None
    origin_told: str = ""

    @property
    def mapped(self) -> tuple[StationAnswer, ...]:
        """Those of which it is known where they are."""
        return tuple(answer for answer in self.answers if answer.is_mapped)


Station: TypeAlias = "Location | Recording | Record"
"""What a station may be given as: names, a recording that is yet to be read, or a record."""


def survey_stations(
    records: Station | Iterable[Station],
    subject: WhatStands | None = None,
    *,
    preparation: Preparation = AS_READ,
    reading: Options | None = None,
    strict: bool = False,
    workers: int | None = None,
    progress: Progress | None = None,
) -> Stations:
    """Return what each station of an earthquake measured, and what that did to a body or a cemetery.

    A record that cannot be read, and one with which a subject can do nothing, is an answer with its reason; the others are answered.

    Parameters
    ----------
    records : path, Recording or Record, or several
        Files, folders, patterns, ``@list.txt`` and bundles, see :func:`~seisblock.readers.gather.gather`; taken as they are needed.
    subject : StandingBody, StandingStones or None
        What stands at each station; None for what was measured alone.
    preparation : Preparation
        What is done to each record before.
    reading : Options
        What the caller says of files that do not say it themselves.
    strict : bool
        Whether a record about which there is any doubt has no answer.
    workers : int
        Threads; as many as there are cores when left out.
    progress : callable
        Told the number of stations done, and the number known of.

    Raises
    ------
    ParameterError
        If the records are of two earthquakes, or there is none, or a solver refuses an option of the body whatever the station.

    Examples
    --------
    >>> found = survey_stations("hanmer_springs_2016")
    >>> found.answers[0].station, found.answers[0].latitude, round(found.answers[0].jma_intensity, 1)
    ('HSES', -42.52333, 5.4)
    """
    checks.instance(preparation, Preparation)
    reading = reading or Options()
    if isinstance(subject, StandingBody):
        subject.refuse_wrong()
    work = partial(_answer, subject=subject, preparation=preparation, reading=reading, strict=strict)
    answers: list[StationAnswer] = []
    known: StationAnswer | None = None
    for answer in _with_progress(in_threads(work, _recordings(records, reading), workers=workers, ahead=RECORDS), progress):
        if answer is None:
            continue
        known = _of_one_earthquake(known, answer)
        answers.append(answer)
    if not answers and reading.station is not None:
        raise ParameterError("no station {station!r} among these records", station=reading.station)
    if not answers:
        raise ParameterError("there is no record: name files, folders or bundles of one earthquake")
    answers.sort(key=lambda each: (each.pga_m_s2 is not None, *each.effect.severity, each.pga_m_s2 or 0.0), reverse=True)
    return Stations(tuple(answers), known.earthquake if known else None, known.origin_told if known else "")


def _recordings(records: Station | Iterable[Station], reading: Options) -> Iterator[Recording | Record]:
    """Yield what is read already or about to be, and what names stand for."""
    single = isinstance(records, (str, PathLike, Recording, Record))
    if not single and not isinstance(records, Iterable):
        raise KindError("names or records of stations are needed, found {found}", found=checks.kind_of(records))
    given: Iterable[Any] = [records] if single else records  # type: ignore[assignment]
    for named, some in groupby(given, key=lambda each: isinstance(each, (str, PathLike))):
        if named:
            yield from gather([str(each) for each in some], reading)
        else:
            yield from some


def _with_progress(answers: Iterable[StationAnswer | None], progress: Progress | None) -> Iterator[StationAnswer | None]:
    """Yield answers, and tell how many there are so far."""
    for done, answer in enumerate(answers, start=1):
        if progress is not None:
            progress(done, done)
        yield answer


def _answer(
    recording: Recording | Record, *, subject: WhatStands | None, preparation: Preparation, reading: Options, strict: bool
) -> StationAnswer | None:
    """Return the answer of one station, None for one that was not asked for."""
    if not isinstance(recording, (Recording, Record)):
        raise KindError("names or records of stations are needed, found {found}", found=checks.kind_of(recording))
    name = recording.name if isinstance(recording, Recording) else recording.source.rsplit("/", 1)[-1]
    try:
        record = recording.read(reading) if isinstance(recording, Recording) else recording
        if reading.station is not None and not is_of_station(record, reading.station):
            return None
        if strict:
            refuse_doubtful(record)
        prepared = preparation.apply(record)
    except SeisblockError as error:
        other = reading.station is not None and isinstance(error, ComponentError)  # a file without that station
        return None if other else StationAnswer(name, failure=error.said)
    site, earthquake = site_of(prepared), earthquake_of(prepared)
    where: dict[str, object] = {
        "station": site.code,
        "name": site.name,
        "latitude": site.latitude_deg,
        "longitude": site.longitude_deg,
        "epicentral_distance_km": epicentral_distance_km(prepared),
        "start": prepared.start,
        "local_start": told_time(prepared, prepared.start),
        "doubts": tuple(sentences([prepared])),
        "history": prepared.history,
        "earthquake": earthquake,
        "origin_told": "" if earthquake is None else told_time(prepared, earthquake.origin_time),
    }
    try:
        measured = _measured(prepared)
    except SeisblockError as error:
        return StationAnswer(name, **where, failure=error.said)  # type: ignore[arg-type]
    try:
        effect, failure = subject.under(prepared) if subject is not None else StationEffect(), None
    except SeisblockError as error:
        effect, failure = StationEffect(), error.said
    where["doubts"] = (*sentences([prepared]), *effect.remarks)
    return StationAnswer(name, **where, **measured, effect=effect, failure=failure)  # type: ignore[arg-type]


def _measured(record: Record) -> dict[str, Any]:
    """Return peaks, intensity and outline of a record."""
    rows = [component.acceleration for component in record.horizontals]
    if not rows:
        raise ParameterError("{source}: no horizontal component; it has {codes}", source=record.source, codes=record.codes)
    peaks = [peak_acceleration(row)[0] for row in rows]
    return {
        "pga_m_s2": max(peaks),
        "outline": _outline(rows[peaks.index(max(peaks))]),
        "duration_s": record.duration_s,
        "pgv_m_s": max(peak_velocity(ground_history(row, record.dt), record.dt) for row in rows),
        "jma_intensity": jma_intensity(record),
    }


def _outline(row: FloatArray) -> tuple[tuple[float, float], ...]:
    """Return least and largest value of a row in equal stretches."""
    starts = np.unique(np.linspace(0, row.size, min(STRETCHES, row.size), endpoint=False).astype(int))
    return tuple(zip(np.minimum.reduceat(row, starts).tolist(), np.maximum.reduceat(row, starts).tolist(), strict=True))


def _of_one_earthquake(known: StationAnswer | None, answer: StationAnswer) -> StationAnswer | None:
    """Return the station that tells most of the earthquake of all so far, and refuse another earthquake."""
    if answer.earthquake is None or known is None or known.earthquake is None:
        return known if answer.earthquake is None else answer
    if are_two(known.earthquake, answer.earthquake):
        raise ParameterError(
            "these records are of two earthquakes: {one} ({first}) and {other} ({second}): give those of one",
            one=words_of(known.earthquake),
            first=known.label,
            other=words_of(answer.earthquake),
            second=answer.label,
        )
    return max(known, answer, key=_told_of_earthquake)


def _told_of_earthquake(answer: StationAnswer) -> int:
    """Return how much of what tells two earthquakes apart a station tells: the time, the place."""
    earthquake = answer.earthquake
    return 0 if earthquake is None else (earthquake.origin_time is not None) + (earthquake.place is not None)

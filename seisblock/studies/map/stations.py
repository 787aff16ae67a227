"""Station survey of an earthquake: measures, response and position by station, largest response first."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from datetime import datetime
from functools import partial
from itertools import groupby
from os import PathLike
from typing import Any, TypeAlias

import numpy as np

from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import ComponentError, KindError, ParameterError, SeisblockError
from seisblock.core.typing import FloatArray, Progress
from seisblock.measures import jma_intensity
from seisblock.measures.baseline import ground_history
from seisblock.measures.peaks import peak_acceleration, peak_velocity
from seisblock.readers.discover import RecordSource, iter_records
from seisblock.readers.options import ReadOptions
from seisblock.readers.read import read_source
from seisblock.readers.source import Location
from seisblock.records import Preparation, Record
from seisblock.records.process import require_horizontals
from seisblock.records.qc_report import qc_summary, require_clean
from seisblock.records.site import (
    Earthquake,
    epicentral_distance_km,
    format_local_time,
    get_earthquake,
    get_site,
    matches_station,
    valid_coordinates,
)
from seisblock.studies.map.earthquakes import are_different_earthquakes, describe_earthquake
from seisblock.studies.map.station_response import StationBody, StationModel, StationResult
from seisblock.studies.parallel import MAX_PENDING_RECORDS, map_threads

NO_PROCESSING = Preparation()
"""Default preparation: only the processing required by the format."""

OUTLINE_POINTS = 160
"""Points of an outline."""


@dataclass(frozen=True, repr=False)
class StationReport(DisplayMixin):
    """Report of one station.

    Parameters
    ----------
    record : str
        File name.
    station, name : str
        Empty if not in the file.
    seed_id : str
        Network, station, location and channels; empty without a network.
    latitude, longitude : float or None
        Degrees north and east; None if not in the file: the station is listed, but not on the map.
    epicentral_distance_km : float or None
    local_start : str
        Local time of the first sample.
    pga_m_s2, pgv_m_s : float or None
        The larger of the horizontal components.
    jma_intensity : float or None, 1
        None for missing components or too few samples.
    effect : StationResult
    failure : str or None
        Reason of a missing result.
    doubts : tuple of str
        Quality flags of the record, and directions or samples without a result.
    history : tuple of str
        Processing steps, including floor motion.
    earthquake : Earthquake or None
    origin_told : str
        Local origin time.
    outline : tuple of pairs of float, m/s^2
        Minima and maxima of the horizontal with the larger peak, over equal intervals of the record.
    duration_s : float
        Of the record, s.
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
    effect: StationResult = field(default_factory=StationResult)
    failure: str | None = None
    doubts: tuple[str, ...] = ()
    history: tuple[str, ...] = ()
    earthquake: Earthquake | None = None
    origin_told: str = ""
    outline: tuple[tuple[float, float], ...] = ()
    duration_s: float = 0.0
    start: datetime | None = None
    seed_id: str = ""

    @property
    def is_mapped(self) -> bool:
        """True if position and measures are available."""
        return valid_coordinates(self.latitude, self.longitude) is not None and self.pga_m_s2 is not None

    @property
    def label(self) -> str:
        """SEED id or code, and name of the station, else the file name."""
        return " ".join(part for part in (self.seed_id or self.station, self.name) if part) or self.record


@dataclass(frozen=True, repr=False)
class Stations(DisplayMixin):
    """Stations of one earthquake, largest response first, those without a result last.

    Parameters
    ----------
    answers : tuple of StationReport
    earthquake : Earthquake or None
    origin_told : str
        Local origin time.
    preparation : Preparation
        Processing of each record.
    """

    answers: tuple[StationReport, ...]
    earthquake: Earthquake | None
    origin_told: str = ""
    preparation: Preparation = NO_PROCESSING

    @property
    def mapped(self) -> tuple[StationReport, ...]:
        """Reports with a position."""
        return tuple(answer for answer in self.answers if answer.is_mapped)


Station: TypeAlias = "Location | RecordSource | Record"
"""Station input: names, a record source or a record."""


def survey_stations(
    records: Station | Iterable[Station],
    subject: StationModel | None = None,
    *,
    preparation: Preparation = NO_PROCESSING,
    read_options: ReadOptions | None = None,
    strict: bool = False,
    workers: int | None = None,
    progress: Progress | None = None,
) -> Stations:
    """Return the measures at each station of an earthquake, and the response of a body or a cemetery.

    Unreadable records and failed solutions give a report with a reason; the others are not affected.

    Parameters
    ----------
    records : path, RecordSource or Record, or several
        Files, folders, patterns, ``@list.txt`` and bundles, see :func:`~seisblock.readers.discover.iter_records`; read lazily.
    subject : StationBody, StationCemetery or None
        Body or cemetery at each station; None for measures only.
    preparation : Preparation
        Processing of each record.
    read_options : ReadOptions
        Properties of files that lack them.
    strict : bool
        Whether records with quality flags fail.
    workers : int
        Threads; default: number of cores.
    progress : callable
        Called with the number of finished stations and of known ones.

    Returns
    -------
    Stations

    Raises
    ------
    ParameterError
        If the records are of two earthquakes, there are none, or an option of the body is invalid.

    Examples
    --------
    >>> from seisblock.studies import survey_stations
    >>> survey = survey_stations("hanmer_springs_2016")
    >>> survey.answers[0].station, survey.answers[0].latitude, round(survey.answers[0].jma_intensity, 1)
    ('HSES', -42.52333, 5.4)
    """
    checks.instance(preparation, Preparation)
    read_options = read_options or ReadOptions()
    if isinstance(subject, StationBody):
        subject.check_options()
    work = partial(_assess_station, subject=subject, preparation=preparation, reading=read_options, strict=strict)
    reports: list[StationReport] = []
    reference: StationReport | None = None
    for report in _with_progress(
        map_threads(work, _recordings(records, read_options), workers=workers, max_pending=MAX_PENDING_RECORDS), progress
    ):
        if report is None:
            continue
        reference = _check_same_earthquake(reference, report)
        reports.append(report)
    if not reports and read_options.station is not None:
        raise ParameterError("no station {station!r} in these records", station=read_options.station)
    if not reports:
        raise ParameterError("no records; give files, folders or archives of one earthquake")
    # stations without measures come last
    reports.sort(key=lambda item: (item.pga_m_s2 is not None, *item.effect.severity, item.pga_m_s2 or 0.0), reverse=True)
    earthquake, origin = (None, "") if reference is None else (reference.earthquake, reference.origin_told)
    return Stations(tuple(reports), earthquake, origin, preparation)


def _recordings(records: Station | Iterable[Station], read_options: ReadOptions) -> Iterator[RecordSource | Record]:
    single = isinstance(records, (str, PathLike, RecordSource, Record))
    if not single and not isinstance(records, Iterable):
        raise KindError("expected names or records of stations, found {found}", found=checks.type_name(records))
    sources: Iterable[Any] = [records] if single else records  # type: ignore[assignment]
    # neighbouring names are expanded together and read lazily; the order of the input remains
    for is_name, group in groupby(sources, key=lambda source: isinstance(source, (str, PathLike))):
        if is_name:
            yield from iter_records([str(source) for source in group], read_options)
        else:
            yield from group


def _with_progress(reports: Iterable[StationReport | None], progress: Progress | None) -> Iterator[StationReport | None]:
    for count, report in enumerate(reports, start=1):
        if progress is not None:
            # the total is unknown while records are read lazily
            progress(count, count)
        yield report


def _assess_station(
    recording: RecordSource | Record, *, subject: StationModel | None, preparation: Preparation, reading: ReadOptions, strict: bool
) -> StationReport | None:
    """Return the report of one station; None for an excluded one."""
    if not isinstance(recording, (RecordSource, Record)):
        raise KindError("expected names or records of stations, found {found}", found=checks.type_name(recording))
    name = recording.name if isinstance(recording, RecordSource) else recording.source.rsplit("/", 1)[-1]
    try:
        record = read_source(recording, reading) if isinstance(recording, RecordSource) else recording
        if reading.station is not None and not matches_station(record, reading.station):
            return None
        if strict:
            require_clean(record)
        processed_record = preparation.apply(record)
    except SeisblockError as error:
        is_other_station = reading.station is not None and isinstance(error, ComponentError)  # the file lacks the requested station
        return None if is_other_station else StationReport(name, failure=error.message)
    site, earthquake = get_site(processed_record), get_earthquake(processed_record)
    site_fields: dict[str, object] = {
        "station": site.code,
        "seed_id": site.seed_id,
        "name": site.name,
        "latitude": site.latitude_deg,
        "longitude": site.longitude_deg,
        "epicentral_distance_km": epicentral_distance_km(processed_record),
        "start": processed_record.start,
        "local_start": format_local_time(processed_record, processed_record.start),
        "doubts": tuple(qc_summary([processed_record])),
        "history": processed_record.history,
        "earthquake": earthquake,
        "origin_told": "" if earthquake is None else format_local_time(processed_record, earthquake.origin_time),
    }
    # a record without measures still has a position and a time
    try:
        measured_fields = _measure_record(processed_record)
    except SeisblockError as error:
        return StationReport(name, **site_fields, failure=error.message)  # type: ignore[arg-type]
    # a failed response leaves the measures of the station
    try:
        effect, failure = subject.evaluate(processed_record) if subject is not None else StationResult(), None
    except SeisblockError as error:
        effect, failure = StationResult(), error.message
    site_fields["doubts"] = (*qc_summary([processed_record]), *effect.remarks)
    return StationReport(name, **site_fields, **measured_fields, effect=effect, failure=failure)  # type: ignore[arg-type]


def _measure_record(record: Record) -> dict[str, Any]:
    rows = [component.acceleration for component in require_horizontals(record)]
    peaks = [peak_acceleration(row)[0] for row in rows]
    return {
        "pga_m_s2": max(peaks),
        "outline": _outline(rows[peaks.index(max(peaks))]),
        "duration_s": record.duration_s,
        "pgv_m_s": max(peak_velocity(ground_history(row, record.dt), record.dt) for row in rows),
        "jma_intensity": jma_intensity(record),
    }


def _outline(row: FloatArray) -> tuple[tuple[float, float], ...]:
    """Return minima and maxima of a row over equal intervals."""
    # `reduceat` requires rising starts
    starts = np.unique(np.linspace(0, row.size, min(OUTLINE_POINTS, row.size), endpoint=False).astype(int))
    return tuple(zip(np.minimum.reduceat(row, starts).tolist(), np.maximum.reduceat(row, starts).tolist(), strict=True))


def _check_same_earthquake(reference: StationReport | None, report: StationReport) -> StationReport | None:
    """Return the station with the most detailed earthquake header; raise for a different earthquake."""
    if report.earthquake is None or reference is None or reference.earthquake is None:
        return reference if report.earthquake is None else report
    if are_different_earthquakes(reference.earthquake, report.earthquake):
        raise ParameterError(
            "records of two earthquakes: {one} ({first}) and {other} ({second}); give the records of one",
            one=describe_earthquake(reference.earthquake),
            first=reference.label,
            other=describe_earthquake(report.earthquake),
            second=report.label,
        )
    return max(reference, report, key=_earthquake_detail)


def _earthquake_detail(report: StationReport) -> int:
    """Return the level of detail of the earthquake header: time, position."""
    earthquake = report.earthquake
    return 0 if earthquake is None else (earthquake.origin_time is not None) + (earthquake.place is not None)

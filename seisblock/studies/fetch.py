"""Download of the records of an earthquake or of a station into a folder that can be read directly."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from datetime import datetime
from pathlib import Path

from seisblock.core.errors import InputError, OutputError, ParameterError, RecordError, RecordNotFoundError, SeisblockError, os_error_text
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.io.files import read_bytes
from seisblock.output.io.atomic import atomic_write
from seisblock.readers import read
from seisblock.readers.event import load_quakeml
from seisblock.readers.fdsn import (
    DEFAULT_CHANNELS,
    DEFAULT_DATA_CENTER,
    DEFAULT_EVENT_CENTER,
    RETRIES,
    TIMEOUT_S,
    DataCenter,
    Sensor,
    parse_utc,
    window,
)
from seisblock.records import Preparation, Record
from seisblock.records.site import Earthquake, great_circle_km

EVENT_FILE, REQUEST_FILE = "event.xml", "fetch.json"
"""Files of a download beside those of the stations: QuakeML, and the request, which a resumed run has to repeat."""

DEFAULT_RADIUS_KM, DEFAULT_BEFORE_S, DEFAULT_DURATION_S = 100.0, 30.0, 300.0
"""Stations within this epicentral distance, km; time window, s."""


@dataclass(frozen=True)
class FetchRequest:
    """Records to be downloaded.

    Parameters
    ----------
    event : str or None
        Identifier of an event at `event_center`, or a QuakeML file.
    time : str or None
        Time of interest, UTC, instead of an event.
    stations : tuple of str
        ``NET.STA``, with wildcards; empty: all within `radius_km` of the epicentre.
    radius_km : float, km
        Largest epicentral distance of stations that are not named.
    before_s, duration_s : float, s
        Beginning of the window before the origin time or `time`, and its length.
    channels : tuple of str
        Channel codes with wildcards, in the order of preference.
    location : str or None
        Location code.
    data_center, event_center : str
        Names known to ObsPy, or addresses.
    """

    event: str | None = None
    time: str | None = None
    stations: tuple[str, ...] = ()
    radius_km: float = DEFAULT_RADIUS_KM
    before_s: float = DEFAULT_BEFORE_S
    duration_s: float = DEFAULT_DURATION_S
    channels: tuple[str, ...] = DEFAULT_CHANNELS
    location: str | None = None
    data_center: str = DEFAULT_DATA_CENTER
    event_center: str = DEFAULT_EVENT_CENTER

    def __post_init__(self) -> None:
        if (self.event is None) == (self.time is None):
            raise ParameterError("give an event, or `stations` and `time`")
        if self.time is not None and not self.stations:
            raise ParameterError("`time` requires `stations`, as CI.MIKB")
        for code in self.stations:
            if len(code.split(".")) != 2 or not all(code.split(".")):
                raise ParameterError("station {code!r}: expected network and station, as CI.MIKB", code=code)

    @property
    def station_codes(self) -> list[tuple[str, str]]:
        """Network and station of each entry of `stations`."""
        pairs = (code.split(".") for code in self.stations)
        return [(network, station) for network, station in pairs]


NEW, KEPT, NO_DATA, UNUSABLE, FAILED = STATUSES = (N_("new"), N_("present"), N_("no data"), N_("not usable"), N_("failed"))
"""Status of a station: downloaded, there from an earlier run, without data, with data that are no acceleration record, not delivered."""


@dataclass(frozen=True)
class StationDownload:
    """Download of one station.

    Parameters
    ----------
    sensor : Sensor
    distance_km : float or None
        Epicentral distance.
    status : str
        One of `STATUSES`.
    record : Record or None
        The record that the files contain, with the processing that its format requires.
    failure : SeisblockError or None
        Reason of a missing record.
    """

    sensor: Sensor
    distance_km: float | None
    status: str
    record: Record | None = None
    failure: SeisblockError | None = None


def fetch(
    request: FetchRequest,
    directory: Path,
    *,
    retries: int = RETRIES,
    timeout_s: float = TIMEOUT_S,
    progress: Callable[[int, int], None] | None = None,
) -> list[StationDownload]:
    """Download records into a folder, nearest station first: miniSEED and StationXML of each station, and QuakeML.

    Files that are there from an earlier run with the same request stay. A station that fails does not stop the others.

    Parameters
    ----------
    request : FetchRequest
    directory : Path
        Folder, created if necessary.
    retries : int
        Repetitions of a request that fails for a while.
    timeout_s : float, s
        Time limit of a request.
    progress : callable or None
        Called with the number of finished stations and of all.

    Raises
    ------
    ParameterError
        If a data centre is unknown, or the request is incomplete.
    RecordNotFoundError
        If there is no such event, or no station.
    RecordError
        If a data centre does not answer.
    OutputError
        If the folder holds another request, or cannot be written.
    """
    center = DataCenter(request.data_center, retries=retries, timeout_s=timeout_s)
    events = DataCenter(request.event_center, retries=retries, timeout_s=timeout_s) if request.event is not None else None
    _check_folder(directory, request)
    quakeml = None if events is None else _load_quakeml(events, request, directory)
    earthquake = None if quakeml is None else _only_event(quakeml)
    start, end = window(_moment(request, earthquake), request.before_s, request.duration_s)
    place = None if earthquake is None else earthquake.place
    if not request.stations and place is None:
        raise RecordError("event {event} has no epicenter: give `stations`", event=request.event)
    sensors = center.sensors(
        start,
        end,
        stations=request.station_codes,
        channels=request.channels,
        location=request.location,
        center=None if request.stations else place,
        radius_km=request.radius_km,
    )
    if not sensors:
        raise RecordNotFoundError("{name} has no data: {what}", name=center.name, what=lazy_gettext("accelerometers"))
    distances = {s: None if place is None else great_circle_km(place, (s.latitude_deg, s.longitude_deg)) for s in sensors}
    sensors.sort(key=lambda s: (distances[s] or 0.0, s.name))
    _write_request(directory, request, quakeml)
    downloads = []
    for count, sensor in enumerate(sensors, 1):
        downloads.append(_fetch_station(center, sensor, distances[sensor], directory, start, end))
        if progress is not None:
            progress(count, len(sensors))
    return downloads


def _check_folder(directory: Path, request: FetchRequest) -> None:
    """Raise OutputError if a folder holds another request."""
    target = directory / REQUEST_FILE
    if target.exists() and read_bytes(target, str(target), RecordError) != _request_bytes(request):
        message = "{directory} holds the records of another request ({file}): choose another folder"
        raise OutputError(message, directory=directory, file=REQUEST_FILE)


def _request_bytes(request: FetchRequest) -> bytes:
    return (json.dumps(asdict(request), ensure_ascii=False, indent=1) + "\n").encode()


def _write_request(directory: Path, request: FetchRequest, quakeml: bytes | None) -> None:
    """Create the folder with the request and the QuakeML of the event."""
    try:
        directory.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError("cannot create the folder {directory}: {reason}", directory=directory, reason=os_error_text(error)) from error
    for name, content in ((REQUEST_FILE, _request_bytes(request)), (EVENT_FILE, quakeml)):
        if content is not None and not (directory / name).exists():
            _write(directory / name, content)


def _write(path: Path, content: bytes) -> None:
    with atomic_write(path) as temporary:
        temporary.write_bytes(content)


def _load_quakeml(center: DataCenter, request: FetchRequest, directory: Path) -> bytes:
    """Return the QuakeML of the event: of an earlier run, of the named file, or of the data centre."""
    for path in (directory / EVENT_FILE, Path(str(request.event))):
        if path.is_file():
            return read_bytes(path, str(path), RecordError)
    return center.event(str(request.event))


def _only_event(quakeml: bytes) -> Earthquake:
    """Return the earthquake of a QuakeML document; raise RecordError for none or several."""
    events = load_quakeml(EVENT_FILE, quakeml).events
    if len(events) != 1:
        raise RecordError("{name}: {count} events; give a file with one event", name=EVENT_FILE, count=len(events))
    return events[0]


def _moment(request: FetchRequest, earthquake: Earthquake | None) -> datetime:
    if request.time is not None:
        return parse_utc(request.time)
    if earthquake is None or earthquake.origin_time is None:
        raise RecordError("event {event} has no origin time", event=request.event)
    return earthquake.origin_time


def _fetch_station(
    center: DataCenter, sensor: Sensor, distance_km: float | None, directory: Path, start: datetime, end: datetime
) -> StationDownload:
    """Return the download of one station; waveforms are written last, so that their file marks a complete station."""
    path = directory / f"{sensor.name}.mseed"
    status = KEPT if path.exists() else NEW
    if status == NEW:
        try:
            waveforms = center.waveforms(sensor, start, end)
            inventory = center.station_xml(sensor, start, end)
        except RecordNotFoundError as error:
            return StationDownload(sensor, distance_km, NO_DATA, failure=error)
        except RecordError as error:
            return StationDownload(sensor, distance_km, FAILED, failure=error)
        _write(directory / f"{sensor.network}.{sensor.station}.xml", inventory)
        _write(path, waveforms)
    try:
        return StationDownload(sensor, distance_km, status, record=Preparation().apply(read(path)))
    except InputError as error:
        return StationDownload(sensor, distance_km, UNUSABLE, failure=error)


def require_any(downloads: Sequence[StationDownload]) -> None:
    """Raise the error of the first station if no station has a record.

    Raises
    ------
    InputError
        If there is no record.
    """
    failures = [download.failure for download in downloads if download.record is None and download.failure is not None]
    if failures and len(failures) == len(downloads):
        raise failures[0]

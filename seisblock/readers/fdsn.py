"""FDSN data centres, queried by ObsPy: events, stations, waveforms; retries, and errors in one sentence."""

from __future__ import annotations

import http.client
import io
import re
import time
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from functools import cached_property
from typing import Any, TypeVar

from seisblock.core.errors import ParameterError, RecordError, RecordNotFoundError
from seisblock.core.i18n import lazy_gettext
from seisblock.readers.event import is_quakeml
from seisblock.readers.formats.mseed import is_mseed
from seisblock.readers.source import MAX_QUOTED_LENGTH

T = TypeVar("T")

DEFAULT_DATA_CENTER, DEFAULT_EVENT_CENTER = "EARTHSCOPE", "USGS"
"""Data centre of stations and waveforms, and that of events."""

DEFAULT_CHANNELS = ("HN?", "EN?", "BN?", "HG?", "EG?", "LN?")
"""Channels of accelerometers, in the order of preference."""

RETRIES, TIMEOUT_S = 3, 60.0
"""Repetitions of a request that fails for a while, and the time limit of one, s."""

FIRST_PAUSE_S = 1.0
"""Pause before the first repetition, s; it doubles with each one."""

_TRANSIENT_STATUS = frozenset({429, 500, 502, 503, 504})
"""HTTP status codes of a server that is busy or down for a while."""

_TOO_LARGE = 413
"""HTTP status code of a request for too much data."""

_STATUS = re.compile(r"HTTP (?:Status )?code: (\d{3})")

KM_PER_DEGREE = 111.195
"""Length of a degree of a great circle, km."""


@dataclass(frozen=True)
class Sensor:
    """Accelerometer of a station: its channels, and the position of the station in degrees."""

    network: str
    station: str
    location: str
    channels: tuple[str, ...]
    latitude_deg: float
    longitude_deg: float

    @property
    def name(self) -> str:
        """Network, station, location and first letters of the channels."""
        return f"{self.network}.{self.station}.{self.location}.{self.channels[0][:2]}"


class DataCenter:
    """Services of one data centre.

    Parameters
    ----------
    name : str
        Name known to ObsPy, or address that begins with ``http``.
    retries : int
        Repetitions of a request that fails for a while.
    timeout_s : float, s
        Time limit of a request.
    """

    def __init__(self, name: str, *, retries: int = RETRIES, timeout_s: float = TIMEOUT_S) -> None:
        from obspy.clients.fdsn.header import URL_MAPPINGS

        is_address = re.match(r"https?://[^/\s]+", name) is not None
        if not is_address and name.upper() not in URL_MAPPINGS:
            message = "unknown data center {name!r}: give an address (https://...) or one of {known}"
            raise ParameterError(message, name=name, known=sorted(URL_MAPPINGS))
        self.name = name if is_address else name.upper()
        self._retries, self._timeout_s = retries, timeout_s

    @cached_property
    def _client(self) -> Any:
        from obspy.clients.fdsn import Client

        def connect() -> Any:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                return Client(self.name, timeout=self._timeout_s)

        try:
            return _repeat(connect, self._retries)
        except Exception as error:  # ObsPy raises all kinds of errors for unusual answers
            message = "no FDSN service responds at {name}: check the network connection and the name of the data center"
            raise RecordError(message, name=self.name) from error

    def _request(self, service: str, what: str, ask: Callable[[Any], T]) -> T:
        """Return the answer to a request; `what` is its subject in messages.

        Raises
        ------
        RecordNotFoundError
            If the data centre has no such data.
        RecordError
            If it refuses, or does not answer after all repetitions.
        """
        client = self._client
        if service not in client.services:
            raise RecordError("{name} offers no {service} service: choose another data center", name=self.name, service=service)
        try:
            return _repeat(lambda: ask(client), self._retries)
        except Exception as error:  # as above
            status = _status_of(error)
            # centres answer to an unknown event by any of these
            if status in (204, 404) or (service == "event" and status == 400):
                raise RecordNotFoundError("{name} has no data: {what}", name=self.name, what=what) from error
            if status in (401, 403):
                raise RecordError("{name} restricts the access to {what}", name=self.name, what=what) from error
            if status == _TOO_LARGE:
                message = "{name} refuses so much data at once: {what}; request a shorter time window, a smaller radius or fewer channels"
                raise RecordError(message, name=self.name, what=what) from error
            message = "{name} returned no {what} ({why}): try again later"
            raise RecordError(message, name=self.name, what=what, why=_reason(error)) from error

    def event(self, event_id: str) -> bytes:
        """Return the QuakeML of an event."""
        subject = lazy_gettext("event {id}", id=event_id)
        content = self._request("event", subject, lambda client: _file_of(client.get_events, eventid=event_id))
        if not is_quakeml(content):
            raise RecordError("{name} returned no QuakeML for event {id}: try again later", name=self.name, id=event_id)
        return content

    def sensors(
        self,
        start: datetime,
        end: datetime,
        *,
        stations: Sequence[tuple[str, str]] = (),
        channels: Sequence[str] = DEFAULT_CHANNELS,
        location: str | None = None,
        center: tuple[float, float] | None = None,
        radius_km: float | None = None,
    ) -> list[Sensor]:
        """Return one sensor for each station that recorded between two times, in the order of the data centre.

        Parameters
        ----------
        start, end : datetime
            UTC.
        stations : sequence of pairs
            Network and station codes, with wildcards; empty: all.
        channels : sequence of str
            Channel codes with wildcards, in the order of preference. Of several sensors, one with three components is preferred.
        location : str or None
            Location code, ``--`` for the empty one.
        center, radius_km : pair of float, degrees, and float, km
            Latitude and longitude of the centre of a circle, and its radius.
        """
        area: dict[str, Any] = {}
        if center is not None and radius_km is not None:
            area = {"latitude": center[0], "longitude": center[1], "maxradius": radius_km / KM_PER_DEGREE}
        result: dict[tuple[str, str], Sensor] = {}
        for network, station in stations or (("*", "*"),):
            subject = lazy_gettext("stations {code}", code=f"{network}.{station}")
            query = {
                "network": network,
                "station": station,
                "channel": ",".join(channels),
                "location": location or "*",
                "starttime": _utc(start),
                "endtime": _utc(end),
                "level": "channel",
                **area,
            }
            inventory = self._request("station", subject, lambda client, query=query: client.get_stations(**query))  # type: ignore[misc]
            for item in inventory:
                for site in item:
                    sensor = _preferred_sensor(item.code, site, channels)
                    if sensor is not None:
                        result.setdefault((item.code, site.code), sensor)
        return list(result.values())

    def station_xml(self, sensor: Sensor, start: datetime, end: datetime) -> bytes:
        """Return the StationXML of a sensor with its response."""
        return self._request(
            "station",
            lazy_gettext("response of {code}", code=sensor.name),
            lambda client: _file_of(client.get_stations, **_codes(sensor), starttime=_utc(start), endtime=_utc(end), level="response"),
        )

    def waveforms(self, sensor: Sensor, start: datetime, end: datetime) -> bytes:
        """Return the miniSEED of a sensor."""
        content = self._request(
            "dataselect",
            lazy_gettext("waveforms of {code}", code=sensor.name),
            lambda client: _whole_blocks(_file_of(client.get_waveforms, **_codes(sensor), starttime=_utc(start), endtime=_utc(end))),
        )
        if not is_mseed(content):
            message = "{name} returned no miniSEED for {code}: try again later"
            raise RecordError(message, name=self.name, code=sensor.name)
        return content


def _utc(moment: datetime) -> Any:
    import obspy

    return obspy.UTCDateTime(moment)


def _codes(sensor: Sensor) -> dict[str, str]:
    return {
        "network": sensor.network,
        "station": sensor.station,
        "location": sensor.location or "--",
        "channel": ",".join(sensor.channels),
    }


def _file_of(ask: Callable[..., Any], **query: Any) -> bytes:
    """Return the bytes of an answer, as sent."""
    buffer = io.BytesIO()
    ask(filename=buffer, **query)
    return buffer.getvalue()


def _whole_blocks(content: bytes) -> bytes:
    """Return miniSEED as received; raise IncompleteRead if it ends inside a block, as after a broken connection."""
    from obspy.io.mseed.util import get_record_information

    if is_mseed(content):
        excess = get_record_information(io.BytesIO(content))["excess_bytes"]
        if excess:
            raise http.client.IncompleteRead(content)
    return content


def _preferred_sensor(network: str, site: Any, patterns: Sequence[str]) -> Sensor | None:
    """Return the sensor of an ObsPy station that comes first: complete, by the order of the patterns, by the location code."""
    groups: dict[tuple[str, str], list[str]] = {}
    for channel in site:
        codes = groups.setdefault((channel.location_code.replace("-", ""), channel.code[:2]), [])
        if channel.code not in codes:  # several epochs
            codes.append(channel.code)
    bands = [pattern[:2] for pattern in patterns]

    def rank(key: tuple[str, str]) -> tuple[bool, int, str]:
        return len(groups[key]) < 3, bands.index(key[1]) if key[1] in bands else len(bands), key[0]

    if not groups:
        return None
    best = min(groups, key=rank)
    return Sensor(network, site.code, best[0], tuple(sorted(groups[best])), float(site.latitude), float(site.longitude))


def _status_of(error: BaseException) -> int | None:
    """Return the HTTP status code of an error of ObsPy."""
    status = getattr(error, "status_code", None)
    match = _STATUS.search(str(error))
    return status or (int(match[1]) if match else None)


def _is_transient(error: BaseException) -> bool:
    """Return whether a request that failed may succeed later: busy server, or no connection."""
    status = _status_of(error)
    return status in _TRANSIENT_STATUS if status else _is_of_service(error)


def _is_of_service(error: BaseException) -> bool:
    """Return whether an error is one of the service or of the connection."""
    from obspy.clients.fdsn.header import FDSNException

    return isinstance(error, (FDSNException, OSError, http.client.HTTPException))


def _repeat(ask: Callable[[], T], retries: int) -> T:
    """Return the answer to a request, which is repeated with growing pauses as long as its failures may be transient."""
    for attempt in range(retries):
        try:
            return ask()
        except Exception as error:
            if not _is_transient(error):
                raise
        time.sleep(FIRST_PAUSE_S * 2**attempt)
    return ask()


def _reason(error: BaseException) -> str:
    """Return the first line of an error in one sentence."""
    if not _is_of_service(error):
        # ObsPy's parsers fail with errors of Python for anything but StationXML
        return lazy_gettext("unreadable answer")
    status = _status_of(error)
    text = " ".join(str(error).partition("Detailed response")[0].split()) or type(error).__name__
    return (f"HTTP {status}: {text}" if status and str(status) not in text else text)[:MAX_QUOTED_LENGTH]


def parse_utc(text: str) -> datetime:
    """Return a time, UTC unless it states another zone.

    Raises
    ------
    ParameterError
        If the text is no time.

    Examples
    --------
    >>> parse_utc("2016-11-13T11:03").isoformat(), parse_utc("2016-11-14T00:03:00+13:00").isoformat()
    ('2016-11-13T11:03:00+00:00', '2016-11-13T11:03:00+00:00')
    """
    try:
        moment = datetime.fromisoformat(text.strip())
    except ValueError as error:
        raise ParameterError("{text!r} is no time: expected UTC as 2016-11-13T11:02:56", text=text) from error
    return moment.replace(tzinfo=UTC) if moment.tzinfo is None else moment.astimezone(UTC)


def window(moment: datetime, before_s: float, duration_s: float) -> tuple[datetime, datetime]:
    """Return start and end of a time window that begins before a moment."""
    start = moment - timedelta(seconds=before_s)
    return start, start + timedelta(seconds=duration_s)

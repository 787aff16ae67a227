"""Earthquake of a record from QuakeML, from a JSON file, or from an ObsPy event."""

from __future__ import annotations

import io
import json
import re
import warnings
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

from seisblock.core import checks
from seisblock.core.errors import KindError, RecordError, RecordFormatError
from seisblock.readers._header import drop_missing
from seisblock.readers.limits import ReadBudget
from seisblock.readers.source import MAX_QUOTED_LENGTH, RawFile, decode_text, read_bytes, resolve_path
from seisblock.records import Record
from seisblock.records.site import Earthquake, get_earthquake

BEFORE_ORIGIN, AFTER_ORIGIN = timedelta(minutes=1), timedelta(hours=1)
"""A record of an event ends at most so long before its origin time, and begins at most so long after it."""

_BUFFER = re.compile(r"<_io\.BytesIO [^>]*>")


@dataclass(frozen=True)
class EventSource:
    """Candidate earthquakes, and their source in messages."""

    name: str
    events: tuple[Earthquake, ...]

    def select(self, record: Record) -> Earthquake | None:
        """Return the earthquake of a record: the only one, or that whose origin time matches the record.

        Raises
        ------
        RecordError
            If no event or several events match.
        """
        if len(self.events) == 1:
            return self.events[0]
        matching = self.matching(record)
        if len(matching) != 1:
            message = "{name}: {count} of {total} events match the time of {record}; give a file with one event"
            raise RecordError(message, name=self.name, count=len(matching), total=len(self.events), record=record.source or record.station)
        return matching[0]

    def matching(self, record: Record) -> list[Earthquake]:
        """Return the earthquakes whose origin time matches the record."""
        start = record.start
        if start is None:
            return []
        end = start + timedelta(seconds=record.duration_s)
        times = [(event, event.origin_time) for event in self.events]
        return [event for event, time in times if time is not None and end >= time - BEFORE_ORIGIN and start <= time + AFTER_ORIGIN]


@dataclass(frozen=True)
class EventsBeside(EventSource):
    """Earthquakes of QuakeML files that lie beside a record and were not named: used only if one of them matches."""

    def select(self, record: Record) -> Earthquake | None:
        """Return the only earthquake that matches the record; None for none or several, or if the header states one."""
        matching = [] if get_earthquake(record) is not None else self.matching(record)
        return matching[0] if len(matching) == 1 else None


def is_quakeml(head: bytes) -> bool:
    """Return whether bytes begin a QuakeML document."""
    return b"quakeml" in head[:4096] and b"FDSNStationXML" not in head[:4096]


def load_events_beside(files: Sequence[RawFile]) -> EventsBeside | None:
    """Return the earthquakes of QuakeML files beside a record; files that cannot be read are omitted."""
    events: list[Earthquake] = []
    for file in files:
        with suppress(RecordError):
            events += load_quakeml(file.name, file.data).events
    return EventsBeside("QuakeML", tuple(dict.fromkeys(events))) if events else None


def load_event(event: Any) -> EventSource:
    """Return the earthquakes in a QuakeML or JSON file, or of an ObsPy Event or Catalog.

    Raises
    ------
    RecordNotFoundError, RecordError
        If the file does not exist, is empty, or has no event.
    RecordFormatError
        If the file is neither QuakeML nor a JSON file with time, latitude and longitude.
    """
    if isinstance(event, EventSource):
        return event
    if not isinstance(event, (str, Path)):
        events = [event] if hasattr(event, "preferred_origin") else event
        if not isinstance(events, Iterable) or not all(hasattr(item, "preferred_origin") for item in events):
            raise KindError("expected a QuakeML file or an ObsPy Event, found {found}", found=checks.type_name(event))
        return _from_catalog("event", list(events))
    path = resolve_path(event)
    file = RawFile(str(event), read_bytes(path, str(event), ReadBudget()), path)
    if not file.data.strip():
        raise RecordError("{name}: empty file; expected QuakeML or a JSON file of an event", name=file.name)
    if file.data.lstrip().startswith(b"{"):
        return EventSource(file.name, (_from_json(file),))
    return load_quakeml(file.name, file.data)


def load_quakeml(name: str, content: bytes) -> EventSource:
    """Return the earthquakes in a QuakeML document; errors as those of :func:`load_event`."""
    import obspy

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            catalog = obspy.read_events(io.BytesIO(content), format="QUAKEML")
    except Exception as error:  # ObsPy's readers raise bare Exceptions
        reason = " ".join(_BUFFER.sub(name, str(error)).split())[:MAX_QUOTED_LENGTH] or type(error).__name__
        raise RecordFormatError("{name}: neither QuakeML nor a JSON file of an event ({why})", name=name, why=reason) from error
    return _from_catalog(name, catalog)


def _from_catalog(name: str, events: Sequence[Any]) -> EventSource:
    earthquakes = []
    for event in events:
        origin = event.preferred_origin() or (event.origins[0] if event.origins else None)
        magnitude = event.preferred_magnitude() or (event.magnitudes[0] if event.magnitudes else None)
        if origin is None:
            continue
        depth_km = None if origin.depth is None else origin.depth / 1000.0
        description = next((text.text for text in event.event_descriptions if text.type in ("earthquake name", "region name")), "")
        earthquakes.append(
            Earthquake(
                origin.time.datetime.replace(tzinfo=UTC) if origin.time else None,
                origin.latitude,
                origin.longitude,
                depth_km,
                None if magnitude is None else float(magnitude.mag),
                str(description or ""),
            )
        )
    if not earthquakes:
        raise RecordError("{name}: no event with an origin", name=name)
    return EventSource(name, tuple(earthquakes))


def _from_json(file: RawFile) -> Earthquake:
    """Return the event of a JSON file: flat keys, or a GeoJSON feature of the U.S. Geological Survey."""
    try:
        document = json.loads(decode_text(file))
        properties = document.get("properties", document)
        longitude, latitude, depth_km = (*document.get("geometry", {}).get("coordinates", ()), None, None, None)[:3]
        latitude = float(_first(properties, "latitude", "lat", default=latitude))
        longitude = float(_first(properties, "longitude", "lon", default=longitude))
        depth_km = _first(properties, "depth_km", "depth", default=depth_km)
        magnitude = _first(properties, "magnitude", "mag")
        return Earthquake(
            _parse_time(properties["time"]),
            latitude,
            longitude,
            None if depth_km is None else float(depth_km),
            None if magnitude is None else float(magnitude),
            str(_first(properties, "place", "name", default="")),
        )
    except (ValueError, KeyError, TypeError, AttributeError, OverflowError) as error:
        message = "{name}: not a JSON file of an event: expected time, latitude and longitude ({why})"
        raise RecordFormatError(message, name=file.name, why=str(error)[:80]) from error


def _first(entries: Mapping[str, Any], *keys: str, default: Any = None) -> Any:
    return next((entries[key] for key in keys if entries.get(key) is not None), default)


def _parse_time(value: Any) -> datetime:
    """Return the UTC time of an ISO text, or of milliseconds since 1970."""
    if isinstance(value, (int, float)):
        return datetime.fromtimestamp(value / 1000.0, UTC)
    moment = datetime.fromisoformat(str(value).strip())
    return moment.replace(tzinfo=UTC) if moment.tzinfo is None else moment.astimezone(UTC)


def apply_event(record: Record, event: EventSource | None) -> Record:
    """Return a record with the earthquake in its metadata, in place of the one of its header."""
    if event is None:
        return record
    earthquake = event.select(record)
    if earthquake is None:
        return record
    header_keys = ("origin_time", "event_latitude_deg", "event_longitude_deg", "event_depth_km", "magnitude", "event_name")
    other_metadata = {k: v for k, v in record.metadata.items() if k not in (*header_keys, "epicentral_distance_km")}
    values = (
        earthquake.origin_time,
        earthquake.latitude_deg,
        earthquake.longitude_deg,
        earthquake.depth_km,
        earthquake.magnitude,
        earthquake.name,
    )
    return replace(record, metadata={**other_metadata, **drop_missing(dict(zip(header_keys, values, strict=True)))})

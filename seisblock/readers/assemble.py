"""Third stage of reading: components of one recording to one record."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from datetime import timedelta

from seisblock.core.errors import ComponentError, RecordError
from seisblock.core.i18n import lazy_gettext
from seisblock.readers.registry import find_format
from seisblock.readers.source import MAX_QUOTED_LENGTH
from seisblock.records import Component, QCFlag, Record
from seisblock.records.site import matches_station

LEVELS = ("surface", "borehole")
_COMPONENT_ORDER = {"NS": 0, "EW": 1, "UD": 3}  # other codes: before the vertical
CLOCK_RESOLUTION_S = 1e-4
"""Time stamps of miniSEED have this resolution, s."""

MIN_COMMON_SHARE = 0.5
"""Smallest common window of components without a flag, relative to the longest component."""

TRIM_TOLERANCE = 0.05
"""Largest relative excess in length over the shortest component that is trimmed."""


def assemble(
    name: str, parts: Sequence[Record], *, station: str | None = None, level: str | None = None, location: str | None = None
) -> Record:
    """Return one record from parts, at least one, with a common station, level, start and sampling interval.

    `station` selects one of several. `level` is the sensor of a station with two; None selects the surface sensor if present. `location`
    is the sensor of SEED channels, see :func:`~seisblock.readers.read`. Components with absolute times are cut to their common window.

    Raises
    ------
    ComponentError
        If the station or level is missing, or there are several stations and none is selected.
    RecordError
        If the parts do not belong to one recording.
    """
    selected_parts, notes = _select_level(name, select_station(name, parts, station), level)
    selected_parts = _select_sensor(name, selected_parts, location)
    if find_format(selected_parts[0].format).aligned:
        selected_parts, align_notes = _align(name, selected_parts)
        notes += align_notes
    # formats without a time are compared by their event
    starts = sorted({str(p.start or p.metadata.get("event", "")) for p in selected_parts})
    if len(starts) > 1:
        message = "{name}: start times differ ({starts}), so the files are not one recording; read them separately"
        raise RecordError(message, name=name, starts=starts)
    # rounded intervals of one recording agree exactly; different ones would shift the components against each other
    intervals = sorted({p.dt for p in selected_parts})
    if len(intervals) > 1:
        interval_texts = [f"{dt:g} s" for dt in intervals]
        raise RecordError("{name}: sampling intervals differ ({found}); give the files of one recording", name=name, found=interval_texts)
    _check_codes(name, selected_parts)
    components = [c for part in selected_parts for c in part.components]
    history = dict.fromkeys(line for part in selected_parts for line in part.history)
    # other formats with unequal lengths are rejected by Record
    if find_format(selected_parts[0].format).synchronous:
        components, trim_notes = _trim_to_shortest(components)
        history.update(dict.fromkeys(trim_notes))
    components.sort(key=lambda c: _COMPONENT_ORDER.get(c.code, 2))
    first = selected_parts[0]
    return replace(
        first,
        components=tuple(components),
        station=first.station[:MAX_QUOTED_LENGTH],
        source=name,
        history=(*notes, *history),
        metadata=_merge_metadata(selected_parts),
        doubts=tuple(dict.fromkeys(flag for part in selected_parts for flag in part.doubts)),
    )


def _check_codes(name: str, parts: Sequence[Record]) -> None:
    """Raise if files have the same component: recordings without station and time cannot be told apart by `station`."""
    codes = [code for part in parts for code in part.codes]
    repeated = next((code for code in codes if codes.count(code) > 1), None)
    holders = [part.source.removeprefix(f"{name}/") for part in parts if repeated in part.codes]
    if len(holders) > 1:
        message = (
            "{name}: {count} recordings of component {code} without station and time to distinguish them ({files}): give each file "
            "separately, unpacked from its archive"
        )
        raise RecordError(message, name=name, count=len(holders), code=repeated, files=", ".join(holders)[:MAX_QUOTED_LENGTH])


def belongs_to_recording(parts: Sequence[Record], group_parts: Sequence[Record]) -> bool:
    """Return whether a single-component file belongs to the recording of other files."""
    # same station, start (or event), sampling interval and format, and a component that the group lacks
    if len(parts) != 1 or len(parts[0].components) != 1:
        return False
    part, first = parts[0], group_parts[0]
    is_identified = bool(part.station) and (part.start is not None or bool(part.metadata.get("event")))
    if not is_identified or (part.dt, part.format) != (first.dt, first.format) or not is_same_recording(part, first):
        return False
    if part.metadata.get("sensor") != first.metadata.get("sensor"):
        return False
    component_keys = {(part_in_group.metadata.get("level"), code) for part_in_group in group_parts for code in part_in_group.codes}
    return (part.metadata.get("level"), part.codes[0]) not in component_keys


def is_same_recording(part: Record, other: Record) -> bool:
    """Return whether parts are of one station and event, and start together or, in formats with absolute times, overlap."""
    keys = [(p.network, p.station, p.metadata.get("event")) for p in (part, other)]
    if keys[0] != keys[1]:
        return False
    if part.start == other.start or part.start is None or other.start is None or not find_format(part.format).aligned:
        return part.start == other.start
    ends = [start + timedelta(seconds=p.duration_s) for start, p in ((part.start, part), (other.start, other))]
    return part.start < ends[1] and other.start < ends[0]


def select_station(name: str, parts: Sequence[Record], station: str | None) -> Sequence[Record]:
    """Return the parts of one station; raise ComponentError if it is missing, or there are several and none is selected."""
    stations = list(dict.fromkeys((p.network, p.station) for p in parts))
    codes = [code for _, code in stations]
    # the network tells apart stations with one code
    station_names = [
        (f"{network}.{code}" if network and codes.count(code) > 1 else code) or lazy_gettext("(unnamed)") for network, code in stations
    ]
    if station is not None:
        matching_parts = [p for p in parts if matches_station(p, station)]
        if not matching_parts:
            raise ComponentError("{name}: no station {station!r}; available: {listed}", name=name, station=station, listed=station_names)
        if len({p.network for p in matching_parts}) > 1:
            message = "{name}: station {station} exists in several networks; select one of {listed} with `station`"
            raise ComponentError(message, name=name, station=station, listed=sorted(f"{p.network}.{p.station}" for p in matching_parts))
        return matching_parts
    if len(stations) > 1:
        message = "{name} contains {count} stations; select one with `station`: {listed}"
        raise ComponentError(message, name=name, count=len(stations), listed=station_names)
    return parts


def _select_sensor(name: str, parts: Sequence[Record], location: str | None) -> Sequence[Record]:
    """Return the parts of one sensor: location code and first letters of the channels."""
    sensors = list(dict.fromkeys(str(p.metadata["sensor"]) for p in parts if "sensor" in p.metadata))
    if location is None:
        if len(sensors) > 1:
            message = "{name}: several sensors at {station}: {sensors}; select one with `location`"
            raise ComponentError(message, name=name, station=parts[0].station, sensors=[_sensor_name(sensor) for sensor in sensors])
        return parts
    code = location.strip().upper()
    code = "" if code == "--" else code
    matching_parts = [p for p in parts if _matches_sensor(str(p.metadata.get("sensor", "")), code)]
    matching_sensors = list(dict.fromkeys(str(p.metadata["sensor"]) for p in matching_parts))
    if not matching_parts:
        available = [_sensor_name(sensor) for sensor in sensors] or lazy_gettext("no location codes")
        raise ComponentError("{name}: no sensor {location!r}; available: {sensors}", name=name, location=location, sensors=available)
    if len(matching_sensors) > 1:
        message = "{name}: several sensors at location {location!r}: {sensors}; give `location` with the channel, as 00.HN"
        raise ComponentError(message, name=name, location=location, sensors=[_sensor_name(sensor) for sensor in matching_sensors])
    return matching_parts


def _sensor_name(sensor: str) -> str:
    """Return a sensor as written in `location`: ``00.HN``, ``--.HN`` for the empty location code."""
    location, _, channel = sensor.partition(".")
    return f"{location or '--'}.{channel}"


def _matches_sensor(sensor: str, code: str) -> bool:
    """Return whether a location code, channel letters, or both denote a sensor."""
    location, _, channel = sensor.upper().partition(".")
    return bool(sensor) and code.rstrip("?*") in (location, channel, f"{location}.{channel}", f"{location or '--'}.{channel}")


def _align(name: str, parts: Sequence[Record]) -> tuple[list[Record], tuple[str, ...]]:
    """Return parts cut to their common window by their start times, and history entries."""
    starts = [p.start for p in parts if p.start is not None]
    if len(starts) < len(parts) or len({p.dt for p in parts}) > 1 or (len(set(starts)) == 1 and len({p.samples for p in parts}) == 1):
        return list(parts), ()
    codes = [p.codes[0] for p in parts]
    latest, dt = max(starts), parts[0].dt
    # shifts of whole samples: interpolation would smooth the peaks
    lags = [(latest - start).total_seconds() / dt for start in starts]
    skips = [round(lag) for lag in lags]
    count = min(p.samples - skip for p, skip in zip(parts, skips, strict=True))
    if count < 2 or len(set(codes)) < len(codes):
        message = "{name}: start times differ ({starts}), so the files are not one recording; read them separately"
        raise RecordError(message, name=name, starts=sorted(map(str, set(starts))))
    notes = [lazy_gettext("components cut to their common window, {count} samples", count=count)]
    residual_s = max(abs(lag - skip) for lag, skip in zip(lags, skips, strict=True)) * dt
    if residual_s > CLOCK_RESOLUTION_S:
        notes.append(lazy_gettext("start times of components differ by up to {residual:.2g} ms after alignment", residual=1e3 * residual_s))
    flags: tuple[QCFlag, ...] = ()
    if count < MIN_COMMON_SHARE * max(p.samples for p in parts):
        message = "components have only {count} samples in common, of up to {longest}"
        flags = (QCFlag("count", lazy_gettext(message, count=count, longest=max(p.samples for p in parts))),)
    cut_parts = [
        replace(
            p,
            start=latest,
            components=tuple(replace(c, acceleration=c.acceleration[skip : skip + count]) for c in p.components),
            doubts=(*p.doubts, *flags),
        )
        for p, skip in zip(parts, skips, strict=True)
    ]
    return cut_parts, tuple(notes)


def _select_level(name: str, parts: Sequence[Record], level: str | None) -> tuple[Sequence[Record], tuple[str, ...]]:
    """Return the parts of one KiK-net sensor and a history entry; parts of other networks are unchanged."""
    levels = {str(p.metadata["level"]) for p in parts if "level" in p.metadata}
    if level is not None and level not in LEVELS:
        raise ComponentError("unknown `level` {level!r}: expected surface or borehole", level=level)
    if not levels:
        if level == "borehole":
            raise ComponentError("{name}: no borehole sensor (KiK-net stations only); omit `level`", name=name)
        return parts, ()
    selected_level = level or ("surface" if "surface" in levels else "borehole")
    matching_parts = [p for p in parts if p.metadata.get("level") == selected_level]
    if not matching_parts:
        raise ComponentError("{name}: no {taken} sensor; available: {levels}", name=name, taken=selected_level, levels=sorted(levels))
    default_reason = lazy_gettext("default") if len(levels) > 1 else lazy_gettext("only sensor in the files")
    reason = lazy_gettext("selected by `level`") if level else default_reason
    text = "KiK-net surface sensor used ({why})" if selected_level == "surface" else "KiK-net borehole sensor used ({why})"
    return matching_parts, (lazy_gettext(text, why=reason),)


def _trim_to_shortest(components: Sequence[Component]) -> tuple[list[Component], list[str]]:
    """Return components trimmed to equal length if they differ slightly, and the history entries."""
    # a recorder may add a few samples to one channel; a large excess means a damaged file
    lengths = [c.acceleration.size for c in components]
    min_length = min(lengths)
    if max(lengths) == min_length or max(lengths) > (1.0 + TRIM_TOLERANCE) * min_length:
        return list(components), []
    length_texts = [f"{c.code} {n}" for c, n in zip(components, lengths, strict=True)]
    trimmed_components = [replace(c, acceleration=c.acceleration[:min_length]) for c in components]
    message = "all components truncated to the shortest, {shortest} samples (file lengths: {lengths})"
    return trimmed_components, [lazy_gettext(message, shortest=min_length, lengths=length_texts)]


def _merge_metadata(parts: Sequence[Record]) -> dict[str, object]:
    """Return merged header entries; dictionaries by component are combined."""
    metadata: dict[str, object] = {}
    proofs = [value for part in parts if isinstance(value := part.metadata.get("proved"), tuple)]
    # proved of every part
    if proofs:
        metadata["proved"] = tuple(word for word in proofs[0] if all(word in proof for proof in proofs))
    for part in parts:
        for key, value in part.metadata.items():
            if isinstance(value, dict):
                previous_value = metadata.get(key)
                metadata[key] = {**(previous_value if isinstance(previous_value, dict) else {}), **value}
            else:
                metadata.setdefault(key, value)
    return metadata

"""Third stage of reading: components of one recording to one record."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from seisblock.core.errors import ComponentError, RecordError
from seisblock.core.i18n import lazy_gettext
from seisblock.readers.registry import find_format
from seisblock.readers.source import MAX_QUOTED_LENGTH
from seisblock.records import Component, Record
from seisblock.records.site import matches_station

LEVELS = ("surface", "borehole")
_COMPONENT_ORDER = {"NS": 0, "EW": 1, "UD": 3}  # other codes: before the vertical
TRIM_TOLERANCE = 0.05
"""Largest relative excess in length over the shortest component that is trimmed."""


def assemble(name: str, parts: Sequence[Record], *, station: str | None = None, level: str | None = None) -> Record:
    """Return one record from parts, at least one, with a common station, level, start and sampling interval.

    `station` selects one of several. `level` is the sensor of a station with two; None selects the surface sensor if present.

    Raises
    ------
    ComponentError
        If the station or level is missing, or there are several stations and none is selected.
    RecordError
        If the parts do not belong to one recording.
    """
    selected_parts, level_notes = _select_level(name, _select_station(name, parts, station), level)
    # formats without a time are compared by their event
    starts = sorted({str(p.start or p.metadata.get("event", "")) for p in selected_parts})
    if len(starts) > 1:
        message = "{name}: start times differ ({starts}), so the files are not one recording; read them separately"
        raise RecordError(message, name=name, starts=starts)
    intervals = sorted({p.dt for p in selected_parts})
    if len(intervals) > 1:
        interval_texts = [f"{dt:g} s" for dt in intervals]
        raise RecordError("{name}: sampling intervals differ ({found}); give the files of one recording", name=name, found=interval_texts)
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
        history=(*level_notes, *history),
        metadata=_merge_metadata(selected_parts),
        doubts=tuple(dict.fromkeys(flag for part in selected_parts for flag in part.doubts)),
    )


def belongs_to_recording(parts: Sequence[Record], group_parts: Sequence[Record]) -> bool:
    """Return whether a single-component file belongs to the recording of other files."""
    # same station, start (or event), sampling interval and format, and a component that the group lacks
    if len(parts) != 1 or len(parts[0].components) != 1:
        return False
    part, first = parts[0], group_parts[0]
    is_identified = bool(part.station) and (part.start is not None or bool(part.metadata.get("event")))
    identity = (part.station, part.start, part.metadata.get("event"), part.dt, part.format)
    if not is_identified or identity != (first.station, first.start, first.metadata.get("event"), first.dt, first.format):
        return False
    component_keys = {(part_in_group.metadata.get("level"), code) for part_in_group in group_parts for code in part_in_group.codes}
    return (part.metadata.get("level"), part.codes[0]) not in component_keys


def _select_station(name: str, parts: Sequence[Record], station: str | None) -> Sequence[Record]:
    stations = list(dict.fromkeys(p.station for p in parts))
    station_names = [s or lazy_gettext("(unnamed)") for s in stations]
    if station is not None:
        matching_parts = [p for p in parts if matches_station(p, station)]
        if not matching_parts:
            raise ComponentError("{name}: no station {station!r}; available: {listed}", name=name, station=station, listed=station_names)
        return matching_parts
    if len(stations) > 1:
        message = "{name} contains {count} stations; select one with `station`: {listed}"
        raise ComponentError(message, name=name, count=len(stations), listed=station_names)
    return parts


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
    for part in parts:
        for key, value in part.metadata.items():
            if isinstance(value, dict):
                previous_value = metadata.get(key)
                metadata[key] = {**(previous_value if isinstance(previous_value, dict) else {}), **value}
            else:
                metadata.setdefault(key, value)
    return metadata

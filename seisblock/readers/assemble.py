"""Which parts are one recording, and how they become one record."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from seisblock.errors import ComponentError, RecordError
from seisblock.readers.source import LONGEST_SHOWN
from seisblock.records import Component, Record
from seisblock.records.site import is_of_station
from seisblock.words import said

LEVELS = ("surface", "borehole")
_ORDER = {"NS": 0, "EW": 1, "UD": 3}  # anything else: before the vertical
START_TOGETHER = {"AT2", "CSMIP", "COSMOS", "SMC", "ESM", "GEONET"}
"""Formats whose components start together and end at will."""

CUT_TOLERANCE = 0.05
"""How much longer than the shortest, relatively, such a component may be."""


def assemble(name: str, parts: Sequence[Record], *, station: str | None = None, level: str | None = None) -> Record:
    """Return the one record that parts make: of one station, level, start and sampling.

    Parameters
    ----------
    name : str
        Of the source, for messages.
    parts : sequence of Record
        One or several components each, at least one part.
    station : str or None
        Station to take when the parts come from several.
    level : {"surface", "borehole"} or None
        Sensor of a KiK-net station; None is the surface when there is one.

    Raises
    ------
    ComponentError
        If the station or level is missing, or several stations leave the choice open.
    RecordError
        If the parts are not one recording.
    """
    chosen, told = _at_level(name, _of_station(name, parts, station), level)
    starts = sorted({str(p.start or p.metadata.get("event", "")) for p in chosen})
    if len(starts) > 1:
        raise RecordError("{name}: not one recording, the starts differ ({starts}): read these files one by one", name=name, starts=starts)
    intervals = sorted({p.dt for p in chosen})
    if len(intervals) > 1:
        found = [f"{dt:g} s" for dt in intervals]
        raise RecordError("{name}: the sampling intervals differ ({found}): give files of one recording", name=name, found=found)
    components = [c for part in chosen for c in part.components]
    history = dict.fromkeys(line for part in chosen for line in part.history)
    if chosen[0].format in START_TOGETHER:
        components, cut = _cut_to_shortest(components)
        history.update(dict.fromkeys(cut))
    components.sort(key=lambda c: _ORDER.get(c.code, 2))
    first = chosen[0]
    return replace(
        first,
        components=tuple(components),
        station=first.station[:LONGEST_SHOWN],
        source=name,
        history=(*told, *history),
        metadata=_merged_metadata(chosen),
        doubts=tuple(dict.fromkeys(doubt for part in chosen for doubt in part.doubts)),
    )


def continues(parts: Sequence[Record], others: Sequence[Record]) -> bool:
    """Return whether the one component of a file belongs to the recording that other files began: same station and start (or event)."""
    if len(parts) != 1 or len(parts[0].components) != 1:
        return False
    part, first = parts[0], others[0]
    named = bool(part.station) and (part.start is not None or bool(part.metadata.get("event")))
    same = (part.station, part.start, part.metadata.get("event"), part.dt, part.format)
    if not named or same != (first.station, first.start, first.metadata.get("event"), first.dt, first.format):
        return False
    held = {(other.metadata.get("level"), code) for other in others for code in other.codes}
    return (part.metadata.get("level"), part.codes[0]) not in held


def _of_station(name: str, parts: Sequence[Record], station: str | None) -> Sequence[Record]:
    """Return the parts of one station."""
    stations = list(dict.fromkeys(p.station for p in parts))
    listed = [s or said("(unnamed)") for s in stations]
    if station is not None:
        chosen = [p for p in parts if is_of_station(p, station)]
        if not chosen:
            raise ComponentError("{name}: no station {station!r}; it holds {listed}", name=name, station=station, listed=listed)
        return chosen
    if len(stations) > 1:
        raise ComponentError(
            "{name} holds {count} stations: choose one with `station`: {listed}", name=name, count=len(stations), listed=listed
        )
    return parts


def _at_level(name: str, parts: Sequence[Record], level: str | None) -> tuple[Sequence[Record], tuple[str, ...]]:
    """Return the parts of one KiK-net sensor and a line for the history; parts of other networks pass."""
    levels = {str(p.metadata["level"]) for p in parts if "level" in p.metadata}
    if level is not None and level not in LEVELS:
        raise ComponentError("unknown level {level!r}: give surface or borehole", level=level)
    if not levels:
        if level == "borehole":
            raise ComponentError("{name} has no borehole sensor: only KiK-net stations have one; leave `level` out", name=name)
        return parts, ()
    taken = level or ("surface" if "surface" in levels else "borehole")
    chosen = [p for p in parts if p.metadata.get("level") == taken]
    if not chosen:
        raise ComponentError("{name} holds no {taken} components, only {levels}", name=name, taken=taken, levels=sorted(levels))
    why = said("as asked") if level else said("the default") if len(levels) > 1 else said("the only one given")
    text = (
        "took the surface sensor of the KiK-net station ({why})"
        if taken == "surface"
        else "took the borehole sensor of the KiK-net station ({why})"
    )
    return chosen, (said(text, why=why),)


def _cut_to_shortest(components: Sequence[Component]) -> tuple[list[Component], list[str]]:
    """Return components of one length when they differ a little at the end, and what was cut."""
    lengths = [c.acceleration.size for c in components]
    shortest = min(lengths)
    if max(lengths) == shortest or max(lengths) > (1.0 + CUT_TOLERANCE) * shortest:
        return list(components), []
    told = [f"{c.code} {n}" for c, n in zip(components, lengths, strict=True)]
    cut = [replace(c, acceleration=c.acceleration[:shortest]) for c in components]
    return cut, [said("cut all components to the shortest, {shortest} samples (the files hold {lengths})", shortest=shortest, lengths=told)]


def _merged_metadata(parts: Sequence[Record]) -> dict[str, object]:
    """Return what the headers say together; what each component has of its own is gathered."""
    merged: dict[str, object] = {}
    for part in parts:
        for key, value in part.metadata.items():
            if isinstance(value, dict):
                held = merged.get(key)
                merged[key] = {**(held if isinstance(held, dict) else {}), **value}
            else:
                merged.setdefault(key, value)
    return merged

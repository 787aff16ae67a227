"""The one line above a figure: which record this is, when, which directions, and what was done to it."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from seisblock.present.figures.canvas import BETWEEN
from seisblock.present.figures.fonts import has_letters
from seisblock.records import Motion, Record
from seisblock.records.site import earthquake_of, epicentral_distance_km, file_of, site_of, told_time
from seisblock.words import listed, plain_text, tell

LONG_NUMBER = re.compile(r"\d+\.\d{4,}")
"""A number of more digits than a title has room for."""


def heading(record: Record | None, directions: Sequence[str] = ()) -> str:
    """Return the line: station, local time, components or azimuths, and what was done to the samples, if anything was.

    Parameters
    ----------
    record : Record or None
    directions : sequence of str
    """
    return heading_over([record], directions)


def heading_of(motions: Sequence[Motion]) -> str:
    """Return the line of some motions."""
    return heading_over([motion.record for motion in motions], [motion.name for motion in motions])


def heading_over(records: Sequence[Record | None], directions: Sequence[str] = ()) -> str:
    """Return the line of what is drawn of some records; of several the names and the directions alone, for each has its own time."""
    there = _different(records)
    along = listed(map(direction, dict.fromkeys(name for name in directions if name)))
    if len(there) == 1:
        (record,) = there
        parts = [_named(record), told_time(record, record.start), _shook(record), along, "; ".join(_brief(record.history))]
    else:
        parts = [listed(map(name_of, there)), along]
    return BETWEEN.join(plain_text(part) for part in parts if part)


def called(record: Record | None, name: str, records: Sequence[Record | None]) -> str:
    """Return what one of several panels is called: its direction, and its record too where the panels are of several."""
    told = direction(name)
    return f"{name_of(record)} {told}" if record is not None and len(_different(records)) > 1 else told


def names_of(motions: Sequence[Motion]) -> list[str]:
    """Return what the panels of some motions are called."""
    return [called(motion.record, motion.name, [each.record for each in motions]) for motion in motions]


def name_of(record: Record) -> str:
    """Return code and name of the station as far as they can be written, else the file's name."""
    site = site_of(record)
    return next((name for name in (site.label, site.code, record.source) if name and has_letters(name)), tell("record"))


def _named(record: Record) -> str:
    """Return what the only record of a figure is called: of a file its name without the folder."""
    name = name_of(record)
    return file_of(record) if name == record.source else name


def _shook(record: Record) -> str:
    """Return magnitude and distance of the earthquake, as far as they are known."""
    earthquake, distance = earthquake_of(record), epicentral_distance_km(record)
    magnitude = None if earthquake is None else earthquake.magnitude
    if magnitude is None:
        return ""
    if distance is None:
        return tell("M {magnitude:.2g}", magnitude=magnitude)
    return tell("M {magnitude:.2g}, {distance:.3g} km", magnitude=magnitude, distance=distance)


def _different(records: Sequence[Record | None]) -> list[Record]:
    """Return the records among these, each once."""
    there = (record for record in records if record is not None)
    return list({(record.station, record.source, record.start, record.history): record for record in there}.values())


def direction(name: str) -> str:
    """Return a component's code, or an azimuth as such."""
    try:
        float(name)
    except ValueError:
        return name
    return f"{name}°"


def _brief(history: Iterable[str]) -> Iterable[str]:
    """Yield what was done without its particulars, which stand in brackets or behind a colon."""
    for did in history:
        told = tell(did)
        for opening in (" (", "（", ": ", "："):
            told = told.split(opening)[0]
        yield LONG_NUMBER.sub(lambda number: f"{float(number[0]):.4g}", told)

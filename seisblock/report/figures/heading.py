"""The one line above a figure: which record this is, when, which directions, and what was done to it."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from seisblock.core.i18n import escape_control, gettext, join_list
from seisblock.records import Motion, Record
from seisblock.records.site import epicentral_distance_km, format_local_time, get_earthquake, get_site, source_name
from seisblock.report.figures.fonts import can_render
from seisblock.report.figures.style import SEPARATOR

LONG_NUMBER = re.compile(r"\d+\.\d{4,}")
"""A number of more digits than a title has room for."""


def heading(record: Record | None, directions: Sequence[str] = ()) -> str:
    """Return the line: station, local time, components or azimuths, and what was done to the samples, if anything was.

    Parameters
    ----------
    record : Record or None
    directions : sequence of str
    """
    return records_heading([record], directions)


def motions_heading(motions: Sequence[Motion]) -> str:
    """Return the line of some motions."""
    return records_heading([motion.record for motion in motions], [motion.name for motion in motions])


def records_heading(records: Sequence[Record | None], directions: Sequence[str] = ()) -> str:
    """Return the line of what is drawn of some records; of several the names and the directions alone, for each has its own time."""
    unique = _unique_records(records)
    directions_text = join_list(map(direction_name, dict.fromkeys(name for name in directions if name)))
    if len(unique) == 1:
        (record,) = unique
        parts = [
            _single_record_label(record),
            format_local_time(record, record.start),
            _earthquake_label(record),
            directions_text,
            "; ".join(_short_history(record.history)),
        ]
    else:
        parts = [join_list(map(record_label, unique)), directions_text]
    return SEPARATOR.join(escape_control(part) for part in parts if part)


def panel_label(record: Record | None, name: str, records: Sequence[Record | None]) -> str:
    """Return what one of several panels is called: its direction, and its record too where the panels are of several."""
    direction_text = direction_name(name)
    return f"{record_label(record)} {direction_text}" if record is not None and len(_unique_records(records)) > 1 else direction_text


def panel_labels(motions: Sequence[Motion]) -> list[str]:
    """Return what the panels of some motions are called."""
    return [panel_label(motion.record, motion.name, [other_motion.record for other_motion in motions]) for motion in motions]


def record_label(record: Record) -> str:
    """Return code and name of the station as far as they can be written, else the file's name."""
    site = get_site(record)
    return next((name for name in (site.label, site.code, record.source) if name and can_render(name)), gettext("record"))


def _single_record_label(record: Record) -> str:
    """Return what the only record of a figure is called: of a file its name without the folder."""
    name = record_label(record)
    return source_name(record) if name == record.source else name


def _earthquake_label(record: Record) -> str:
    """Return magnitude and distance of the earthquake, as far as they are known."""
    earthquake, distance = get_earthquake(record), epicentral_distance_km(record)
    magnitude = None if earthquake is None else earthquake.magnitude
    if magnitude is None:
        return ""
    if distance is None:
        return gettext("M {magnitude:.2g}", magnitude=magnitude)
    return gettext("M {magnitude:.2g}, {distance:.3g} km", magnitude=magnitude, distance=distance)


def _unique_records(records: Sequence[Record | None]) -> list[Record]:
    """Return the records among these, each once."""
    present = (record for record in records if record is not None)
    return list({(record.station, record.source, record.start, record.history): record for record in present}.values())


def direction_name(name: str) -> str:
    """Return a component's code, or an azimuth as such."""
    try:
        float(name)
    except ValueError:
        return name
    return f"{name}°"


def _short_history(history: Iterable[str]) -> Iterable[str]:
    """Yield what was done without its particulars, which stand in brackets or behind a colon."""
    for did in history:
        text = gettext(did)
        for opening in (" (", "（", ": ", "："):
            text = text.split(opening)[0]
        yield LONG_NUMBER.sub(lambda number: f"{float(number[0]):.4g}", text)

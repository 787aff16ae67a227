"""Titles of figures: record, time, earthquake, directions, processing."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from seisblock.core.i18n import escape_control, format_share, gettext, join_clauses, join_list
from seisblock.output.figures.fonts import can_render
from seisblock.output.figures.style import SEPARATOR
from seisblock.output.text.record_info import format_step
from seisblock.output.units_display import length_unit
from seisblock.records import Motion, Record
from seisblock.records.motion import ALL_AZIMUTHS
from seisblock.records.site import epicentral_distance_km, format_local_time, get_earthquake, get_site, source_name


def heading(record: Record | None, directions: Sequence[str] = ()) -> str:
    """Return the title of a record: station, local time, components or azimuths, processing.

    Parameters
    ----------
    record : Record or None
    directions : sequence of str
    """
    return records_heading([record], directions)


def motions_heading(motions: Sequence[Motion]) -> str:
    """Return the title of motions."""
    return records_heading([motion.record for motion in motions], [motion.name for motion in motions])


def records_heading(records: Sequence[Record | None], directions: Sequence[str] = ()) -> str:
    """Return the title of records; several records have only names and directions."""
    unique = _unique_records(records)
    directions_text = join_list(map(direction_name, dict.fromkeys(name for name in directions if name)))
    if len(unique) == 1:
        (record,) = unique
        parts = [
            _single_record_label(record),
            format_local_time(record, record.start),
            _earthquake_label(record),
            directions_text,
            join_clauses(_short_history(record.history)),
        ]
    else:
        parts = [join_list(map(record_label, unique)), directions_text]
    return SEPARATOR.join(escape_control(part) for part in parts if part)


def panel_label(record: Record | None, name: str, records: Sequence[Record | None]) -> str:
    """Return the label of a panel: direction, preceded by the record if there are several."""
    direction_text = direction_name(name)
    return f"{record_label(record)} {direction_text}" if record is not None and len(_unique_records(records)) > 1 else direction_text


def panel_labels(motions: Sequence[Motion]) -> list[str]:
    """Return the labels of the panels of motions."""
    return [panel_label(motion.record, motion.name, [other_motion.record for other_motion in motions]) for motion in motions]


def record_label(record: Record) -> str:
    """Return code and name of the station if the font has the glyphs, else the file name."""
    site = get_site(record)
    return next((name for name in (site.label, site.code, record.source) if name and can_render(name)), gettext("record"))


def object_label(*sizes: float, friction: float | None, probability: float | None = None, gal: bool, narrow: bool = False) -> str:
    """Return sizes, friction and overturning probability of an object, where known, below a panel title; one a line if `narrow`."""
    unit = length_unit(sizes, gal=gal)
    parts = [f"{' × '.join(f'{size / unit.size:.3g}' for size in sizes)} {unit.name}"] if sizes else []
    if friction is not None:
        parts.append(gettext("μ {mu:g}", mu=friction))
    if probability is not None:
        parts.append(gettext("overturning probability {share}", share=format_share(probability)))
    return "\n".join(parts) if narrow else join_list(parts)


def _single_record_label(record: Record) -> str:
    """Return the label of a single record; a file name without folder."""
    name = record_label(record)
    return source_name(record) if name == record.source else name


def _earthquake_label(record: Record) -> str:
    """Return magnitude and epicentral distance as far as known."""
    earthquake, distance = get_earthquake(record), epicentral_distance_km(record)
    magnitude = None if earthquake is None else earthquake.magnitude
    if magnitude is None:
        return ""
    if distance is None:
        return gettext("M {magnitude:.2g}", magnitude=magnitude)
    return gettext("M {magnitude:.2g}, {distance:.3g} km", magnitude=magnitude, distance=distance)


def _unique_records(records: Sequence[Record | None]) -> list[Record]:
    """Return the distinct records."""
    present = (record for record in records if record is not None)
    return list({(record.station, record.source, record.start, record.history): record for record in present}.values())


def direction_name(name: str) -> str:
    """Return the code of a component, an azimuth with degree sign, or that all azimuths are meant."""
    if name == ALL_AZIMUTHS:
        return gettext("all azimuths")
    try:
        float(name)
    except ValueError:
        return name
    return f"{name}°"


def _short_history(history: Iterable[str]) -> Iterable[str]:
    """Yield the processing steps without details in parentheses or after a colon."""
    for step in history:
        text = format_step(step)
        for opening in (" (", "（", ": ", "："):
            text = text.split(opening)[0]
        yield text

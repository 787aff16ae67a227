"""Column headings of plain tables: component, time, unit.

Every column is classified; an ambiguous or unknown heading is an error, and ignored columns are recorded in the history.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace

from seisblock.core.errors import RecordFormatError, UnitError
from seisblock.core.i18n import lazy_gettext
from seisblock.readers.directions import Direction, parse_direction, parse_signed_direction, strip_component_words
from seisblock.readers.table.headers import (
    TIME,
    classify_other_quantity,
    component_code,
    is_clock_unit,
    normalize_cell,
    normalize_unit,
    split_unit,
    strip_name,
    time_unit_seconds,
)

_BRACKET = re.compile(r"[(\[（]\s*(?![\d.\s]*[)\]）])[^()\[\]（）]*[)\]）]")
"""Text in brackets that is not a number."""

ACCEPTED_NAMES = lazy_gettext(
    "a direction (NS, EW, UD; N10E or 10°; X, Y, Z; L, T, V; HNN, HNE, HNZ), time, or a name with an acceleration unit, as in 'table (gal)'"
)
_NON_NAMES = {"true", "false", "nan", "inf", "null", "none", "yes"}
_RIGHT_ANGLE_TOLERANCE_DEG = 1.0
"""Largest deviation from perpendicular, degrees, of two bare numbers taken as azimuths."""


@dataclass(frozen=True)
class Column:
    """Column to be read.

    `label` is its name in messages, `code` the component or ``TIME``, `unit` the normalised acceleration unit (empty for time), `seconds`
    the unit of a time column, s. `sign` is -1 if the samples are converted to positive up.
    """

    index: int
    label: str
    code: str
    unit: str = ""
    azimuth_deg: float | None = None
    sign: float = 1.0
    seconds: float = 1.0


@dataclass(frozen=True)
class TableColumns:
    """Columns to be read, and history notes on ignored columns and assumptions."""

    columns: tuple[Column, ...]
    notes: tuple[str, ...] = ()


def parse_header(name: str, names: Sequence[str], units: str | None = None) -> TableColumns:
    """Return the columns of a table from the names in its header, at least one not empty; `units` is the unit of columns without one.

    Raises
    ------
    RecordFormatError
        If a column is unknown, two have the same meaning, or a name is a unit or another word.
    UnitError
        If a unit is unknown, missing, or contradicts `units`.
    """
    entries = [_classify_column(name, index, heading) for index, heading in enumerate(names)]
    notes = [
        lazy_gettext("column {name!r} ignored: {what}", name=names[i], what=lazy_gettext(entry))
        for i, entry in enumerate(entries)
        if isinstance(entry, str)
    ]
    columns = [entry for entry in entries if not isinstance(entry, str)]
    # D and T depend on the other columns and are resolved after all are classified
    columns = _resolve_transverse(name, names, _resolve_down(names, columns), units)
    _check_ambiguous(name, names, columns, units)
    _check_duplicates(name, names, columns)
    default_unit = _parse_units_option(units)
    stated_units = {column.unit for column in columns if column.unit}
    unitless = [column for column in columns if column.code != TIME and not column.unit]
    if unitless and len(stated_units) == 1 and default_unit is None:
        common_unit = next(iter(stated_units))
        stating_names = _quote_names(names, [c for c in columns if c.unit])
        message = "unit {unit} of {states} also used for {others}"
        notes.append(lazy_gettext(message, unit=common_unit, states=stating_names, others=_quote_names(names, unitless)))
        default_unit = common_unit
    final_columns = tuple(_apply_unit(name, names[column.index], column, default_unit, units) for column in columns)
    notes += [
        lazy_gettext("sign of {name!r} (positive down) reversed to UD (positive up)", name=names[c.index])
        if c.code == "UD"
        else lazy_gettext("sign of {name!r} reversed to {code}", name=names[c.index], code=c.code)
        for c in final_columns
        if c.sign < 0
    ]
    if len({column.unit for column in final_columns if column.code != TIME}) > 1:
        unit_texts = [f"{names[c.index]!r}: {c.unit}" for c in final_columns if c.code != TIME]
        notes.append(lazy_gettext("columns converted from different units ({units})", units=unit_texts))
    return TableColumns(final_columns, tuple(notes))


def is_header_row(names: Sequence[str]) -> bool:
    """Return whether a line can be a header: a name is a direction or the time, or has an acceleration unit."""
    return any(
        normalize_unit(split_unit(n)[1])
        or component_code(n) in (TIME, "ACC")
        or ((d := parse_direction(strip_name(n))) is not None and not d.is_bare_number)
        for n in names
    )


def _classify_column(name: str, index: int, heading: str) -> Column | str:
    """Return a column from its own name, or the quantity of a column to be ignored."""
    unit_text = split_unit(heading)[1]
    bare_heading = strip_name(heading)
    unit, seconds = normalize_unit(unit_text), time_unit_seconds(unit_text)
    inner_unit = normalize_unit(split_unit(split_unit(heading)[0])[1])
    if unit and inner_unit and inner_unit != unit:
        message = "{name}: two units, {inner} and {unit}, in column {written!r}; keep one"
        raise UnitError(message, name=name, written=heading, inner=inner_unit, unit=unit)
    # the sense may stand behind the unit: "Z (gal) down"
    without_unit = re.sub(rf"[(\[{{<]\s*{re.escape(unit_text)}\s*[)\]}}>]", " ", normalize_cell(heading), count=1)
    names = map(strip_component_words, (split_unit(heading)[0], without_unit) if unit else (heading,))
    signed = next((direction for direction in map(parse_signed_direction, names) if direction is not None), None)
    if signed is not None:
        return _acceleration_column(index, heading, signed, unit or "")
    if unit and _BRACKET.search(bare_heading) and parse_direction(_BRACKET.sub("", bare_heading)) is not None:
        message = (
            "{name}: {inner!r} in column {written!r} is neither a unit nor a direction: write the positive direction, as in 'UD (down)'"
        )
        raise RecordFormatError(message, name=name, inner=(_BRACKET.findall(bare_heading) or [""])[0], written=heading)
    if bare_heading.isdecimal() and parse_direction(bare_heading) is None:
        message = "{name}: column name {written!r} is not an azimuth: expected 0 to 360 degrees, or {understood}"
        raise RecordFormatError(message, name=name, written=heading, understood=ACCEPTED_NAMES)
    if normalize_unit(bare_heading) or bare_heading.lower() in _NON_NAMES:
        message = "{name}: {written!r} is not a name for column {index}: expected {understood}"
        raise RecordFormatError(message, name=name, written=heading, index=index + 1, understood=ACCEPTED_NAMES)
    direction = parse_direction(bare_heading)
    quantity = classify_other_quantity(heading)
    if unit and quantity is None:
        return _acceleration_column(index, heading, direction or _unknown_direction(bare_heading), unit)
    # acceleration units come first: 'T (gal)' is transverse, 'T (s)' is time
    if component_code(heading) == TIME or seconds:
        if unit_text and seconds is None and not is_clock_unit(unit_text):
            message = "{name}: unknown time unit {unit_text!r} in column {written!r}: expected s, ms or min, or JST, UTC, hh:mm:ss"
            raise UnitError(message, name=name, written=heading, unit_text=unit_text)
        return Column(index, heading, TIME, seconds=seconds or 1.0)
    if direction is not None and (not unit_text or unit_text.lower() == "deg"):
        return _acceleration_column(index, heading, direction, "")
    if quantity is not None:
        return quantity
    if unit_text:
        message = "{name}: unknown unit {unit_text!r} in column {written!r}: expected gal, m/s2 or g; correct the unit or remove the column"
        raise UnitError(message, name=name, written=heading, unit_text=unit_text)
    if component_code(heading) == "ACC":
        return Column(index, heading, "ACC")
    return Column(index, heading or f"number {index + 1}", "", unit="")


def _acceleration_column(index: int, heading: str, direction: Direction, unit: str) -> Column:
    return Column(index, heading, direction.code, unit, direction.azimuth_deg, direction.sign)


def _unknown_direction(bare_heading: str) -> Direction:
    """Return the direction of a column known as acceleration by its unit; ``T`` with a unit is transverse."""
    return Direction(
        component_code(bare_heading) if component_code(bare_heading) != TIME else bare_heading.upper() if bare_heading else "ACC"
    )


def _resolve_down(names: Sequence[str], columns: list[Column]) -> list[Column]:
    """Return the columns; a lone ``D`` is down only beside two oriented horizontals and no vertical."""
    down_column = next((c for c in columns if c.sign < 0.0 and strip_name(names[c.index]).lower() == "d"), None)
    known_count = sum(c.azimuth_deg is not None for c in columns)
    if down_column is None or (known_count == 2 and sum(c.code == down_column.code for c in columns) == 1):
        return columns
    return [replace(c, code="D" if c.unit else "", sign=1.0) if c is down_column else c for c in columns]


def _resolve_transverse(name: str, names: Sequence[str], columns: list[Column], units: str | None) -> list[Column]:
    """Return the columns; a lone ``T`` beside ``L`` or ``R`` is transverse if an acceleration unit is known."""
    time_columns = [c for c in columns if c.code == TIME]
    # with both t and T, the lower-case letter is the time
    time_column = next((c for c in time_columns if names[c.index] == "T" or (names[c.index] == "t" and len(time_columns) == 1)), None)
    if time_column is None or not {"L", "R"} & {c.code for c in columns}:
        return columns
    if units is None and not any(c.unit for c in columns):
        message = (
            "{name}: columns {names} have no unit: {one!r} may be time or the transverse direction; add the unit to the header, as "
            "in 'T (s)' or 'T (gal)', or give `units`, gal|m/s2|g"
        )
        raise UnitError(message, name=name, names=[repr(n) for n in names], one=names[time_column.index])
    return [replace(c, code="T") if c is time_column else c for c in columns]


def _check_ambiguous(name: str, names: Sequence[str], columns: list[Column], units: str | None) -> None:
    """Raise for ambiguous or unknown columns; name the remaining columns when `units` is given."""
    bare_azimuths = [c for c in columns if not c.unit and (d := parse_direction(strip_name(names[c.index]))) and d.is_bare_number]
    if bare_azimuths and not (len(bare_azimuths) == 2 and _are_perpendicular(*bare_azimuths)):
        raise RecordFormatError(
            "{name}: ambiguous column names {names}: write azimuths as a perpendicular pair (10,280), with N and E (N10E) or with "
            "a degree sign (10°)",
            name=name,
            names=_quote_names(names, bare_azimuths),
        )
    velocity_columns = [
        c for c in columns if not c.unit and units is None and (d := parse_direction(strip_name(names[c.index]))) and d.velocity
    ]
    if velocity_columns:
        raise UnitError(
            "{name}: velocity-sensor codes {names}: expected accelerations; for accelerations, add the unit to the header, as in "
            "'HHN (gal)', or give `units`, gal|m/s2|g",
            name=name,
            names=_quote_names(names, velocity_columns),
        )
    unknown_columns = [c for c in columns if not c.code]
    known_columns = [c for c in columns if c.code and c.code != TIME]
    if unknown_columns and (known_columns or units is None):
        message = "{name}: unknown column {names}: expected {understood}; rename or remove the column"
        raise RecordFormatError(message, name=name, names=_quote_names(names, unknown_columns), understood=ACCEPTED_NAMES)
    for position, column in enumerate(columns):
        if not column.code:  # `units` declares all columns as accelerations
            columns[position] = replace(column, code=re.sub(r"\s+", " ", names[column.index].upper()) or f"C{column.index + 1}")


def _are_perpendicular(first: Column, second: Column) -> bool:
    angle = abs((first.azimuth_deg or 0.0) - (second.azimuth_deg or 0.0)) % 180.0
    return abs(angle - 90.0) <= _RIGHT_ANGLE_TOLERANCE_DEG


def _check_duplicates(name: str, names: Sequence[str], columns: Sequence[Column]) -> None:
    """Raise if two columns have the same meaning."""
    for code, count in Counter(c.code for c in columns).items():
        if count > 1:
            meaning = lazy_gettext("time") if code == TIME else code
            message = "{name}: several columns for {meant} ({names}); keep one"
            raise RecordFormatError(message, name=name, meant=meaning, names=_quote_names(names, [c for c in columns if c.code == code]))


def _parse_units_option(units: str | None) -> str | None:
    unit = None if units is None else normalize_unit(units)
    if units is not None and unit is None:
        raise UnitError("unknown acceleration unit {units!r}: expected gal, m/s2 or g", units=units)
    return unit


def _apply_unit(name: str, heading: str, column: Column, option: str | None, units: str | None) -> Column:
    """Return an acceleration column with its own unit or the default unit."""
    if column.code == TIME:
        return column
    unit = column.unit or option
    if unit is None:
        message = "{name}: column {written!r} has no unit: add it to the header, as in 'EW (gal)', or give `units`, gal|m/s2|g"
        raise UnitError(message, name=name, written=heading or column.index + 1)
    if units is not None and unit != option:
        message = "{name}: unit {unit} of column {written!r} contradicts `units` {units}; omit `units`"
        raise UnitError(message, name=name, written=heading, unit=unit, units=units)
    return replace(column, unit=unit)


def _quote_names(names: Sequence[str], columns: Sequence[Column]) -> str:
    """Return the names of columns as written, quoted."""
    return ", ".join(repr(names[c.index]) for c in columns)

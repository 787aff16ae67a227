"""What each column of a plain table is: no column is dropped in silence, and none is read as what it does not say it is."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace

from seisblock.errors import RecordFormatError, UnitError
from seisblock.readers.directions import Direction, direction_of
from seisblock.readers.naming import TIME, bare_name, code_of, normal_unit, other_quantity, split_unit, tells_clock, time_unit
from seisblock.words import said

UNDERSTOOD = said(
    "a direction (NS, EW, UD; N10E or 10°; X, Y, Z; L, T, V; HNN, HNE, HNZ), time, or an acceleration by its unit, as in 'table (gal)'"
)
_NO_NAME = {"true", "false", "nan", "inf", "null", "none", "yes"}
_RIGHT_ANGLE = 1.0
"""How far from perpendicular, in degrees, two bare numbers may be and still be taken for azimuths."""


@dataclass(frozen=True)
class Column:
    """One column that is read.

    Parameters
    ----------
    index : int
        Its place in the table.
    label : str
        What messages call it.
    code : str
        Component code, or ``TIME``.
    unit : str
        Of the acceleration, normalised; of the time, empty.
    azimuth_deg : float or None
    sign : float
        -1 where the samples are turned to positive up.
    seconds : float
        Unit of a time column, s.
    """

    index: int
    label: str
    code: str
    unit: str = ""
    azimuth_deg: float | None = None
    sign: float = 1.0
    seconds: float = 1.0


@dataclass(frozen=True)
class Columns:
    """The columns that are read, and what is to be said about the others and about guesses."""

    read: tuple[Column, ...]
    remarks: tuple[str, ...] = ()


def columns_of_header(name: str, names: Sequence[str], units: str | None = None) -> Columns:
    """Return what the columns of a table are, by the names in its header.

    Parameters
    ----------
    name : str
        Of the file, for messages.
    names : sequence of str
        As written; at least one is not empty.
    units : str or None
        Unit of columns that name none.

    Raises
    ------
    RecordFormatError
        If a column is not understood, two mean the same, or a unit or a word stands where a name should.
    UnitError
        If a unit is unknown, missing or contradicts the option.
    """
    told = [_first_look(name, index, written) for index, written in enumerate(names)]
    remarks = [
        said("left out column {name!r}: {what}", name=names[i], what=said(what)) for i, what in enumerate(told) if isinstance(what, str)
    ]
    kept = [what for what in told if not isinstance(what, str)]
    kept = _transverse(name, names, _down(names, kept), units)
    _check_guesses(name, names, kept, units)
    _check_repeats(name, names, kept)
    option = _option(units)
    stated = {column.unit for column in kept if column.unit}
    sharers = [column for column in kept if column.code != TIME and not column.unit]
    if sharers and len(stated) == 1 and option is None:
        shared = next(iter(stated))
        states = _quoted(names, [c for c in kept if c.unit])
        remarks.append(
            said("took {unit}, which {states} states, for {others}, too", unit=shared, states=states, others=_quoted(names, sharers))
        )
        option = shared
    read = tuple(_with_unit(name, names[column.index], column, option, units) for column in kept)
    remarks += [
        said("turned the sign of {name!r}, which is positive down, to UD, positive up", name=names[c.index]) for c in read if c.sign < 0
    ]
    if len({column.unit for column in read if column.code != TIME}) > 1:
        told_units = [f"{names[c.index]!r}: {c.unit}" for c in read if c.code != TIME]
        remarks.append(said("the columns state several units, and each was taken in its own ({units})", units=told_units))
    return Columns(read, tuple(remarks))


def means_something(names: Sequence[str]) -> bool:
    """Return whether a line can be a header: one of its words is a direction, the time, or carries a unit of acceleration."""
    return any(
        normal_unit(split_unit(n)[1]) or code_of(n) in (TIME, "ACC") or ((d := direction_of(bare_name(n))) is not None and not d.bare)
        for n in names
    )


def _first_look(name: str, index: int, written: str) -> Column | str:
    """Return a column as its own name tells it, or what it is when it is no acceleration and no time."""
    unit_text = split_unit(written)[1]
    plain = bare_name(written)
    unit, seconds = normal_unit(unit_text), time_unit(unit_text)
    inner = normal_unit(split_unit(split_unit(written)[0])[1])
    if unit and inner and inner != unit:
        raise UnitError(
            "{name}: column {written!r} states two units, {inner} and {unit}: keep one of them",
            name=name,
            written=written,
            inner=inner,
            unit=unit,
        )
    if plain.isdecimal() and direction_of(plain) is None:
        raise RecordFormatError(
            "{name}: column {written!r} is named by a number that is no azimuth: expected 0 to 360 degrees, or {understood}",
            name=name,
            written=written,
            understood=UNDERSTOOD,
        )
    if normal_unit(plain) or plain.lower() in _NO_NAME:
        raise RecordFormatError(
            "{name}: {written!r} stands where column {index} should have a name: expected {understood}",
            name=name,
            written=written,
            index=index + 1,
            understood=UNDERSTOOD,
        )
    direction = direction_of(plain)
    if unit:
        return _acceleration(index, written, direction or _channel(plain), unit)
    if code_of(written) == TIME or seconds:
        if unit_text and seconds is None and not tells_clock(unit_text):
            raise UnitError(
                "{name}: column {written!r} has the unknown unit of time {unit_text!r}: expected s, ms or min, or JST, UTC, hh:mm:ss",
                name=name,
                written=written,
                unit_text=unit_text,
            )
        return Column(index, written, TIME, seconds=seconds or 1.0)
    if direction is not None and (not unit_text or unit_text.lower() == "deg"):
        return _acceleration(index, written, direction, "")
    other = other_quantity(written)
    if other is not None:
        return other
    if unit_text:
        raise UnitError(
            "{name}: column {written!r} has the unknown unit {unit_text!r}: expected gal, m/s2 or g, or no such column",
            name=name,
            written=written,
            unit_text=unit_text,
        )
    if code_of(written) == "ACC":
        return Column(index, written, "ACC")
    return Column(index, written or f"number {index + 1}", "", unit="")


def _acceleration(index: int, written: str, direction: Direction, unit: str) -> Column:
    """Return a column of acceleration."""
    return Column(index, written, direction.code, unit, direction.azimuth_deg, direction.sign)


def _channel(plain: str) -> Direction:
    """Return the direction, not known, of a column that is an acceleration by its unit; ``T`` beside a unit is transverse."""
    return Direction(code_of(plain) if code_of(plain) != TIME else plain.upper() if plain else "ACC")


def _down(names: Sequence[str], columns: list[Column]) -> list[Column]:
    """Return the columns with a lone ``D`` taken as down only beside two horizontals that are known, and no vertical."""
    lone = next((c for c in columns if c.sign < 0.0 and bare_name(names[c.index]).lower() == "d"), None)
    known = sum(c.azimuth_deg is not None for c in columns)
    if lone is None or (known == 2 and sum(c.code == lone.code for c in columns) == 1):
        return columns
    return [replace(c, code="D" if c.unit else "", sign=1.0) if c is lone else c for c in columns]


def _transverse(name: str, names: Sequence[str], columns: list[Column], units: str | None) -> list[Column]:
    """Return the columns with a lone ``T`` beside ``L`` or ``R`` taken as transverse where a unit of acceleration is known."""
    clocks = [c for c in columns if c.code == TIME]
    # t and T: the small letter is the time
    lone = next((c for c in clocks if names[c.index] == "T" or (names[c.index] == "t" and len(clocks) == 1)), None)
    if lone is None or not {"L", "R"} & {c.code for c in columns}:
        return columns
    if units is None and not any(c.unit for c in columns):
        raise UnitError(
            "{name}: columns {names} without a unit: {one!r} may be the time or the transverse direction; name the unit in "
            "the header, as in 'T (s)' or 'T (gal)', or give `units`, gal|m/s2|g",
            name=name,
            names=[repr(n) for n in names],
            one=names[lone.index],
        )
    return [replace(c, code="T") if c is lone else c for c in columns]


def _check_guesses(name: str, names: Sequence[str], columns: list[Column], units: str | None) -> None:
    """Refuse what is not understood, and complete what needs company: bare numbers, and channels whose unit is an option."""
    bare = [c for c in columns if not c.unit and (d := direction_of(bare_name(names[c.index]))) and d.bare]
    if bare and not (len(bare) == 2 and _perpendicular(*bare)):
        raise RecordFormatError(
            "{name}: no names in the header: {names}; azimuths come as a perpendicular pair (10,280), with N and E (N10E), or "
            "with a degree sign (10°)",
            name=name,
            names=_quoted(names, bare),
        )
    seismometers = [c for c in columns if not c.unit and units is None and (d := direction_of(bare_name(names[c.index]))) and d.velocity]
    if seismometers:
        raise UnitError(
            "{name}: codes of instruments that measure velocity: {names}; expected accelerations: if they are, name the unit in "
            "the header, as in 'HHN (gal)', or give `units`, gal|m/s2|g",
            name=name,
            names=_quoted(names, seismometers),
        )
    strange = [c for c in columns if not c.code]
    known = [c for c in columns if c.code and c.code != TIME]
    if strange and (known or units is None):
        raise RecordFormatError(
            "{name}: column not understood: {names}; expected {understood}; name it so, or take it out",
            name=name,
            names=_quoted(names, strange),
            understood=UNDERSTOOD,
        )
    for position, column in enumerate(columns):
        if not column.code:  # the option says that they are accelerations
            columns[position] = replace(column, code=re.sub(r"\s+", " ", names[column.index].upper()) or f"C{column.index + 1}")


def _perpendicular(one: Column, other: Column) -> bool:
    """Return whether two azimuths are a right angle apart."""
    apart = abs((one.azimuth_deg or 0.0) - (other.azimuth_deg or 0.0)) % 180.0
    return abs(apart - 90.0) <= _RIGHT_ANGLE


def _check_repeats(name: str, names: Sequence[str], columns: Sequence[Column]) -> None:
    """Refuse two columns that mean the same."""
    for code, count in Counter(c.code for c in columns).items():
        if count > 1:
            meant = said("the time") if code == TIME else code
            raise RecordFormatError(
                "{name}: several columns mean {meant} ({names}): keep one of them",
                name=name,
                meant=meant,
                names=_quoted(names, [c for c in columns if c.code == code]),
            )


def _option(units: str | None) -> str | None:
    """Return the unit that the caller states."""
    option = None if units is None else normal_unit(units)
    if units is not None and option is None:
        raise UnitError("unknown unit of acceleration {units!r}: give gal, m/s2 or g", units=units)
    return option


def _with_unit(name: str, written: str, column: Column, option: str | None, units: str | None) -> Column:
    """Return a column of acceleration with the unit it states, or the one that is given."""
    if column.code == TIME:
        return column
    unit = column.unit or option
    if unit is None:
        raise UnitError(
            "{name}: column {written!r} has no unit: name it in the header, as in 'EW (gal)', or give `units`, gal|m/s2|g",
            name=name,
            written=written or column.index + 1,
        )
    if units is not None and unit != option:
        raise UnitError(
            "{name}: column {written!r} is in {unit}, the option says {units}: leave the option out",
            name=name,
            written=written,
            unit=unit,
            units=units,
        )
    return replace(column, unit=unit)


def _quoted(names: Sequence[str], columns: Sequence[Column]) -> str:
    """Return the names of columns as they are written, each in quotes."""
    return ", ".join(repr(names[c.index]) for c in columns)

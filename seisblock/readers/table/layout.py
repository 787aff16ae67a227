"""Layout of plain tables: header line, units in a separate line, first line of numbers, separator."""

from __future__ import annotations

import csv
import re
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from seisblock.core.errors import RecordFormatError
from seisblock.core.io.csv_table import is_separator_line, stated_separator
from seisblock.readers._header import parse_number
from seisblock.readers.lines import iter_chunks, map_lines
from seisblock.readers.table.columns import is_header_row
from seisblock.readers.table.headers import is_clock_unit, is_unit, split_unit
from seisblock.readers.table.sampling import parse_timestamp

TIME_HEADING = "time (s)"
"""Name given to an unnamed first column of evenly increasing values."""

NO_UNIT_MARKS = ("-", "--", "―", "なし")
"""Cells of a unit line for columns without a unit."""

INSPECTED_LINES = 50
"""Number of lines inspected to guess the meaning of a column."""

_NUMBER_STARTS = frozenset("0123456789+-.")


def merge_unit_row(names: Sequence[str], cells: Sequence[str]) -> tuple[str, ...] | None:
    """Return names with the units of the line below, or None if that is not a unit line.

    Examples
    --------
    >>> merge_unit_row(["time", "NS", "UD"], ["s", "(gal)", "(gal)"])
    ('time (s)', 'NS (gal)', 'UD (gal)')
    >>> merge_unit_row(["No", "NS"], ["-", "gal"]), merge_unit_row(["time", "NS"], ["0.00", "1.5"]) is None
    (('No', 'NS (gal)'), True)
    """
    units = [cell.strip().strip("()[]（）").strip() for cell in cells]
    units = ["" if unit in NO_UNIT_MARKS else unit for unit in units]
    while len(units) > len(names) and not units[-1]:
        units.pop()
    if len(units) != len(names) or not any(units) or not all(is_unit(unit) or is_clock_unit(unit) for unit in units if unit):
        return None
    return tuple(name if not unit or split_unit(name)[1] == unit else f"{name} ({unit})" for name, unit in zip(names, units, strict=True))


def guess_first_name(lines: Sequence[str], separator: str | None) -> str:
    """Return the name of an unnamed first column from the first lines of the table: ``index``, time, or empty."""
    cells = [line.split(separator)[0].strip().strip('"') for line in lines if line.strip()]
    if cells and all(parse_timestamp(cell) for cell in cells):
        return "time"
    values = [parse_number(cell) for cell in cells]
    # whole numbers in steps of one are line numbers, other steps below 1 are times in s
    steps = [b - a for a, b in pairwise(values) if a is not None and b is not None]
    if not steps or len(steps) + 1 != len(values):
        return ""
    if all(cell.isdecimal() for cell in cells):
        return "index" if set(steps) == {1.0} else ""
    return TIME_HEADING if min(steps) > 0.0 and max(steps) < 1.0 else ""


FORTRAN_EXPONENT = re.compile(r"(?<=[\d.])[dD](?=[-+]?\d)")
"""Exponent letter of Fortran double precision."""

MAX_PREAMBLE_LINES = 100
"""Number of lines searched for a header below other text."""

MAX_QUOTED_LENGTH = 60
"""Longest quotation of a line in messages, letters."""

_ABSOLUTE_VALUE = re.compile(r"(?<!\S)\|[^|\s]+\|(?!\S)")
"""Name of a resultant, ``|a|``, in a header separated by blanks."""

_WIDTH_TOLERANT = {",", ";", "\t", "|"}

_COMMA_NUMBER = re.compile(r"[-+]?(?:\d+(?:,\d*)?|,\d+)(?:[eE][-+]?\d+)?")
"""Whole number, or number with a decimal comma."""


@dataclass(frozen=True)
class TableLayout:
    """Column names, index of the first line of numbers, and separator of a table."""

    names: tuple[str, ...]
    body: int
    separator: str | None
    decimal_comma: bool = False


def looks_like_csv(lines: Sequence[str]) -> bool:
    """Return whether a text is a table of numbers or has a header with components or units."""
    if lines and lines[0].lstrip("\ufeff ").startswith("<"):
        return False  # XML, HTML
    body = next((i for i, line in enumerate(lines) if is_data_line(line)), None)
    if body is None:
        return False
    separator = _separator_of(lines[body], lines)
    if _is_numeric_row(lines[body], separator):
        return True
    names = _split_cells(lines[body], separator)
    next_line = next((line for line in lines[body + 1 :] if is_data_line(line)), "")
    if is_header_row(names) or merge_unit_row(names, _unit_cells(next_line, separator)):
        return True
    separator = _separator_of(next_line, lines)
    return _is_numeric_row(next_line, separator) and len(_split_cells(next_line, separator)) == len(names)


def preamble_error(name: str, lines: Sequence[str]) -> RecordFormatError | None:
    """Return the error of a table, or of numbers without names, below lines that are not comments; None if there is none."""
    head = lines[:MAX_PREAMBLE_LINES]
    table_line = next((table_line for table_line in range(len(head)) if is_table_start(head[table_line:])), None)
    first = next((line.strip() for line in head if is_data_line(line)), "")
    if table_line is None:
        return _title_error(name, head, first)
    if head[table_line].strip() == first:
        return None
    message = "{name}: column names found in line {line} ({header!r}), below {first!r}; remove the lines above or begin each with #"
    return RecordFormatError(
        message, name=name, line=table_line + 1, header=head[table_line].strip()[:MAX_QUOTED_LENGTH], first=first[:MAX_QUOTED_LENGTH]
    )


def _title_error(name: str, head: Sequence[str], first: str) -> RecordFormatError | None:
    """Return the error of nothing but numbers below a title: a first line with another number of words than the numbers have cells."""
    is_numeric = {i: _is_numeric_row(line, find_separator(line)) for i, line in enumerate(head) if is_data_line(line)}
    numbers = next((i for i, numeric in is_numeric.items() if numeric), None)
    if numbers is None or not all(numeric for i, numeric in is_numeric.items() if i > numbers):
        return None
    counts = [len(_split_cells(line, find_separator(line))) for line in (first, head[numbers])]
    if counts[0] == counts[1]:
        return None
    message = "{name}: numbers begin in line {line}, below {first!r}, which does not name the columns; begin the lines above with #"
    return RecordFormatError(message, name=name, line=numbers + 1, first=first[:MAX_QUOTED_LENGTH])


def is_table_start(lines: Sequence[str]) -> bool:
    """Return whether the first line is a header followed by a row with as many numbers."""
    cells = _split_cells(lines[0], find_separator(lines[0]))
    if (
        not is_data_line(lines[0])
        or _is_numeric_row(lines[0], find_separator(lines[0]))
        or merge_unit_row(cells, cells)
        or not looks_like_csv(lines[:1])
    ):
        return False
    layout = find_layout("", lines)
    numbers = next((line for line in lines[layout.body :] if is_data_line(line)), "")
    return (
        bool(numbers) and _is_numeric_row(numbers, layout.separator) and len(_split_cells(numbers, layout.separator)) == len(layout.names)
    )


def find_layout(name: str, lines: Sequence[str]) -> TableLayout:
    """Return the layout of a table."""
    first = next((i for i, line in enumerate(lines) if is_data_line(line)), None)
    if first is None:
        raise RecordFormatError("{name}: comments only; expected columns of numbers", name=name)
    separator = _separator_of(lines[first], lines)
    if not _is_numeric_row(lines[first], separator):
        names = tuple(_split_cells(lines[first], separator))
        units_line = next((i for i, line in enumerate(lines[first + 1 :], first + 1) if is_data_line(line)), first)
        merged_names = merge_unit_row(names, _unit_cells(lines[units_line], separator))
        return _refine_layout(
            lines,
            TableLayout(names, first + 1, separator) if merged_names is None else TableLayout(merged_names, units_line + 1, separator),
        )
    width = len(_split_cells(lines[first], separator))
    # without a header line, the last comment may name the columns
    comment = next((line for line in reversed(lines[:first]) if line.strip()), "").lstrip("\ufeff# ")
    names = tuple(_split_cells(comment, separator if separator in _WIDTH_TOLERANT else find_separator(comment)))
    if comment and len(names) == width and is_header_row(names):
        return _refine_layout(lines, TableLayout(names, first, separator))
    return _refine_layout(lines, TableLayout(("",) * width, first, separator))


def _refine_layout(lines: Sequence[str], layout: TableLayout) -> TableLayout:
    """Return the layout adjusted to the first line of numbers: trailing empty names, separator, decimal commas."""
    names = list(layout.names)
    while len(names) > 1 and not names[-1].strip() and any(names):
        names.pop()
    samples = [line for line in lines[layout.body : layout.body + INSPECTED_LINES] if is_data_line(line)]
    sample = samples[0] if samples else ""
    separator = layout.separator
    # the header may use another separator than the numbers
    if sample and separator is not None and separator not in sample and len(names) > 1:
        separator = find_separator(sample)
    text = "".join(samples)
    decimal_comma = separator != "," and "," in text and "." not in text
    if decimal_comma and separator is None:
        decimal_comma = all(_has_comma_numbers(line) and len(line.split()) == len(names) for line in samples)
    return TableLayout(tuple(names), layout.body, separator, decimal_comma)


def find_separator(line: str) -> str | None:
    """Return the separator of a line: semicolon, tab, comma, vertical bar, else None for blanks."""
    # the comma after semicolons and tabs: beside them it may be a decimal comma
    mark = next((mark for mark in (";", "\t", ",", "|") if mark in line), None)
    if mark == "," and len(line.split()) > 1 and _has_comma_numbers(line):
        return None
    return None if mark == "|" and _ABSOLUTE_VALUE.search(line) else mark


def _has_comma_numbers(line: str) -> bool:
    """Return whether a line has nothing but numbers between blanks, with decimal commas."""
    return all(_COMMA_NUMBER.fullmatch(cell) for cell in line.split())


def _separator_of(line: str, lines: Sequence[str]) -> str | None:
    """Return the separator that the table states, else that of a line."""
    return stated_separator(lines) or find_separator(line)


def is_data_line(line: str) -> bool:
    """Return whether a line is neither blank, nor a comment, nor Excel's statement of the separator (``sep=;``)."""
    # most lines begin with a digit or a sign
    if line[:1] in _NUMBER_STARTS:
        return True
    return bool(line.strip(" \t,;|\ufeff")) and not line.lstrip("\ufeff ").startswith("#") and not is_separator_line(line)


def without_comments(lines: Sequence[str]) -> Sequence[str]:
    """Return lines with comments and lines without cells made empty, so that line numbers in messages stay those of the file."""
    starts = _NUMBER_STARTS | {""}
    # one quick pass spares most tables a call for every line, each time that they are read
    if all(line[:1] in starts for piece in iter_chunks(lines) for line in piece):
        return lines
    return map_lines(lines, lambda line: line if is_data_line(line) else "")


def _unit_cells(line: str, separator: str | None) -> list[str]:
    return line.split() if separator is None else _split_cells(line, separator)


def _split_cells(line: str, separator: str | None) -> list[str]:
    """Return the cells of a header line; bracketed units may contain blanks."""
    if separator is None:
        return re.findall(r"\S+(?:\s*[(\[][^)\]]*[)\]])?", line)
    # a quoted name may contain the separator
    try:
        cells = next(csv.reader([line.strip()], delimiter=separator)) if '"' in line else line.strip().split(separator)
    except csv.Error:  # a cell beyond the limit of the module: no table
        cells = line.strip().split(separator)
    return [cell.strip().strip('"').strip() for cell in cells]


def _is_numeric_row(line: str, separator: str | None) -> bool:
    """Return whether every nonempty cell of a line is a number."""
    cells = [cell for cell in _split_cells(line, separator) if cell]
    try:
        return bool(cells) and all(float(FORTRAN_EXPONENT.sub("E", cell.replace(",", "."))) is not None for cell in cells)
    except ValueError:
        return False

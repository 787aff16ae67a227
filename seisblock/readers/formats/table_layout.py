"""Where the numbers of a plain table begin, what separates them, and which line names its columns."""

from __future__ import annotations

import csv
import re
from collections.abc import Sequence
from dataclasses import dataclass

from seisblock.errors import RecordFormatError
from seisblock.readers.columns import means_something
from seisblock.readers.formats.table_names import with_units

FORTRAN = re.compile(r"(?<=[\d.])[dD](?=[-+]?\d)")
"""The letter of an exponent of double precision."""

FARTHEST = 100
"""Lines among which the names of a table are looked for that are not in the first."""

SHOWN = 60
"""Letters of a line that are quoted."""

_WIDTH_TOLERANT = {",", ";", "\t"}


@dataclass(frozen=True)
class TableLayout:
    """Where the numbers of a table begin and what its columns are called."""

    names: tuple[str, ...]
    body: int
    separator: str | None
    decimal_comma: bool = False


def looks_like_csv(lines: Sequence[str]) -> bool:
    """Return whether a text is a table of numbers, or at least has a header that names components or units."""
    body = next((i for i, line in enumerate(lines) if is_data(line)), None)
    if body is None:
        return False
    separator = separator_of(lines[body])
    if _all_numbers(lines[body], separator):
        return True
    names = _split(lines[body], separator)
    following = next((line for line in lines[body + 1 :] if is_data(line)), "")
    if means_something(names) or with_units(names, _cells_below(following, separator)):
        return True
    return _all_numbers(following, separator_of(following)) and len(_split(following, separator_of(following))) == len(names)


def preamble(name: str, lines: Sequence[str]) -> RecordFormatError | None:
    """Return the error of a file in which a table begins below other lines than comments, or None where it does not."""
    head = lines[:FARTHEST]
    at = next((at for at in range(len(head)) if begins_table(head[at:])), None)
    first = next((line.strip() for line in head if is_data(line)), "")
    if at is None or head[at].strip() == first:
        return None
    return RecordFormatError(
        "{name}: the names of the columns stand in line {line} only ({header!r}), and the file begins {first!r}: take the lines above "
        "the names out, or put # before each",
        name=name,
        line=at + 1,
        header=head[at].strip()[:SHOWN],
        first=first[:SHOWN],
    )


def begins_table(lines: Sequence[str]) -> bool:
    """Return whether the names of columns stand in the first of some lines, and as many numbers below it."""
    cells = _split(lines[0], separator_of(lines[0]))
    if not is_data(lines[0]) or _all_numbers(lines[0], separator_of(lines[0])) or with_units(cells, cells) or not looks_like_csv(lines[:1]):
        return False
    layout = layout_of("", lines)
    numbers = next((line for line in lines[layout.body :] if is_data(line)), "")
    return bool(numbers) and _all_numbers(numbers, layout.separator) and len(_split(numbers, layout.separator)) == len(layout.names)


def layout_of(name: str, lines: Sequence[str]) -> TableLayout:
    """Return where the numbers begin, the names of the columns and the separator."""
    first = next((i for i, line in enumerate(lines) if is_data(line)), None)
    if first is None:
        raise RecordFormatError("{name} holds comments only: expected columns of numbers", name=name)
    separator = separator_of(lines[first])
    if not _all_numbers(lines[first], separator):
        names = tuple(_split(lines[first], separator))
        below = next((i for i, line in enumerate(lines[first + 1 :], first + 1) if is_data(line)), first)
        united = with_units(names, _cells_below(lines[below], separator))
        return _closed(lines, TableLayout(names, first + 1, separator) if united is None else TableLayout(united, below + 1, separator))
    width = len(_split(lines[first], separator))
    comment = next((line for line in reversed(lines[:first]) if line.strip()), "").lstrip("\ufeff# ")
    names = tuple(_split(comment, separator if separator in _WIDTH_TOLERANT else separator_of(comment)))
    if comment and len(names) == width and means_something(names):
        return _closed(lines, TableLayout(names, first, separator))
    return _closed(lines, TableLayout(("",) * width, first, separator))


def _closed(lines: Sequence[str], layout: TableLayout) -> TableLayout:
    """Return the layout after a look at the first line of numbers: trailing empty names off, another separator, decimal commas."""
    names = list(layout.names)
    while len(names) > 1 and not names[-1].strip() and any(names):
        names.pop()
    sample = next((line for line in lines[layout.body :] if is_data(line)), "")
    separator = layout.separator
    if sample and separator is not None and separator not in sample and len(names) > 1:
        separator = separator_of(sample)
    return TableLayout(
        tuple(names), layout.body, separator, decimal_comma=separator not in (",", None) and "," in sample and "." not in sample
    )


def separator_of(line: str) -> str | None:
    """Return the separator of a line: semicolon, tab, comma, else blanks (None)."""
    return next((mark for mark in (";", "\t", ",") if mark in line), None)


def is_data(line: str) -> bool:
    """Return whether a line is neither blank nor a comment."""
    return bool(line.strip(" \t,;\ufeff")) and not line.lstrip("\ufeff ").startswith("#")


def _cells_below(line: str, separator: str | None) -> list[str]:
    """Return the cells of a line that may hold the units of the names above it."""
    return line.split() if separator is None else _split(line, separator)


def _split(line: str, separator: str | None) -> list[str]:
    """Return the cells of a header line; units in brackets may hold blanks."""
    if separator is None:
        return re.findall(r"\S+(?:\s*[(\[][^)\]]*[)\]])?", line)
    # a name in quotes may hold the separator
    cells = next(csv.reader([line.strip()], delimiter=separator)) if '"' in line else line.strip().split(separator)
    return [cell.strip().strip('"').strip() for cell in cells]


def _all_numbers(line: str, separator: str | None) -> bool:
    """Return whether every filled cell of a line is a finite or infinite number."""
    cells = [cell for cell in _split(line, separator) if cell]
    try:
        return bool(cells) and all(float(FORTRAN.sub("E", cell.replace(",", "."))) is not None for cell in cells)
    except ValueError:
        return False

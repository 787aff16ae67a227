"""Numbers in columns of one width, as Fortran writes them: a line that lost a character is found by its length."""

from __future__ import annotations

import re
from collections.abc import Sequence
from math import ceil, isfinite

import numpy as np

from seisblock.core.errors import RecordFormatError
from seisblock.core.i18n import lazy_gettext
from seisblock.core.typing import FloatArray
from seisblock.readers._header import MAX_COUNT
from seisblock.readers.table.parse import raise_line_error

DOS_EOF = "\x1a"
"""What old systems end a text with."""

_FORTRAN_FORMAT = re.compile(r"\(\s*(\d*)[FEGI](\d+)(?:\.\d+)?\s*\)", re.IGNORECASE)


def parse_fortran_format(text: str) -> tuple[int, int] | None:
    """Return how many numbers stand in a line and how wide each is, of a Fortran format, or None.

    Examples
    --------
    >>> parse_fortran_format("(8F10.3)"), parse_fortran_format("Format=(1E15.6)"), parse_fortran_format("(10I8)"),
    ... parse_fortran_format("none")
    ((8, 10), (1, 15), (10, 8), None)
    """
    match = _FORTRAN_FORMAT.search(text)
    per_line, width = (int(match[1] or 1), int(match[2])) if match else (0, 0)
    return (per_line, width) if per_line and width else None


def parse_fixed_width(name: str, lines: Sequence[str], first: int, count: int, layout: tuple[int, int]) -> FloatArray:
    """Return numbers in columns of one width, (count,).

    Parameters
    ----------
    name : str
        Of the file, for messages.
    lines : sequence of str
        Of the whole file.
    first : int
        Index of the line in which they begin.
    count : int
        How many the header promises.
    layout : tuple of int
        How many stand in a line, and how wide each is.

    Raises
    ------
    RecordFormatError
        If the file ends before them, a line holds more or fewer, or a cell is no number.
    """
    per_line, width = layout
    field_lines = lines[first : first + ceil(count / per_line)]
    if count < 1 or len(field_lines) * per_line < count:
        raise RecordFormatError(
            "{name}: file truncated: {count} numbers expected from line {line} on, end of file reached; download the file again",
            name=name,
            count=count,
            line=first + 1,
        )
    values = np.empty(count)
    for row, text in enumerate(field_lines):
        line_count = min(per_line, count - row * per_line)
        line = text.rstrip()
        if len(line) != line_count * width:
            message = lazy_gettext(
                "expected {count} numbers of {width} characters each, found {text!r}", count=line_count, width=width, text=line.strip()[:80]
            )
            raise_line_error(name, first + row + 1, message)
        for column in range(line_count):
            values[row * per_line + column] = _parse_field(name, first + row + 1, line[column * width : (column + 1) * width])
    return values


def count_lines(count: int, layout: tuple[int, int]) -> int:
    """Return how many lines so many numbers take.

    Examples
    --------
    >>> count_lines(100, (16, 5)), count_lines(80, (8, 10))
    (7, 10)
    """
    return ceil(count / layout[0])


def _parse_field(name: str, line: int, cell: str) -> float:
    """Return the number in a cell."""
    try:
        value = float(cell)
    except ValueError:
        value = float("nan")
    if not isfinite(value) or "_" in cell:
        raise_line_error(name, line, lazy_gettext("expected a number, found {cell!r}", cell=cell.strip()))
    return value


def parse_sample_count(name: str, line: int, text: str) -> int:
    """Return a count of samples that a header tells.

    Raises
    ------
    RecordFormatError
        If it is none, or so few that nothing moves.
    """
    if not text.strip().isascii() or not text.strip().isdigit() or not 2 <= int(text[:20]) < MAX_COUNT:
        raise_line_error(name, line, lazy_gettext("expected the number of samples, found {text!r}", text=text.strip()[:40]))
    return int(text)

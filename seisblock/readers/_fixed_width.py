"""Fixed-width Fortran number columns; the line length reveals missing characters."""

from __future__ import annotations

import re
from collections.abc import Sequence
from math import ceil, isfinite

import numpy as np

from seisblock.core.errors import RecordFormatError
from seisblock.core.typing import FloatArray
from seisblock.readers._header import MAX_COUNT
from seisblock.readers.lines import line_error

_FORTRAN_FORMAT = re.compile(r"\(\s*(\d*)[FEGI](\d+)(?:\.\d+)?\s*\)", re.IGNORECASE)


def parse_fortran_format(text: str) -> tuple[int, int] | None:
    """Return numbers per line and field width of a Fortran format, or None.

    Examples
    --------
    >>> [parse_fortran_format(text) for text in ("(8F10.3)", "Format=(1E15.6)", "(10I8)", "none")]
    [(8, 10), (1, 15), (10, 8), None]
    """
    match = _FORTRAN_FORMAT.search(text)
    per_line, width = (int(match[1] or 1), int(match[2])) if match else (0, 0)
    return (per_line, width) if per_line and width else None


def parse_fixed_width(name: str, lines: Sequence[str], first: int, count: int, layout: tuple[int, int]) -> tuple[FloatArray, int]:
    """Return `count` fixed-width numbers, (count,), and the index of the line after them.

    `layout` is numbers per line and field width, `first` the index of the first of `lines` with numbers. Raise RecordFormatError if the
    file is too short, a line has the wrong length, or a cell is not a number.
    """
    per_line, width = layout
    field_lines = lines[first : first + ceil(count / per_line)]
    if count < 1 or len(field_lines) * per_line < count:
        message = "{name}: file truncated: {count} numbers expected from line {line} on, end of file reached; download the file again"
        raise RecordFormatError(message, name=name, count=count, line=first + 1)
    parts = []
    for row, text in enumerate(field_lines):
        line_count = min(per_line, count - row * per_line)
        line = text.rstrip()
        # a lost or inserted character shifts all later fields of the line
        if len(line) != line_count * width:
            message = "expected {count} numbers of {width} characters each, found {text!r}"
            raise line_error(message, name, first + row + 1, count=line_count, width=width, text=line.strip()[:80])
        parts.append(line)
    digits = "".join(parts)
    try:
        values = np.array([float(digits[start : start + width]) for start in range(0, count * width, width)])
    except ValueError:
        values = np.full(count, np.nan)
    # float() accepts underscores between digits
    if "_" in digits or not np.isfinite(values).all():
        for number in range(count):
            _check_field(name, first + number // per_line + 1, digits[number * width : (number + 1) * width])
    return values, first + len(field_lines)


def _check_field(name: str, line: int, cell: str) -> None:
    """Raise RecordFormatError for a cell that is not a finite number."""
    try:
        value = float(cell)
    except ValueError:
        value = float("nan")
    if not isfinite(value) or "_" in cell:
        raise line_error("expected a number, found {cell!r}", name, line, cell=cell.strip())


def parse_sample_count(name: str, line: int, text: str) -> int:
    """Return the number of samples stated by a header; raise RecordFormatError unless it is a whole number of at least 2."""
    # 20 digits suffice to exceed MAX_COUNT; int() of a longer text is slow, and refused beyond 4300 digits
    if not text.strip().isascii() or not text.strip().isdigit() or not 2 <= int(text[:20]) < MAX_COUNT:
        raise line_error("expected the number of samples, found {text!r}", name, line, text=text.strip()[:40])
    return int(text)

"""Numbers in columns of one width, as Fortran writes them: a line that lost a character is found by its length."""

from __future__ import annotations

import re
from collections.abc import Sequence
from math import ceil, isfinite

import numpy as np

from seisblock.errors import RecordFormatError
from seisblock.readers.cells import fail
from seisblock.readers.header import LARGEST_COUNT
from seisblock.typing import FloatArray
from seisblock.words import said

DOS_END = "\x1a"
"""What old systems end a text with."""

_FORM = re.compile(r"\(\s*(\d*)[FEGI](\d+)(?:\.\d+)?\s*\)", re.IGNORECASE)


def form_of(text: str) -> tuple[int, int] | None:
    """Return how many numbers stand in a line and how wide each is, of a Fortran format, or None.

    Examples
    --------
    >>> form_of("(8F10.3)"), form_of("Format=(1E15.6)"), form_of("(10I8)"), form_of("none")
    ((8, 10), (1, 15), (10, 8), None)
    """
    match = _FORM.search(text)
    each, width = (int(match[1] or 1), int(match[2])) if match else (0, 0)
    return (each, width) if each and width else None


def fields_of(name: str, lines: Sequence[str], first: int, count: int, form: tuple[int, int]) -> FloatArray:
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
    form : tuple of int
        How many stand in a line, and how wide each is.

    Raises
    ------
    RecordFormatError
        If the file ends before them, a line holds more or fewer, or a cell is no number.
    """
    each, width = form
    taken = lines[first : first + ceil(count / each)]
    if count < 1 or len(taken) * each < count:
        raise RecordFormatError(
            "{name} is cut short: its header promises {count} numbers from line {line} on, and the file ends before them: fetch it again",
            name=name,
            count=count,
            line=first + 1,
        )
    values = np.empty(count)
    for row, text in enumerate(taken):
        held = min(each, count - row * each)
        line = text.rstrip()
        if len(line) != held * width:
            what = said(
                "expected {count} numbers of {width} characters each, found {text!r}", count=held, width=width, text=line.strip()[:80]
            )
            fail(name, first + row + 1, what)
        for column in range(held):
            values[row * each + column] = _number(name, first + row + 1, line[column * width : (column + 1) * width])
    return values


def lines_for(count: int, form: tuple[int, int]) -> int:
    """Return how many lines so many numbers take.

    Examples
    --------
    >>> lines_for(100, (16, 5)), lines_for(80, (8, 10))
    (7, 10)
    """
    return ceil(count / form[0])


def _number(name: str, line: int, cell: str) -> float:
    """Return the number in a cell."""
    try:
        value = float(cell)
    except ValueError:
        value = float("nan")
    if not isfinite(value) or "_" in cell:
        fail(name, line, said("expected a number, found {cell!r}", cell=cell.strip()))
    return value


def count_in(name: str, line: int, text: str) -> int:
    """Return a count of samples that a header tells.

    Raises
    ------
    RecordFormatError
        If it is none, or so few that nothing moves.
    """
    if not text.strip().isascii() or not text.strip().isdigit() or not 2 <= int(text[:20]) < LARGEST_COUNT:
        fail(name, line, said("expected the number of samples, found {text!r}", text=text.strip()[:40]))
    return int(text)

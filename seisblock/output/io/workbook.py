"""Excel workbooks; require openpyxl (extra ``excel``)."""

from __future__ import annotations

import csv
import math
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any
from unicodedata import east_asian_width

from seisblock.core.errors import OutputError
from seisblock.core.io.csv_safety import unescape_formula
from seisblock.output.io.atomic import atomic_write

MAX_COLUMN_WIDTH = 60
"""Largest width of a column, characters; longer texts wrap."""


def check_workbook(path: Path | str) -> None:
    """Raise OutputError unless the name ends in .xlsx and openpyxl is installed."""
    if Path(path).suffix.lower() != ".xlsx":
        raise OutputError("cannot save the table as {target}: the name must end in .xlsx", target=path)
    try:
        import openpyxl  # noqa: F401
    except ImportError as error:
        raise OutputError("writing .xlsx requires openpyxl: pip install 'seisblock[excel]', or write --csv") from error


def write_workbook(path: Path | str, header: Sequence[str], rows: Iterable[Sequence[Any]]) -> None:
    """Write rows as the one sheet of a workbook, header fixed and bold; texts like formulas stay texts.

    Parameters
    ----------
    path : str or Path
    header : sequence of str
    rows : iterable of sequence
        Texts, numbers or None.
    """
    import openpyxl
    from openpyxl.cell import WriteOnlyCell
    from openpyxl.cell.cell import ILLEGAL_CHARACTERS_RE
    from openpyxl.styles import Alignment, Font
    from openpyxl.utils import get_column_letter

    check_workbook(path)
    # a sheet that is begun and not saved ends in errors of lxml
    with atomic_write(path) as temporary:
        book = openpyxl.Workbook(write_only=True)
        sheet = book.create_sheet()
        table = [header, *rows]
        # a sheet that is written row by row takes these first
        for column, values in enumerate(zip(*table, strict=True), start=1):
            width = max(_width(value) for value in values if isinstance(value, str))
            sheet.column_dimensions[get_column_letter(column)].width = min(width, MAX_COLUMN_WIDTH) + 2
        sheet.freeze_panes = "B2"
        # each value is written before the cell takes the next one
        heading, cell = WriteOnlyCell(sheet), WriteOnlyCell(sheet)
        heading.font = Font(bold=True)
        heading.alignment = cell.alignment = Alignment(wrap_text=True, vertical="top")

        def cells(row: Sequence[Any], cell: Any) -> Iterator[Any]:
            for value in row:
                cell.value = ILLEGAL_CHARACTERS_RE.sub("", value) if isinstance(value, str) else value
                if isinstance(value, str):
                    cell.data_type = "s"  # without the type, a text that begins with = would be a formula
                yield cell

        for line, row in enumerate(table):
            sheet.append(cells(row, cell if line else heading))
        book.save(temporary)


def convert_csv(table: Path, target: Path) -> None:
    """Write a CSV table of a command as a workbook: its numbers as numbers, all other cells, such as the name 007, as texts."""
    with table.open(encoding="utf-8-sig", newline="") as stream:
        header, *rows = csv.reader(stream)
    write_workbook(target, header, [[_parse_cell(text) for text in row] for row in rows])


def _parse_cell(text: str) -> str | float | None:
    """Return the value of a CSV cell, None if empty; a number is one that Python writes so."""
    try:
        number = float(text)
    except ValueError:
        return unescape_formula(text) or None
    return number if math.isfinite(number) and text in (repr(number), f"{number:.0f}") else text


def _width(text: str) -> int:
    """Return the width of a text, characters; East Asian ones count twice."""
    return sum(2 if east_asian_width(letter) in "WF" else 1 for letter in text)

"""Excel workbooks; require openpyxl (extra ``excel``)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any
from unicodedata import east_asian_width

from seisblock.core.errors import OutputError
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
    from openpyxl.styles import Alignment, Font
    from openpyxl.utils import get_column_letter

    check_workbook(path)
    book = openpyxl.Workbook()
    sheet = book.active
    widths = [_width(text) for text in header]
    for line, row in enumerate([header, *rows], start=1):
        for column, value in enumerate(row, start=1):
            cell = sheet.cell(line, column)
            if isinstance(value, str):
                # without the type, a text that begins with = would be a formula
                cell.value = openpyxl.cell.cell.ILLEGAL_CHARACTERS_RE.sub("", value)
                cell.data_type = "s"
                widths[column - 1] = max(widths[column - 1], _width(value))
            else:
                cell.value = value
            cell.alignment = Alignment(wrap_text=True, vertical="top")
            if line == 1:
                cell.font = Font(bold=True)
    for column, width in enumerate(widths, start=1):
        sheet.column_dimensions[get_column_letter(column)].width = min(width, MAX_COLUMN_WIDTH) + 2
    sheet.freeze_panes = "B2"
    with atomic_write(path) as temporary:
        book.save(temporary)


def _width(text: str) -> int:
    """Return the width of a text, characters; East Asian ones count twice."""
    return sum(2 if east_asian_width(letter) in "WF" else 1 for letter in text)

"""Excel workbooks: the sheet with a table of motion, read as a plain table; requires openpyxl (extra ``excel``)."""

from __future__ import annotations

import csv
import io
import warnings
from datetime import datetime, time
from itertools import takewhile
from typing import Any

from seisblock.core.errors import RecordFormatError
from seisblock.core.i18n import N_
from seisblock.readers.archive import is_workbook
from seisblock.readers.registry import Format, find_format, register
from seisblock.readers.source import RawFile
from seisblock.records import Record

MIN_ROWS = 3
"""Rows of the shortest table."""


def read_xlsx(blob: RawFile, *, units: str | None = None, dt: float | None = None) -> Record:
    """Return the record in the only sheet of a workbook that is a table.

    Raises
    ------
    RecordFormatError
        If openpyxl is not installed, the workbook is damaged or encrypted, or none or several of its sheets have a table of numbers.
    UnitError, ParameterError
        As for a plain table.
    """
    try:
        import openpyxl
    except ImportError as error:
        raise RecordFormatError("{name}: Excel files require openpyxl: pip install 'seisblock[excel]'", name=blob.name) from error
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            workbook = openpyxl.load_workbook(io.BytesIO(blob.data), read_only=True, data_only=True)
            sheets = {sheet.title: _to_csv(sheet) for sheet in workbook.worksheets}
    except Exception as error:  # openpyxl, zlib and the XML parser raise errors of many classes for damaged files
        raise RecordFormatError("{name}: Excel file damaged or encrypted; save it again or as CSV", name=blob.name) from error
    tables = {title: text for title, text in sheets.items() if text.count("\n") >= MIN_ROWS}
    if len(tables) != 1:
        message = "{name}: {count} sheets with a table ({sheets}), one expected; save the sheet of the motion as CSV"
        raise RecordFormatError(message, name=blob.name, count=len(tables), sheets=list(sheets))
    table_format = find_format("CSV")
    ((title, text),) = tables.items()
    record = table_format.parse(RawFile(f"{blob.name}/{title}", text.encode()), units=units, dt=dt)
    if isinstance(record, list):
        (record,) = record
    return record


def _to_csv(sheet: Any) -> str:
    """Return the cells of a sheet as a table of commas, without empty rows and columns; rows of one cell on top are comments."""
    rows = [[_to_text(cell) for cell in row] for row in sheet.iter_rows(values_only=True)]
    rows = [row for row in rows if any(row)]
    used = [i for i in range(max(map(len, rows), default=0)) if any(row[i] for row in rows if i < len(row))]
    titles = [] if len(used) == 1 else list(takewhile(lambda row: sum(map(bool, row)) == 1, rows))
    buffer = io.StringIO("".join(f"# {' '.join(''.join(row).split())}\n" for row in titles))
    buffer.seek(0, io.SEEK_END)
    csv.writer(buffer, lineterminator="\n").writerows([[row[i] if i < len(row) else "" for i in used] for row in rows[len(titles) :]])
    return buffer.getvalue()


def _to_text(cell: object) -> str:
    """Return a cell as printed in a table."""
    if cell is None:
        return ""
    if isinstance(cell, (datetime, time)):
        return cell.isoformat(" ") if isinstance(cell, datetime) else cell.isoformat()
    return repr(cell) if isinstance(cell, float) else str(cell).strip()


FORMAT = register(
    Format(
        name="XLSX",
        title=N_("an Excel workbook"),
        parse=read_xlsx,
        matches=is_workbook,
        options=("units", "dt"),
        proves=("unit",),
        plugin=False,
    )
)

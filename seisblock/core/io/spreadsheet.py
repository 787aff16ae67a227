"""Tables with one header row: CSV text or the first worksheet of an Excel workbook, as rows of text cells."""

from __future__ import annotations

import csv
import io
import zipfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from seisblock.core.errors import BodyError, InputError
from seisblock.core.i18n import N_, Message
from seisblock.core.io.csv_table import (
    decode_text,
    is_separator_line,
    more_bad_rows,
    normalize_cell,
    parse_heading,
    row_dict,
    stated_separator,
)
from seisblock.core.io.files import read_bytes
from seisblock.core.limits import MAX_CELLS, check_file_size, check_limit

EXCEL_SUFFIXES = (".xlsx", ".xlsm")
TABLE_SUFFIXES = (".csv", ".tsv", ".txt", *EXCEL_SUFFIXES)
"""Suffixes of tables, in lower case."""

HEADER_ROWS = 20
"""Rows searched for the header: spreadsheets begin with a title, a place or a date."""

HEADER_CELLS = 2
"""Known headings that make a row the header."""

_ZIP_MAGIC, _OLE_MAGIC = b"PK\x03\x04", b"\xd0\xcf\x11\xe0"

Row = tuple[int, list[str]]
"""Line number and cells."""


@dataclass(frozen=True)
class Sheet:
    """Rows of a table.

    Parameters
    ----------
    source : str
        Name for messages.
    rows : tuple of (int, list of str)
        Line numbers and cells, normalised to NFKC, without comments and empty rows.
    notes : tuple of (int, str)
        Line numbers and texts of comments.
    """

    source: str
    rows: tuple[Row, ...]
    notes: tuple[tuple[int, str], ...] = ()

    def split_header(self, meanings: Mapping[str, str]) -> tuple[Row, tuple[Row, ...]]:
        """Return the header and the rows below it.

        The header is the first of the top rows with two known headings; without such a row the first one.

        Parameters
        ----------
        meanings : mapping of str to str
            Keys by normalised heading, see :func:`~seisblock.core.io.csv_table.parse_heading`.
        """
        for index, (_, cells) in enumerate(self.rows[:HEADER_ROWS]):
            if sum(bool(parse_heading(cell, meanings)[0]) for cell in cells) >= HEADER_CELLS:
                return self.rows[index], self.rows[index + 1 :]
        return self.rows[0], self.rows[1:]

    def parse_rows(
        self,
        columns: Sequence[str],
        rows: Sequence[Row],
        parse: Callable[[dict[str, str], int], Any],
        replace_invalid: Callable[[dict[str, str], int, Message], Any] | None = None,
    ) -> list[Any]:
        """Return the values of all rows; the first invalid one raises an error that counts the others.

        Parameters
        ----------
        columns : sequence of str
            Key of each column; empty for ignored ones.
        rows : sequence of (int, list of str)
        parse : callable
            Called with the cells by key and the line number.
        replace_invalid : callable
            Returns the value of an invalid row from its cells, its line number and the reason, instead of the error.

        Raises
        ------
        BodyError
            If a row is invalid; the message gives the line.
        """
        values, bad_rows = [], []
        for number, cells in rows:
            try:
                values.append(parse(row_dict(columns, cells), number))
            except InputError as error:
                if replace_invalid is None:
                    bad_rows.append((number, error.message))
                else:
                    values.append(replace_invalid(dict(zip(columns, cells, strict=False)), number, error.message))
        if bad_rows:
            (line, message), more_rows = bad_rows[0], more_bad_rows([number for number, _ in bad_rows[1:]])
            raise BodyError("{source}, line {line}: {what}{others}", source=self.source, line=line, what=message, others=more_rows)
        return values


def is_table(name: str | Path) -> bool:
    """Return whether a file is a table, by its suffix."""
    return Path(name).suffix.lower() in TABLE_SUFFIXES


def read_sheet(path: Path, name: str) -> Sheet:
    """Return the rows of a CSV file (UTF-8, Shift-JIS or UTF-16) or of the first worksheet of an .xlsx workbook.

    Parameters
    ----------
    path : Path
    name : str
        Name for messages.

    Raises
    ------
    BodyError
        If the file cannot be read, is neither text nor .xlsx, or openpyxl is missing.
    """
    data = read_bytes(path, name, BodyError)
    if data.startswith(_OLE_MAGIC):
        raise BodyError("{name} is a workbook of an old Excel: save it as .xlsx or as CSV UTF-8", name=name)
    if data.startswith(_ZIP_MAGIC) or path.suffix.lower() in EXCEL_SUFFIXES:
        return Sheet(name, tuple(_excel_rows(data, name)))
    return text_sheet(decode_text(data, name), name)


def text_sheet(text: str, source: str) -> Sheet:
    """Return the rows of a CSV text; a cell in quotes may have several lines.

    The separator is the stated one (``sep=;``), else that of most lines.
    """
    lines = text.splitlines()
    # a title may have a comma, and so may numbers and notes, but not the header of a table with another separator
    counted = [line for line in lines if not _is_comment(line)]
    separator = stated_separator(lines) or max(",\t;|", key=lambda mark: (sum(mark in line for line in counted), text.count(mark)))
    if lines and is_separator_line(lines[0]):
        lines[0] = ""
    rows: list[Row] = []
    notes: list[tuple[int, str]] = []
    read: list[int] = []  # lines of the row being read

    def content() -> Iterator[str]:
        for number, line in enumerate(lines, start=1):
            if _is_comment(line) and not read:
                notes.append((number, line.strip().lstrip("# ").rstrip()))
            elif line.strip(" \t,;|") or read:
                read.append(number)
                yield f"{line}\n"

    try:
        for cells in csv.reader(content(), delimiter=separator):
            rows.append((read[0], [normalize_cell(cell) for cell in cells]))
            read.clear()
    except csv.Error as error:
        raise BodyError("the line cannot be read as a table row: {error}", error=error) from error
    return Sheet(source, tuple(rows), tuple(notes))


def _is_comment(line: str) -> bool:
    return line.lstrip().startswith("#")


def _excel_rows(data: bytes, name: str) -> Iterator[Row]:
    """Yield the non-empty rows of the first worksheet."""
    try:
        import openpyxl
    except ImportError as error:
        raise BodyError(
            "{name}: reading .xlsx requires openpyxl (pip install 'seisblock[excel]'); or save the sheet as CSV UTF-8", name=name
        ) from error
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            check_file_size(sum(member.file_size for member in archive.infolist()), name, BodyError)
        book = openpyxl.load_workbook(io.BytesIO(data), read_only=True, data_only=True)
        rows = book.worksheets[0].iter_rows(values_only=True)
        cell_count = 0
        for number, values in enumerate(rows, start=1):
            cell_count += len(values)
            check_limit(N_("cells"), cell_count, MAX_CELLS, source=name, error=BodyError)
            cells = [_cell_text(value) for value in values]
            while cells and not cells[-1]:
                cells.pop()
            if cells and not cells[0].startswith("#"):
                yield number, cells
    except InputError:
        raise
    except Exception as error:  # openpyxl raises whatever its XML and zip parsers raise on a damaged workbook
        raise BodyError("{name} is not a readable .xlsx workbook: save it again, or as CSV UTF-8", name=name) from error


def _cell_text(value: Any) -> str:
    """Return the text of a worksheet cell; whole numbers without a decimal point."""
    if value is None:
        return ""
    if isinstance(value, bool):
        return str(int(value))
    if isinstance(value, float):
        return f"{value:.15g}"
    return normalize_cell(str(value))


def first_note(sheet: Sheet, header_line: int) -> tuple[str, ...]:
    """Return the comments above the header."""
    return tuple(text for number, text in sheet.notes if number < header_line)

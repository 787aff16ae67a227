"""Cells of tables from spreadsheets: encodings, separators, comments, headings and units."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Mapping, Sequence

from seisblock.core.errors import BodyError
from seisblock.core.i18n import lazy_gettext
from seisblock.core.units import LENGTH_UNITS, MASS_UNITS, parse_length

UNIT_PATTERN = re.compile(r"(.*?)\s*[(\[]\s*(.+?)\s*[)\]]\s*\Z")
"""Heading with a unit, such as ``height (cm)``."""

TRUE_WORDS = frozenset({"1", "1.0", "yes", "y", "true", "t", "○", "〇", "◯", "有", "有り", "あり", "はい"})
FALSE_WORDS = frozenset({"0", "0.0", "no", "n", "false", "f", "×", "✕", "無", "無し", "なし", "いいえ"})
UNKNOWN_WORDS = frozenset({"-", "−", "–", "?", "unknown", "不明"})
"""Values of a yes/no cell, case-insensitive."""

MAX_LISTED_ROWS = 5
"""Maximum number of further invalid rows listed in a message."""


_SEPARATOR_LINE = re.compile(r'[\ufeff \t]*"?sep=(.?)"?\s*', re.IGNORECASE)


def is_separator_line(line: str) -> bool:
    """Return whether a line is the first one of a table by which Excel knows its separator (``sep=;``)."""
    return _SEPARATOR_LINE.fullmatch(line) is not None


def stated_separator(lines: Sequence[str]) -> str | None:
    """Return the separator stated in the first line of a table (``sep=;``): comma, tab, semicolon or bar; None without one."""
    match = _SEPARATOR_LINE.fullmatch(lines[0]) if lines else None
    return match[1] if match and match[1] and match[1] in ",\t;|" else None


def decode_text(data: bytes, name: str) -> str:
    """Return the text of the content of a file in UTF-8 (with or without a byte order mark), Shift-JIS or UTF-16.

    Raises
    ------
    BodyError
        If it is not a text.
    """
    if b"\0" in data and data[:2] not in (b"\xff\xfe", b"\xfe\xff"):
        raise BodyError("{name} is not a text table: give a CSV file with one row per line", name=name)
    for encoding in ("utf-16",) if data[:2] in (b"\xff\xfe", b"\xfe\xff") else ("utf-8-sig", "cp932"):
        try:
            return data.decode(encoding)
        except UnicodeDecodeError:
            continue
    raise BodyError("{name} is neither UTF-8 nor Shift-JIS: save it as CSV UTF-8", name=name)


def normalize_cell(text: str) -> str:
    """Return the text of a cell in NFKC, on one line."""
    return " ".join(unicodedata.normalize("NFKC", text).split())


def normalize_heading(text: str) -> str:
    """Return a heading in lower case without blanks and underscores."""
    return re.sub(r"[\s_]+", "", text).casefold()


def parse_heading(cell: str, meanings: Mapping[str, str]) -> tuple[str, str]:
    """Return the key of a heading (empty if unknown) and its unit.

    Parameters
    ----------
    cell : str
        For example ``height (cm)``, ``height_cm``, ``Height``.
    meanings : mapping of str to str
        Keys by normalised heading.
    """
    match = UNIT_PATTERN.match(cell)
    label, unit = (match[1], match[2]) if match else (cell, "")
    key = normalize_heading(label)
    # height_cm
    if not unit and key not in meanings and "_" in label:
        head, _, tail = label.rpartition("_")
        if tail in (*LENGTH_UNITS, *MASS_UNITS) and normalize_heading(head) in meanings:
            key, unit = normalize_heading(head), tail
    # 幅cm
    if not unit and key not in meanings:
        for tail in LENGTH_UNITS:
            if key.endswith(tail) and not key[: -len(tail)].isascii() and key[: -len(tail)] in meanings:
                key, unit = key[: -len(tail)], tail
    return meanings.get(key, ""), unit


def row_dict(columns: Sequence[str], cells: Sequence[str]) -> dict[str, str]:
    """Return the cells of a row by column key.

    Raises
    ------
    BodyError
        If there are more cells than columns.
    """
    if any(cells[len(columns) :]):
        raise BodyError("expected {count} cells as in the header, found {found}", count=len(columns), found=len(cells))
    return dict(zip(columns, cells, strict=False))


def more_bad_rows(lines: Sequence[int]) -> str:
    """Return a note on further invalid lines, of which the first few are listed; empty if there are none.

    Parameters
    ----------
    lines : sequence of int
        Numbers of the invalid lines after the first.

    Examples
    --------
    >>> from seisblock.core.i18n import gettext
    >>> [gettext(more_bad_rows(lines)) for lines in ([], [4], [4, 7])]
    ['', ' (1 more invalid row: line 4)', ' (2 more invalid rows: lines 4, 7)']
    """
    if not lines:
        return ""
    if len(lines) == 1:
        return lazy_gettext(" (1 more invalid row: line {line})", line=lines[0])
    line_list = ", ".join(map(str, lines[:MAX_LISTED_ROWS])) + (" ..." if len(lines) > MAX_LISTED_ROWS else "")
    return lazy_gettext(" ({count} more invalid rows: lines {lines})", count=len(lines), lines=line_list)


def parse_length_cell(text: str, key: str, unit: str) -> float:
    """Return a length, m; its unit is that of the cell, else that of the column, else metres."""
    return parse_length(text + (unit or "m") if is_bare_number(text) else text, quantity=key)


def is_bare_number(text: str) -> bool:
    """Return True if a cell is a number without a unit."""
    return re.fullmatch(r"[-+.\deE]+", text) is not None


def parse_number_cell(text: str, key: str) -> float:
    """Return a number from a cell.

    Raises
    ------
    BodyError
        If the cell is not a number.
    """
    try:
        return float(text)
    except ValueError:
        raise BodyError("{key} must be a number, found {text!r}", key=key, text=text) from None

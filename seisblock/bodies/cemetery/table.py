"""CSV tables of cemeteries, with English or Japanese column names."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path

from seisblock.bodies.cemetery.cemetery import Cemetery, Stone
from seisblock.core import checks
from seisblock.core.errors import BodyError, InputError
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.io.csv_table import (
    FALSE_WORDS,
    TRUE_WORDS,
    data_lines,
    find_separator,
    is_bare_number,
    more_bad_rows,
    parse_heading,
    parse_length_cell,
    parse_number_cell,
    read_text,
    row_dict,
    split_cells,
)
from seisblock.core.limits import MAX_STONES, check_limit
from seisblock.samples import resolve_file_or_sample, sample_names

_COLUMN_NAMES = {
    "height_over_width": (
        "heightoverwidth",
        "h/b",
        "hb",
        "h/w",
        "height/width",
        "高さ幅比",
        "高さ/幅",
        "縦横比",
        "高さ幅比h/b",
        "竿の高さ幅比",
    ),
    "height": ("height", "h", "高さ", "竿高さ", "竿の高さ", "高"),
    "width": ("width", "b", "幅", "竿幅", "竿の幅"),
    "reinforced": ("reinforced", "dowelled", "doweled", "補強", "補強の有無"),
    "fallen": ("fallen", "overturned", "転倒", "転倒の有無", "被害"),
    "azimuth_deg": ("azimuthdeg", "azimuth", "方位", "方位角", "向き"),
    "count": ("count", "number", "個数", "基数", "数"),
}
"""Accepted column names, without case, blanks and underscores."""

_COLUMNS = {spelling: name for name, spellings in _COLUMN_NAMES.items() for spelling in spellings}
_BOOLEAN_WORDS = {
    "fallen": (
        TRUE_WORDS | {"fallen", "overturned", "転倒"},
        FALSE_WORDS | {"standing", "stood", "残存"},
        N_("0, 1, yes, no, 転倒 or 残存"),
    ),
    "reinforced": (
        TRUE_WORDS | {"reinforced", "補強", "補強有", "補強あり"},
        FALSE_WORDS | {"unreinforced", "無補強", "補強なし"},
        N_("0, 1, yes or no"),
    ),
}

MAX_SIZE = 20.0
"""Largest plausible size of a stone, m; larger numbers probably lack their unit."""

RATIO_TOLERANCE = 0.05
"""Largest relative difference between a given ratio and that of height and width."""


def read_cemetery(name: str | Path) -> Cemetery:
    """Return a cemetery from a CSV file or a bundled one.

    The header names the columns: ``height_over_width``, or ``height`` and ``width`` (a unit in the name, ``height (cm)``,
    or in the cell, ``8sun``; metres without); and, where known, ``reinforced``, ``fallen``, ``azimuth_deg``, ``count``. Japanese
    names (高さ幅比, 高さ, 幅, 補強, 転倒, 方位, 個数) are accepted, too. Lines that begin with # are comments; those before the
    header are kept as notes. UTF-8 with or without a byte order mark, Shift-JIS and UTF-16 are recognised; other columns are ignored.

    Parameters
    ----------
    name : str or Path
        File, or name of a bundled cemetery such as ``aoyama.csv``.

    Raises
    ------
    BodyError
        If there is no such file or bundled cemetery, a column is missing, or a row is invalid; the message gives the line.

    Examples
    --------
    >>> read_cemetery("aoyama.csv").size
    100
    """
    text = read_text(_resolve_path(name), str(name))
    return parse_cemetery(text, source=str(name))


def parse_cemetery(text: str, *, source: str = "table") -> Cemetery:
    """Return a cemetery from the text of a table, see :func:`read_cemetery`."""
    lines = [(number, line) for number, line in enumerate(text.splitlines(), start=1)]
    data_rows = data_lines(text)
    if not data_rows:
        raise BodyError("{source} contains no gravestones, only {count} empty lines and comments", source=source, count=len(lines))
    (header_line, header), rows = data_rows[0], data_rows[1:]
    separator = find_separator(header)
    columns, units = _parse_header(split_cells(header, separator), source, header_line)
    if not rows:
        template = "{source}, line {line}: no gravestone below the header; add one line per stone"
        raise BodyError(template, source=source, line=header_line)
    stones, bad_rows = [], []
    for number, line in rows:
        try:
            stones.append(_parse_stone(row_dict(columns, split_cells(line, separator)), units, number))
        except InputError as error:
            bad_rows.append((number, error.message))
    if bad_rows:
        (bad_line, message), more_text = bad_rows[0], more_bad_rows([number for number, _ in bad_rows[1:]])
        raise BodyError("{source}, line {line}: {what}{others}", source=source, line=bad_line, what=message, others=more_text)
    size = sum(stone.count for stone in stones)
    check_limit(N_("gravestones"), size, MAX_STONES, source=source, error=BodyError)
    notes = tuple(line.lstrip("# ").rstrip() for number, line in lines if number < header_line and line.startswith("#"))
    return Cemetery(tuple(stones), Path(source).stem, source, notes)


def _resolve_path(name: str | Path) -> Path:
    """Return the path of a file, or of a bundled cemetery."""
    path = Path(checks.path(name))
    if path.is_dir():
        raise BodyError("{name} is a folder: give the CSV file of a cemetery", name=name)
    resolved = resolve_file_or_sample(path, "cemetery")
    if resolved is None:
        raise BodyError(
            "no cemetery file {name}, and no bundled cemetery of that name; bundled: {known}", name=name, known=sample_names("cemetery")
        )
    return resolved


def _parse_header(cells: Sequence[str], source: str, line: int) -> tuple[list[str], dict[str, str]]:
    """Return the meaning of each column (empty if ignored) and the units in the column names."""
    columns, units = [], {}
    for cell in cells:
        name, unit = parse_heading(cell, _COLUMNS)
        if name and name in columns:
            raise BodyError("{source}, line {line}: two columns mean {name}: rename or remove one", source=source, line=line, name=name)
        columns.append(name)
        if unit and name in ("height", "width"):
            units[name] = unit
    if "height_over_width" not in columns and not {"height", "width"} <= set(columns):
        columns_found = cells or lazy_gettext("none")
        raise BodyError(
            "{source}, line {line}: columns required: height_over_width, or height and width; found {found}",
            source=source,
            line=line,
            found=columns_found,
        )
    return columns, units


def _parse_stone(row: Mapping[str, str], units: Mapping[str, str], line: int) -> Stone:
    width, height = (_parse_size(row, key, units) for key in ("width", "height"))
    ratio = _parse_number(row, "height_over_width")
    if ratio is not None:
        checks.positive("height over width", ratio, error=BodyError)
    if width is not None and height is not None:
        if ratio is not None and abs(height / width / ratio - 1.0) > RATIO_TOLERANCE:
            raise BodyError("height over width is {ratio:g}, but height and width give {found:.3g}", ratio=ratio, found=height / width)
        ratio = height / width if ratio is None else ratio
    elif ratio is None:
        missing_names = [name for name, value in (("height", height), ("width", width)) if value is None]
        raise BodyError("dimensions missing: height over width, or height and width, required; empty: {missing}", missing=missing_names)
    elif height is not None:
        width = height / ratio
    return Stone(
        ratio,
        width,
        reinforced=bool(_parse_bool(row, "reinforced")),
        fallen=_parse_bool(row, "fallen"),
        azimuth_deg=_parse_number(row, "azimuth_deg"),
        count=_parse_count(row),
        line=line,
    )


def _parse_size(row: Mapping[str, str], key: str, units: Mapping[str, str]) -> float | None:
    """Return a length, m; None for an empty cell."""
    text = row.get(key, "")
    if not text:
        return None
    has_no_unit, unit = is_bare_number(text), units.get(key, "")
    value = parse_length_cell(text, key, unit)
    if not value > 0.0:
        raise BodyError("{key} must be positive, found {text}", key=key, text=text)
    if value > MAX_SIZE:
        remedy = (
            lazy_gettext(" (read as metres without a unit: name the column, for example, {key} (cm))", key=key)
            if has_no_unit and not unit
            else ""
        )
        raise BodyError("{key} of {value:g} m is not plausible for a gravestone{remedy}", key=key, value=value, remedy=remedy)
    return value


def _parse_number(row: Mapping[str, str], key: str) -> float | None:
    """Return a number; None for an empty cell."""
    text = row.get(key, "")
    return parse_number_cell(text, key) if text else None


def _parse_count(row: Mapping[str, str]) -> int:
    """Return the number of stones of a row; 1 for an empty cell."""
    value = _parse_number(row, "count")
    if value is None:
        return 1
    if not (1 <= value < math.inf and value == int(value)):
        raise BodyError("count must be an integer, 1 or more; found {count}", count=row["count"])
    check_limit(N_("gravestones"), int(value), MAX_STONES, error=BodyError)
    return int(value)


def _parse_bool(row: Mapping[str, str], key: str) -> bool | None:
    """Return a bool; None for an empty cell."""
    text = row.get(key, "")
    true_words, false_words, expected = _BOOLEAN_WORDS[key]
    if not text:
        return None
    if text.casefold() not in true_words | false_words:
        raise BodyError("{key} must be {expected}, found {text!r}", key=key, expected=lazy_gettext(expected), text=text)
    return text.casefold() in true_words

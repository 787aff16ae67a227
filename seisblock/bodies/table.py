"""Tables of bodies and of gravestones (CSV, .xlsx), and body files, as specifications for solvers."""

from __future__ import annotations

import math
import os
import re
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from itertools import pairwise
from pathlib import Path
from typing import Any

from seisblock.bodies.body_name import body_name
from seisblock.bodies.edge_wear import parse_edge_wear
from seisblock.bodies.kinds import KINDS, normalize_kind
from seisblock.bodies.toml import bundled_bodies, pile_note, read_body_toml
from seisblock.bodies.uncertainty import ParameterRanges
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import BodyError, SeisblockError
from seisblock.core.i18n import N_, Message, lazy_gettext
from seisblock.core.io.csv_table import (
    FALSE_WORDS,
    TRUE_WORDS,
    UNKNOWN_WORDS,
    is_bare_number,
    normalize_cell,
    normalize_heading,
    parse_heading,
    parse_length_cell,
    parse_number_cell,
)
from seisblock.core.io.spreadsheet import Sheet, is_table, read_sheet
from seisblock.core.limits import MAX_BODIES, MAX_STONES, check_limit
from seisblock.core.units import MAX_UNITLESS_LENGTH, SUN, parse_mass

PAPER_WIDTH = 8 * SUN
"""Default width of an upper stone (sao), m: that of the fitted criterion ([Furukawa2009]_ table 1)."""

LENGTH_COLUMNS = ("width", "height", "depth", "centroid_height", "centroid_offset", "slope_length", "tenon", "drop")
NUMBER_COLUMNS = (
    "density",
    "centroid_inertia",
    "mu",
    "mu_kinetic",
    "kappa",
    "restitution",
    "rocking_restitution",
    "slope_deg",
    "frequency_vertical",
    "beta",
    "damping",
)
MAX_UNKNOWN_KINDS = 5
"""Largest number of unknown words of the column ``kind`` in a note."""

TEXT_COLUMNS = ("name", "body", "surface", "side", "kind")
SURVEY_COLUMNS = ("height_over_width", "reinforced", "fallen", "azimuth_deg", "count")
"""Columns of a survey of gravestones: a table with one of them lists stones."""

AMBIGUOUS_COLUMNS = ("azimuth_deg", "count")
"""Columns of a survey whose headings (number, direction) mean something else in an inventory."""

POSITIVE_COLUMNS = (
    "width",
    "height",
    "depth",
    "centroid_height",
    "slope_length",
    "mass",
    "density",
    "frequency_vertical",
    "height_over_width",
)
SIGNED_COLUMNS = ("centroid_offset", "slope_deg", "azimuth_deg")
"""Columns that may be negative; all others are zero or more."""

_RANGE = re.compile(r"([0-9.]+) ?(?:[-~\u2010-\u2015\u301c\u2212]|to|から) ?([0-9.]+)")
"""Range of friction in a cell: 0.5-0.7, 0.5~0.7."""

_IDENTIFIERS = ("番号", "墓石番号", "整理番号", "管理番号", "資料番号", "登録番号", "収蔵番号", "備品番号", "no", "no.", "id")
"""Headings of a number that names a body where there is no name."""

_SPELLINGS = {
    "width": ("b", "w", "幅", "横幅", "間口"),
    "height": ("h", "高さ", "高"),
    "depth": ("d", "奥行", "奥行き"),
    "mass": ("weight", "質量", "重量", "重さ"),
    "mu": ("μ", "friction", "frictioncoefficient", "摩擦係数", "摩擦係数μ", "静摩擦係数", "静摩擦係数μ"),
    "mu_kinetic": ("動摩擦係数",),
    "restitution": ("反発係数",),
    "centroid_height": ("重心高さ", "重心の高さ"),
    "name": (
        *("object", "item", "title", "名前", "名称", "品名", "物品名", "資料名", "資料名称", "作品名", "題名", "件名", "物体"),
        *_IDENTIFIERS,
    ),
    "surface": ("接触面",),
    "kind": ("種類", "種別"),
    "inset": ("摩耗", "縁の摩耗"),
    "height_over_width": ("h/b", "hb", "h/w", "height/width", "高さ幅比", "高さ/幅", "縦横比", "高さ幅比h/b"),
    "reinforced": ("dowelled", "doweled", "補強", "補強の有無"),
    "fallen": ("overturned", "転倒", "転倒の有無", "転倒有無", "転倒状況", "被害", "倒伏"),
    "azimuth_deg": ("azimuth", "方位", "方位角", "向き"),
    "count": ("number", "個数", "基数", "数"),
}
_SAO = ("竿", "棹")
"""Word for an upper stone (sao), in two spellings: in a heading it makes a table one of gravestones."""

_OF_STONE = [f"{word}{particle}" for word in (*_SAO, *(f"{sao}石" for sao in _SAO), "墓石", "石塔") for particle in ("", "の")]
"""Beginnings of the headings of a stone's sizes."""

_COLUMNS = {
    spelling: name
    for name in (*TEXT_COLUMNS, *LENGTH_COLUMNS, "mass", *NUMBER_COLUMNS, "inset", *SURVEY_COLUMNS)
    for spelling in (name.replace("_", ""), *_SPELLINGS.get(name, ()))
} | {
    f"{beginning}{spelling}": name
    for name in ("width", "height", "depth", "height_over_width")
    for spelling in _SPELLINGS[name]
    for beginning in _OF_STONE
    if not spelling.isascii()
}
"""Keys by heading, without case, blanks and underscores."""

_BOOLEAN_WORDS = {
    "fallen": (
        TRUE_WORDS | {"fallen", "overturned", "転倒", "倒れた", "倒伏", "倒壊", "倒"},
        FALSE_WORDS
        | {"standing", "stood", "残存", "未転倒", "不転倒", "非転倒", "正立", "直立", "ずれ", "回転", "移動", "無被害", "被害なし"},
        N_("0, 1, yes, no, 転倒 or 残存"),
    ),
    "reinforced": (
        TRUE_WORDS | {"reinforced", "補強", "補強有", "補強あり"},
        FALSE_WORDS | {"unreinforced", "無補強", "補強なし"},
        N_("0, 1, yes or no"),
    ),
}

_UNITS = {
    "density": ("kg/m3", "kg/m^3"),
    "centroid_inertia": ("kg m2", "kg m^2"),
    "frequency_vertical": ("hz",),
    "slope_deg": ("deg", "degrees", "°"),
}
"""Units accepted in the headings of columns without other units."""

MAX_LENGTH = 100.0
"""Largest plausible size of an object, m; of a gravestone, and of a number without a unit, :data:`MAX_UNITLESS_LENGTH`."""

RATIO_TOLERANCE = 0.05
"""Largest relative difference between a given ratio and that of height and width."""


@dataclass(frozen=True, repr=False)
class BodySpec(DisplayMixin):
    """Specification of one body: parameters from which each solver takes those it needs.

    Parameters
    ----------
    name : str
        Name in the results.
    parameters : mapping of str to float, str or EdgeWear
        Values by column name; lengths in m, masses in kg, others as the options of the same name.
    description : mapping or None
        TOML table of the body's file.
    source : str
        File, and line of a table, for messages.
    error : str or None
        Reason why an invalid row of a list describes no body, see :func:`read_body_list`.
    """

    name: str
    parameters: Mapping[str, Any] = field(default_factory=dict)
    description: Mapping[str, Any] | None = None
    source: str = ""
    error: str | None = None


def read_bodies(names: str | Path | Iterable[str | Path]) -> tuple[BodySpec, ...]:
    """Return the bodies of tables, body files and bundled names.

    A table (.csv, .xlsx) has a header that names its columns in English or Japanese: ``name``; ``width``, ``height``, ``depth``,
    ``centroid_height``, ``centroid_offset``, ``slope_length``, ``tenon``, ``drop`` (m, or with a unit in the heading, ``width (cm)``, or in
    the cell, ``24cm``); ``mass`` (kg, or with a unit); ``inset`` (a length, or a share per side); ``mu`` (a number, or a range from which
    samples are drawn, ``0.5-0.7``), ``mu_kinetic``, ``kappa``, ``surface``, ``restitution``, ``rocking_restitution``, ``slope_deg``,
    ``frequency_vertical`` (Hz), ``beta``, ``damping``, ``density``, ``centroid_inertia``; ``kind`` (gravestone, furniture, statue or block)
    beside sizes; and ``body``, a file or a bundled body whose description the row uses, with ``side`` short or long. Empty cells are
    ignored. A table with a column of a survey (``fallen``, ``reinforced``, ``height_over_width``, ``count``, ``azimuth_deg``) lists
    gravestones, as in :func:`~seisblock.bodies.cemetery.table.read_cemetery`: their kind is gravestone, a row with a count is that many
    bodies, names are optional, and other columns are ignored. Any other name is a file that describes one body, or a bundled body.

    Parameters
    ----------
    names : path, or paths

    Returns
    -------
    tuple of BodySpec
        In the order of files and rows.

    Raises
    ------
    BodyError
        If a file cannot be read, a column is unknown, or a row is invalid (the message gives the line).

    Examples
    --------
    >>> from seisblock.bodies import read_bodies
    >>> [body.name for body in read_bodies(["gravestone", "lantern"])]
    ['gravestone', 'lantern']
    """
    return _read_all(names, is_list=False)[0]


def read_body_list(names: str | Path | Iterable[str | Path]) -> tuple[tuple[BodySpec, ...], tuple[Message, ...]]:
    """Return the bodies of inventories, and notes: as :func:`read_bodies`, but one invalid cell does not refuse the others.

    An invalid row becomes a body with the reason as its ``error``; columns with another meaning are ignored and named in a note.

    Parameters
    ----------
    names : str, Path or iterable
    """
    return _read_all(names, is_list=True)


def _read_all(names: str | Path | Iterable[str | Path], *, is_list: bool) -> tuple[tuple[BodySpec, ...], tuple[Message, ...]]:
    paths = [names] if isinstance(names, (str, Path)) else list(names)
    bodies: list[BodySpec] = []
    notes: list[Message] = []
    for name in map(str, paths):
        if os.path.isdir(name):  # noqa: PTH112 - never raises, whatever the name
            text = "{name} is a folder: give a table of bodies (.csv, .xlsx), a TOML file that describes one body, or a bundled body"
            raise BodyError(text, name=name)
        if is_table(name):
            rows, ignored = _read_body_table(name, is_list=is_list)
            bodies += rows
            if ignored:
                notes.append(lazy_gettext("{source}: columns ignored: {columns}", source=Path(name).name, columns=ignored))
        else:
            bodies.append(_read_body_file(name))
    if not bodies:
        raise BodyError("body required: give a table of bodies, a file that describes one body, or a bundled body")
    check_limit(N_("bodies"), len(bodies), MAX_BODIES, error=BodyError)
    return tuple(bodies), tuple(notes)


def pile_notes(specs: Iterable[BodySpec]) -> list[Message]:
    """Return a note on each pile, which models of one block take as a whole."""
    notes = [(spec.name, pile_note(spec.description)) for spec in specs]
    return [lazy_gettext("{what}: {note}", what=body_name(name), note=note) for name, note in notes if note is not None]


def _read_body_file(name: str) -> BodySpec:
    """Return the body of a file or a bundled one."""
    table = read_body_toml(name)
    return BodySpec(Path(name).stem if Path(name).suffix else name, description=table, source=name)


def _read_body_table(name: str, *, is_list: bool) -> tuple[list[BodySpec], tuple[str, ...]]:
    """Return the bodies of a table and the headings of ignored columns."""
    sheet = read_sheet(Path(name), name)
    if len(sheet.rows) < 2:
        raise BodyError("{name} contains no bodies: a header and one line per body are required", name=name)
    table = parse_table(sheet, is_list=is_list)
    check_limit(N_("bodies"), sum(row.count for row in table.rows), MAX_BODIES, source=name, error=BodyError)
    return [spec for row in table.rows for spec in _body_specs(row, name, stones=table.stones)], table.ignored


@dataclass(frozen=True)
class TableRow:
    """Values of one row.

    Parameters
    ----------
    line : int
        Line of the file.
    name : str
        Of the row; its number, counted from 1, where names are optional and missing.
    values : mapping of str to float, str, bool or EdgeWear
        Non-empty cells by key, SI; of a gravestone always with ``height_over_width``, and with both sizes if one is known.
    count : int
        Number of such bodies.
    error : str or None
        Reason why the row is invalid.
    """

    line: int
    name: str
    values: Mapping[str, Any]
    count: int = 1
    error: str | None = None


@dataclass(frozen=True)
class Table:
    """Rows of a table of bodies.

    Parameters
    ----------
    rows : tuple of TableRow
    stones : bool
        True for a survey of gravestones.
    header_line : int
    ignored : tuple of str
        Headings of columns of a list of bodies that have another meaning.
    """

    rows: tuple[TableRow, ...]
    stones: bool
    header_line: int
    ignored: tuple[str, ...] = ()


def parse_table(sheet: Sheet, *, stones: bool | None = None, is_list: bool = False) -> Table:
    """Return the rows of a table of bodies or gravestones; the one reader of both.

    Parameters
    ----------
    sheet : Sheet
        With at least one row.
    stones : bool or None
        True: every row is a gravestone; None: by the headings.
    is_list : bool
        True: invalid rows are kept with their reason, and unknown columns of bodies are ignored.

    Raises
    ------
    BodyError
        If a column is unknown or missing, or a row is invalid; the message gives the line.
    """
    (header_line, header), rows = sheet.split_header(_COLUMNS)
    columns, units = _parse_header(header, sheet.source, header_line)
    index = columns.index("count") if "count" in columns else None
    if index is not None and normalize_heading(header[index]) == "number":
        cells = [cells[index] for _, cells in rows if index < len(cells) and cells[index]]
        if _are_running_numbers(cells):
            columns[index] = "" if "name" in columns else "name"
    marks = [key for key in SURVEY_COLUMNS if not (is_list and key in AMBIGUOUS_COLUMNS)]
    lists_stones = (
        any(key in marks for key in columns) or any(word in cell for word in _SAO for cell in header) if stones is None else stones
    )
    if is_list and not lists_stones:
        columns = ["" if key in AMBIGUOUS_COLUMNS else key for key in columns]
    if not lists_stones:
        _require_known(columns, header, sheet.source, header_line, is_list=is_list)
    elif "height_over_width" not in columns and not {"height", "width"} <= set(columns):
        raise BodyError(
            "{source}, line {line}: columns required: height_over_width, or height and width; found {found}",
            source=sheet.source,
            line=header_line,
            found=header or lazy_gettext("none"),
        )
    numbers = {line: number for number, (line, _) in enumerate(rows, start=1)}

    def parse_row(cells: dict[str, str], line: int) -> TableRow:
        values = {
            key: value
            for key, cell in cells.items()
            if key and cell and (value := _parse_value(key, cell, units.get(key, ""), stone=lists_stones)) is not None
        }
        if isinstance(limits := values.get("mu"), tuple):
            values |= {"mu": 0.5 * sum(limits), "mu_range": limits}
        count = int(values.pop("count", 1))
        name = values.pop("name", "")
        if lists_stones:
            return TableRow(line, name or str(numbers[line]), _with_ratio(values), count)
        if not name and not is_list:
            raise BodyError("the name of a body is empty: fill the cell")
        return TableRow(line, name or str(numbers[line]), values)

    def keep_invalid_row(cells: dict[str, str], line: int, reason: Message) -> TableRow:
        return TableRow(line, cells.get("name") or str(numbers[line]), {}, error=reason)

    parsed = sheet.parse_rows(columns, rows, parse_row, keep_invalid_row if is_list else None)
    ignored = () if lists_stones else tuple(cell[:100] for key, cell in zip(columns, header, strict=True) if cell and not key)
    return Table(tuple(parsed), lists_stones, header_line, ignored)


def _body_specs(row: TableRow, source: str, *, stones: bool) -> list[BodySpec]:
    """Return the bodies of a row; several for a count of gravestones."""
    values = dict(row.values)
    place = lazy_gettext("{name}, line {line}", name=source, line=row.line)
    if row.error is not None:
        return [BodySpec(row.name, source=place, error=lazy_gettext("{source}: {why}", source=place, why=row.error))]
    if stones:
        if values.pop("reinforced", False):
            raise BodyError(
                "{source}: a stone with a dowel is not a rigid block; remove the row, or use the criterion furukawa of overturn-rate",
                source=place,
            )
        ratio = values.pop("height_over_width")
        width = values.setdefault("width", PAPER_WIDTH)
        values.setdefault("height", width * ratio)
        values.setdefault("kind", "gravestone")
        for key in ("fallen", "azimuth_deg"):
            values.pop(key, None)
    description = values.pop("body", None)
    names = [row.name] if row.count == 1 else [f"{row.name}-{number}" for number in range(1, row.count + 1)]
    return [BodySpec(name, values, description, place) for name in names]


def _parse_header(cells: Sequence[str], source: str, line: int) -> tuple[list[str], dict[str, str]]:
    """Return the key of each column (empty if unknown) and the units in the headings.

    Beside a column of names a number or a second name is no column of its own.
    """
    columns, units = [], {}
    headings = [parse_heading(cell, _COLUMNS) for cell in cells]
    named = [index for index, (key, _) in enumerate(headings) if key == "name"]
    first = next((index for index in named if normalize_heading(cells[index]) not in _IDENTIFIERS), named[0] if named else -1)
    for index, (cell, (key, unit)) in enumerate(zip(cells, headings, strict=True)):
        name = "" if key == "name" and index != first else key
        if name and name in columns:
            raise BodyError("{source}, line {line}: two columns mean {name}: rename or remove one", source=source, line=line, name=name)
        if name and unit and name not in (*LENGTH_COLUMNS, "mass", "inset") and unit.casefold() not in _UNITS.get(name, ()):
            # 転倒(有無), 転倒(1/0): a remark on the values, not a unit
            if name not in SURVEY_COLUMNS and name not in TEXT_COLUMNS:
                raise BodyError(
                    "{source}, line {line}: unit {unit!r} of column {cell!r} is not known; known: {expected}",
                    source=source,
                    line=line,
                    cell=cell[:100],
                    unit=unit[:100],
                    expected=list(_UNITS.get(name, ())) or lazy_gettext("none"),
                )
            unit = ""
        if name:
            units[name] = unit
        columns.append(name)
    return columns, units


def _are_running_numbers(cells: Sequence[str]) -> bool:
    """Return whether cells under ``number`` identify stones: consecutive numbers, or at least three in rising order; else they count."""
    if not cells or not all(cell.isdecimal() for cell in cells):
        return bool(cells) and any(any(letter.isalpha() for letter in cell) for cell in cells)
    steps = [int(b) - int(a) for a, b in pairwise(cells)]
    return set(steps) == {1} or (len(steps) > 1 and min(steps) > 0)


def _require_known(columns: Sequence[str], header: Sequence[str], source: str, line: int, *, is_list: bool) -> None:
    """Raise an error for an unknown heading of another table than a list, or for bodies without names."""
    for key, cell in zip(columns, header, strict=True):
        if not key and not is_list:
            raise BodyError(
                "{source}, line {line}: unknown column {cell!r}; known: {known}",
                source=source,
                line=line,
                cell=cell[:100],
                known=[*TEXT_COLUMNS, *LENGTH_COLUMNS, "mass", *NUMBER_COLUMNS, "inset"],
            )
    if "name" not in columns:
        raise BodyError("{source}, line {line}: a column 'name' is required; found {found}", source=source, line=line, found=list(header))


def _with_ratio(values: dict[str, Any]) -> dict[str, Any]:
    """Return the values of a gravestone with its H/B, and with both sizes if one is known."""
    width, height, ratio = (values.get(key) for key in ("width", "height", "height_over_width"))
    if width is not None and height is not None:
        if ratio is not None and abs(height / width / ratio - 1.0) > RATIO_TOLERANCE:
            raise BodyError("height over width is {ratio:g}, but height and width give {found:.3g}", ratio=ratio, found=height / width)
        return {"height_over_width": height / width} | values
    if ratio is None:
        missing_names = [key for key, value in (("height", height), ("width", width)) if value is None]
        raise BodyError("dimensions missing: height over width, or height and width, required; empty: {missing}", missing=missing_names)
    if height is not None:
        values["width"] = height / ratio
    elif width is not None:
        values["height"] = width * ratio
    return values


def _find_file(cell: str) -> str:
    """Return the file that a cell names: cells are in NFKC, and names of files may have full-width letters and brackets."""
    path = Path(cell)
    with suppress(OSError, ValueError):  # too long a name, no such folder
        if path.suffix and not path.exists():
            return next((str(entry) for entry in sorted(path.parent.iterdir()) if normalize_cell(entry.name) == path.name), cell)
    return cell


def _parse_value(key: str, cell: str, unit: str, *, stone: bool) -> Any:
    """Return the value of a cell, SI; None for an outcome marked as unknown."""
    if key == "body":
        return read_body_toml(_find_file(cell))
    if key == "kind":
        return normalize_kind(cell)
    if key in TEXT_COLUMNS:
        return cell
    if key in _BOOLEAN_WORDS:
        return _parse_bool(key, cell)
    if key == "inset":
        return parse_edge_wear(cell + unit if is_bare_number(cell) else cell)
    if key == "mass":
        return _check_range(key, parse_mass(cell + unit if is_bare_number(cell) else cell, quantity=key), "kg")
    if key == "count":
        return _parse_count(cell)
    if key in LENGTH_COLUMNS:
        value = _check_range(key, parse_length_cell(cell, key, unit), "m")
        unitless = is_bare_number(cell) and not unit
        if abs(value) > (MAX_UNITLESS_LENGTH if stone or unitless else MAX_LENGTH):
            text = " (read as metres without a unit: name the column, for example, {key} (cm))"
            remedy = lazy_gettext(text, key=key) if unitless else ""
            raise BodyError("{key} of {value:g} m is not plausible{remedy}", key=key, value=value, remedy=remedy)
        return value
    if key == "mu" and (ends := _RANGE.fullmatch(cell)):
        return ParameterRanges(mu=(parse_number_cell(ends[1], key), parse_number_cell(ends[2], key))).mu
    return _check_range(key, parse_number_cell(cell, key))


def _check_range(key: str, value: float, unit: str = "") -> float:
    """Return a number after the range check of its column."""
    check = checks.finite if key in SIGNED_COLUMNS else checks.positive if key in POSITIVE_COLUMNS else checks.non_negative
    return check("{key}", value, unit, key=key, error=BodyError)


def _parse_count(cell: str) -> int:
    """Return the number of stones of a row."""
    value = parse_number_cell(cell, "count")
    if not (1 <= value < math.inf and value == int(value)):
        raise BodyError("count must be an integer, 1 or more; found {count}", count=cell)
    check_limit(N_("gravestones"), int(value), MAX_STONES, error=BodyError)
    return int(value)


def _parse_bool(key: str, cell: str) -> bool | None:
    """Return a bool; None for a cell that says unknown."""
    true_words, false_words, expected = _BOOLEAN_WORDS[key]
    word = cell.casefold()
    if word in UNKNOWN_WORDS:
        return None
    if word not in true_words | false_words:
        raise BodyError("{key} must be {expected}, found {text!r}", key=key, expected=lazy_gettext(expected), text=cell)
    return word in true_words


def resolve_kinds(specs: Sequence[BodySpec]) -> tuple[list[BodySpec], list[Message]]:
    """Return bodies with the values of their kinds, and notes on words of the column ``kind`` without effect.

    A bundled name stands for that body; beside sizes it gives the friction of the kind, and an unknown word has no effect.
    """
    pairs = [_resolve_kind(spec) for spec in specs]
    unknown = sorted({kind for _, kind in pairs if kind is not None})
    words = [repr(kind[:40]) for kind in unknown[:MAX_UNKNOWN_KINDS]]
    notes = [lazy_gettext("kinds without effect: {unknown}; known: {known}", unknown=words, known=_known_kinds())] if unknown else []
    return [spec for spec, _ in pairs], notes


def _resolve_kind(spec: BodySpec) -> tuple[BodySpec, str | None]:
    """Return a body with the values of its kind, and the kind if it is unknown and has no effect."""
    values = dict(spec.parameters)
    kind = values.get("kind")
    if not isinstance(kind, str) or spec.description is not None:
        return spec, None
    has_sizes = "width" in values or "height" in values
    # without sizes `statue` is the bundled body, beside them the kind of the object
    if kind in KINDS and (has_sizes or kind not in bundled_bodies()):
        return spec, None
    del values["kind"]
    try:
        table = read_body_toml(kind)
    except SeisblockError:
        if has_sizes:
            return replace(spec, parameters=values), kind
        text = lazy_gettext("unknown kind of body {kind!r}; known: {known}", kind=kind[:100], known=_known_kinds())
        return replace(spec, error=lazy_gettext("{source}: {why}", source=spec.source, why=text)), None
    if not has_sizes:
        return BodySpec(spec.name, values, table, spec.source), None
    if "mu" not in values and "surface" not in values and table.get("mu") is not None:
        values["mu"] = float(table["mu"])
    return BodySpec(spec.name, values, None, spec.source), None


def _known_kinds() -> list[str]:
    return list(dict.fromkeys((*KINDS, *bundled_bodies())))

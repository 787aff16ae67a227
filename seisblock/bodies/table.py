"""Tables of bodies (CSV), and body files, as specifications for solvers."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from seisblock.bodies.edge_wear import EdgeWear, parse_edge_wear
from seisblock.bodies.toml import read_body_toml
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import BodyError, InputError
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.io.csv_table import (
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
from seisblock.core.limits import MAX_BODIES, check_limit
from seisblock.core.units import parse_mass

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
TEXT_COLUMNS = ("name", "body", "surface", "side", "kind")
POSITIVE_COLUMNS = ("width", "height", "depth", "centroid_height", "slope_length", "mass", "density", "frequency_vertical")
SIGNED_COLUMNS = ("centroid_offset", "slope_deg")
"""Columns that may be negative; all others are zero or more."""

_JAPANESE_NAMES = {
    "width": ("幅",),
    "height": ("高さ",),
    "depth": ("奥行", "奥行き"),
    "mass": ("質量",),
    "mu": ("摩擦係数", "静摩擦係数"),
    "mu_kinetic": ("動摩擦係数",),
    "restitution": ("反発係数",),
    "centroid_height": ("重心高さ", "重心の高さ"),
    "name": ("名前", "名称", "資料名"),
    "surface": ("接触面",),
    "kind": ("種類", "種別"),
}
_COLUMNS = {
    spelling: name
    for name in (*TEXT_COLUMNS, *LENGTH_COLUMNS, "mass", *NUMBER_COLUMNS, "inset")
    for spelling in (name.replace("_", ""), *_JAPANESE_NAMES.get(name, ()))
}

_UNITS = {
    "density": ("kg/m3", "kg/m^3"),
    "centroid_inertia": ("kg m2", "kg m^2"),
    "frequency_vertical": ("hz",),
    "slope_deg": ("deg", "degrees", "°"),
}
"""Units accepted in the headings of columns without other units."""

MAX_LENGTH = 100.0
"""Largest plausible size, m; larger numbers probably lack their unit."""


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
    """

    name: str
    parameters: Mapping[str, Any] = field(default_factory=dict)
    description: Mapping[str, Any] | None = None
    source: str = ""


def read_bodies(names: str | Path | Iterable[str | Path]) -> tuple[BodySpec, ...]:
    """Return the bodies of tables, body files and bundled names.

    A table (.csv) has a header that names its columns: ``name``; ``width``, ``height``, ``depth``, ``centroid_height``,
    ``centroid_offset``, ``slope_length``, ``tenon``, ``drop`` (m, or with a unit in the heading, ``width (cm)``, or in the cell, ``24cm``);
    ``mass`` (kg, or with a unit); ``inset`` (a length, or a share per side); ``mu``, ``mu_kinetic``, ``kappa``, ``surface``,
    ``restitution``, ``rocking_restitution``, ``slope_deg``, ``frequency_vertical`` (Hz), ``beta``, ``damping``, ``density``,
    ``centroid_inertia``; ``kind`` (gravestone, furniture, statue or block) beside sizes; and ``body``, a file or a bundled body whose
    description the row uses, with ``side`` short or long. Empty cells are ignored. Any other name is a file that describes one body, or a
    bundled body.

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
    paths = [names] if isinstance(names, (str, Path)) else list(names)
    bodies = [body for name in paths for body in (_read_body_table(str(name)) if _is_table(name) else [_read_body_file(str(name))])]
    if not bodies:
        raise BodyError("body required: give a table of bodies, a file that describes one body, or a bundled body")
    check_limit(N_("bodies"), len(bodies), MAX_BODIES, error=BodyError)
    return tuple(bodies)


def _is_table(name: str | Path) -> bool:
    """Return whether a file is a table, by its suffix."""
    return Path(name).suffix.lower() in (".csv", ".tsv", ".txt")


def _read_body_file(name: str) -> BodySpec:
    """Return the body of a file or a bundled one."""
    table = read_body_toml(name)
    return BodySpec(Path(name).stem if Path(name).suffix else name, description=table, source=name)


def _read_body_table(name: str) -> list[BodySpec]:
    path = Path(name)
    if path.is_dir():
        raise BodyError("{name} is a folder: give a CSV file with one body on each line", name=name)
    lines = data_lines(read_text(path, name))
    if len(lines) < 2:
        raise BodyError("{name} contains no bodies: a header and one line per body are required", name=name)
    (header_line, header), rows = lines[0], lines[1:]
    separator = find_separator(header)
    columns, units = _parse_header(split_cells(header, separator), name, header_line)
    bodies, bad_rows = [], []
    for number, line in rows:
        try:
            bodies.append(
                _parse_row(
                    row_dict(columns, split_cells(line, separator)), units, lazy_gettext("{name}, line {line}", name=name, line=number)
                )
            )
        except InputError as error:
            bad_rows.append((number, error.message))
    if bad_rows:
        (bad_line, message), more_text = bad_rows[0], more_bad_rows([number for number, _ in bad_rows[1:]])
        raise BodyError("{source}, line {line}: {what}{others}", source=name, line=bad_line, what=message, others=more_text)
    return bodies


def _parse_header(cells: Sequence[str], source: str, line: int) -> tuple[list[str], dict[str, str]]:
    """Return the meaning of each column and the units in the headings; unknown columns raise an error."""
    columns, units = [], {}
    for cell in cells:
        name, unit = parse_heading(cell, _COLUMNS)
        if not name:
            raise BodyError(
                "{source}, line {line}: unknown column {cell!r}; known: {known}",
                source=source,
                line=line,
                cell=cell[:100],
                known=[*TEXT_COLUMNS, *LENGTH_COLUMNS, "mass", *NUMBER_COLUMNS, "inset"],
            )
        if name in columns:
            raise BodyError("{source}, line {line}: two columns mean {name}: rename or remove one", source=source, line=line, name=name)
        if unit and name not in (*LENGTH_COLUMNS, "mass", "inset") and unit.casefold() not in _UNITS.get(name, ()):
            raise BodyError(
                "{source}, line {line}: unit {unit!r} of column {cell!r} is not known; known: {expected}",
                source=source,
                line=line,
                cell=cell[:100],
                unit=unit[:100],
                expected=list(_UNITS.get(name, ())) or lazy_gettext("none"),
            )
        units[name] = unit
        columns.append(name)
    if "name" not in columns:
        raise BodyError("{source}, line {line}: column name required; found {found}", source=source, line=line, found=list(cells))
    return columns, units


def _parse_row(row: Mapping[str, str], units: Mapping[str, str], source: str) -> BodySpec:
    name = row["name"]
    if not name:
        raise BodyError("the name of a body is empty: fill the cell")
    values: dict[str, Any] = {}
    for key, cell in row.items():
        if key != "name" and cell:
            values[key] = _parse_value(key, cell, units.get(key, ""))
    description = read_body_toml(values.pop("body")) if "body" in values else None
    return BodySpec(name, values, description, source)


def _parse_value(key: str, cell: str, unit: str) -> float | str | EdgeWear:
    """Return the value of a cell, SI."""
    if key in TEXT_COLUMNS:
        return cell
    if key == "inset":
        return parse_edge_wear(cell + unit if is_bare_number(cell) else cell)
    if key == "mass":
        return _check_range(key, parse_mass(cell + unit if is_bare_number(cell) else cell, quantity=key), "kg")
    if key in LENGTH_COLUMNS:
        value = parse_length_cell(cell, key, unit)
        if abs(value) > MAX_LENGTH:
            raise BodyError("{key} of {value:g} m is not plausible for an object (read as metres without a unit)", key=key, value=value)
        return _check_range(key, value, "m")
    return _check_range(key, parse_number_cell(cell, key))


def _check_range(key: str, value: float, unit: str = "") -> float:
    """Return a number after the range check of its column."""
    check = checks.finite if key in SIGNED_COLUMNS else checks.positive if key in POSITIVE_COLUMNS else checks.non_negative
    return check("{key}", value, unit, key=key, error=BodyError)

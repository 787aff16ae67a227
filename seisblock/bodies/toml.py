"""TOML body descriptions: files and bundled bodies, typed access to their entries."""

from __future__ import annotations

import tomllib
from collections.abc import Collection, Mapping, Sequence
from pathlib import Path
from typing import Any

from seisblock.bodies.edge_wear import EdgeWear, parse_edge_wear
from seisblock.bodies.scan.mesh import SUFFIXES as MESH_SUFFIXES
from seisblock.core import checks
from seisblock.core.errors import BodyError
from seisblock.core.i18n import Message, lazy_gettext
from seisblock.core.io.files import read_bytes
from seisblock.core.units import parse_length, parse_mass
from seisblock.samples import sample_directory

MAX_QUOTED_LENGTH = 200
"""Largest number of quoted characters of a file in a message."""


def read_body_toml(name: str | Path, *, kind: str | None = None) -> dict[str, Any]:
    """Return the TOML table of a body, from a path or the name of a bundled body.

    Parameters
    ----------
    name : str or Path
        File, or name of a bundled body such as ``chozusha``.
    kind : str or None
        Required kind: without such a file, only bundled bodies of this kind are suggested.

    Raises
    ------
    BodyError
        If there is no such file or bundled body, or the file is not TOML.
    """
    path = Path(checks.path(name))
    if not _exists(path):
        bundled = sample_directory() / (path.name if path.suffix == ".toml" else f"{path.name}.toml")
        if path.parent != Path() or not _exists(bundled):
            raise BodyError(
                "no body file {name}, and no bundled body of that name; bundled: {known}",
                name=str(name)[:MAX_QUOTED_LENGTH],
                known=bundled_bodies(kind),
            )
        path = bundled
    if path.is_dir():
        raise BodyError("{name} is a folder: give a TOML file that describes a body", name=name)
    if path.suffix.lower() in MESH_SUFFIXES:
        raise BodyError("{name} is a mesh: give the TOML file that `seisblock body` writes of it", name=str(name))
    data = read_bytes(path, str(name), BodyError)
    if not data.strip():
        raise BodyError("{name} is empty: give a TOML file that describes a body", name=name)
    try:
        table = tomllib.loads(data.decode("utf-8-sig"))
    except UnicodeDecodeError as error:
        raise BodyError("{name} is not UTF-8 text: give a TOML file that describes a body, saved as UTF-8", name=name) from error
    except (ValueError, RecursionError) as error:  # invalid TOML or date, or nesting too deep
        raise BodyError("{name} is not valid TOML: {reason}", name=str(name), reason=str(error)) from error
    return {**table, "source": str(name)}


def bundled_bodies(kind: str | None = None) -> list[str]:
    """Return the names of the bundled bodies, of one kind or all."""
    return sorted(path.stem for path in sample_directory().glob("*.toml") if path.stem != "MANIFEST" and kind in (None, _kind(path)))


def _kind(path: Path) -> str:
    return str(tomllib.loads(path.read_text(encoding="utf-8"))["kind"])


def _exists(path: Path) -> bool:
    """Return whether a file exists; False for names that the system rejects."""
    try:
        return path.exists()
    except OSError:  # name too long for the system
        return False


def source_name(table: Mapping[str, Any]) -> str:
    """Return the name of a table in messages."""
    source = table.get("source") or lazy_gettext("body")
    return source if isinstance(source, str) else str(source)


def get_number(table: Mapping[str, Any], key: str) -> float | None:
    """Return an optional finite number, None if missing."""
    value = table.get(key)
    return None if value is None else checks.finite("{source}: {key}", value, error=BodyError, source=source_name(table), key=key)


def get_text(table: Mapping[str, Any], key: str, default: str) -> str:
    """Return an optional string."""
    return _check_text(table.get(key, default), table, key)


def get_texts(table: Mapping[str, Any], key: str) -> tuple[str, ...]:
    """Return an optional list of strings, empty if missing."""
    return tuple(_check_text(value, table, key) for value in _check_list(table.get(key, []), table, key))


def get_text_groups(table: Mapping[str, Any], key: str) -> tuple[tuple[str, ...], ...]:
    """Return an optional list of lists of strings, empty if missing."""
    return tuple(get_texts({**table, key: group}, key) for group in _check_list(table.get(key, []), table, key))


def get_subtable(table: Mapping[str, Any], key: str) -> Mapping[str, Any]:
    """Return an optional subtable, named by both in messages."""
    value = table.get(key, {})
    if not isinstance(value, Mapping):
        raise BodyError("{source}: {key} must be a table, found {found}", source=source_name(table), key=key, found=quote_value(value))
    return {**value, "source": lazy_gettext("{source}: {key}", source=source_name(table), key=key)}


def check_keys(table: Mapping[str, Any], allowed: Collection[str]) -> None:
    """Raise an error for unknown keys."""
    unknown_keys = sorted(set(table) - {*allowed, "source"})
    if unknown_keys:
        raise BodyError(
            "{source}: unknown entries {unknown}; known: {known}",
            source=source_name(table),
            unknown=[key[:MAX_QUOTED_LENGTH] for key in unknown_keys],
            known=sorted(allowed),
        )


def quote_value(value: Any) -> Message | str:
    """Return a value as shown in a message."""
    return lazy_gettext("nothing") if value is None else repr(value)[:MAX_QUOTED_LENGTH]


def check_kind(table: Mapping[str, Any], kind: str) -> None:
    """Raise an error for a table of another kind of body."""
    actual = table.get("kind")
    if actual != kind:
        raise BodyError('{source}: kind must be "{kind}", found {found}', source=source_name(table), kind=kind, found=quote_value(actual))


def get_length(table: Mapping[str, Any], key: str) -> float:
    """Return a required length, m; a string may carry a unit."""
    return parse_length(_require(table, key), quantity=lazy_gettext("{source}: {key}", source=source_name(table), key=key))


def get_lengths(table: Mapping[str, Any], key: str, count: int) -> tuple[float, ...]:
    """Return a required list of lengths, m."""
    label = lazy_gettext("{source}: {key}", source=source_name(table), key=key)
    return tuple(parse_length(entry, quantity=label) for entry in entries(table, key, count))


def get_edge_wear(table: Mapping[str, Any]) -> EdgeWear:
    """Return the edge wear of a table: string with length or share, or number as share; sharp if missing.

    Examples
    --------
    >>> get_edge_wear({"inset": "1cm"}), get_edge_wear({"inset": 0.1}).share, get_edge_wear({}).share
    (EdgeWear(length_m=0.01, share=0.0), 0.1, 0.0)
    """
    value = table.get("inset")
    return parse_edge_wear(value) if isinstance(value, str) else EdgeWear(share=get_number(table, "inset") or 0.0)


def get_mass(table: Mapping[str, Any], key: str) -> float:
    """Return a required mass, kg; a string may carry a unit."""
    return parse_mass(_require(table, key), quantity=lazy_gettext("{source}: {key}", source=source_name(table), key=key))


def get_masses(table: Mapping[str, Any], key: str, count: int) -> tuple[float, ...]:
    """Return a required list of masses, kg."""
    label = lazy_gettext("{source}: {key}", source=source_name(table), key=key)
    return tuple(parse_mass(entry, quantity=label) for entry in entries(table, key, count))


def _require(table: Mapping[str, Any], key: str) -> Any:
    if key not in table:
        raise BodyError(
            "{source}: {key} is missing; entries: {known}", source=source_name(table), key=key, known=[k for k in table if k != "source"]
        )
    return table[key]


def entries(table: Mapping[str, Any], key: str, count: int) -> Sequence[Any]:
    """Return a required list of a given length."""
    values = _require(table, key)
    if not isinstance(values, list) or len(values) != count:
        raise BodyError(
            "{source}: {key} must be a list of {count} values, found {values}",
            source=source_name(table),
            key=key,
            count=count,
            values=quote_value(values),
        )
    return values


def _check_list(value: Any, table: Mapping[str, Any], key: str) -> Sequence[Any]:
    if not isinstance(value, list):
        raise BodyError("{source}: {key} must be a list, found {found}", source=source_name(table), key=key, found=quote_value(value))
    return value


def _check_text(value: Any, table: Mapping[str, Any], key: str) -> str:
    if not isinstance(value, str):
        raise BodyError("{source}: {key} must be a string, found {found}", source=source_name(table), key=key, found=quote_value(value))
    return value


def pile_note(table: Mapping[str, Any] | None) -> Message | None:
    """Return a note on a pile that is taken as one rigid block; None for other bodies."""
    if table is None or table.get("kind") != "pile":
        return None
    return lazy_gettext(
        "{count} stones as one rigid block (stones one by one: seisblock stack)", count=len(table["stone"]) - len(table.get("fixed", ()))
    )

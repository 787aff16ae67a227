"""Body descriptions as TOML: found by path, or by name among the bundled ones."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from seisblock.errors import BodyError
from seisblock.ledger import reading
from seisblock.units import parse_length, parse_mass


def read_table(name: str | Path) -> dict[str, Any]:
    """Return the TOML table of a body, from a path or the name of a bundled body.

    Parameters
    ----------
    name : str or Path
        A file, or for example ``chozusha``.

    Raises
    ------
    BodyError
        If there is no such file or bundled body, or it is not TOML.
    """
    from seisblock.samples import sample_directory

    path = Path(name)
    if not path.exists():
        bundled = sample_directory() / (path.name if path.suffix == ".toml" else f"{path.name}.toml")
        if path.parent != Path() or not bundled.exists():
            known = ", ".join(sorted(p.stem for p in sample_directory().glob("*.toml") if p.stem != "MANIFEST"))
            raise BodyError(f"no body file {name}, and no bundled body of that name; bundled are {known}")
        path = bundled
    if path.is_dir():
        raise BodyError(f"{name} is a directory: give a TOML file that describes a body")
    try:
        table = tomllib.loads(path.read_text(encoding="utf-8-sig"))
        reading(path)
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise BodyError(f"{name} is not a TOML description of a body: {error}") from error
    return {"source": str(name), **table}


def of_kind(table: Mapping[str, Any], kind: str) -> None:
    """Refuse a table that describes another kind of body."""
    found = table.get("kind")
    if found != kind:
        raise BodyError(f'{table.get("source", "body")}: expected kind = "{kind}", found {found!r}')


def length(table: Mapping[str, Any], key: str) -> float:
    """Return a required length in metres; a text may carry a unit."""
    return parse_length(_required(table, key), what=f"{table.get('source', 'body')}: {key}")


def lengths(table: Mapping[str, Any], key: str, count: int) -> tuple[float, ...]:
    """Return a required list of lengths in metres."""
    return tuple(parse_length(entry, what=f"{table.get('source', 'body')}: {key}") for entry in _listed(table, key, count))


def masses(table: Mapping[str, Any], key: str, count: int) -> tuple[float, ...]:
    """Return a required list of masses in kilograms."""
    return tuple(parse_mass(entry, what=f"{table.get('source', 'body')}: {key}") for entry in _listed(table, key, count))


def _required(table: Mapping[str, Any], key: str) -> Any:
    """Return an entry that must be there."""
    if key not in table:
        raise BodyError(f"{table.get('source', 'body')}: {key} is missing; it has {', '.join(k for k in table if k != 'source')}")
    return table[key]


def _listed(table: Mapping[str, Any], key: str, count: int) -> Sequence[Any]:
    """Return a required list of a given length."""
    values = _required(table, key)
    if not isinstance(values, list) or len(values) != count:
        raise BodyError(f"{table.get('source', 'body')}: {key} must be a list of {count} values, found {values!r}")
    return values

"""Body descriptions as TOML: found by path, or by name among the bundled ones."""

from __future__ import annotations

import tomllib
from collections.abc import Collection, Mapping, Sequence
from pathlib import Path
from typing import Any

from seisblock import checks
from seisblock.bodies.inset import Inset, parse_inset
from seisblock.contents import contents
from seisblock.errors import BodyError
from seisblock.samples import sample_directory
from seisblock.units import parse_length, parse_mass
from seisblock.words import said

LONGEST_SHOWN = 200
"""How much of what stands in a file a message shows at most."""


def read_table(name: str | Path, *, kind: str | None = None) -> dict[str, Any]:
    """Return the TOML table of a body, from a path or the name of a bundled body.

    Parameters
    ----------
    name : str or Path
        A file, or for example ``chozusha``.
    kind : str or None
        What kind is wanted: where there is no such file, no bundled body of another kind is offered.

    Raises
    ------
    BodyError
        If there is no such file or bundled body, or it is not TOML.
    """
    path = Path(checks.path(name))
    if not _is_there(path):
        bundled = sample_directory() / (path.name if path.suffix == ".toml" else f"{path.name}.toml")
        if path.parent != Path() or not _is_there(bundled):
            known = sorted(p.stem for p in sample_directory().glob("*.toml") if p.stem != "MANIFEST" and kind in (None, _kind(p)))
            raise BodyError(
                "no body file {name}, and no bundled body of that name; bundled are {known}", name=str(name)[:LONGEST_SHOWN], known=known
            )
        path = bundled
    if path.is_dir():
        raise BodyError("{name} is a directory: give a TOML file that describes a body", name=name)
    data = contents(path, str(name), BodyError)
    if not data.strip():
        raise BodyError("{name} is empty: give a TOML file that describes a body", name=name)
    try:
        table = tomllib.loads(data.decode("utf-8-sig"))
    except UnicodeDecodeError as error:
        raise BodyError("{name} is no text in UTF-8: give a TOML file that describes a body, saved as UTF-8", name=name) from error
    except (ValueError, RecursionError) as error:  # no TOML, a date that is none, lists in lists in lists
        raise BodyError("{name} is not a TOML description of a body: {reason}", name=str(name), reason=str(error)) from error
    return {**table, "source": str(name)}


def _kind(path: Path) -> str:
    """Return the kind of a bundled body."""
    return str(tomllib.loads(path.read_text(encoding="utf-8"))["kind"])


def _is_there(path: Path) -> bool:
    """Return whether there is a file of that name, whatever stands in the name."""
    try:
        return path.exists()
    except OSError:  # too long for a name
        return False


def source_of(table: Mapping[str, Any]) -> str:
    """Return what messages call a table."""
    source = table.get("source") or said("body")
    return source if isinstance(source, str) else str(source)


def number(table: Mapping[str, Any], key: str) -> float | None:
    """Return an optional finite number, None where the table is silent."""
    value = table.get(key)
    return None if value is None else checks.finite("{source}: {key}", value, error=BodyError, source=source_of(table), key=key)


def text(table: Mapping[str, Any], key: str, default: str) -> str:
    """Return an optional text."""
    return _text(table.get(key, default), table, key)


def texts(table: Mapping[str, Any], key: str) -> tuple[str, ...]:
    """Return an optional list of texts, empty where the table is silent."""
    return tuple(_text(value, table, key) for value in _list(table.get(key, []), table, key))


def text_groups(table: Mapping[str, Any], key: str) -> tuple[tuple[str, ...], ...]:
    """Return an optional list of lists of texts, empty where the table is silent."""
    return tuple(texts({**table, key: group}, key) for group in _list(table.get(key, []), table, key))


def subtable(table: Mapping[str, Any], key: str) -> Mapping[str, Any]:
    """Return an optional table within a table, which goes by the name of both in messages."""
    value = table.get(key, {})
    if not isinstance(value, Mapping):
        raise BodyError("{source}: {key} must be a table, found {found}", source=source_of(table), key=key, found=shown(value))
    return {**value, "source": said("{source}: {key}", source=source_of(table), key=key)}


def refuse_unknown(table: Mapping[str, Any], known: Collection[str]) -> None:
    """Refuse a key that means nothing, which is a slip of the pen."""
    unknown = sorted(set(table) - {*known, "source"})
    if unknown:
        raise BodyError(
            "{source}: unknown entries {unknown}; known are {known}",
            source=source_of(table),
            unknown=[key[:LONGEST_SHOWN] for key in unknown],
            known=sorted(known),
        )


def shown(value: Any) -> str:
    """Return a value as a message shows it."""
    return repr(value)[:LONGEST_SHOWN]


def of_kind(table: Mapping[str, Any], kind: str) -> None:
    """Refuse a table that describes another kind of body."""
    found = table.get("kind")
    if found != kind:
        raise BodyError('{source}: expected kind = "{kind}", found {found}', source=source_of(table), kind=kind, found=shown(found))


def length(table: Mapping[str, Any], key: str) -> float:
    """Return a required length in metres; a text may carry a unit."""
    return parse_length(_required(table, key), what=said("{source}: {key}", source=source_of(table), key=key))


def lengths(table: Mapping[str, Any], key: str, count: int) -> tuple[float, ...]:
    """Return a required list of lengths in metres."""
    what = said("{source}: {key}", source=source_of(table), key=key)
    return tuple(parse_length(entry, what=what) for entry in entries(table, key, count))


def inset_of(table: Mapping[str, Any]) -> Inset:
    """Return the inset of a table: a text with a length or a share, or a share of the width per side; sharp where there is none.

    Examples
    --------
    >>> inset_of({"inset": "1cm"}), inset_of({"inset": 0.1}).share, inset_of({}).share
    (Inset(length_m=0.01, share=0.0), 0.1, 0.0)
    """
    value = table.get("inset")
    return parse_inset(value) if isinstance(value, str) else Inset(share=number(table, "inset") or 0.0)


def mass(table: Mapping[str, Any], key: str) -> float:
    """Return a required mass in kilograms; a text may carry a unit."""
    return parse_mass(_required(table, key), what=said("{source}: {key}", source=source_of(table), key=key))


def masses(table: Mapping[str, Any], key: str, count: int) -> tuple[float, ...]:
    """Return a required list of masses in kilograms."""
    what = said("{source}: {key}", source=source_of(table), key=key)
    return tuple(parse_mass(entry, what=what) for entry in entries(table, key, count))


def _required(table: Mapping[str, Any], key: str) -> Any:
    """Return an entry that must be there."""
    if key not in table:
        raise BodyError(
            "{source}: {key} is missing; it has {known}", source=source_of(table), key=key, known=[k for k in table if k != "source"]
        )
    return table[key]


def entries(table: Mapping[str, Any], key: str, count: int) -> Sequence[Any]:
    """Return a required list of a given length."""
    values = _required(table, key)
    if not isinstance(values, list) or len(values) != count:
        raise BodyError(
            "{source}: {key} must be a list of {count} values, found {values}",
            source=source_of(table),
            key=key,
            count=count,
            values=shown(values),
        )
    return values


def _list(value: Any, table: Mapping[str, Any], key: str) -> Sequence[Any]:
    """Return what must be a list."""
    if not isinstance(value, list):
        raise BodyError("{source}: {key} must be a list, found {found}", source=source_of(table), key=key, found=shown(value))
    return value


def _text(value: Any, table: Mapping[str, Any], key: str) -> str:
    """Return what must be a text."""
    if not isinstance(value, str):
        raise BodyError("{source}: {key} must be a text, found {found}", source=source_of(table), key=key, found=shown(value))
    return value

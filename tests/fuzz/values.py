"""Random values in place of a number, a text or a table."""

from __future__ import annotations

import copy
from typing import Any

import numpy as np

STRANGE = [
    "true",
    "false",
    "[]",
    "[1]",
    "[[1, 2], [3]]",
    "{}",
    "{ a = 1 }",
    "2020-01-01",
    "07:32:00",
    "2020-01-01T07:32:00Z",
    "nan",
    "-inf",
    "0",
    "-1",
    "1e308",
    "1e-308",
    "5e-324",
    "1e-9",
    "1e9",
    "24",
    "9" * 400,
    '""',
    '"x"',
    '"24cm"',
    '"8sun"',
    '"10%"',
    '"-3m"',
    '"1e999 m"',
    '"nan"',
    '"\\u001b[31m"',
    '"$x^{$"',
    f'"{"long " * 2000}"',
]
"""As TOML writes them."""

KEYS = ["width", "height", "mu", "kind", "name", "source", "stone", "inset", "restitution", "contact", "on", "\x1b[2J", "x" * 3000, ""]


class Raw(str):
    """A value as TOML writes it."""


def with_mistakes(table: dict[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """Return a table after one to three mistakes in it, at any depth."""
    created = copy.deepcopy({key: value for key, value in table.items() if key != "source"})
    for _ in range(rng.integers(1, 4)):
        places = list(_places(created))
        if not places:
            break
        home, key = places[rng.integers(len(places))]
        kind = rng.integers(6)
        if kind == 0:
            del home[key]
        elif kind == 1 and isinstance(home, dict):
            home[KEYS[rng.integers(len(KEYS))]] = Raw(STRANGE[rng.integers(len(STRANGE))])
        elif kind == 2 and isinstance(home, list):
            home.append(copy.deepcopy(home[key]))
        else:
            home[key] = Raw(STRANGE[rng.integers(len(STRANGE))])
    return created


def _places(value: Any):
    """Yield each container within a value with each of its keys."""
    keys = value if isinstance(value, dict) else range(len(value)) if isinstance(value, list) else ()
    for key in keys:
        yield value, key
        yield from _places(value[key])


def as_toml(table: dict[str, Any]) -> str:
    """Return a table as TOML, tables within it in braces."""
    return "".join(f"{_toml_string(key)} = {_toml_value(value)}\n" for key, value in table.items())


def _toml_value(value: Any) -> str:
    """Return a value as TOML writes it."""
    if isinstance(value, Raw):
        return value
    if isinstance(value, str):
        return _toml_string(value)
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{_toml_string(key)} = {_toml_value(part)}" for key, part in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(_toml_value, value)) + "]"
    return str(value).lower() if isinstance(value, bool) else repr(value)


def _toml_string(text: str) -> str:
    """Return a text between quotes."""
    return '"' + "".join(c if c.isprintable() and c not in '"\\' else f"\\u{ord(c):04x}" for c in text) + '"'

"""Piles as TOML files, the bundled ones among them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import GRANITE, GROUND, PileStone
from seisblock.bodies.toml import length, of_kind, read_table
from seisblock.errors import BodyError
from seisblock.units import parse_length

_PILE_KEYS = {"source", "name", "kind", "mu", "density", "reinforced", "fixed", "stone", "note"}
_STONE_KEYS = {"name", "width", "depth", "height", "offset", "on", "density", "mu", "bottom"}


def load_pile(name: str | Path, *, reinforced: bool = False, mu: float | None = None) -> Pile:
    """Return a pile of stones from a TOML file, or a bundled one by its name (``wagata``, ``lantern``).

    Parameters
    ----------
    name : str or Path
        ``kind = "pile"``, and one ``[[stone]]`` table per stone, from below upwards: ``name``, ``width``, ``depth``, ``height``
        (numbers in m or texts such as ``"8sun"``); optional ``offset`` (two lengths), ``on``, ``density``, ``mu``, ``bottom``.
        On top: ``name``, ``mu``, ``density``, ``fixed`` (list of names), ``reinforced`` (list of lists of names that dowels hold).
    reinforced : bool
        Whether the dowels of the file are in place.
    mu : float or None, 1
        Friction of every joint; None: what the file says.

    Raises
    ------
    BodyError
        If there is no such file, or it describes no pile that can stand.

    Examples
    --------
    >>> load_pile("wagata").names
    ('gedai', 'mizubachi', 'chudai', 'jodai', 'sao')
    """
    table = read_table(name)
    of_kind(table, "pile")
    source = str(table["source"])
    _refuse_unknown(table, _PILE_KEYS, source)
    entries = table.get("stone")
    if not isinstance(entries, list) or not entries:
        raise BodyError(f"{source}: a pile needs at least one [[stone]] table")
    stones: list[PileStone] = []
    for number, entry in enumerate(entries, start=1):
        below = stones[-1].name if stones else GROUND
        stones.append(_stone({"source": f"{source}: stone {number}", **entry}, below, table))
    if mu is not None:
        stones = [replace(stone, mu=None) for stone in stones]
    dowels = table.get("reinforced", [])
    if reinforced and not dowels:
        raise BodyError(f"{source} has no dowels: add reinforced = [[name, name]] to the file, or leave --reinforced out")
    return Pile(
        str(table.get("name", Path(source).stem)),
        tuple(stones),
        tuple(tuple(str(n) for n in group) for group in dowels) if reinforced else (),
        tuple(str(n) for n in table.get("fixed", [])),
        _number(table, "mu", 0.438) if mu is None else mu,
    )


def _stone(entry: Mapping[str, Any], below: str, table: Mapping[str, Any]) -> PileStone:
    """Return one stone of a file."""
    _refuse_unknown(entry, _STONE_KEYS | {"source"}, str(entry["source"]))
    if not isinstance(entry.get("name"), str):
        raise BodyError(f"{entry['source']}: name is missing")
    offset = entry.get("offset", [0.0, 0.0])
    if not isinstance(offset, list) or len(offset) != 2:
        raise BodyError(f"{entry['source']}: offset must be a list of two lengths, along x and y, found {offset!r}")
    return PileStone(
        entry["name"],
        length(entry, "width"),
        length(entry, "depth"),
        length(entry, "height"),
        (parse_length(offset[0], what="offset"), parse_length(offset[1], what="offset")),
        str(entry.get("on", below)),
        _number(entry, "density", _number(table, "density", GRANITE)),
        _number(entry, "mu", math.nan) if "mu" in entry else None,
        length(entry, "bottom") if "bottom" in entry else None,
    )


def _number(table: Mapping[str, Any], key: str, default: float) -> float:
    """Return an optional number."""
    value = table.get(key, default)
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise BodyError(f"{table['source']}: {key} must be a number, found {value!r}")
    return float(value)


def _refuse_unknown(table: Mapping[str, Any], known: set[str], source: str) -> None:
    """Refuse a key that means nothing, which is a slip of the pen."""
    unknown = sorted(set(table) - known)
    if unknown:
        raise BodyError(f"{source}: unknown key {unknown[0]!r}; known are {', '.join(sorted(known - {'source'}))}")

"""Which block the user means: sizes given one by one, a TOML file, or a bundled body by its name."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from seisblock.bodies.block import Block
from seisblock.bodies.files import length, read_table
from seisblock.bodies.two_layer import two_layer_block
from seisblock.errors import BodyError, ParameterError
from seisblock.units import parse_length, parse_mass

_LENGTHS = ("width", "height", "depth", "centroid_height", "centroid_offset")
_NUMBERS = ("density", "centroid_inertia")
_KEYS = {"kind", "source", "name", "mass", "restitution", *_LENGTHS, *_NUMBERS}


@dataclass(frozen=True)
class BlockChoice:
    """A block, the restitution it brings along (None for that of its angular momentum), and one line on where it comes from."""

    block: Block
    restitution: float | None
    says: str


def load_block(name: str | Path, *, side: str = "short") -> Block:
    """Return the block of a TOML file, or of a bundled body such as ``gravestone``.

    Parameters
    ----------
    name : str or Path
        ``kind = "block"`` with ``width`` and ``height`` (a number in m, or a text with a unit) and whatever else
        :class:`~seisblock.bodies.block.Block` takes; or ``kind = "two-layer"``, taken as one rigid block.
    side : "short" or "long"
        Which side lies along the motion, where a two-layer body gives both.

    Raises
    ------
    BodyError
        If there is no such body, something is missing or unknown, or it is of another kind.

    Examples
    --------
    >>> block = load_block("gravestone")
    >>> round(block.height / block.width, 12)
    2.6
    """
    return block_of(read_table(name), side=side)


def block_of(table: Mapping[str, Any], *, side: str = "short") -> Block:
    """Return the block that a TOML table describes; see :func:`load_block`."""
    where = table.get("source", "body")
    kind = table.get("kind")
    if kind == "two-layer":
        body = two_layer_block(table, side)
        return Block(
            body.width, body.height, body.depth, body.mass, centroid_height=body.centroid_height, centroid_inertia=body.centroid_inertia,
            name=body.name,
        )  # fmt: skip
    if kind != "block":
        raise BodyError(f'{where}: expected kind = "block" or "two-layer", found {kind!r}')
    unknown = set(table) - _KEYS
    if unknown:
        raise BodyError(f"{where}: unknown entries {', '.join(sorted(unknown))}; a block has {', '.join(sorted(_KEYS - {'source'}))}")
    given: dict[str, Any] = {"width": length(table, "width"), "height": length(table, "height")}
    for key in _LENGTHS[2:]:
        if key in table:
            given[key] = parse_length(table[key], what=f"{where}: {key}")
    if "mass" in table:
        given["mass"] = parse_mass(table["mass"], what=f"{where}: mass")
    for key in _NUMBERS:
        if key in table:
            given[key] = _number(table[key], f"{where}: {key}")
    return Block(**given, name=str(table.get("name", where)))


def choose_block(asked: Mapping[str, Any]) -> BlockChoice:
    """Return the block that a set of options describes.

    Parameters
    ----------
    asked : mapping
        ``block`` and ``side``, or ``width``, ``height`` and the other sizes of a block, SI; ``restitution`` overrides what a file
        brings along. None where not given.

    Raises
    ------
    BodyError
        If sizes and a named block are mixed, or something needed is missing.
    """
    keys = ("width", "height", "depth", "mass", "centroid_height", "centroid_offset", "centroid_inertia")
    sizes = {key: asked[key] for key in keys if asked.get(key) is not None}
    restitution = asked.get("restitution")
    if asked.get("block"):
        if sizes:
            raise BodyError(f"give either --block or sizes (--{', --'.join(key.replace('_', '-') for key in sizes)}), not both")
        table = read_table(asked["block"])
        own = table.get("restitution")
        if restitution is None and own is not None:
            restitution = _number(own, f"{asked['block']}: restitution")
        block = block_of(table, side=asked.get("side") or "short")
        return BlockChoice(block, restitution, f"{block.name}, from {asked['block']}")
    missing = [f"--{key}" for key in ("width", "height") if key not in sizes]
    if missing:
        raise BodyError(f"which block? {' and '.join(missing)} missing: give --width and --height, or --block NAME|FILE (say gravestone)")
    block = Block(**sizes)
    return BlockChoice(block, restitution, f"block {block.width:g} m wide, {block.height:g} m high")


def described(block: Block) -> dict[str, Any]:
    """Return what defines a block, SI with the unit in each key, for documents."""
    right, left = block.slendernesses
    return {
        "name": block.name,
        "width_m": block.width,
        "height_m": block.height,
        "depth_m": block.width if block.depth is None else block.depth,
        "mass_kg": block.total_mass,
        "centroid_height_m": block.centre,
        "centroid_offset_m": block.centroid_offset,
        "centroid_inertia_kg_m2": block.gyration_squared * block.total_mass,
        "slenderness_right_rad": right,
        "slenderness_left_rad": left,
    }


def _number(value: Any, what: str) -> float:
    """Return a number of a table."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise ParameterError(f"{what} must be a number, found {value!r}")
    return float(value)

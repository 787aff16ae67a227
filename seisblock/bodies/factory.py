"""Bodies from TOML files and bundled names."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, TypeVar

from seisblock.bodies.block import Block
from seisblock.bodies.pile.toml import load_pile
from seisblock.bodies.scan.body import ScannedBody
from seisblock.bodies.scan.toml import scan_from_table
from seisblock.bodies.spring_factory import springs_from_table
from seisblock.bodies.toml import (
    check_keys,
    get_edge_wear,
    get_length,
    get_mass,
    get_number,
    get_text,
    quote_value,
    read_body_toml,
    source_name,
)
from seisblock.bodies.two_layer import contact_from_table, two_layer_from_table
from seisblock.bodies.uncertainty import parse_ranges
from seisblock.core.errors import BodyError
from seisblock.records import Motion
from seisblock.records.motion import requested_azimuth

AnyBody = TypeVar("AnyBody")

_LENGTH_KEYS = ("width", "height", "depth", "centroid_height", "centroid_offset")
_NUMBER_KEYS = ("density", "centroid_inertia")
_FRICTION_KEYS = ("mu", "mu_kinetic")
_KEYS = {"kind", "name", "mass", "restitution", "inset", "ranges", *_FRICTION_KEYS, *_LENGTH_KEYS, *_NUMBER_KEYS}


def load_block(name: str | Path, *, side: str = "short") -> Block:
    """Return the block of a TOML file or of a bundled body such as ``gravestone``.

    Parameters
    ----------
    name : str or Path
        ``kind = "block"`` with ``width`` and ``height`` (a number in m, or a string with a unit) and the other parameters of
        :class:`~seisblock.bodies.block.Block`; or ``kind = "two-layer"`` or ``"pile"``, taken as one rigid block.
    side : "short" or "long"
        Side along the motion, for a two-layer body with both.

    Returns
    -------
    Block

    Raises
    ------
    BodyError
        If there is no such body, an entry is missing or unknown, or the kind is another.

    Examples
    --------
    >>> block = load_block("gravestone")
    >>> round(block.height / block.width, 12)
    2.6
    """
    return block_from_table(read_body_toml(name), side=side)


def block_from_table(table: Mapping[str, Any], *, side: str = "short") -> Block:
    """Return the block described by a TOML table, see :func:`load_block`."""
    source = source_name(table)
    kind = table.get("kind")
    if kind == "two-layer":
        return two_layer_from_table(table, side).as_block()
    if kind == "pile":
        return load_pile(source).as_block()
    if kind == "springs":
        springs = springs_from_table(table)
        return Block(springs.width, springs.height, springs.depth, springs.mass, name=get_text(table, "name", source))
    if kind == "scan":
        raise BodyError("{where} is a scan, whose dimensions depend on the azimuth: give the azimuth", where=source)
    if kind != "block":
        raise BodyError(
            '{where}: kind must be "block", "two-layer", "pile", "springs" or "scan", found {kind}', where=source, kind=quote_value(kind)
        )
    check_keys(table, _KEYS)
    sizes: dict[str, Any] = {"width": get_length(table, "width"), "height": get_length(table, "height")}
    sizes |= {key: get_length(table, key) for key in _LENGTH_KEYS[2:] if key in table}
    sizes |= {key: get_number(table, key) for key in _NUMBER_KEYS if key in table}
    if "mass" in table:
        sizes["mass"] = get_mass(table, "mass")
    block = Block(**sizes, name=get_text(table, "name", source))
    worn_block = block.with_wear(get_edge_wear(table)) if "inset" in table else block
    ranges = parse_ranges(
        table, {"width": worn_block.width, "height": worn_block.height, "inset": worn_block.inset, "mu": get_number(table, "mu")}
    )
    return worn_block if ranges is None else replace(worn_block, ranges=ranges)


def body_from_table(table: Mapping[str, Any], *, side: str = "short") -> Block | ScannedBody:
    """Return the body described by a TOML table: a block or a scan.

    Examples
    --------
    >>> type(body_from_table(read_body_toml("boulder"))).__name__, type(body_from_table(read_body_toml("gravestone"))).__name__
    ('ScannedBody', 'Block')
    """
    return scan_from_table(table) if table.get("kind") == "scan" else block_from_table(table, side=side)


def block_for_motion(body: AnyBody, motion: Motion) -> AnyBody | Block:
    """Return the block for a motion: of a scan, the block of the motion's azimuth.

    The width of a block lies along a recorded component. Towards an azimuth it stands with its width towards north, and its base is
    projected, as in a sweep of all azimuths.

    Examples
    --------
    >>> stone = load_block("gravestone")
    >>> block_for_motion(stone, Motion.from_arrays([0.0, 1.0], 0.01)) is stone
    True
    """
    if isinstance(body, ScannedBody):
        return body.block_for_motion(motion)
    azimuth = requested_azimuth(motion)
    return body if azimuth is None or not isinstance(body, Block) else body.block_toward(azimuth)


def table_restitution(table: Mapping[str, Any], name: str) -> float | None:
    """Return the coefficient of restitution in a body's file, or None."""
    return get_number({**table, "source": name}, "restitution")


def table_friction(table: Mapping[str, Any], name: str) -> tuple[float | None, float | None]:
    """Return static and kinetic friction in a body's file, None where missing."""
    entries: Mapping[str, Any] = contact_from_table(table) if table.get("kind") == "two-layer" else table
    mu, kinetic = (get_number({**entries, "source": name}, key) for key in _FRICTION_KEYS)
    return mu, kinetic

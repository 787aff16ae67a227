"""Which block the user means: sizes given one by one, a TOML file, or a bundled body by its name."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, TypeVar

from seisblock.bodies.block import Block
from seisblock.bodies.pile.toml import load_pile
from seisblock.bodies.ranges import ranges_of
from seisblock.bodies.scan.body import ScannedBody
from seisblock.bodies.scan.toml import scanned_body
from seisblock.bodies.toml import inset_of, length, mass, number, read_table, refuse_unknown, shown, source_of, text
from seisblock.bodies.two_layer import contact, two_layer_block
from seisblock.errors import BodyError
from seisblock.records import Motion

AnyBody = TypeVar("AnyBody")

_LENGTHS = ("width", "height", "depth", "centroid_height", "centroid_offset")
_NUMBERS = ("density", "centroid_inertia")
_FRICTION = ("mu", "mu_kinetic")
_KEYS = {"kind", "name", "mass", "restitution", "inset", "ranges", *_FRICTION, *_LENGTHS, *_NUMBERS}


def load_block(name: str | Path, *, side: str = "short") -> Block:
    """Return the block of a TOML file, or of a bundled body such as ``gravestone``.

    Parameters
    ----------
    name : str or Path
        ``kind = "block"`` with ``width`` and ``height`` (a number in m, or a text with a unit) and whatever else
        :class:`~seisblock.bodies.block.Block` takes; or ``kind = "two-layer"`` or ``"pile"``, taken as one rigid block.
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
    where = source_of(table)
    kind = table.get("kind")
    if kind == "two-layer":
        return two_layer_block(table, side).as_block()
    if kind == "pile":
        return load_pile(where).as_block()
    if kind == "scan":
        raise BodyError("{where} is a scan, which is another block in each direction: say towards which azimuth", where=where)
    if kind != "block":
        raise BodyError('{where}: expected kind = "block", "two-layer", "pile" or "scan", found {kind}', where=where, kind=shown(kind))
    refuse_unknown(table, _KEYS)
    given: dict[str, Any] = {"width": length(table, "width"), "height": length(table, "height")}
    given |= {key: length(table, key) for key in _LENGTHS[2:] if key in table}
    given |= {key: number(table, key) for key in _NUMBERS if key in table}
    if "mass" in table:
        given["mass"] = mass(table, "mass")
    block = Block(**given, name=text(table, "name", where))
    worn = block.worn(inset_of(table)) if "inset" in table else block
    known = ranges_of(table, {"width": worn.width, "height": worn.height, "inset": worn.inset, "mu": number(table, "mu")})
    return worn if known is None else replace(worn, ranges=known)


def body_of(table: Mapping[str, Any], *, side: str = "short") -> Block | ScannedBody:
    """Return the body that a TOML table describes: one block, or a scan, which is another one in each direction.

    Examples
    --------
    >>> type(body_of(read_table("boulder"))).__name__, type(body_of(read_table("gravestone"))).__name__
    ('ScannedBody', 'Block')
    """
    return scanned_body(table) if table.get("kind") == "scan" else block_of(table, side=side)


def along(body: AnyBody, motion: Motion) -> AnyBody | Block:
    """Return a body as it follows a motion: a scan as the block that it is towards its azimuth, any other as it is.

    Examples
    --------
    >>> stone = load_block("gravestone")
    >>> along(stone, Motion.from_arrays([0.0, 1.0], 0.01)) is stone
    True
    """
    return body.along(motion) if isinstance(body, ScannedBody) else body


def restitution_of(table: Mapping[str, Any], name: str) -> float | None:
    """Return the restitution that a body's file brings along, or None."""
    return number({**table, "source": name}, "restitution")


def friction_of(table: Mapping[str, Any], name: str) -> tuple[float | None, float | None]:
    """Return the static and the kinetic friction that a body's file brings along, None where it is silent."""
    found: Mapping[str, Any] = contact(table) if table.get("kind") == "two-layer" else table
    mu, kinetic = (number({**found, "source": name}, key) for key in _FRICTION)
    return mu, kinetic

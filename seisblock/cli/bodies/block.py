"""Which block the user means: sizes given one by one, a TOML file, or a bundled body by its name."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from seisblock.bodies.block import Block
from seisblock.bodies.library import block_of, edges, restitution_of
from seisblock.bodies.toml import read_table
from seisblock.errors import BodyError
from seisblock.words import said


@dataclass(frozen=True)
class BlockChoice:
    """A block, the restitution it brings along (None for that of its angular momentum), and one line on where it comes from."""

    block: Block
    restitution: float | None
    says: str


def choose_block(asked: Mapping[str, Any]) -> BlockChoice:
    """Return the block that a set of options describes.

    Parameters
    ----------
    asked : mapping
        ``block`` and ``side``, or ``width``, ``height`` and the other sizes of a block, SI; ``restitution`` and ``inset`` override
        what a file brings along. None where not given.

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
            raise BodyError("give either --block or sizes ({sizes}), not both", sizes=["--" + key.replace("_", "-") for key in sizes])
        table = read_table(asked["block"])
        if restitution is None:
            restitution = restitution_of(table, asked["block"])
        block = block_of(table, side=asked.get("side") or "short")
        origin = said("{name}, from {file}", name=said(block.name), file=asked["block"])
    else:
        missing = [f"--{key}" for key in ("width", "height") if key not in sizes]
        if missing:
            raise BodyError(
                "which block? {missing} missing: give --width and --height, or --block NAME|FILE (say gravestone)", missing=missing
            )
        block = Block(**sizes)
        origin = said("block {width:g} m wide, {height:g} m high", width=block.width, height=block.height)
    if asked.get("inset") is not None:
        block = block.worn(asked["inset"])
    return BlockChoice(block, restitution, said("{parts}", parts=[part for part in (origin, edges(block)) if part]))

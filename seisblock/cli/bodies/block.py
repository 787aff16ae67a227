"""Which body the user means: sizes given one by one, a TOML file, or a bundled body by its name."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from seisblock.bodies.block import Block
from seisblock.bodies.kinds import of_kind
from seisblock.bodies.library import body_of, restitution_of
from seisblock.bodies.scan.body import ScannedBody
from seisblock.bodies.toml import read_table
from seisblock.errors import BodyError
from seisblock.present.edges import edges
from seisblock.records import Motion
from seisblock.words import said


@dataclass(frozen=True)
class BodyChoice:
    """A body, which may be another block in each direction."""

    body: Block | ScannedBody

    @property
    def block(self) -> Block:
        """The block, where it is the same one in each direction."""
        if isinstance(self.body, ScannedBody):
            raise BodyError("{name} is a scan, which is another block in each direction: say towards which azimuth", name=self.body.name)
        return self.body

    def towards(self, azimuth: float) -> Block:
        """Return the block that a scan is towards an azimuth, degrees clockwise from north."""
        if not isinstance(self.body, ScannedBody):
            raise BodyError("{name} is the same block in each direction: leave the azimuth out", name=said(self.body.name))
        return self.body.towards(azimuth)

    def along(self, motion: Motion) -> Block:
        """Return the block that follows a motion: of a scan that towards its azimuth."""
        return self.body.along(motion) if isinstance(self.body, ScannedBody) else self.body

    def entry_of(self, block: Block) -> dict[str, Any]:
        """Return what is told beside an answer of the block that it is of, nothing where all answers are of one."""
        from seisblock.present.documents.bodies import block_entry

        return {"block": block_entry(block)} if isinstance(self.body, ScannedBody) else {}


@dataclass(frozen=True)
class BlockChoice(BodyChoice):
    """A body, the restitution it brings along (None for that of its angular momentum), and one line on where it comes from."""

    restitution: float | None
    says: str


def choose_block(asked: Mapping[str, Any]) -> BlockChoice:
    """Return the body that a set of options describes.

    Parameters
    ----------
    asked : mapping
        ``block`` and ``side``, or ``width``, ``height`` and the other sizes of a block, SI, and ``kind``; ``restitution`` and ``inset``
        override what a file brings along. None where not given. ``gal``: False where lengths are told in m.

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
        refuse_kind(asked)
        table = read_table(asked["block"])
        if restitution is None:
            restitution = restitution_of(table, asked["block"])
        refuse_side(asked, table.get("kind"))
        body = body_of(table, side=asked.get("side") or "short")
        origin = said("{name}, from {file}", name=said(body.name), file=asked["block"])
    else:
        refuse_side(asked, None)
        missing = [f"--{key}" for key in ("width", "height") if key not in sizes]
        if missing:
            raise BodyError(
                "which block? {missing} missing: give --width and --height, or --block NAME|FILE (say gravestone)", missing=missing
            )
        body = of_kind(Block(**sizes), asked.get("kind") or "block")
        origin = said("block {width:g} m wide, {height:g} m high", width=body.width, height=body.height)
    if asked.get("inset") is not None:
        body = body.worn(asked["inset"])
    return BlockChoice(
        body, restitution, said("{parts}", parts=[part for part in (origin, edges(body, gal=asked.get("gal", True))) if part])
    )


def refuse_kind(asked: Mapping[str, Any]) -> None:
    """Refuse the kind of a body that comes from a file, which tells its own ranges."""
    if asked.get("kind") is not None:
        raise BodyError("--kind has no effect with --block: give it with --width and --height")


def refuse_side(asked: Mapping[str, Any], kind: str | None) -> None:
    """Refuse the side of a body that has but one."""
    if asked.get("side") is not None and kind != "two-layer":
        raise BodyError("--side is of a two-layer --block: leave it out")

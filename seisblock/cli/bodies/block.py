"""Body from command-line options: sizes, TOML file or bundled name."""

from __future__ import annotations

from collections.abc import Container, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from seisblock.bodies.block import Block
from seisblock.bodies.factory import block_for_motion, body_from_table, table_restitution
from seisblock.bodies.kinds import of_kind
from seisblock.bodies.scan.body import ScannedBody
from seisblock.bodies.toml import pile_note, read_body_toml
from seisblock.core.errors import BodyError
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.output.describe_wear import describe_edges
from seisblock.records import Motion


@dataclass(frozen=True)
class BodyChoice:
    """Body selected by options: a block, or a scan whose block depends on the azimuth."""

    body: Block | ScannedBody

    @property
    def block(self) -> Block:
        """The block; an error for a scan, whose block depends on the azimuth."""
        if isinstance(self.body, ScannedBody):
            raise BodyError("{name} is a scan, whose dimensions depend on the azimuth: give the azimuth", name=self.body.name)
        return self.body

    def towards(self, azimuth: float) -> Block:
        """Return the block of a scan for an azimuth, degrees clockwise from north."""
        if not isinstance(self.body, ScannedBody):
            raise BodyError("{name} has the same dimensions in all azimuths: omit the azimuth", name=lazy_gettext(self.body.name))
        return self.body.block_toward(azimuth)

    def block_for_motion(self, motion: Motion) -> Block:
        """Return the block for a motion: its base is projected on a requested azimuth."""
        block = block_for_motion(self.body, motion)
        assert isinstance(block, Block)
        return block

    def block_key(self, block: Block) -> dict[str, Any]:
        """Return the JSON entry of the block of a direction, empty where it is the body itself."""
        from seisblock.output.json.bodies import block_entry

        return {} if block is self.body else {"block": block_entry(block)}


@dataclass(frozen=True)
class BlockChoice(BodyChoice):
    """Body with the restitution from its file (None: from angular momentum) and a one-line description."""

    restitution: float | None
    description: str


def choose_block(params: Mapping[str, Any]) -> BlockChoice:
    """Return the body described by a set of options.

    Parameters
    ----------
    params : mapping
        ``block`` and ``side``, or ``width``, ``height`` and the other sizes of a block, SI, and ``kind``; ``restitution`` and ``inset``
        override those of a file. None where not given. ``gal``: False for lengths in m in the description.

    Raises
    ------
    BodyError
        If both sizes and a named block are given, or a required value is missing.
    """
    keys, note = ("width", "height", "depth", "mass", "centroid_height", "centroid_offset", "centroid_inertia"), None
    sizes = {key: params[key] for key in keys if params.get(key) is not None}
    restitution = params.get("restitution")
    if params.get("block"):
        table = read_named_block(params, sizes)
        if restitution is None:
            restitution = table_restitution(table, params["block"])
        body = body_from_table(table, side=params.get("side") or "short")
        origin = lazy_gettext(body.name)
        if origin != params["block"]:
            origin = lazy_gettext("{name}, from {file}", name=origin, file=params["block"])
        note = pile_note(table)
    else:
        require_sizes(params, sizes)
        body = of_kind(Block(**sizes), params.get("kind") or "block")
        text = N_("block {width:g} m wide, {height:g} m high")
        if body.depth is not None:
            text = N_("block {width:g} m wide along the motion, {depth:g} m deep, {height:g} m high")
        origin = lazy_gettext(text, width=body.width, depth=body.depth, height=body.height)
    if params.get("inset") is not None:
        body = body.with_wear(params["inset"])
    return BlockChoice(
        body,
        restitution,
        lazy_gettext("{parts}", parts=[part for part in (origin, note, describe_edges(body, gal=params.get("gal", True))) if part]),
    )


def read_named_block(params: Mapping[str, Any], sizes: Iterable[str]) -> dict[str, Any]:
    """Return the description of ``--block``; raise BodyError for sizes beside it, and for ``--kind``: a file has its own ranges."""
    if flags := ["--" + key.replace("_", "-") for key in sizes]:
        raise BodyError("--block and sizes ({sizes}) exclude each other: give only one of them", sizes=flags)
    if params.get("kind") is not None:
        raise BodyError("--kind has no effect with --block: use --kind with --width and --height")
    table = read_body_toml(params["block"])
    check_side(params, table.get("kind"))
    return table


def require_sizes(params: Mapping[str, Any], sizes: Container[str]) -> None:
    """Raise BodyError for a body without ``--block`` that has no width or no height, or has a side."""
    check_side(params, None)
    if missing := [f"--{key}" for key in ("width", "height") if key not in sizes]:
        text = "body required ({missing} missing): give --width and --height, or --block NAME|FILE (for example gravestone)"
        raise BodyError(text, missing=missing)


def check_side(params: Mapping[str, Any], kind: str | None) -> None:
    """Raise an error for ``--side`` unless the body is a two-layer block."""
    if params.get("side") is not None and kind != "two-layer":
        raise BodyError("--side has no effect: this body is not a two-layer --block; omit --side")

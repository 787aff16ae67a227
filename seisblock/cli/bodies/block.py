"""Which body the user means: sizes given one by one, a TOML file, or a bundled body by its name."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from seisblock.bodies.block import Block
from seisblock.bodies.factory import body_from_table, table_restitution
from seisblock.bodies.kinds import of_kind
from seisblock.bodies.scan.body import ScannedBody
from seisblock.bodies.toml import read_body_toml
from seisblock.core.errors import BodyError
from seisblock.core.i18n import lazy_gettext
from seisblock.records import Motion
from seisblock.report.describe_wear import describe_edges


@dataclass(frozen=True)
class BodyChoice:
    """A body, which may be another block in each direction."""

    body: Block | ScannedBody

    @property
    def block(self) -> Block:
        """The block, where it is the same one in each direction."""
        if isinstance(self.body, ScannedBody):
            raise BodyError("{name} is a scan, whose dimensions depend on the azimuth: give the azimuth", name=self.body.name)
        return self.body

    def towards(self, azimuth: float) -> Block:
        """Return the block that a scan is towards an azimuth, degrees clockwise from north."""
        if not isinstance(self.body, ScannedBody):
            raise BodyError("{name} has the same dimensions in all azimuths: omit the azimuth", name=lazy_gettext(self.body.name))
        return self.body.block_toward(azimuth)

    def block_for_motion(self, motion: Motion) -> Block:
        """Return the block that follows a motion: of a scan that towards its azimuth."""
        return self.body.block_for_motion(motion) if isinstance(self.body, ScannedBody) else self.body

    def block_key(self, block: Block) -> dict[str, Any]:
        """Return what is told beside an answer of the block that it is of, nothing where all answers are of one."""
        from seisblock.report.json.bodies import block_entry

        return {"block": block_entry(block)} if isinstance(self.body, ScannedBody) else {}


@dataclass(frozen=True)
class BlockChoice(BodyChoice):
    """A body, the restitution it brings along (None for that of its angular momentum), and one line on where it comes from."""

    restitution: float | None
    description: str


def choose_block(params: Mapping[str, Any]) -> BlockChoice:
    """Return the body that a set of options describes.

    Parameters
    ----------
    params : mapping
        ``block`` and ``side``, or ``width``, ``height`` and the other sizes of a block, SI, and ``kind``; ``restitution`` and ``inset``
        override what a file brings along. None where not given. ``gal``: False where lengths are told in m.

    Raises
    ------
    BodyError
        If sizes and a named block are mixed, or something needed is missing.
    """
    keys = ("width", "height", "depth", "mass", "centroid_height", "centroid_offset", "centroid_inertia")
    sizes = {key: params[key] for key in keys if params.get(key) is not None}
    restitution = params.get("restitution")
    if params.get("block"):
        if sizes:
            raise BodyError(
                "--block and sizes ({sizes}) exclude each other: give only one of them",
                sizes=["--" + key.replace("_", "-") for key in sizes],
            )
        refuse_kind(params)
        table = read_body_toml(params["block"])
        if restitution is None:
            restitution = table_restitution(table, params["block"])
        check_side(params, table.get("kind"))
        body = body_from_table(table, side=params.get("side") or "short")
        origin = lazy_gettext("{name}, from {file}", name=lazy_gettext(body.name), file=params["block"])
    else:
        check_side(params, None)
        missing = [f"--{key}" for key in ("width", "height") if key not in sizes]
        if missing:
            raise BodyError(
                "body required ({missing} missing): give --width and --height, or --block NAME|FILE (for example gravestone)",
                missing=missing,
            )
        body = of_kind(Block(**sizes), params.get("kind") or "block")
        origin = lazy_gettext("block {width:g} m wide, {height:g} m high", width=body.width, height=body.height)
    if params.get("inset") is not None:
        body = body.with_wear(params["inset"])
    return BlockChoice(
        body,
        restitution,
        lazy_gettext("{parts}", parts=[part for part in (origin, describe_edges(body, gal=params.get("gal", True))) if part]),
    )


def refuse_kind(asked: Mapping[str, Any]) -> None:
    """Refuse the kind of a body that comes from a file, which tells its own ranges."""
    if asked.get("kind") is not None:
        raise BodyError("--kind has no effect with --block: use --kind with --width and --height")


def check_side(params: Mapping[str, Any], kind: str | None) -> None:
    """Refuse the side of a body that has but one."""
    if params.get("side") is not None and kind != "two-layer":
        raise BodyError("--side has no effect: this body is not a two-layer --block; omit --side")

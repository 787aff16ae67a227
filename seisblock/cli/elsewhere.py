"""Where `respond` answers for the same body under the same record: the command line to type, said where a model's assumption ends."""

from __future__ import annotations

import shlex
from collections.abc import Iterator, Mapping
from typing import Any

from seisblock.bodies.block import Block
from seisblock.bodies.two_layer import Contact, TwoLayerBlock
from seisblock.cli.options import Source
from seisblock.present.text.tables import line
from seisblock.words import tell

DEPTH = "DEPTH"
"""What stands for a depth that only the user knows."""


def respond_line(source: Source, *words: str) -> str:
    """Return the command line of `respond` for what was asked of the record, with some more words."""
    given = {
        "--scale": source.scale,
        "--target-pga": source.target_pga,
        "--highpass": source.highpass,
        "--floor": source.floor and source.floor.written,
        "--format": source.format,
        "--units": source.units,
        "--dt": source.dt,
        "--station": source.station,
        "--level": source.level,
    }
    options = [word for name, value in given.items() if value is not None for word in (name, str(value))]
    options += [word for window in source.window for word in ("--window", ":".join("" if end is None else f"{end:g}" for end in window))]
    options += [] if source.demean is None else ["--demean" if source.demean else "--no-demean"]
    options += ["--strict"] * source.strict
    return shlex.join(
        ["seisblock", "respond", *source.record, *(w for c in source.component for w in ("--component", c)), *options, *words]
    )


def _sizes(block: Block) -> list[str]:
    """Return the options that give a block's sizes; what follows from others is left out."""
    words = ["--width", f"{block.width:.6g}", "--height", f"{block.height:.6g}"]
    if block.centroid_height is not None:
        words += ["--centroid-height", f"{block.centroid_height:.6g}"]
    if block.centroid_offset:
        words += ["--centroid-offset", f"{block.centroid_offset:.6g}"]
    if block.mass is not None:
        words += ["--mass", f"{block.mass:.6g}"]
    if block.centroid_inertia is not None:
        words += ["--inertia", f"{block.centroid_inertia:.6g}"]
    return [*words, "--inset", f"{block.inset / block.width:.6g}"] if block.inset else words


def after_jump(
    source: Source, asked: Mapping[str, Any], default: str, block: TwoLayerBlock, contact: Contact, tenon: float | None
) -> Iterator[Any]:
    """Yield where the jump's body is followed with friction, tenons and all motions together."""
    named = asked.get("width") is None
    body = ["--block", asked.get("block") or default, "--side", asked.get("side") or "short"] if named else _sizes(block.as_block())
    words = [*body, "--mu", f"{contact.mu:g}", "--mu-kinetic", f"{contact.kinetic:g}", "--restitution", f"{contact.restitution_y:g}"]
    typed = respond_line(source, *words, "--tenon", DEPTH if tenon is None else f"{tenon:g}")
    if tenon is None:
        text = tell("respond follows the same body through all of its motions, once the depth of its tenons is known: {typed}", typed=typed)
    else:
        text = tell("respond follows the same body through all of its motions, with its tenons: {typed}", typed=typed)
    yield line(text)


def after_rock(source: Source, asked: Mapping[str, Any], block: Block, mu: float | None, *, suffices: bool) -> Iterator[Any]:
    """Yield where a block that friction does not hold is followed as it slides and rocks."""
    if mu is not None and not suffices:
        side = ["--side", asked["side"]] if asked.get("side") else []
        body = ["--block", asked["block"], *side] if asked.get("block") else _sizes(block)
        yield line(tell("respond lets it slide and rock: {typed}", typed=respond_line(source, *body, "--mu", f"{mu:g}")))


def after_slide(source: Source, mu: float, mu_kinetic: float | None, *, slips: bool) -> Iterator[Any]:
    """Yield which bodies would rock instead of sliding, and where they are followed."""
    if slips:
        kinetic = [] if mu_kinetic is None else ["--mu-kinetic", f"{mu_kinetic:g}"]
        typed = respond_line(source, "--width", "B", "--height", "H", "--mu", f"{mu:g}", *kinetic)
        text = tell(
            "This holds for what does not rock: b/h, half the base over the height of the centre, above {mu:g}. Others: {typed}",
            mu=mu,
            typed=typed,
        )
        yield line(text)

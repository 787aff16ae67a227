"""Suggested ``respond`` command lines after the results of other solvers."""

from __future__ import annotations

import shlex
from collections.abc import Iterator, Mapping
from typing import Any

from seisblock.bodies.block import Block
from seisblock.bodies.two_layer import Contact, TwoLayerBlock
from seisblock.cli.bodies.options import DEFAULT_TWO_LAYER
from seisblock.cli.options import Source
from seisblock.core.i18n import N_, gettext
from seisblock.output.text.tables import styled_line

LENGTH_PLACEHOLDER = "LENGTH"
"""Placeholder for a length that the user has to enter."""

REPEATED_OPTIONS = (
    "scale", "target_pga", "target_jma", "highpass", "format", "units", "dt", "station", "level", "location", "inventory", "event",
)  # fmt: skip
"""Record options that are repeated as they were given."""


def respond_command(source: Source, *words: str) -> str:
    """Return the ``respond`` command line for the record options and further words."""
    values = {
        **{f"--{name.replace('_', '-')}": getattr(source, name) for name in REPEATED_OPTIONS},
        "--floor": source.floor and source.floor.spec,
        "--response": None if source.response == "sensitivity" else source.response,
    }
    options = [word for name, value in values.items() if value is not None for word in (name, str(value))]
    options += [word for window in source.window for word in ("--window", ":".join("" if end is None else f"{end:g}" for end in window))]
    options += [] if source.demean is None else ["--demean" if source.demean else "--no-demean"]
    options += ["--differentiate"] * source.differentiate + ["--strict"] * source.strict
    return shlex.join(
        ["seisblock", "respond", *source.record, *(w for c in source.component for w in ("--component", c)), *options, *words]
    )


def _size_options(block: Block) -> list[str]:
    """Return the size options of a block; sizes that follow from others are omitted."""
    words = ["--width", f"{block.width:.6g}", "--height", f"{block.height:.6g}"]
    if block.depth is not None:
        words += ["--depth", f"{block.depth:.6g}"]
    if block.centroid_height is not None:
        words += ["--centroid-height", f"{block.centroid_height:.6g}"]
    if block.centroid_offset:
        words += ["--centroid-offset", f"{block.centroid_offset:.6g}"]
    if block.mass is not None:
        words += ["--mass", f"{block.mass:.6g}"]
    if block.centroid_inertia is not None:
        words += ["--inertia", f"{block.centroid_inertia:.6g}"]
    return [*words, "--inset", f"{block.inset / block.width:.6g}"] if block.inset else words


def jump_hint(source: Source, params: Mapping[str, Any], block: TwoLayerBlock, contact: Contact, tenon: float) -> Iterator[Any]:
    """Yield the ``respond`` command line for the two-layer block, with friction and tenons."""
    body = _size_options(block.as_block())
    if params.get("width") is None:
        body = ["--block", params.get("block") or DEFAULT_TWO_LAYER, "--side", params.get("side") or "short"]
    words = [*body, "--mu", f"{contact.mu:g}", "--mu-kinetic", f"{contact.kinetic:g}", "--restitution", f"{contact.restitution_y:g}"]
    command = respond_command(source, *words, "--tenon", f"{tenon:g}" if tenon else LENGTH_PLACEHOLDER)
    text = N_("Full response with friction and tenons: {typed}")
    if not tenon:
        text = N_("Full response with friction and tenons (tenon length required): {typed}")
    yield styled_line(gettext(text, typed=command))


def rock_hint(source: Source, params: Mapping[str, Any], block: Block, mu: float | None, *, suffices: bool) -> Iterator[Any]:
    """Yield the ``respond`` command line where friction does not suffice for rocking without sliding."""
    if mu is not None and not suffices:
        side = ["--side", params["side"]] if params.get("side") else []
        body = ["--block", params["block"], *side] if params.get("block") else _size_options(block)
        yield styled_line(gettext("Response with sliding and rocking: {typed}", typed=respond_command(source, *body, "--mu", f"{mu:g}")))


def slide_hint(source: Source, mu: float, mu_kinetic: float | None, *, slips: bool) -> Iterator[Any]:
    """Yield the slenderness limit of pure sliding and the ``respond`` command line for other bodies."""
    if slips:
        kinetic = [] if mu_kinetic is None else ["--mu-kinetic", f"{mu_kinetic:g}"]
        command = respond_command(source, "--width", "B", "--height", "H", "--mu", f"{mu:g}", *kinetic)
        text = gettext(
            "Valid for objects that do not rock: b/h (half base over height of the centre of gravity) above {mu:g}. Other objects: {typed}",
            mu=mu,
            typed=command,
        )
        yield styled_line(text)

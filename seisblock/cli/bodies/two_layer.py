"""Which two-layer block the user means: a bundled one, a file, or sizes given one by one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from seisblock.bodies.toml import read_table
from seisblock.bodies.two_layer import Contact, TwoLayerBlock, contact, two_layer_block
from seisblock.errors import BodyError
from seisblock.words import said

_CONTACT = ("mu", "mu_kinetic", "restitution_x", "restitution_y")


@dataclass(frozen=True)
class TwoLayerChoice:
    """A block with its contact, and one line on where they come from."""

    block: TwoLayerBlock
    contact: Contact
    says: str


def two_layer_choice(asked: Mapping[str, Any], *, default: str) -> TwoLayerChoice:
    """Return the block and contact that a set of options describes.

    Parameters
    ----------
    asked : mapping
        ``block``, ``side``, or ``width``, ``depth``, ``heights``, ``masses``; and ``mu``, ``mu_kinetic``, ``restitution_x``,
        ``restitution_y``, which override those that a preset brings along. SI; None where not given.
    default : str
        Bundled body taken when neither a block nor sizes are given.

    Raises
    ------
    BodyError
        If sizes and a named block are mixed, or something needed is missing.
    """
    sizes = {key: asked.get(key) for key in ("width", "heights", "masses")}
    given = [key for key, value in sizes.items() if value is not None]
    if given and asked.get("block"):
        raise BodyError("give either --block or sizes ({given}), not both", given=[f"--{name}" for name in given])
    preset: Mapping[str, float] = {}
    if given:
        block = _from_sizes(asked, sizes)
        origin = said("sizes as given")
    else:
        name = asked.get("block") or default
        table = read_table(name)
        block, preset = two_layer_block(table, asked.get("side") or "short"), contact(table)
        origin = said("from {file}", file=name) if asked.get("block") else said("from {file} (the default)", file=name)
    values = {**preset, **{key: asked[key] for key in _CONTACT if asked.get(key) is not None}}
    if "mu" not in values:
        raise BodyError("{name} brings no friction of its own: give --mu", name=block.name)
    met = Contact(**values)
    told = said(
        "mu {mu:g}, mu kinetic {kinetic:g}, restitution x {x:g}, restitution y {y:g}",
        mu=met.mu,
        kinetic=met.kinetic,
        x=met.restitution_x,
        y=met.restitution_y,
    )
    return TwoLayerChoice(block, met, said("{origin}; {values}", origin=origin, values=told))


def _from_sizes(asked: Mapping[str, Any], sizes: Mapping[str, Any]) -> TwoLayerBlock:
    """Return a block from sizes given one by one."""
    missing = [f"--{key}" for key, value in sizes.items() if value is None]
    if missing:
        raise BodyError("a block given by its sizes also needs {missing}", missing=missing)
    for key in ("heights", "masses"):
        if len(sizes[key]) != 2:
            raise BodyError("--{key} takes two values, upper and lower layer, found {count}", key=key, count=len(sizes[key]))
    width, depth = sizes["width"], asked.get("depth")
    return TwoLayerBlock(width, width if depth is None else depth, *sizes["heights"], *sizes["masses"])

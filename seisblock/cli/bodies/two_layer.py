"""Two-layer block from command-line options: bundled name, TOML file or sizes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from seisblock.bodies.toml import read_body_toml
from seisblock.bodies.two_layer import Contact, TwoLayerBlock, base_from_table, contact_from_table, two_layer_from_table
from seisblock.cli.bodies.options import DEFAULT_TWO_LAYER
from seisblock.core.errors import BodyError
from seisblock.core.i18n import lazy_gettext

_CONTACT = ("mu", "mu_kinetic", "restitution_x", "restitution_y")


@dataclass(frozen=True)
class TwoLayerChoice:
    """Two-layer block with its contact, a one-line description, and drop and tenon of its file, m, as far as it has them."""

    block: TwoLayerBlock
    contact: Contact
    description: str
    base: Mapping[str, float]


def two_layer_choice(params: Mapping[str, Any]) -> TwoLayerChoice:
    """Return the two-layer block and the contact described by a set of options.

    Parameters
    ----------
    params : mapping
        ``block``, ``side``, or ``width``, ``depth``, ``heights``, ``masses``; and ``mu``, ``mu_kinetic``, ``restitution_x``,
        ``restitution_y``, which override those of a preset. SI; None where not given.

    Raises
    ------
    BodyError
        If both sizes and a named block are given, or a required value is missing.
    """
    sizes = {key: params.get(key) for key in ("width", "heights", "masses")}
    given_sizes = [key for key, value in sizes.items() if value is not None]
    if given_sizes and params.get("block"):
        raise BodyError(
            "--block and sizes ({given}) exclude each other: give only one of them", given=[f"--{name}" for name in given_sizes]
        )
    preset: Mapping[str, float] = {}
    base: Mapping[str, float] = {}
    if given_sizes:
        block = _from_sizes(params, sizes)
        origin = lazy_gettext("sizes as given")
    else:
        name = params.get("block") or DEFAULT_TWO_LAYER
        table = read_body_toml(name)
        block, preset = two_layer_from_table(table, params.get("side") or "short"), contact_from_table(table)
        base = base_from_table(table)
        origin = lazy_gettext("from {file}", file=name) if params.get("block") else lazy_gettext("from {file} (default)", file=name)
    values = {**preset, **{key: params[key] for key in _CONTACT if params.get(key) is not None}}
    if "mu" not in values:
        raise BodyError("friction required: {name} defines none; give --mu", name=block.name)
    layer_contact = Contact(**values)
    values_text = lazy_gettext(
        "mu {mu:g}, kinetic {kinetic:g}, restitution x {x:g}, y {y:g}",
        mu=layer_contact.mu,
        kinetic=layer_contact.kinetic,
        x=layer_contact.restitution_x,
        y=layer_contact.restitution_y,
    )
    return TwoLayerChoice(block, layer_contact, lazy_gettext("{origin}; {values}", origin=origin, values=values_text), base)


def _from_sizes(params: Mapping[str, Any], sizes: Mapping[str, Any]) -> TwoLayerBlock:
    missing = [f"--{key}" for key, value in sizes.items() if value is None]
    if missing:
        raise BodyError("a two-layer block given by its sizes also requires {missing}", missing=missing)
    for key in ("heights", "masses"):
        if len(sizes[key]) != 2:
            raise BodyError("--{key} requires two values, upper and lower layer; found {count}", key=key, count=len(sizes[key]))
    width, depth = sizes["width"], params.get("depth")
    return TwoLayerBlock(width, width if depth is None else depth, *sizes["heights"], *sizes["masses"])

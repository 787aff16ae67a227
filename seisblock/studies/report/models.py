"""Body of a report, in the form required by each model."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field

from seisblock.bodies.block import Block
from seisblock.bodies.factory import block_from_table, table_friction, table_restitution
from seisblock.bodies.kinds import of_kind
from seisblock.bodies.spring_block import REFERENCE_MASS, SpringBlock
from seisblock.bodies.spring_factory import PAPER_BETA, PAPER_DAMPING
from seisblock.bodies.toml import read_body_toml
from seisblock.bodies.two_layer import Contact, TwoLayerBlock, base_from_table, contact_from_table, two_layer_from_table
from seisblock.core.errors import BodyError
from seisblock.core.i18n import lazy_gettext
from seisblock.core.units import parse_length

_SIZE_PATTERN = re.compile(r"^\s*([\d.]+\s*[^\W\d]*?)\s*[x×X]\s*([\d.]+\s*[^\W\d]*)\s*$")


@dataclass(frozen=True)
class BodyModels:
    """One body, in the form required by each model.

    Parameters
    ----------
    name : str
    block : Block
        Rigid block, for rocking.
    restitution : float or None
        Of the body; None for conservation of angular momentum.
    layers, contact : TwoLayerBlock, Contact, or None
        Two-layer block, for the jump.
    springs : SpringBlock or None
        Block on corner springs, for uplift.
    mu, mu_kinetic : float or None
        Friction under the body, for sliding; None if unknown.
    base : mapping
        Drop and tenon of a two-layer block, m, as far as its file has them.
    """

    name: str
    block: Block
    restitution: float | None = None
    layers: TwoLayerBlock | None = None
    contact: Contact | None = None
    springs: SpringBlock | None = None
    mu: float | None = None
    mu_kinetic: float | None = None
    base: Mapping[str, float] = field(default_factory=dict)


def is_sizes(text: str) -> bool:
    """Return True for a text with the width and height of a body."""
    return _SIZE_PATTERN.match(text) is not None


def body_models(
    text: str,
    *,
    side: str = "short",
    kind: str = "block",
    mu: float | None = None,
    mu_kinetic: float | None = None,
    frequency_vertical: float | None = None,
) -> BodyModels:
    """Return the body of a text.

    Parameters
    ----------
    text : str
        A bundled body, a TOML file, or a width and a height such as ``24cmx72cm``.
    side : "short" or "long"
        Side of a two-layer body along the motion.
    kind : str
        Kind of a body given by its sizes, see :data:`~seisblock.bodies.kinds.KINDS`.
    mu, mu_kinetic : float
        Friction under the body; default: its own.
    frequency_vertical : float, Hz
        Vertical frequency on corner springs, for uplift, with the horizontal stiffness and damping of [Okumura1987]_'s figures.

    Raises
    ------
    BodyError
        If there is no such body, or its sizes are not possible.

    Examples
    --------
    >>> body_models("24cm x 72cm").block.height
    0.72
    """
    sizes = _SIZE_PATTERN.match(text)
    layers = None
    contact_values: Mapping[str, float] = {}
    base: Mapping[str, float] = {}
    own_friction: tuple[float | None, float | None] = (None, None)
    name: str
    if sizes:
        width, height = (parse_length(part, quantity=lazy_gettext("body {text}", text=text)) for part in sizes.groups())
        block, own_restitution = of_kind(Block(width, height), kind), None
        name = lazy_gettext("block {width:g} x {height:g} m", width=width, height=height)
    else:
        table = read_body_toml(text)
        if table.get("kind") not in ("block", "two-layer"):
            raise BodyError("{text}: expected a body of kind block or two-layer, found {found!r}", text=text, found=table.get("kind"))
        block, own_restitution = block_from_table(table, side=side), table_restitution(table, text)
        name = block.name
        if table["kind"] == "two-layer":
            layers, contact_values = two_layer_from_table(table, side), contact_from_table(table)
            base = base_from_table(table)
        own_friction = table_friction(table, text)
    if mu is not None:
        block = block.without_ranges("mu")
    static = own_friction[0] if mu is None else mu
    kinetic = mu_kinetic if mu_kinetic is not None else (static if mu is not None or own_friction[1] is None else own_friction[1])
    # the foot lands with the friction under the body
    contact = None
    if layers is not None and static is not None:
        restitution = {key: value for key, value in contact_values.items() if key.startswith("restitution")}
        contact = Contact(static, kinetic, **restitution)
    return BodyModels(
        name,
        block,
        own_restitution,
        layers if contact else None,
        contact,
        _make_spring_block(block, frequency_vertical),
        static,
        kinetic,
        base,
    )


def _make_spring_block(block: Block, frequency: float | None) -> SpringBlock | None:
    if frequency is None:
        return None
    depth = block.width if block.depth is None else block.depth
    mass = block.mass or REFERENCE_MASS
    return SpringBlock.from_frequency(
        block.width, depth, block.height, frequency_vertical=frequency, beta=PAPER_BETA, mass=mass, damping=PAPER_DAMPING
    )

"""What a report is about: one body as every model that can follow it sees it."""

from __future__ import annotations

import re
from dataclasses import dataclass

from seisblock.bodies.block import Block
from seisblock.bodies.kinds import of_kind
from seisblock.bodies.library import block_of, friction_of, restitution_of
from seisblock.bodies.spring_block import REFERENCE_MASS, SpringBlock
from seisblock.bodies.spring_choice import PAPER_BETA, PAPER_DAMPING
from seisblock.bodies.toml import read_table
from seisblock.bodies.two_layer import Contact, TwoLayerBlock, contact, two_layer_block
from seisblock.errors import BodyError
from seisblock.units import parse_length
from seisblock.words import said

_SIZES = re.compile(r"^\s*([\d.]+\s*[^\W\d]*?)\s*[x×X]\s*([\d.]+\s*[^\W\d]*)\s*$")


@dataclass(frozen=True)
class Subject:
    """One body.

    Parameters
    ----------
    name : str
    block : Block
        As one rigid block, for rocking.
    restitution : float or None
        Its own; None for that of its angular momentum.
    layers, contact : TwoLayerBlock, Contact, or None
        As a two-layer block, for the jump.
    springs : SpringBlock or None
        On corner springs, for uplift.
    mu, mu_kinetic : float or None
        Friction under it, for sliding; None when nothing is known of it.
    """

    name: str
    block: Block
    restitution: float | None = None
    layers: TwoLayerBlock | None = None
    contact: Contact | None = None
    springs: SpringBlock | None = None
    mu: float | None = None
    mu_kinetic: float | None = None


def is_sizes(text: str) -> bool:
    """Return whether a text names a body by its width and height."""
    return _SIZES.match(text) is not None


def subject(
    text: str,
    *,
    side: str = "short",
    kind: str = "block",
    mu: float | None = None,
    mu_kinetic: float | None = None,
    frequency_vertical: float | None = None,
) -> Subject:
    """Return the body a text names.

    Parameters
    ----------
    text : str
        A bundled body, a TOML file, or a width and a height such as ``24cmx72cm``.
    side : "short" or "long"
        Side of a two-layer body along the motion.
    kind : str
        Kind of a body given by its sizes, see :data:`~seisblock.bodies.kinds.KINDS`.
    mu, mu_kinetic : float
        Friction under the body; a body's own where left out.
    frequency_vertical : float, Hz
        Vertical frequency on corner springs, for uplift, with the horizontal stiffness and damping of [Okumura1987]_'s figures.

    Raises
    ------
    BodyError
        If there is no such body, or its sizes are not possible.

    Examples
    --------
    >>> subject("24cm x 72cm").block.height
    0.72
    """
    sizes = _SIZES.match(text)
    layers = own = None
    bare: tuple[float | None, float | None] = (None, None)
    name: str
    if sizes:
        width, height = (parse_length(part, what=said("body {text}", text=text)) for part in sizes.groups())
        block, own_restitution = of_kind(Block(width, height), kind), None
        name = said("block {width:g} x {height:g} m", width=width, height=height)
    else:
        table = read_table(text)
        if table.get("kind") not in ("block", "two-layer"):
            raise BodyError(
                "{text} is no body of one piece: expected kind block or two-layer, found {found!r}", text=text, found=table.get("kind")
            )
        block, own_restitution = block_of(table, side=side), restitution_of(table, text)
        name = block.name
        if table["kind"] == "two-layer":
            layers, found = two_layer_block(table, side), contact(table)
            own = Contact(**found) if "mu" in found else None
        bare = friction_of(table, text)
    if mu is not None:
        block = block.known("mu")
    static = bare[0] if mu is None else mu
    kinetic = mu_kinetic if mu_kinetic is not None else (static if mu is not None or bare[1] is None else bare[1])
    return Subject(name, block, own_restitution, layers if own else None, own, _on_springs(block, frequency_vertical), static, kinetic)


def _on_springs(block: Block, frequency: float | None) -> SpringBlock | None:
    """Return the block on corner springs of a vertical frequency, Hz."""
    if frequency is None:
        return None
    depth = block.width if block.depth is None else block.depth
    mass = block.mass or REFERENCE_MASS
    return SpringBlock.from_frequency(
        block.width, depth, block.height, frequency_vertical=frequency, beta=PAPER_BETA, mass=mass, damping=PAPER_DAMPING
    )

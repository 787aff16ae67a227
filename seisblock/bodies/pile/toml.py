"""Piles as TOML files, the bundled ones among them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

from seisblock import checks
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import GRANITE, GROUND, RECTANGULAR, ROUND, PileStone
from seisblock.bodies.ranges import ranges_of
from seisblock.bodies.toml import (
    inset_of,
    length,
    lengths,
    number,
    of_kind,
    read_table,
    refuse_unknown,
    source_of,
    text,
    text_groups,
    texts,
)
from seisblock.errors import BodyError
from seisblock.limits import check_budget
from seisblock.words import noted, said

_PILE_KEYS = {"name", "kind", "mu", "mu_kinetic", "density", "inset", "reinforced", "fixed", "stone", "note", "ranges"}
_STONE_KEYS = {"name", "width", "depth", "height", "offset", "on", "density", "mu", "mu_kinetic", "bottom", "shape", "inset"}


def load_pile(name: str | Path, *, reinforced: bool = False, mu: float | None = None) -> Pile:
    """Return a pile of stones from a TOML file, or a bundled one by its name (``wagata``, ``lantern``, ``column``).

    Parameters
    ----------
    name : str or Path
        ``kind = "pile"``, and one ``[[stone]]`` table per stone, from below upwards: ``name``, ``width``, ``depth``, ``height``
        (numbers in m or texts such as ``"8sun"``); optional ``offset`` (two lengths), ``on``, ``density``, ``mu``, ``mu_kinetic``,
        ``bottom``, ``shape = "round"`` (``width`` is then its diameter, and ``depth`` may be left out), ``inset`` as of a block.
        On top: ``name``, ``mu``, ``mu_kinetic``, ``density``, ``inset``, ``fixed`` (list of names), ``reinforced`` (list of lists of
        names that dowels hold); ``[ranges]`` of its kind, as of a block.
    reinforced : bool
        Whether the dowels of the file are in place.
    mu : float or None, 1
        Friction of every joint, sliding or not; None: what the file says.

    Raises
    ------
    BodyError
        If there is no such file, or it describes no pile that can stand.

    Examples
    --------
    >>> load_pile("wagata").names
    ('gedai', 'mizubachi', 'chudai', 'jodai', 'sao')
    """
    if mu is not None:
        checks.not_negative("friction of the pile {name}", mu, error=BodyError, name=str(name))
    table = read_table(name, kind="pile")
    of_kind(table, "pile")
    source = source_of(table)
    refuse_unknown(table, _PILE_KEYS)
    entries = table.get("stone")
    if not isinstance(entries, list) or not entries or not all(isinstance(entry, dict) for entry in entries):
        raise BodyError("{source}: a pile needs at least one [[stone]] table", source=source)
    check_budget(noted("stones of a pile"), len(entries), "SEISBLOCK_PILE_STONES", where=source, error=BodyError)
    stones: list[PileStone] = []
    for rank, entry in enumerate(entries, start=1):
        below = stones[-1].name if stones else GROUND
        stones.append(_stone({**entry, "source": said("{source}: stone {number}", source=source, number=rank)}, below, table))
    if mu is not None:
        stones = [replace(stone, mu=None, mu_kinetic=None) for stone in stones]
    dowels = text_groups(table, "reinforced")
    if reinforced and not dowels:
        raise BodyError("{source} has no dowels: add reinforced = [[name, name]] to the file, or leave `reinforced` out", source=source)
    own = number(table, "mu")
    friction = mu if mu is not None else Pile.mu if own is None else own
    name_of, fixed, kinetic = text(table, "name", Path(source).stem), texts(table, "fixed"), number(table, "mu_kinetic")
    with _saying(source):
        pile = Pile(name_of, tuple(stones), dowels if reinforced else (), fixed, friction, mu_kinetic=None if mu is not None else kinetic)
    whole = pile.as_block()
    return replace(pile, ranges=ranges_of(table, {"width": whole.width, "height": whole.height, "inset": whole.inset, "mu": own}))


def _stone(entry: Mapping[str, Any], below: str, table: Mapping[str, Any]) -> PileStone:
    """Return one stone of a file."""
    refuse_unknown(entry, _STONE_KEYS)
    if not isinstance(entry.get("name"), str):
        raise BodyError("{source}: name is missing", source=entry["source"])
    x, y = lengths(entry, "offset", 2) if "offset" in entry else (0.0, 0.0)
    own, common = number(entry, "density"), number(table, "density")
    shape = text(entry, "shape", RECTANGULAR)
    described = (
        entry["name"],
        length(entry, "width"),
        length(entry, "width" if shape == ROUND and "depth" not in entry else "depth"),
        length(entry, "height"),
        (x, y),
        text(entry, "on", below),
        own if own is not None else GRANITE if common is None else common,
        number(entry, "mu"),
        length(entry, "bottom") if "bottom" in entry else None,
        shape,
        inset_of(entry if "inset" in entry else table),
        number(entry, "mu_kinetic"),
    )
    with _saying(source_of(table)):
        return PileStone(*described)


@contextmanager
def _saying(source: str) -> Iterator[None]:
    """Have what is wrong with a pile, or with a stone of it, said with the file in front."""
    try:
        yield
    except BodyError as error:
        raise BodyError("{source}: {why}", source=source, why=error.said) from None

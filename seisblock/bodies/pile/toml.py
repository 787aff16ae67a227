"""TOML files of piles, bundled ones included."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import GRANITE_DENSITY, GROUND, RECTANGULAR, ROUND, PileStone
from seisblock.bodies.toml import (
    check_keys,
    check_kind,
    get_edge_wear,
    get_length,
    get_lengths,
    get_number,
    get_text,
    get_text_groups,
    get_texts,
    read_body_toml,
    source_name,
)
from seisblock.bodies.uncertainty import parse_ranges
from seisblock.core import checks
from seisblock.core.errors import BodyError
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.limits import MAX_PILE_STONES, check_limit

_PILE_KEYS = {"name", "kind", "mu", "mu_kinetic", "density", "inset", "reinforced", "fixed", "stone", "note", "ranges"}
_STONE_KEYS = {"name", "width", "depth", "height", "offset", "on", "density", "mu", "mu_kinetic", "bottom", "shape", "inset"}


def load_pile(name: str | Path, *, reinforced: bool = False, mu: float | None = None) -> Pile:
    """Return a pile from a TOML file or a bundled one (``wagata``, ``lantern``, ``column``).

    Parameters
    ----------
    name : str or Path
        ``kind = "pile"``, and one ``[[stone]]`` table per stone, from bottom to top: ``name``, ``width``, ``depth``, ``height``
        (numbers in m or strings such as ``"8sun"``); optional ``offset`` (two lengths), ``on``, ``density``, ``mu``, ``mu_kinetic``,
        ``bottom``, ``shape = "round"`` (``width`` is the diameter, ``depth`` optional), ``inset`` as of a block.
        On top: ``name``, ``mu``, ``mu_kinetic``, ``density``, ``inset``, ``fixed`` (list of names), ``reinforced`` (list of lists of
        dowelled names); ``[ranges]`` of the kind, as of a block.
    reinforced : bool
        Whether to insert the dowels of the file.
    mu : float or None, 1
        Static and kinetic friction of every joint; None: that of the file.

    Returns
    -------
    Pile

    Raises
    ------
    BodyError
        If there is no such file, or the pile is invalid or unstable.

    Examples
    --------
    >>> load_pile("wagata").names
    ('gedai', 'mizubachi', 'chudai', 'jodai', 'sao')
    """
    if mu is not None:
        checks.non_negative("friction of the pile {name}", mu, error=BodyError, name=str(name))
    table = read_body_toml(name, kind="pile")
    check_kind(table, "pile")
    source = source_name(table)
    check_keys(table, _PILE_KEYS)
    entries = table.get("stone")
    if not isinstance(entries, list) or not entries or not all(isinstance(entry, dict) for entry in entries):
        raise BodyError("{source}: a pile requires at least one [[stone]] table", source=source)
    check_limit(N_("stones of a pile"), len(entries), MAX_PILE_STONES, source=source, error=BodyError)
    stones: list[PileStone] = []
    for rank, entry in enumerate(entries, start=1):
        support = stones[-1].name if stones else GROUND
        stones.append(
            _parse_stone({**entry, "source": lazy_gettext("{source}: stone {number}", source=source, number=rank)}, support, table)
        )
    if mu is not None:
        stones = [replace(stone, mu=None, mu_kinetic=None) for stone in stones]
    dowels = get_text_groups(table, "reinforced")
    if reinforced and not dowels:
        raise BodyError("{source} has no dowels: add reinforced = [[name, name]] to the file, or omit `reinforced`", source=source)
    file_mu = get_number(table, "mu")
    friction = mu if mu is not None else Pile.mu if file_mu is None else file_mu
    pile_name, fixed, kinetic = get_text(table, "name", Path(source).stem), get_texts(table, "fixed"), get_number(table, "mu_kinetic")
    with _prefix_errors(source):
        pile = Pile(pile_name, tuple(stones), dowels if reinforced else (), fixed, friction, mu_kinetic=None if mu is not None else kinetic)
    block = pile.as_block()
    return replace(pile, ranges=parse_ranges(table, {"width": block.width, "height": block.height, "inset": block.inset, "mu": file_mu}))


def _parse_stone(entry: Mapping[str, Any], default_support: str, table: Mapping[str, Any]) -> PileStone:
    check_keys(entry, _STONE_KEYS)
    if not isinstance(entry.get("name"), str):
        raise BodyError("{source}: name is missing", source=entry["source"])
    x, y = get_lengths(entry, "offset", 2) if "offset" in entry else (0.0, 0.0)
    own_density, pile_density = get_number(entry, "density"), get_number(table, "density")
    shape = get_text(entry, "shape", RECTANGULAR)
    arguments = (
        entry["name"],
        get_length(entry, "width"),
        get_length(entry, "width" if shape == ROUND and "depth" not in entry else "depth"),
        get_length(entry, "height"),
        (x, y),
        get_text(entry, "on", default_support),
        own_density if own_density is not None else GRANITE_DENSITY if pile_density is None else pile_density,
        get_number(entry, "mu"),
        get_length(entry, "bottom") if "bottom" in entry else None,
        shape,
        get_edge_wear(entry if "inset" in entry else table),
        get_number(entry, "mu_kinetic"),
    )
    with _prefix_errors(source_name(table)):
        return PileStone(*arguments)


@contextmanager
def _prefix_errors(source: str) -> Iterator[None]:
    """Prefix the errors of a pile with the name of its file."""
    try:
        yield
    except BodyError as error:
        raise BodyError("{source}: {why}", source=source, why=error.message) from None

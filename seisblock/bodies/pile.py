"""Piles as TOML files, the bundled ones among them, and how their stones press on each other."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from seisblock.bodies.files import length, of_kind, read_table
from seisblock.bodies.gravestone import GRANITE, GROUND, Gravestone, PileStone
from seisblock.errors import BodyError, ParameterError
from seisblock.units import parse_length

_PILE_KEYS = {"source", "name", "kind", "mu", "density", "reinforced", "fixed", "stone", "note"}
_STONE_KEYS = {"name", "width", "depth", "height", "offset", "on", "density", "mu", "bottom"}


@dataclass(frozen=True)
class PileContact:
    """Spring, dashpot and slider at each contact point.

    Two descriptions: per unit mass of the upper stone and per point, as [Furukawa2009]_ table 2 must be read (3947.8 = (2 pi 10)^2
    is 10 Hz, 125.66 = 2 (2 pi 10) critical damping; as N/m the stones would sink by centimetres); or physical, by the stones'
    Young's modulus or the stiffness of the joint per area.

    Parameters
    ----------
    normal, shear : float, 1/s^2
        Stiffness per point over the upper stone's mass.
    normal_damping, shear_damping : float, 1/s
        Dashpots per point over the upper stone's mass.
    young : float, Pa, or None
        Each joint is as stiff as the half heights of its two stones, all damped by ``damping_ratio``; replaces the four above.
    stiffness : float, N/m^3, or None
        Stiffness of the joints per area; replaces the four above.
    damping_ratio : float
        Of the upper stone on its whole joint, for the physical descriptions.
    shear_ratio : float
        Shear over normal stiffness, for the physical descriptions; 0.4 as in [Furukawa2009]_ table 2.
    """

    normal: float = 3947.8
    shear: float = 1579.1
    normal_damping: float = 125.66
    shear_damping: float = 50.265
    young: float | None = None
    stiffness: float | None = None
    damping_ratio: float = 1.0
    shear_ratio: float = 0.4

    def __post_init__(self) -> None:
        for name in ("normal", "shear", "shear_ratio", "young", "stiffness"):
            value = getattr(self, name)
            if value is not None and not (value > 0.0 and math.isfinite(value)):
                raise ParameterError(f"{name} of the contact must be positive, found {value}")
        for name in ("normal_damping", "shear_damping", "damping_ratio"):
            value = getattr(self, name)
            if not (value >= 0.0 and math.isfinite(value)):
                raise ParameterError(f"{name} of the contact must be zero or more, found {value}")
        if self.young is not None and self.stiffness is not None:
            raise ParameterError("the contact takes Young's modulus or the stiffness per area, not both")

    def of_joint(self, mass: float, area: float, length_: float, points: int) -> tuple[float, float, float, float]:
        """Return normal spring and dashpot, shear spring and dashpot of one point of a joint, N/m and N s/m.

        Parameters
        ----------
        mass : float, kg
            Of the upper stone.
        area, length_ : float, m^2, m
            Of the joint; and half the heights of both stones together.
        points : int
            How many points share the joint.
        """
        per_area = self.stiffness if self.young is None else self.young / length_
        if per_area is None:
            return mass * self.normal, mass * self.normal_damping, mass * self.shear, mass * self.shear_damping
        whole = per_area * area
        dashpot = 2.0 * self.damping_ratio * math.sqrt(whole * mass)
        return whole / points, dashpot / points, self.shear_ratio * whole / points, self.shear_ratio * dashpot / points


def read_pile(name: str | Path, *, reinforced: bool = False, mu: float | None = None) -> Gravestone:
    """Return a pile of stones from a TOML file, or a bundled one by its name (``wagata``, ``lantern``).

    Parameters
    ----------
    name : str or Path
        ``kind = "pile"``, and one ``[[stone]]`` table per stone, from below upwards: ``name``, ``width``, ``depth``, ``height``
        (numbers in m or texts such as ``"8sun"``); optional ``offset`` (two lengths), ``on``, ``density``, ``mu``, ``bottom``.
        On top: ``name``, ``mu``, ``density``, ``fixed`` (list of names), ``reinforced`` (list of lists of names that dowels hold).
    reinforced : bool
        Whether the dowels of the file are in place.
    mu : float or None
        Friction of every joint; None: what the file says.

    Raises
    ------
    BodyError
        If there is no such file, or it describes no pile that can stand.

    Examples
    --------
    >>> read_pile("wagata").names
    ('gedai', 'mizubachi', 'chudai', 'jodai', 'sao')
    """
    table = read_table(name)
    of_kind(table, "pile")
    source = str(table["source"])
    _refuse_unknown(table, _PILE_KEYS, source)
    entries = table.get("stone")
    if not isinstance(entries, list) or not entries:
        raise BodyError(f"{source}: a pile needs at least one [[stone]] table")
    stones: list[PileStone] = []
    for number, entry in enumerate(entries, start=1):
        below = stones[-1].name if stones else GROUND
        stones.append(_stone({"source": f"{source}: stone {number}", **entry}, below, table))
    if mu is not None:
        stones = [replace(stone, mu=None) for stone in stones]
    dowels = table.get("reinforced", [])
    if reinforced and not dowels:
        raise BodyError(f"{source} has no dowels: add reinforced = [[name, name]] to the file, or leave --reinforced out")
    return Gravestone(
        str(table.get("name", Path(source).stem)),
        tuple(stones),
        tuple(tuple(str(n) for n in group) for group in dowels) if reinforced else (),
        tuple(str(n) for n in table.get("fixed", [])),
        _number(table, "mu", 0.438) if mu is None else mu,
    )


def _stone(entry: Mapping[str, Any], below: str, table: Mapping[str, Any]) -> PileStone:
    """Return one stone of a file."""
    _refuse_unknown(entry, _STONE_KEYS | {"source"}, str(entry["source"]))
    if not isinstance(entry.get("name"), str):
        raise BodyError(f"{entry['source']}: name is missing")
    offset = entry.get("offset", [0.0, 0.0])
    if not isinstance(offset, list) or len(offset) != 2:
        raise BodyError(f"{entry['source']}: offset must be a list of two lengths, along x and y, found {offset!r}")
    return PileStone(
        entry["name"],
        length(entry, "width"),
        length(entry, "depth"),
        length(entry, "height"),
        (parse_length(offset[0], what="offset"), parse_length(offset[1], what="offset")),
        str(entry.get("on", below)),
        _number(entry, "density", _number(table, "density", GRANITE)),
        _number(entry, "mu", math.nan) if "mu" in entry else None,
        length(entry, "bottom") if "bottom" in entry else None,
    )


def _number(table: Mapping[str, Any], key: str, default: float) -> float:
    """Return an optional number."""
    value = table.get(key, default)
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise BodyError(f"{table['source']}: {key} must be a number, found {value!r}")
    return float(value)


def _refuse_unknown(table: Mapping[str, Any], known: set[str], source: str) -> None:
    """Refuse a key that means nothing, which is a slip of the pen."""
    unknown = sorted(set(table) - known)
    if unknown:
        raise BodyError(f"{source}: unknown key {unknown[0]!r}; known are {', '.join(sorted(known - {'source'}))}")

"""Block on corner springs from user parameters, with completeness checks."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from seisblock.bodies.spring_block import REFERENCE_MASS, SpringBlock
from seisblock.bodies.toml import check_keys, check_kind, entries, get_length, get_number, read_body_toml
from seisblock.core.errors import BodyError

PAPER_BETA = 0.707
"""Horizontal over vertical frequency in figs. 6, 7 and 9 to 11 of [Okumura1987]_: horizontal springs half as stiff."""

PAPER_DAMPING = 0.05
"""Damping ratio in figs. 7 to 11 of [Okumura1987]_."""


def spring_block(
    *,
    width: float | None = None,
    depth: float | None = None,
    height: float | None = None,
    mass: float | None = None,
    stiffness: Sequence[float] | None = None,
    frequency_vertical: float | None = None,
    beta: float | None = None,
    damping: float | None = None,
) -> SpringBlock:
    """Return the block of given sizes and either stiffnesses or frequencies.

    Parameters
    ----------
    width, depth, height : float, m
        The depth defaults to the width.
    mass : float, kg
        Required with `stiffness`; otherwise default 1000 kg, which affects only forces.
    stiffness : (kx, ky, kz), N/m per corner
        Instead of `frequency_vertical` and `beta`.
    frequency_vertical : float, Hz
    beta : float
        Ratio of horizontal to vertical frequency, default 0.707.
    damping : float
        Damping ratio, default 0.05.

    Raises
    ------
    BodyError
        If a value is missing, contradictory or out of range.

    Examples
    --------
    >>> spring_block(width=1.0, height=2.0, mass=800.0, stiffness=(1e4, 1e4, 2e4)).depth
    1.0
    """
    if width is None or height is None:
        missing_name = "`width`" if width is None else "`height`"
        raise BodyError("{missing} required: give `width` and `height`, for example 1.2 and 3 m", missing=missing_name)
    zeta = PAPER_DAMPING if damping is None else damping
    if stiffness is not None:
        if frequency_vertical is not None or beta is not None:
            raise BodyError("`stiffness` excludes `frequency_vertical` and `beta`: omit them")
        if mass is None:
            raise BodyError("`stiffness` requires `mass`, kg, for the natural frequencies")
        if len(stiffness) != 3:
            raise BodyError("`stiffness` requires three numbers, kx,ky,kz in N/m per corner; found {count}", count=len(stiffness))
        kx, ky, kz = stiffness
        return SpringBlock(width, width if depth is None else depth, height, mass, (kx, ky, kz), zeta)
    if frequency_vertical is None:
        raise BodyError("spring stiffness required: give `frequency_vertical` in Hz, or `mass` and `stiffness` kx,ky,kz in N/m")
    return SpringBlock.from_frequency(
        width,
        width if depth is None else depth,
        height,
        frequency_vertical=frequency_vertical,
        beta=PAPER_BETA if beta is None else beta,
        mass=REFERENCE_MASS if mass is None else mass,
        damping=zeta,
    )


SIZES, NUMBERS = ("width", "depth", "height"), ("mass", "frequency_vertical", "beta", "damping")
"""Entries of a table of kind ``springs``, beside ``stiffness``."""


def springs_from_table(table: Mapping[str, Any], **overrides: Any) -> SpringBlock:
    """Return the block on corner springs described by a TOML table.

    Parameters
    ----------
    table : mapping
        ``kind = "springs"``, with the arguments of :func:`spring_block`.
    overrides
        Arguments that replace those of the table; None: as in the table.

    Raises
    ------
    BodyError
        If an entry is missing, unknown or out of range.
    """
    check_kind(table, "springs")
    check_keys(table, ("kind", "name", "stiffness", *SIZES, *NUMBERS))
    values: dict[str, Any] = {key: get_length(table, key) for key in SIZES if key in table}
    values |= {key: get_number(table, key) for key in NUMBERS if key in table}
    if "stiffness" in table:
        values["stiffness"] = tuple(get_number({**table, "stiffness": k}, "stiffness") for k in entries(table, "stiffness", 3))
    given_values = {key: value for key, value in overrides.items() if value is not None}
    # stiffness and frequencies exclude each other
    for name, excluded in (("stiffness", ("frequency_vertical", "beta")), ("frequency_vertical", ("stiffness",)), ("beta", ("stiffness",))):
        if name in given_values:
            values = {key: value for key, value in values.items() if key not in excluded}
    return spring_block(**{**values, **given_values})


def load_springs(name: str | Path, **overrides: Any) -> SpringBlock:
    """Return the block on corner springs of a TOML file or a bundled one (``machine``).

    Parameters
    ----------
    name : str or Path
        File of kind ``springs``, see :func:`springs_from_table`.
    overrides
        Arguments of :func:`spring_block` that replace those of the file.

    Raises
    ------
    BodyError
        If there is no such body, or it is not possible.

    Examples
    --------
    >>> round(load_springs("machine").alpha, 4)
    0.8571
    """
    return springs_from_table(read_body_toml(name, kind="springs"), **overrides)

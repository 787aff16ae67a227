"""Display units: gal, kine and cm, or with ``--si`` m/s², m/s and m.

Lengths shown together have one unit: mm if all are below 1 cm, m if any reaches 10 m, else cm.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from seisblock.core.i18n import gettext
from seisblock.core.units import GAL, KINE, LENGTH_UNITS

SMALL_LIMIT = 0.00995
"""Upper limit of lengths in mm, m: larger ones round to 1 cm."""

LARGE_LIMIT = 9.995
"""Lower limit of lengths in m, m; sentences give them to 10 cm."""

SCIENTIFIC_LIMIT = 1e6
"""Lower limit of lengths in scientific notation, m."""

TEXT_DECIMALS = {"mm": 2, "cm": 1, "m": 3}
TABLE_DECIMALS = {"mm": 2, "cm": 2, "m": 4}
"""Decimals of a length by unit, in sentences and in tables."""


class Unit(NamedTuple):
    """A display unit: its size in SI and its name."""

    size: float
    name: str


def acceleration_unit(*, gal: bool) -> Unit:
    """Return the display unit of accelerations.

    Examples
    --------
    >>> acceleration_unit(gal=True), acceleration_unit(gal=False).name
    (Unit(size=0.01, name='gal'), 'm/s²')
    """
    return Unit(GAL, "gal") if gal else Unit(1.0, "m/s²")


def velocity_unit(*, gal: bool) -> Unit:
    """Return the display unit of velocities.

    Examples
    --------
    >>> velocity_unit(gal=True).name, velocity_unit(gal=False).name
    ('kine', 'm/s')
    """
    return Unit(KINE, "kine") if gal else Unit(1.0, "m/s")


def length_unit(lengths: Iterable[float | None], *, gal: bool) -> Unit:
    """Return the common display unit of lengths, m; None values are skipped.

    Examples
    --------
    >>> [length_unit(row, gal=True).name for row in ([0.215, -0.004], [0.0005, None], [], [18.0])], length_unit([0.2], gal=False).name
    (['cm', 'mm', 'cm', 'm'], 'm')
    """
    if not gal:
        return Unit(1.0, "m")
    sizes = [abs(length) for length in lengths if length is not None]
    longest = max(sizes, default=0.0)
    name = "mm" if 0.0 < longest < SMALL_LIMIT else "m" if longest >= LARGE_LIMIT else "cm"
    return Unit(LENGTH_UNITS[name], name)


def format_length(length: float, unit: Unit | None = None, *, gal: bool = True) -> str:
    """Return a length, m, with its unit, for a sentence; a zero has no sign.

    Parameters
    ----------
    length : float
    unit : Unit, optional
        Unit of the other lengths of the sentence.
    gal : bool

    Examples
    --------
    >>> format_length(0.2153), format_length(-0.0047), format_length(0.0047, length_unit([0.2], gal=True)), format_length(0.2153, gal=False)
    ('21.5 cm', '-4.70 mm', '0.5 cm', '0.215 m')
    >>> format_length(118.681), format_length(-3.9e301)
    ('118.7 m', '-3.9e+301 m')
    """
    size, name = unit or length_unit([length], gal=gal)
    if abs(length) >= SCIENTIFIC_LIMIT:
        return f"{length / size:.3g} {name}"
    decimals = TEXT_DECIMALS[name] if abs(length) < LARGE_LIMIT else 1
    return f"{round(length / size, decimals) + 0.0:.{decimals}f} {name}"


def format_size(length: float, unit: Unit | None = None, *, gal: bool = True) -> str:
    """Return the absolute value of a length, m, with its unit; "less than" the last digit for a nonzero length that rounds to zero.

    Examples
    --------
    >>> format_size(-0.0047), format_size(0.0), format_size(1e-6)
    ('4.70 mm', '0.0 cm', 'less than 0.01 mm')
    """
    unit = unit or length_unit([length], gal=gal)
    resolution = 10.0 ** -TEXT_DECIMALS[unit.name]
    if length and abs(length) < resolution * unit.size / 2:
        return gettext("less than {length}", length=f"{resolution:g} {unit.name}")
    return format_length(abs(length), unit)


def length_cell(length: float | None, unit: Unit) -> str:
    """Return a length, m, as a table cell without unit; a dash for None.

    Examples
    --------
    >>> length_cell(-0.21534, length_unit([-0.21534], gal=True)), length_cell(None, length_unit([], gal=True))
    ('-21.53', '-')
    >>> length_cell(3.9e301, length_unit([3.9e301], gal=True))
    '3.9e+301'
    """
    if length is None:
        return "-"
    if abs(length) >= SCIENTIFIC_LIMIT:
        return f"{length / unit.size:.3g}"
    decimals = TABLE_DECIMALS[unit.name]
    return f"{round(length / unit.size, decimals) + 0.0:.{decimals}f}"

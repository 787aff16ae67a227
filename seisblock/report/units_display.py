"""The units in which people see things, chosen here and nowhere else: gal, kine and cm, or with ``--si`` m/s², m/s and m.

Lengths are those that a surveyor reads off a tape: cm, mm only where all that is shown together is below 1 cm, m where some of it is
beyond 10 m.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from seisblock.core.i18n import gettext
from seisblock.core.units import GAL, KINE, LENGTH_UNITS

SMALL_LIMIT = 0.00995
"""Lengths below this are told in mm, m: what is larger would be written as 1 cm."""

LARGE_LIMIT = 9.995
"""Lengths from this on are told in m, m, and to 10 cm in a sentence."""

SCIENTIFIC_LIMIT = 1e6
"""Lengths from this on are told as a power of ten, m: nobody counts the digits of 1000 km."""

TEXT_DECIMALS = {"mm": 2, "cm": 1, "m": 3}
TABLE_DECIMALS = {"mm": 2, "cm": 2, "m": 4}
"""Decimals of a length, by its unit: in a sentence, and in a table, where one compares."""


class Unit(NamedTuple):
    """A unit: what one of it is in SI, and its name."""

    size: float
    name: str


def acceleration_unit(*, gal: bool) -> Unit:
    """Return the unit in which accelerations are shown.

    Examples
    --------
    >>> acceleration_unit(gal=True), acceleration_unit(gal=False).name
    (Unit(size=0.01, name='gal'), 'm/s²')
    """
    return Unit(GAL, "gal") if gal else Unit(1.0, "m/s²")


def velocity_unit(*, gal: bool) -> Unit:
    """Return the unit in which velocities are shown.

    Examples
    --------
    >>> velocity_unit(gal=True).name, velocity_unit(gal=False).name
    ('kine', 'm/s')
    """
    return Unit(KINE, "kine") if gal else Unit(1.0, "m/s")


def length_unit(lengths: Iterable[float | None], *, gal: bool) -> Unit:
    """Return the one unit in which some displacements, m, are shown together; None among them is none.

    Examples
    --------
    >>> [length_unit(each, gal=True).name for each in ([0.215, -0.004], [0.0005, None], [], [18.0])], length_unit([0.2], gal=False).name
    (['cm', 'mm', 'cm', 'm'], 'm')
    """
    if not gal:
        return Unit(1.0, "m")
    sizes = [abs(length) for length in lengths if length is not None]
    longest = max(sizes, default=0.0)
    name = "mm" if 0.0 < longest < SMALL_LIMIT else "m" if longest >= LARGE_LIMIT else "cm"
    return Unit(LENGTH_UNITS[name], name)


def format_length(length: float, unit: Unit | None = None, *, gal: bool = True) -> str:
    """Return a length, m, with its unit, as a sentence holds it; what rounds to nothing has no sign.

    Parameters
    ----------
    length : float
    unit : Unit, optional
        That of the other lengths of the sentence.
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
    """Return how large a length is, m, with its unit; what is written as nothing and is something is less than the least that is written.

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
    """Return a length, m, as the cell of a table under a heading that names the unit; a dash for none.

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

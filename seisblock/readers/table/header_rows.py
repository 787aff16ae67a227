"""Names of columns that the first line of a table does not tell whole: units in a line of their own, a first column without a name."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from seisblock.readers._header import parse_number
from seisblock.readers.table.headers import is_clock_unit, is_unit, split_unit
from seisblock.readers.table.timestamps import parse_timestamp

TIME_HEADING = "time (s)"
"""What a first column without a name is called that climbs."""

NO_UNIT_MARKS = ("-", "--", "―", "なし")
"""What stands in a line of units where a column has none."""

INSPECTED_LINES = 50
"""Lines that show what a column without a name is."""


def merge_unit_row(names: Sequence[str], cells: Sequence[str]) -> tuple[str, ...] | None:
    """Return names with the units that stand in the line below them, or None where that is no line of units.

    Examples
    --------
    >>> merge_unit_row(["time", "NS", "UD"], ["s", "(gal)", "(gal)"])
    ('time (s)', 'NS (gal)', 'UD (gal)')
    >>> merge_unit_row(["No", "NS"], ["-", "gal"]), merge_unit_row(["time", "NS"], ["0.00", "1.5"]) is None
    (('No', 'NS (gal)'), True)
    """
    units = [cell.strip().strip("()[]（）").strip() for cell in cells]
    units = ["" if unit in NO_UNIT_MARKS else unit for unit in units]
    while len(units) > len(names) and not units[-1]:
        units.pop()
    if len(units) != len(names) or not any(units) or not all(is_unit(unit) or is_clock_unit(unit) for unit in units if unit):
        return None
    return tuple(name if not unit or split_unit(name)[1] == unit else f"{name} ({unit})" for name, unit in zip(names, units, strict=True))


def guess_first_name(lines: Sequence[str], separator: str | None) -> str:
    """Return what a first column without a name is: ``index`` where whole numbers go up by one, the time where it climbs, else nothing.

    Parameters
    ----------
    lines : sequence of str
        The first lines of the table.
    separator : str or None
    """
    cells = [line.split(separator)[0].strip().strip('"') for line in lines if line.strip()]
    if cells and all(parse_timestamp(cell) for cell in cells):
        return "time"
    values = [parse_number(cell) for cell in cells]
    steps = [b - a for a, b in pairwise(values) if a is not None and b is not None]
    if not steps or len(steps) + 1 != len(values):
        return ""
    if all(cell.isdecimal() for cell in cells):
        return "index" if set(steps) == {1.0} else ""
    return TIME_HEADING if min(steps) > 0.0 and max(steps) < 1.0 else ""

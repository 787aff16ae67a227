"""Incomplete header rows: units in a separate line, first column without a name."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from seisblock.readers._header import parse_number
from seisblock.readers.table.headers import is_clock_unit, is_unit, split_unit
from seisblock.readers.table.timestamps import parse_timestamp

TIME_HEADING = "time (s)"
"""Name given to an unnamed first column of evenly increasing values."""

NO_UNIT_MARKS = ("-", "--", "―", "なし")
"""Cells of a unit line for columns without a unit."""

INSPECTED_LINES = 50
"""Number of lines inspected to guess the meaning of a column."""


def merge_unit_row(names: Sequence[str], cells: Sequence[str]) -> tuple[str, ...] | None:
    """Return names with the units of the line below, or None if that is not a unit line.

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
    """Return the name of an unnamed first column: ``index``, time, or empty.

    Parameters
    ----------
    lines : sequence of str
        First lines of the table.
    separator : str or None
    """
    cells = [line.split(separator)[0].strip().strip('"') for line in lines if line.strip()]
    if cells and all(parse_timestamp(cell) for cell in cells):
        return "time"
    values = [parse_number(cell) for cell in cells]
    # whole numbers in steps of one are line numbers, other steps below 1 are times in s
    steps = [b - a for a, b in pairwise(values) if a is not None and b is not None]
    if not steps or len(steps) + 1 != len(values):
        return ""
    if all(cell.isdecimal() for cell in cells):
        return "index" if set(steps) == {1.0} else ""
    return TIME_HEADING if min(steps) > 0.0 and max(steps) < 1.0 else ""

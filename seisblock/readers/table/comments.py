"""What the comments above a plain table say of it, held against the table: how many samples, how far apart, in which unit."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from seisblock.core.i18n import lazy_gettext
from seisblock.readers._header import parse_number
from seisblock.readers.table.columns import Column
from seisblock.readers.table.headers import TIME, normalize_unit
from seisblock.records import QCFlag

_NUMBER = r"\s*[=:]\s*([\d.]++(?:e[-+]?\d++)?+)"
_COUNT = re.compile(r"\b(?:npts|(?:number|no\.?) of (?:samples|points))" + _NUMBER, re.IGNORECASE)
_INTERVAL = re.compile(r"\b(?:dt|(?:sampling|time) (?:interval|step))(?:\s*\(s\))?" + _NUMBER + r"(?!\s*ms)", re.IGNORECASE)
_RATE = re.compile(r"\b(?:fs|(?:sampling|sample) (?:rate|frequency))(?:\s*\(Hz\))?" + _NUMBER + r"(?!\s*kHz)", re.IGNORECASE)
_UNIT = re.compile(r"\bunits?\s*[=:]\s*([^\s,;]+)", re.IGNORECASE)
_INTERVAL_TOLERANCE = 1e-3
"""How far, relatively, an interval may lie from the one that a comment tells: comments are rounded."""


def flag_comment_mismatch(comments: Sequence[str], columns: Sequence[Column], samples: int, dt: float) -> tuple[QCFlag, ...]:
    """Return what comments say that the table does not bear out.

    Parameters
    ----------
    comments : sequence of str
        The lines above the numbers.
    columns : sequence of Column
        Those that are read.
    samples : int
    dt : float, s
    """
    text = "\n".join(line for line in comments if line.lstrip("\ufeff ").startswith("#"))
    return (*_flag_count(text, samples), *_flag_interval(text, dt), *_flag_unit(text, columns))


def _flag_count(text: str, samples: int) -> Iterator[QCFlag]:
    """Yield a doubt for each number of samples that is another."""
    for count in _COUNT.findall(text):
        if parse_number(count) not in (None, samples):
            yield QCFlag(
                "count", lazy_gettext("{promised} samples stated in a comment, file contains {count}", promised=count, count=samples)
            )


def _flag_interval(text: str, dt: float) -> Iterator[QCFlag]:
    """Yield a doubt for each sampling interval or rate that is another."""
    for pattern, actual, unit in ((_INTERVAL, dt, "s"), (_RATE, 1.0 / dt, "Hz")):
        for value_text in pattern.findall(text):
            value = parse_number(value_text)
            if value is not None and abs(value - actual) > _INTERVAL_TOLERANCE * actual:
                yield QCFlag(
                    "clock",
                    lazy_gettext(
                        "{told} {unit} in a comment differs from the sampling interval, {dt:g} s", told=value_text, unit=unit, dt=dt
                    ),
                )


def _flag_unit(text: str, columns: Sequence[Column]) -> Iterator[QCFlag]:
    """Yield a doubt for each unit of acceleration that no column is in."""
    units = {column.unit for column in columns if column.code != TIME}
    for unit_text in _UNIT.findall(text):
        unit = normalize_unit(unit_text.rstrip(".)"))
        if unit is not None and unit not in units:
            text = lazy_gettext("unit {told} in a comment differs from the unit of the columns, {units}", told=unit, units=sorted(units))
            yield QCFlag("header", text)

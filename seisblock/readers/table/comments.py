"""Check of a plain table against its comments: number of samples, sampling interval, unit."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from seisblock.readers._header import parse_number, qc_flag
from seisblock.readers.table.columns import Column
from seisblock.readers.table.headers import TIME, normalize_unit
from seisblock.records import QCFlag

_NUMBER = r"\s*[=:]\s*([\d.]++(?:e[-+]?\d++)?+)"
_COUNT = re.compile(r"\b(?:npts|(?:number|no\.?) of (?:samples|points))" + _NUMBER, re.IGNORECASE)
_INTERVAL = re.compile(r"\b(?:dt|(?:sampling|time) (?:interval|step))(?:\s*\(s\))?" + _NUMBER + r"(?!\s*ms)", re.IGNORECASE)
_RATE = re.compile(r"\b(?:fs|(?:sampling|sample) (?:rate|frequency))(?:\s*\(Hz\))?" + _NUMBER + r"(?!\s*kHz)", re.IGNORECASE)
_UNIT = re.compile(r"\bunits?\s*[=:]\s*([^\s,;]+)", re.IGNORECASE)
_INTERVAL_TOLERANCE = 1e-3
"""Relative tolerance of an interval against a comment, which is rounded."""


def flag_comment_mismatch(comments: Sequence[str], columns: Sequence[Column], samples: int, dt: float) -> tuple[QCFlag, ...]:
    """Return flags for comments that contradict the table.

    Parameters
    ----------
    comments : sequence of str
        Lines above the numbers.
    columns : sequence of Column
        Columns read.
    samples : int
    dt : float, s
    """
    text = "\n".join(line for line in comments if line.lstrip("\ufeff ").startswith("#"))
    return (*_flag_count(text, samples), *_flag_interval(text, dt), *_flag_unit(text, columns))


def _flag_count(text: str, samples: int) -> Iterator[QCFlag]:
    for count in _COUNT.findall(text):
        if parse_number(count) not in (None, samples):
            yield qc_flag("{promised} samples stated in a comment, file contains {count}", "count", promised=count, count=samples)


def _flag_interval(text: str, dt: float) -> Iterator[QCFlag]:
    for pattern, actual, unit in ((_INTERVAL, dt, "s"), (_RATE, 1.0 / dt, "Hz")):
        for value_text in pattern.findall(text):
            value = parse_number(value_text)
            if value is not None and abs(value - actual) > _INTERVAL_TOLERANCE * actual:
                yield qc_flag(
                    "{told} {unit} in a comment differs from the sampling interval, {dt:g} s", "clock", told=value_text, unit=unit, dt=dt
                )


def _flag_unit(text: str, columns: Sequence[Column]) -> Iterator[QCFlag]:
    units = {column.unit for column in columns if column.code != TIME}
    for unit_text in _UNIT.findall(text):
        unit = normalize_unit(unit_text.rstrip(".)"))
        if unit is not None and unit not in units:
            yield qc_flag(
                "unit {told} in a comment differs from the unit of the columns, {units}", "header", told=unit, units=sorted(units)
            )

"""What the comments above a plain table say of it, held against the table: how many samples, how far apart, in which unit."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from seisblock.readers.columns import Column
from seisblock.readers.header import number
from seisblock.readers.naming import TIME, normal_unit
from seisblock.records import Doubt
from seisblock.words import said

_FIGURE = r"\s*[=:]\s*([\d.]++(?:e[-+]?\d++)?+)"
_COUNT = re.compile(r"\b(?:npts|(?:number|no\.?) of (?:samples|points))" + _FIGURE, re.IGNORECASE)
_INTERVAL = re.compile(r"\b(?:dt|(?:sampling|time) (?:interval|step))(?:\s*\(s\))?" + _FIGURE + r"(?!\s*ms)", re.IGNORECASE)
_RATE = re.compile(r"\b(?:fs|(?:sampling|sample) (?:rate|frequency))(?:\s*\(Hz\))?" + _FIGURE + r"(?!\s*kHz)", re.IGNORECASE)
_UNIT = re.compile(r"\bunits?\s*[=:]\s*([^\s,;]+)", re.IGNORECASE)
_SLACK = 1e-3
"""How far, relatively, an interval may lie from the one that a comment tells: comments are rounded."""


def doubts_of_comments(comments: Sequence[str], columns: Sequence[Column], samples: int, dt: float) -> tuple[Doubt, ...]:
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
    return (*_of_count(text, samples), *_of_interval(text, dt), *_of_unit(text, columns))


def _of_count(text: str, samples: int) -> Iterator[Doubt]:
    """Yield a doubt for each number of samples that is another."""
    for count in _COUNT.findall(text):
        if number(count) not in (None, samples):
            yield Doubt("count", said("a comment promises {promised} samples, the file holds {count}", promised=count, count=samples))


def _of_interval(text: str, dt: float) -> Iterator[Doubt]:
    """Yield a doubt for each sampling interval or rate that is another."""
    for pattern, found, unit in ((_INTERVAL, dt, "s"), (_RATE, 1.0 / dt, "Hz")):
        for told in pattern.findall(text):
            value = number(told)
            if value is not None and abs(value - found) > _SLACK * found:
                yield Doubt("clock", said("a comment says {told} {unit}, the samples are {dt:g} s apart", told=told, unit=unit, dt=dt))


def _of_unit(text: str, columns: Sequence[Column]) -> Iterator[Doubt]:
    """Yield a doubt for each unit of acceleration that no column is in."""
    units = {column.unit for column in columns if column.code != TIME}
    for told in _UNIT.findall(text):
        unit = normal_unit(told.rstrip(".)"))
        if unit is not None and unit not in units:
            text = said("a comment says that the unit is {told}, the columns are in {units}", told=unit, units=sorted(units))
            yield Doubt("header", text)

"""The one line above a figure: which record this is, when, which directions, and what was done to it."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from seisblock.present.figures.fonts import has_letters
from seisblock.records import Motion, Record
from seisblock.records.site import site_of, told_time
from seisblock.words import listed, plain_text, tell

BETWEEN = "   "

LONG_NUMBER = re.compile(r"\d+\.\d{4,}")
"""A number of more digits than a title has room for."""


def heading(record: Record | None, directions: Sequence[str] = ()) -> str:
    """Return the line: station, local time, components or azimuths, and what was done to the samples, if anything was.

    Parameters
    ----------
    record : Record or None
    directions : sequence of str
    """
    if record is None:
        return listed(map(_direction, dict.fromkeys(directions)))
    site = site_of(record)
    name = next((name for name in (site.label, site.code, record.source) if name and has_letters(name)), tell("record"))
    parts = (name, told_time(record, record.start), listed(map(_direction, dict.fromkeys(directions))), "; ".join(_brief(record.history)))
    return BETWEEN.join(plain_text(part) for part in parts if part)


def heading_of(motions: Sequence[Motion]) -> str:
    """Return the line of the motions of one record."""
    return heading(motions[0].record, [motion.name for motion in motions])


def _direction(name: str) -> str:
    """Return a component's code, or an azimuth as such."""
    try:
        float(name)
    except ValueError:
        return name
    return f"{name}°"


def _brief(history: Iterable[str]) -> Iterable[str]:
    """Yield what was done without its particulars, which stand in brackets or behind a colon."""
    for did in history:
        told = tell(did)
        for opening in (" (", "（", ": ", "："):
            told = told.split(opening)[0]
        yield LONG_NUMBER.sub(lambda number: f"{float(number[0]):.4g}", told)

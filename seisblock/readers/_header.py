"""Header values: optional numbers and times in JST."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta
from math import isfinite

JST = timedelta(hours=9)
"""Japan Standard Time ahead of UTC."""

MAX_COUNT = 2.0**53
"""Largest sample count or raw value accepted; beyond it float64 does not represent all integers."""


def parse_number(text: str) -> float | None:
    """Return a finite number, or None if the text is not one."""
    try:
        value = float(text)
    except ValueError:
        return None
    return value if isfinite(value) else None


def parse_jst(text: str) -> datetime | None:
    """Return the UTC time of ``yyyy/mm/dd HH:MM:SS[.ff]`` JST, or None if the text is not a time."""
    for form in ("%Y/%m/%d %H:%M:%S.%f", "%Y/%m/%d %H:%M:%S"):
        try:
            return datetime.strptime(text.strip(), form).replace(tzinfo=UTC) - JST
        except ValueError:
            continue
    return None

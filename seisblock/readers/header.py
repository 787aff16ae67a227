"""Small words that headers are made of: numbers that may be missing, times in Japan."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta

JST = timedelta(hours=9)
"""Japan Standard Time ahead of UTC."""


def number(text: str) -> float | None:
    """Return a number, or None when the text is none."""
    try:
        return float(text)
    except ValueError:
        return None


def time_in_japan(text: str) -> datetime | None:
    """Return the UTC time of ``yyyy/mm/dd HH:MM:SS[.ff]`` JST, or None when the text is no time."""
    for form in ("%Y/%m/%d %H:%M:%S.%f", "%Y/%m/%d %H:%M:%S"):
        try:
            return datetime.strptime(text.strip(), form).replace(tzinfo=UTC) - JST
        except ValueError:
            continue
    return None

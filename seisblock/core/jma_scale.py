"""JMA seismic intensities in every usual spelling: 5-, 5弱, 震度6強, 6 upper, 5.8."""

from __future__ import annotations

import re
import unicodedata

from seisblock.core.errors import ParameterError

HALF_CLASS = 0.25
"""Distance of the middle of a half class (5-, 5+, 6-, 6+) from the whole number."""

MIN_TARGET, MAX_TARGET = 0.0, 8.0
"""Range of intensities of a scaled record; the largest intensity observed so far is 6.8."""

_SIGNS = {
    **dict.fromkeys(("-", "弱", "lower", "low", "minus", "l"), -HALF_CLASS),
    **dict.fromkeys(("+", "強", "upper", "high", "plus", "u"), HALF_CLASS),
}
_HALVES = ("5", "6")
"""Classes with a lower and an upper half."""

_PATTERN = re.compile(r"(?:震度|jma|intensity|i=)?\s*(?P<before>[a-z]*)\s*(?P<number>\d+(?:\.\d+)?)\s*(?P<after>[-+弱強]|[a-z]*)")


def parse_jma_intensity(text: str | float) -> float:
    """Return the instrumental intensity that a text means; a half class stands for its middle.

    Parameters
    ----------
    text : str or float
        ``5-``, ``5+``, ``6-``, ``6+``, ``5弱``, ``震度6強``, ``6 upper``, or a number. 6+ (6.0 to below 6.5) is 6.25, 5- is 4.75. A
        whole number is that intensity, so that 7 is 7.0.

    Raises
    ------
    ParameterError
        If the text is no intensity, or lies outside 0 to 8.

    Examples
    --------
    >>> [parse_jma_intensity(text) for text in ("5-", "5強", "震度６弱", "6 upper", "7", "5.8")]
    [4.75, 5.25, 5.75, 6.25, 7.0, 5.8]
    """
    plain = unicodedata.normalize("NFKC", str(text)).strip().lower().replace("−", "-").replace("–", "-")
    match = _PATTERN.fullmatch(plain) if len(plain) <= 40 else None
    words = [] if match is None else [word for word in (match["before"], match["after"]) if word]
    number = "" if match is None else match["number"]
    if match is None or len(words) > 1 or (words and (number not in _HALVES or words[0] not in _SIGNS)):
        raise ParameterError(
            "{text!r} is not a JMA intensity; expected 5-, 5+, 6-, 6+, 7 (or 5弱, 6強) or a number such as 5.8", text=str(text)[:40]
        )
    value = float(number) + (_SIGNS[words[0]] if words else 0.0)
    if not MIN_TARGET <= value <= MAX_TARGET:
        raise ParameterError(
            "the JMA intensity must lie between {low:g} and {high:g}, found {value:g}", low=MIN_TARGET, high=MAX_TARGET, value=value
        )
    return value

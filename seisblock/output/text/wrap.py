"""Line wrapping for Latin text and full-width Japanese characters."""

from __future__ import annotations

import re
from itertools import pairwise

_WIDE = r"\u1100-\u115f\u2e80-\u303e\u3041-\u3247\u3250-\ua4cf\uac00-\ud7a3\uf900-\ufaff\ufe30-\ufe6f\uff00-\uff60\uffe0-\uffe6"
"""Characters two columns wide."""

_CLOSING_PUNCTUATION = "、。，．）」』］：；！？ー・々ぁぃぅぇぉゃゅょっァィゥェォャュョッ"
"""Characters that may not begin a line."""

_UNITS = rf"(?:%|mm|cm|km|m|s|Hz|gal|kine|g|kg|N|J|rad|deg)(?![\w/])(?:[^\s{_WIDE}]*)"
"""Unit that stays with the preceding number, with following punctuation."""

_NUMBER = rf"[(+±-]*\d[\d.,]*\ {_UNITS}"

_ATOM = re.compile(rf"\s*[（「『［]*(?:{_NUMBER}|[^\s{_WIDE}]+|[{_WIDE}])[{_CLOSING_PUNCTUATION}]*|\s+")
"""Unbreakable piece: a word, a number with unit, or a wide character, with adjacent punctuation."""

_WIDE_LETTER = re.compile(rf"[{_WIDE}]")


def is_wide(text: str) -> bool:
    """Return whether a text contains characters two columns wide."""
    return _WIDE_LETTER.search(text) is not None


def has_quantity(text: str) -> bool:
    """Return whether a text contains a number with a unit, which should stay together."""
    return re.search(_NUMBER, text) is not None


def fits(text: str, width: int) -> bool:
    """Return whether every unbreakable piece of a text fits into `width` columns."""
    return max((display_width(atom[0].strip()) for atom in _ATOM.finditer(text)), default=0) <= width


def display_width(text: str) -> int:
    """Return the number of terminal columns of a text."""
    return len(text) + len(_WIDE_LETTER.findall(text))


def break_positions(text: str, width: int) -> list[int]:
    """Return the positions of line breaks such that no line exceeds `width` columns.

    Parameters
    ----------
    text : str
        Without line ends.
    width : int
        Columns; a word that is longer stays whole.
    """
    positions: list[int] = []
    start = end = 0
    for atom in _ATOM.finditer(text):
        so_far = text[start : atom.end()].rstrip()
        # leading blanks of continuation lines are dropped and do not count
        if end > start and display_width(so_far.lstrip() if positions else so_far) > width:
            start = end
            positions.append(start)
        end = atom.end()
    return positions


def wrap_text(text: str, width: int) -> list[str]:
    """Return the lines of a text wrapped to `width` columns."""
    ends = [0, *break_positions(text, width), len(text)]
    return [text[first:last].strip() for first, last in pairwise(ends)]

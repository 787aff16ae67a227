"""Where a line may end: between words, and between the wide letters of Japanese, which take two columns of a terminal."""

from __future__ import annotations

import re
from itertools import pairwise

_WIDE = r"\u1100-\u115f\u2e80-\u303e\u3041-\u3247\u3250-\ua4cf\uac00-\ud7a3\uf900-\ufaff\ufe30-\ufe6f\uff00-\uff60\uffe0-\uffe6"
"""Letters that take two columns."""

_CLOSING = "、。，．）」』］：；！？ー・々ぁぃぅぇぉゃゅょっァィゥェォャュョッ"
"""Marks that may not begin a line."""

_ATOM = re.compile(rf"\s*[（「『［]*(?:[^\s{_WIDE}]+|[{_WIDE}])[{_CLOSING}]*|\s+")
"""What is not broken: a word, or a wide letter, with the marks that belong to it."""

_MARKS = re.compile(rf"[{_WIDE}]")


def is_wide(text: str) -> bool:
    """Whether a text holds letters that take two columns."""
    return _MARKS.search(text) is not None


def columns(text: str) -> int:
    """Return how many columns of a terminal a text takes."""
    return len(text) + len(_MARKS.findall(text))


def breaks(text: str, width: int) -> list[int]:
    """Return where a text is broken, as positions in it, so that no line takes more columns than `width`.

    Parameters
    ----------
    text : str
        Without line ends.
    width : int
        Columns; a word that is longer stays whole.
    """
    found: list[int] = []
    start = end = 0
    for atom in _ATOM.finditer(text):
        if end > start and columns(text[start : atom.end()].rstrip()) > width:
            start = end
            found.append(start)
        end = atom.end()
    return found


def wrapped(text: str, width: int) -> list[str]:
    """Return a text in lines of at most so many columns."""
    ends = [0, *breaks(text, width), len(text)]
    return [text[first:last].strip() for first, last in pairwise(ends)]

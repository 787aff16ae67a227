"""Texts that a spreadsheet would compute: names from files go into tables as texts, whatever they begin with."""

from __future__ import annotations

import re

_FORMULA = re.compile(r"'*(?:[=@\t\r]|[+-].*[(|!])")
"""What a spreadsheet takes for a formula; of those that begin with a sign, the ones that could call or reach for anything."""

AS_TEXT = "'"
"""What a spreadsheet takes for the sign of a text."""


def guarded(cell: object) -> object:
    """Return a cell that no spreadsheet computes; :func:`unguarded` gives it back as it was.

    Examples
    --------
    >>> guarded("=1+1"), guarded("-x"), guarded(-0.5)
    ("'=1+1", '-x', -0.5)
    """
    return AS_TEXT + cell if isinstance(cell, str) and _FORMULA.match(cell) else cell


def unguarded(text: str) -> str:
    """Return the text that a guarded cell holds.

    Examples
    --------
    >>> unguarded("'=1+1"), unguarded("'tis")
    ('=1+1', "'tis")
    """
    return text[1:] if text.startswith(AS_TEXT) and _FORMULA.match(text) else text

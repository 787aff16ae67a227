"""Texts that a spreadsheet would compute: names from files go into tables as texts, whatever they begin with."""

from __future__ import annotations

import re

_FORMULA = re.compile(r"'*(?:[=@\t\r]|[+-].*[(|!])")
"""What a spreadsheet takes for a formula; of those that begin with a sign, the ones that could call or reach for anything."""

ESCAPE = "'"
"""What a spreadsheet takes for the sign of a text."""


def escape_formula(cell: object) -> object:
    """Return a cell that no spreadsheet computes; :func:`unescape_formula` gives it back as it was.

    Examples
    --------
    >>> escape_formula("=1+1"), escape_formula("-x"), escape_formula(-0.5)
    ("'=1+1", '-x', -0.5)
    """
    return ESCAPE + cell if isinstance(cell, str) and _FORMULA.match(cell) else cell


def unescape_formula(text: str) -> str:
    """Return the text that a guarded cell holds.

    Examples
    --------
    >>> unescape_formula("'=1+1"), unescape_formula("'tis")
    ('=1+1', "'tis")
    """
    return text[1:] if text.startswith(ESCAPE) and _FORMULA.match(text) else text

"""Protection against CSV formula injection."""

from __future__ import annotations

import re

_FORMULA = re.compile(r"'*(?:[=@\t\r]|[+-].*[(|!])")
"""Cells that a spreadsheet evaluates; of those that begin with a sign, only the ones that could call a function or reference data."""

ESCAPE = "'"
"""Prefix that marks a cell as text."""


def escape_formula(cell: object) -> object:
    """Return a cell that spreadsheets do not evaluate; :func:`unescape_formula` is the inverse.

    Examples
    --------
    >>> escape_formula("=1+1"), escape_formula("-x"), escape_formula(-0.5)
    ("'=1+1", '-x', -0.5)
    """
    return ESCAPE + cell if isinstance(cell, str) and _FORMULA.match(cell) else cell


def unescape_formula(text: str) -> str:
    """Return the original text of an escaped cell.

    Examples
    --------
    >>> unescape_formula("'=1+1"), unescape_formula("'tis")
    ('=1+1', "'tis")
    """
    return text[1:] if text.startswith(ESCAPE) and _FORMULA.match(text) else text

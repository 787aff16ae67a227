"""Unique ASCII identifiers for body names: letters, digits and underscores, a letter first."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable


def ascii_identifiers(names: Iterable[str], *, prefix: str = "body") -> dict[str, str]:
    """Return a unique ASCII identifier for each name; names without ASCII letters are numbered.

    Parameters
    ----------
    names : iterable of str
    prefix : str
        Prefix of identifiers that would not begin with a letter.

    Examples
    --------
    >>> ascii_identifiers(["bookcase, 2 shelves", "墓石"])
    {'bookcase, 2 shelves': 'bookcase_2_shelves', '墓石': 'body_2'}
    """
    identifiers: dict[str, str] = {}
    for number, name in enumerate(names, start=1):
        ascii_only = unicodedata.normalize("NFKD", name).encode("ascii", "ignore").decode()
        identifier = re.sub(r"[^A-Za-z0-9]+", "_", ascii_only).strip("_")
        identifier = identifier if identifier[:1].isalpha() else f"{prefix}_{identifier or number}"
        identifiers[name] = identifier if identifier not in identifiers.values() else f"{identifier}_{number}"
    return identifiers

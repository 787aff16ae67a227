"""Names that other programs take: letters, digits and underlines, each once, a letter first."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable


def plain_names(names: Iterable[str], *, otherwise: str = "body") -> dict[str, str]:
    """Return names by which other programs can call some bodies; what has no such letters is numbered.

    Parameters
    ----------
    names : iterable of str
    otherwise : str
        Begins the names of those.

    Examples
    --------
    >>> plain_names(["bookcase, 2 shelves", "墓石"])
    {'bookcase, 2 shelves': 'bookcase_2_shelves', '墓石': 'body_2'}
    """
    found: dict[str, str] = {}
    for number, name in enumerate(names, start=1):
        ascii_only = unicodedata.normalize("NFKD", name).encode("ascii", "ignore").decode()
        plain = re.sub(r"[^A-Za-z0-9]+", "_", ascii_only).strip("_")
        plain = plain if plain[:1].isalpha() else f"{otherwise}_{plain or number}"
        found[name] = plain if plain not in found.values() else f"{plain}_{number}"
    return found

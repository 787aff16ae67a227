"""What somebody meant who wrote a name that is not there: the nearest of those that are."""

from __future__ import annotations

from collections.abc import Iterable

from seisblock.words import Said, tell

ALIKE = 0.6
"""Least likeness, of 1, at which a name is taken for another one misspelt."""

LISTS = ("known", "codes", "names")
"""Fields of a message that list the names there are."""

GIVEN = ("name", "code", "pair")
"""Fields that hold the one that is not."""


def nearest(name: str, known: Iterable[str]) -> str | None:
    """Return the name that is most like one that is not there, whatever its case; None where none is."""
    from difflib import get_close_matches

    there = {each.lower(): each for each in reversed(list(known))}
    found = get_close_matches(name.lower(), there, 1, ALIKE)
    return there[found[0]] if found else None


def suggested(told: str, said: str) -> str:
    """Return a message as it is told, and after it the name that was meant, where it lists the names there are and one of them is like.

    Parameters
    ----------
    told : str
        In the language spoken.
    said : str
        The same, with the values it was said with.
    """
    if not isinstance(said, Said):
        return told
    known = next((said.values[key] for key in LISTS if key in said.values), ())
    name = next((said.values[key] for key in GIVEN if key in said.values), "")
    return asking(told, nearest(str(name), map(str, known)) if isinstance(known, list | tuple) else None)


def asking(told: str, name: str | None) -> str:
    """Return a message that asks whether a name was meant, where there is one."""
    return tell("{message}; did you mean {name}?", message=told.rstrip("。."), name=name) if name else told

"""Figures and tables of the five papers: one module per paper, each with a `PAPER` that lists its items."""

from __future__ import annotations

import importlib

from seisblock.core.errors import ParameterError
from seisblock.paper.item import Answer, Inputs, Item, Paper

MODULES = ("sugimoto", "tsutsui", "furukawa", "fujino", "okumura")
"""Modules of this package that export PAPER."""


def papers() -> tuple[Paper, ...]:
    """Return the papers with their items."""
    return tuple(importlib.import_module(f"{__name__}.{name}").PAPER for name in MODULES)


def find_paper(key: str) -> Paper:
    """Return the paper whose citation key begins with a name, case-insensitive.

    Raises
    ------
    ParameterError
        If there is none, or more than one.
    """
    matches = [paper for paper in papers() if key and paper.key.lower().startswith(key.lower())]
    if len(matches) != 1:
        keys = [paper.key.lower() for paper in papers()]
        raise ParameterError("no paper {name!r}; available: {known}", name=key, known=keys)
    return matches[0]


def find_item(paper: Paper, name: str) -> Item:
    """Return an item of a paper by its name: ``fig7``, ``fig. 7``, ``table 1``.

    Raises
    ------
    ParameterError
        If there is none.
    """
    item_name = "".join(name.lower().replace("figure", "fig").replace(".", "").split())
    for item in paper.items:
        if item.name == item_name:
            return item
    raise ParameterError(
        "{paper} has no item {name!r}; available: {known}", paper=paper.key, name=name, known=[item.name for item in paper.items]
    )


__all__ = ["MODULES", "Answer", "Inputs", "Item", "Paper", "find_item", "find_paper", "papers"]

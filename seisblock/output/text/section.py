"""Section of a model in the HTML report: title and texts."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from seisblock.core.i18n import Message
from seisblock.core.results import Response

SEVERE = 2.0
"""Severity of overturning and of a jump."""


@dataclass(frozen=True, kw_only=True)
class Section:
    """Section of a model in the HTML report.

    Parameters
    ----------
    title : str
    severity : callable
        ``severity(outcome) -> float``: 0 no motion, below :data:`SEVERE` motion, from there on overturning or a jump.
    verdict : callable
        ``verdict(response) -> str``: the result in a few words.
    sentences : callable
        ``sentences(response)`` yields the result in full, without the direction, then its sensitivity.
    onset : str
        Sentence on the ``factor`` on the record at which the motion begins.
    has_figure : bool
        False for a model that the figure of the full response covers.
    """

    title: str | Message
    severity: Callable[[Any], float]
    verdict: Callable[[Response[Any]], str]
    sentences: Callable[[Response[Any]], Iterator[str]]
    onset: str = ""
    has_figure: bool = True

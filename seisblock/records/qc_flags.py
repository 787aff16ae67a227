"""What a careful reader notices about a record before he believes it: values that travel with the record to every answer."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

FLAG_KINDS = {
    "header": "the header contradicts the samples, or cannot be read where it would judge them",
    "count": "the number of samples is not the one that the file states or implies",
    "clock": "the times in the file are not those of an even clock",
    "cut": "the end of the file looks cut",
    "line": "a line is empty where each stands for a sample",
    "point": "a number lacks the decimal point that all others of its column have",
    "spike": "a sample stands apart from its neighbours",
    "jump": "a step between two samples stands apart from those around it",
    "held": "a value is held in the midst of shaking, as where a gap was filled",
    "clipped": "the peaks are flat, as of an instrument at the end of its range",
    "offset": "the mean is a large part of the peak",
    "size": "the peak is larger than has hardly ever been recorded",
    "directions": "the horizontal components are not at right angles, or stand without a vertical one",
    "calibration": "a factor in the file was not applied",
}
"""The kinds of doubt, and what each means."""

RESOLVED_BY_DEMEAN = {"offset"}
"""Kinds of doubt that a removed mean or a high-pass settles."""


@dataclass(frozen=True)
class QCFlag:
    """One thing about a record that is not as it should be.

    Parameters
    ----------
    kind : str
        One of ``KINDS``.
    message : str
        What was expected and what was found, a sentence that can be told in any language.
    component : str
        Which component it is about; empty for the whole record.
    """

    kind: str
    message: str
    component: str = ""


def drop_resolved(flags: Iterable[QCFlag]) -> tuple[QCFlag, ...]:
    """Return the doubts that remain after the mean was removed."""
    return tuple(flag for flag in flags if flag.kind not in RESOLVED_BY_DEMEAN)

"""Quality-control flags of a record."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from seisblock.core._display import DisplayMixin

FLAG_KINDS = {
    "header": "header contradicts the samples, or its check value is unreadable",
    "count": "number of samples differs from the one stated or implied by the file",
    "clock": "times in the file are not evenly spaced",
    "cut": "end of the file is probably missing",
    "line": "empty line in a file with one sample per line",
    "point": "a number lacks the decimal point that all others of its column have",
    "spike": "isolated outlier sample",
    "jump": "isolated step between two samples",
    "repetition": "samples repeat earlier ones exactly",
    "sign": "minus signs are lost",
    "held": "constant value during shaking, as in a filled gap",
    "clipped": "flat peaks, as of a saturated instrument",
    "offset": "mean is a large part of the peak",
    "size": "peak larger than almost any recorded",
    "directions": "horizontal components not perpendicular, identical, or without a vertical component",
    "calibration": "calibration factor in the file not applied",
}
"""Kinds of quality flag and their meaning."""

RESOLVED_BY_DEMEAN = {"offset"}
"""Kinds of flag resolved by removing the mean or by a high-pass."""


@dataclass(frozen=True, repr=False)
class QCFlag(DisplayMixin):
    """Quality flag of a record.

    Parameters
    ----------
    kind : str
        Key of ``FLAG_KINDS``.
    message : str
        Finding as a translatable sentence.
    component : str
        Code of the component concerned; empty for the whole record.
    """

    kind: str
    message: str
    component: str = ""


def drop_resolved(flags: Iterable[QCFlag]) -> tuple[QCFlag, ...]:
    """Return the flags that remain after the mean was removed."""
    return tuple(flag for flag in flags if flag.kind not in RESOLVED_BY_DEMEAN)

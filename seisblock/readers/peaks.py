"""The peak that a header tells, held against the samples: the one test of a whole file that the file itself brings."""

from __future__ import annotations

import numpy as np

from seisblock.readers.header import number
from seisblock.records import Doubt
from seisblock.typing import FloatArray
from seisblock.words import said


def half_unit(text: str) -> float:
    """Return half a unit of the last digit of a printed number.

    Examples
    --------
    >>> half_unit("-267.957"), half_unit(".079"), half_unit("104")
    (0.0005, 0.0005, 0.5)
    """
    return 0.5 * 10.0 ** -len(text.strip().partition(".")[2])


def doubts_of_peak(code: str, told: str, values: FloatArray, unit: str, slack: float) -> tuple[Doubt, ...]:
    """Return a doubt where the largest sample is not the peak that the header tells.

    Parameters
    ----------
    code : str
        Of the component.
    told : str
        The peak as the header prints it, with its sign.
    values : (n,) array
        The samples, in the unit of the header.
    unit : str
        Its name.
    slack : float
        How far the two may lie apart, in this unit: the digits that both are printed to.
    """
    peak = number(told)
    if peak is None:
        text = said("{component}: the header's peak is no number ({text!r}): the samples cannot be checked", component=code, text=told[:20])
        return (Doubt("header", text, code),)
    extremes = np.array([values.max(), values.min()])
    largest = extremes[np.abs(extremes) >= np.abs(extremes).max() - slack]
    if (np.abs(largest - peak) <= slack * (1.0 + 1e-6)).any():
        return ()
    text = said(
        "{component}: the header says that the peak is {told:g} {unit}, the samples reach {peak:g} {unit}",
        component=code,
        told=peak,
        unit=unit,
        peak=float(largest[0]),
    )
    return (Doubt("header", text, code),)

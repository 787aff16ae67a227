"""The peak that a header tells, held against the samples: the one test of a whole file that the file itself brings."""

from __future__ import annotations

import numpy as np

from seisblock.core.i18n import lazy_gettext
from seisblock.core.typing import FloatArray
from seisblock.readers._header import parse_number
from seisblock.records import QCFlag


def half_last_digit(text: str) -> float:
    """Return half a unit of the last digit of a printed number.

    Examples
    --------
    >>> half_last_digit("-267.957"), half_last_digit(".079"), half_last_digit("104")
    (0.0005, 0.0005, 0.5)
    """
    return 0.5 * 10.0 ** -len(text.strip().partition(".")[2])


def flag_peak_mismatch(code: str, peak_text: str, values: FloatArray, unit: str, slack: float) -> tuple[QCFlag, ...]:
    """Return a doubt where the largest sample is not the peak that the header tells.

    Parameters
    ----------
    code : str
        Of the component.
    peak_text : str
        The peak as the header prints it, with its sign.
    values : (n,) array
        The samples, in the unit of the header.
    unit : str
        Its name.
    slack : float
        How far the two may lie apart, in this unit: the digits that both are printed to.
    """
    peak = parse_number(peak_text)
    if peak is None:
        text = lazy_gettext(
            "{component}: header peak {text!r} is not a number; peak of the samples not checked", component=code, text=peak_text[:20]
        )
        return (QCFlag("header", text, code),)
    extremes = np.array([values.max(), values.min()])
    largest = extremes[np.abs(extremes) >= np.abs(extremes).max() - slack]
    if (np.abs(largest - peak) <= slack * (1.0 + 1e-6)).any():
        return ()
    text = lazy_gettext(
        "{component}: header peak {told:g} {unit} differs from the peak of the samples, {peak:g} {unit}",
        component=code,
        told=peak,
        unit=unit,
        peak=float(largest[0]),
    )
    return (QCFlag("header", text, code),)

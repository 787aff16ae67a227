"""Check of the samples against the peak stated in the header."""

from __future__ import annotations

import numpy as np

from seisblock.core.i18n import lazy_gettext
from seisblock.core.typing import FloatArray
from seisblock.readers._header import parse_number
from seisblock.records import QCFlag


def half_last_digit(text: str) -> float:
    """Return half a unit of the last printed digit of a number.

    Examples
    --------
    >>> half_last_digit("-267.957"), half_last_digit(".079"), half_last_digit("104")
    (0.0005, 0.0005, 0.5)
    """
    return 0.5 * 10.0 ** -len(text.strip().partition(".")[2])


def flag_peak_mismatch(code: str, peak_text: str, values: FloatArray, unit: str, slack: float) -> tuple[QCFlag, ...]:
    """Return a flag if the largest sample differs from the header peak.

    Parameters
    ----------
    code : str
        Component code.
    peak_text : str
        Peak as printed in the header, with sign.
    values : (n,) array
        Samples in the unit of the header.
    unit : str
        Name of the unit.
    slack : float
        Tolerance in this unit, from the printed digits of both.
    """
    peak = parse_number(peak_text)
    if peak is None:
        text = lazy_gettext(
            "{component}: header peak {text!r} is not a number; peak of the samples not checked", component=code, text=peak_text[:20]
        )
        return (QCFlag("header", text, code),)
    extremes = np.array([values.max(), values.min()])
    # both extremes when their sizes agree within the rounding: the header may state either
    largest = extremes[np.abs(extremes) >= np.abs(extremes).max() - slack]
    # 1e-6: rounding of the tolerance itself
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

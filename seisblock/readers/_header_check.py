"""Quality flags of files, and checks of the samples against the header."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from seisblock.core.i18n import lazy_gettext
from seisblock.core.typing import FloatArray
from seisblock.readers._header import parse_number
from seisblock.records import QCFlag


def qc_flag(message: str, kind: str, component: str = "", /, **values: object) -> QCFlag:
    """Return a quality flag with a translatable message, the template first."""
    return QCFlag(kind, lazy_gettext(message, **({"component": component} if component else {}), **values), component)


def half_last_digit(text: str) -> float:
    """Return half a unit of the last printed digit of a number.

    Examples
    --------
    >>> half_last_digit("-267.957"), half_last_digit(".079"), half_last_digit("104")
    (0.0005, 0.0005, 0.5)
    """
    return 0.5 * 10.0 ** -len(text.strip().partition(".")[2])


def flag_peak_mismatch(
    code: str, peak_text: str, values: FloatArray, unit: str, slack: float, *, signed: bool = True, about_mean: bool = False
) -> tuple[QCFlag, ...]:
    """Return a flag if the largest sample differs from the header peak.

    `peak_text` is the peak as printed; `values`, (n,), and `slack`, the tolerance from the printed digits of both, are in `unit`. Without
    `signed` the sign of the peak is not checked; with `about_mean` the peak may be that about the mean of the samples.
    """
    peak = parse_number(peak_text)
    if peak is None:
        message = "{component}: header peak {text!r} is not a number; peak of the samples not checked"
        return (qc_flag(message, "header", code, text=peak_text[:20]),)
    extremes = np.array([values.max(), values.min()])
    for mean in (0.0, float(values.mean())) if about_mean else (0.0,):
        # both extremes when their sizes agree within the rounding: the header may state either
        largest = extremes[np.abs(extremes - mean) >= np.abs(extremes - mean).max() - slack] - mean
        differences = np.abs(largest - peak) if signed else np.abs(np.abs(largest) - abs(peak))
        # 1e-6: rounding of the tolerance itself
        if (differences <= slack * (1.0 + 1e-6)).any():
            return ()
    peak_of_samples = extremes[np.abs(extremes).argmax()]
    message = "{component}: header peak {stated:g} {unit} differs from the peak of the samples, {peak:g} {unit}"
    return (qc_flag(message, "header", code, stated=peak, unit=unit, peak=float(peak_of_samples)),)


def flag_count(promised: int, count: int) -> tuple[QCFlag, ...]:
    """Return a flag if the number of samples differs from the one in the header."""
    if promised == count:
        return ()
    return (qc_flag("header states {promised} samples, file contains {count}", "count", promised=promised, count=count),)


def flag_duration(text: str, count: int, dt: float, slack: float | None = None, *, counts: Sequence[int] = ()) -> tuple[QCFlag, ...]:
    """Return a flag if the duration printed in the header, s, differs from that of `count` samples at intervals of `dt`, s.

    `slack`, s, is by default 1.5 intervals and half the last printed digit: the duration may count samples or intervals. `counts` are the
    numbers of intervals that the duration may state (default: `count`).
    """
    seconds = parse_number(text)
    slack = 1.5 * dt + half_last_digit(text) if slack is None else slack
    if seconds is not None and any(abs(seconds - intervals * dt) <= slack for intervals in counts or (count,)):
        return ()
    message = "header duration {text} s differs from the duration of {count} samples, {seconds:g} s"
    return (qc_flag(message, "count", text=text[:20] or "-", count=count, seconds=count * dt),)

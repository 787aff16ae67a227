"""What [Furukawa2009]_ prints on its criterion and on rates, cell by cell.

Table 3 rests on four records that may not be passed on: only what it says about itself is checked. The survey at Aoyama is not
printed; the bundled file was rebuilt from table 6, so that its estimated rates show consistency, not evidence.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import cache, partial

import numpy as np

from seisblock.bodies.cemetery.cemetery import Cemetery
from seisblock.bodies.cemetery.table import read_cemetery
from seisblock.core.units import GAL
from seisblock.criteria.gravestones import (
    BORDERLINE_TOLERANCE,
    DOWELLED,
    PLAIN,
    GravestoneFit,
    overturning_level,
    overturning_ratio,
    predict,
)
from seisblock.studies.survey.overturning_rate import overturning_rate
from seisblock.validation.case import Case, expected_difference
from seisblock.validation.furukawa_surveys import SURVEYS, SurveyedRate

GRAVITY_GAL = 980.0
"""The paper's g."""

RATIO = 2.6
"""H/B of the stone on the shaking table ([Furukawa2009]_ table 5)."""

LEVELS = ("6-lower", "6-upper", "7")

# table 4: direction -> PGA (gal), PGV (kine), printed f (Hz) at each level
TABLE_4 = {
    "x": ((553, 894, 1170), (39, 65, 92), (2.3, 2.2, 2.2)),
    "y": ((484, 818, 1049), (38, 63, 86), (2.0, 2.0, 1.9)),
    "z": ((279, 468, 733), (12, 19, 28), (3.7, 3.9, 4.2)),
}

STANDS, ON_LINE, FALLS = 0.0, 1.0, 2.0
CODE = {"stands": STANDS, "on the line": ON_LINE, "overturns": FALLS}
CODES = "0 stands, 1 on the line, 2 overturns"

# table 5(a), (b): direction -> verdicts without a dowel, with one
TABLE_5 = {
    "x": ((STANDS, FALLS, FALLS), (STANDS, STANDS, FALLS)),
    "y": ((ON_LINE, FALLS, FALLS), (STANDS, ON_LINE, FALLS)),
}

TABLE_5C = ((STANDS, FALLS, FALLS), (STANDS, STANDS, FALLS))
"""What happened on the shaking table ([Furukawa2009]_ table 5(c)): rows without a dowel and with one."""

# table 3: record -> PGA/(2 pi PGV), Fourier, pulse width, Hz
TABLE_3 = {"Kobe": (1.55, 1.48, 1.32), "Tokachi": (4.40, 4.84, 4.55), "Chuetsu": (1.93, 0.46, 1.56), "Fukuoka": (1.73, 0.93, 1.39)}

ONE_DIGIT = "p = 1162.9 gal as printed; both verdicts on the dowelled stone at 6-upper need 1342 to 1409 gal, 1362.9 would do (one digit)"

ROUNDED_SHARE = 0.0250001
"""Rates are printed to 0.05 above 0.1."""


@cache
def aoyama() -> Cemetery:
    """Return the rebuilt survey of Aoyama."""
    return read_cemetery("aoyama.csv")


def _criterion() -> Iterator[Case]:
    """Yield the cases on (8) to (10) and section 3(4)."""
    yield Case(
        "furukawa-8-p", "[Furukawa2009]_ eq. (8), text", "p of the fit, printed without a unit as 8.268", "m/s^2", 8.268, 1e-9,
        lambda: float(overturning_level(0.0)), note="826.8 gal in (9): the text's 8.268 is in m/s^2",
    )  # fmt: skip
    yield Case(
        "furukawa-10-q", "[Furukawa2009]_ eq. (10), text", "largest relative change of a(f) up to 3 Hz, q = 1.85 of the text for 1.84", "1",
        0.0, 1e-3, _largest_change, status="differs", kind="print", today=expected_difference(0.0109051303), note="the text says q = 1.85, the formula 1.84; the formula stands here",
    )  # fmt: skip
    yield Case(
        "furukawa-static", "[Furukawa2009]_ section 3(4)a", "curves of 0.5, 1 and 1.5 Hz that lie below the static one, g/PGA", "1", 3.0,
        0.0, lambda: float(sum(100.0 * float(overturning_level(f)) < GRAVITY_GAL for f in (0.5, 1.0, 1.5))),
    )  # fmt: skip
    yield Case(
        "furukawa-table-3-choice", "[Furukawa2009]_ table 3, section 3(5)e", "records but Tokachi whose PGA/(2 pi PGV) is nearest 2 Hz", "1",
        3.0, 0.0, _nearest, kind="print", note="from the printed frequencies; the records themselves may not be passed on",
    )  # fmt: skip
    yield Case(
        "furukawa-table-3-tokachi", "[Furukawa2009]_ section 3(5)e", "mean of Tokachi's three frequencies, 'about 4.5 Hz'", "Hz", 4.5, 0.11,
        lambda: float(np.mean(TABLE_3["Tokachi"])), kind="print", note="from the printed frequencies",
    )  # fmt: skip


def _largest_change() -> float:
    """Return how far (10) moves when q is the text's."""
    f = np.linspace(0.0, 3.0, 3001)
    text = overturning_level(f, GravestoneFit(DOWELLED.p_m_s2, 1.85, DOWELLED.r))
    return float(np.abs(text / overturning_level(f, DOWELLED) - 1.0).max())


def _nearest() -> float:
    """Return for how many records method 1 is the nearest to 2 Hz."""
    return float(sum(int(np.argmin(np.abs(np.subtract(f, 2.0)))) == 0 for name, f in TABLE_3.items() if name != "Tokachi"))


def _table_4() -> Iterator[Case]:
    """Yield the equivalent frequencies of the shaking table, each from the PGA and PGV printed beside it."""
    for direction, (peaks, speeds, printed) in TABLE_4.items():
        for level, pga, pgv, f in zip(LEVELS, peaks, speeds, printed, strict=True):
            computed = pga / (2.0 * math.pi * pgv)
            rounding = 0.05 + computed * (0.5 / pga + 0.5 / pgv)
            differs = (direction, level) == ("x", "7")
            is_borderline = (direction, level) == ("y", "6-upper")
            yield Case(
                f"furukawa-table-4c-{direction}-{level}", "[Furukawa2009]_ table 4(c)",
                f"PGA/(2 pi PGV), direction {direction}, intensity {level}", "Hz", f, rounding, partial(float, computed),
                status="differs" if differs else "holds", kind="print", today=expected_difference(2.0240356893) if differs else None,
                note="tables 4(a) and (b) give 2.02, printed 2.2" if differs
                else "2.07, printed 2.0: reached only at the far end of the rounding of 818 gal and 63 kine" if is_borderline
                else "tolerance: the rounding of the printed peaks and of the frequency",
            )  # fmt: skip


def _table_5() -> Iterator[Case]:
    """Yield the verdicts on the shaking-table stone with the printed frequencies, and what p the two other cells need."""
    for direction, rows in TABLE_5.items():
        peaks, _, frequencies = TABLE_4[direction]
        for name, fit, row in (("plain", PLAIN, rows[0]), ("dowelled", DOWELLED, rows[1])):
            for level, pga, f, expected in zip(LEVELS, peaks, frequencies, row, strict=True):
                differs = (name, level) == ("dowelled", "6-upper")
                yield Case(
                    f"furukawa-table-5-{direction}-{name}-{level}", f"[Furukawa2009]_ table 5({'a' if direction == 'x' else 'b'})",
                    f"{name} stone of H/B 2.6, direction {direction}, intensity {level} ({CODES})", "1", expected, 0.0,
                    partial(_verdict, pga, f, fit), status="differs" if differs else "holds", note=ONE_DIGIT if differs else "",
                    today=(FALLS, 0.0) if differs else None,
                )  # fmt: skip
    for name, fit, row in (("plain", PLAIN, TABLE_5C[0]), ("dowelled", GravestoneFit(13.629, 1.84, 4.5), TABLE_5C[1])):
        for level, pga, f, expected in zip(LEVELS, TABLE_4["x"][0], TABLE_4["x"][2], row, strict=True):
            yield Case(
                f"furukawa-table-5c-{name}-{level}", "[Furukawa2009]_ table 5(c)",
                f"{name} stone on the shaking table at {level}, judged in direction x ({CODES})", "1", expected, 0.0,
                partial(_verdict, pga, f, fit), note="dowelled: with p = 1362.9 gal" if name == "dowelled" else "",
                kind="rebuilt" if name == "dowelled" else "computed",
            )  # fmt: skip
    for key, direction, threshold, expected in (
        ("least", "x", RATIO + BORDERLINE_TOLERANCE, 1341.9), ("most", "y", RATIO + BORDERLINE_TOLERANCE, 1409.1),
    ):  # fmt: skip
        yield Case(
            f"furukawa-table-5-p-{key}", "[Furukawa2009]_ table 5", f"{key} p of (10) for the printed verdicts on the dowelled stone, 6-upper",
            "gal", expected, 0.5, partial(_needed_p, direction, threshold), kind="derived", note="the print has 1162.9",
        )  # fmt: skip


def _verdict(pga_gal: float, frequency: float, fit: GravestoneFit) -> float:
    """Return the code of the verdict on the shaking-table stone."""
    return CODE[predict(RATIO, float(overturning_ratio(pga_gal * GAL, frequency, fit)))]


def _needed_p(direction: str, threshold: float) -> float:
    """Return the p, gal, at which (10) has a threshold in a direction at 6-upper."""
    pga, f = TABLE_4[direction][0][1], TABLE_4[direction][2][1]
    return threshold * pga * DOWELLED.p_m_s2 / float(overturning_level(f, DOWELLED))


def _table_6() -> Iterator[Case]:
    """Yield the frequencies of table 6, its estimated rates from the rebuilt survey, and the scatter of the surveyed rates."""
    for survey in SURVEYS:
        rounding = 0.005 + survey.frequency * (0.5 / survey.pga_gal + 0.5 / survey.pgv_kine)
        yield Case(
            f"furukawa-table-6-f-{survey.name}", "[Furukawa2009]_ table 6", f"equivalent frequency at {survey.name}", "Hz",
            survey.printed_frequency_hz, rounding, partial(getattr, survey, "frequency"), kind="print", note="the scan's row, repaired by PGA/(2 pi PGV)",
        )  # fmt: skip
        estimates = (("plain", survey.estimate, False), ("dowelled", survey.estimate_reinforced, True))
        for name, estimate, reinforced in estimates:
            if estimate is not None:
                tolerance = ROUNDED_SHARE if estimate >= 0.1 else 0.0050001
                yield Case(
                    f"furukawa-table-6-{name}-{survey.name}", "[Furukawa2009]_ table 6", f"estimated rate at {survey.name}, {name} stones",
                    "1", estimate, tolerance, partial(_rate, survey, reinforced), kind="rebuilt", note="aoyama.csv was rebuilt to give this",
                )  # fmt: skip
    for name, printed, reinforced, today in (("plain", 0.05, False, 0.10), ("dowelled", 0.0, True, 0.04)):
        yield Case(
            f"furukawa-table-6-{name}-Sakaiminato", "[Furukawa2009]_ table 6", f"estimated rate at Sakaiminato, {name} stones", "1", printed,
            0.005, partial(_rate, SURVEYS[-1], reinforced), status="differs", kind="rebuilt", today=expected_difference(today),
            note="0.05 and 0 contradict the other rows: less than at Yonago, where the threshold H/B is "
            + ("3.61 against 3.88 here" if not reinforced else "5.28 against 5.46 here"),
        )  # fmt: skip
    yield Case(
        "furukawa-table-6-scatter", "[Furukawa2009]_ table 6", "rms of ln PGA that the curve needs for the surveyed rate over the recorded one",
        "1", 0.3, 0.1, scatter, kind="rebuilt", note="the model uncertainty of the inverse; 0.23 without Hino, whose rate is near saturation",
    )  # fmt: skip


def _rate(survey: SurveyedRate, reinforced: bool) -> float:
    """Return the rate that the rebuilt survey of Aoyama gives at a station."""
    return overturning_rate(aoyama().with_dowels() if reinforced else aoyama(), survey.pga, survey.frequency).rate


def scatter(surveys: tuple[SurveyedRate, ...] = SURVEYS) -> float:
    """Return how far the surveyed rates lie from the curves, as an rms of ln PGA."""
    residuals = [math.log(float(overturning_level(s.frequency)) / _quantile(s.rate) / s.pga) for s in surveys]
    return math.sqrt(sum(r * r for r in residuals) / len(residuals))


def _quantile(rate: float) -> float:
    """Return the H/B that a share of the stones of Aoyama exceeds."""
    return float(np.quantile(aoyama().ratios, 1.0 - rate))


CASES = (*_criterion(), *_table_4(), *_table_5(), *_table_6())
"""Every case of this paper on the criterion and on rates."""

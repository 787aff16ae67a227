"""Validation against [Furukawa2009]_: overturning criterion, equivalent frequencies, shaking table and surveyed overturning rates.

Table 3 is based on four records that cannot be redistributed: only its printed values are checked. The survey at Aoyama is not printed;
the bundled file was reconstructed from table 6, so its estimated rates show consistency, not evidence.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache, partial

import numpy as np

from seisblock.bodies.cemetery.cemetery import Cemetery
from seisblock.bodies.cemetery.table import read_cemetery
from seisblock.core.i18n import N_
from seisblock.core.typing import FloatArray
from seisblock.core.units import GAL, KINE
from seisblock.criteria.gravestones import (
    BORDERLINE_TOLERANCE,
    DOWELLED,
    PLAIN,
    GravestoneFit,
    overturning_level,
    overturning_ratio,
    predict,
)
from seisblock.criteria.overturning import housner_acceleration_as_printed
from seisblock.studies.survey.overturning_rate import overturning_rate
from seisblock.validation.case import Case, expected_difference


@dataclass(frozen=True)
class SurveyedRate:
    """One row of table 6; digits lost in the scan follow from f = PGA/(2 pi PGV).

    Parameters
    ----------
    name : str
    pga_gal, pgv_kine, printed_frequency_hz : float
        As printed; fig. 18 repeats the frequency.
    rate : float
        Surveyed around the station.
    estimate, estimate_reinforced : float or None
        Read by the authors from figs. 16 and 17; None if illegible in the scan.
    """

    name: str
    pga_gal: float
    pgv_kine: float
    printed_frequency_hz: float
    rate: float
    estimate: float | None
    estimate_reinforced: float | None

    @property
    def pga(self) -> float:
        """Peak ground acceleration, m/s^2."""
        return self.pga_gal * GAL

    @property
    def frequency(self) -> float:
        """Equivalent frequency PGA/(2 pi PGV), Hz ([Furukawa2009]_ section 3(5)e)."""
        return self.pga_gal * GAL / (2.0 * math.pi * self.pgv_kine * KINE)


SURVEYS = (
    SurveyedRate(N_("Hakuta"), 720, 36, 3.18, 0.05, 0.10, 0.02),
    SurveyedRate(N_("Kofu"), 725, 42, 2.75, 0.30, 0.35, 0.08),
    SurveyedRate(N_("Yonago"), 280, 27, 1.65, 0.07, 0.10, 0.04),
    SurveyedRate(N_("Nichinan"), 629, 36, 2.78, 0.40, 0.20, 0.05),
    SurveyedRate(N_("Hino"), 927, 113, 1.31, 0.90, 1.0, None),
    SurveyedRate(N_("Sakaiminato"), 213, 90, 0.38, 0.36, None, None),
)
"""Rows of table 6 in printed order. The estimates of the last row, 0.05 and 0, contradict the other rows and are omitted."""


GRAVITY_GAL = 980.0
"""Gravity in the paper, gal."""

RATIO = 2.6
"""H/B of the stone on the shaking table ([Furukawa2009]_ table 5)."""

LEVELS = (N_("6-lower"), N_("6-upper"), "7")

# table 4: direction -> PGA (gal), PGV (kine), printed f (Hz) at each level
TABLE_4 = {
    "x": ((553, 894, 1170), (39, 65, 92), (2.3, 2.2, 2.2)),
    "y": ((484, 818, 1049), (38, 63, 86), (2.0, 2.0, 1.9)),
    "z": ((279, 468, 733), (12, 19, 28), (3.7, 3.9, 4.2)),
}

STABLE, BORDERLINE, OVERTURNS = 0.0, 1.0, 2.0
CODE = {"stands": STABLE, "on the line": BORDERLINE, "overturns": OVERTURNS}
CODES = "0 stable, 1 borderline, 2 overturns"

# table 5(a), (b): direction -> verdicts without a dowel, with one
TABLE_5 = {
    "x": ((STABLE, OVERTURNS, OVERTURNS), (STABLE, STABLE, OVERTURNS)),
    "y": ((BORDERLINE, OVERTURNS, OVERTURNS), (STABLE, BORDERLINE, OVERTURNS)),
}

TABLE_5C = ((STABLE, OVERTURNS, OVERTURNS), (STABLE, STABLE, OVERTURNS))
"""Observed results on the shaking table ([Furukawa2009]_ table 5(c)): rows without and with a dowel."""

# table 3: record -> PGA/(2 pi PGV), Fourier, pulse width, Hz
TABLE_3 = {
    N_("Kobe"): (1.55, 1.48, 1.32),
    N_("Tokachi"): (4.40, 4.84, 4.55),
    N_("Chuetsu"): (1.93, 0.46, 1.56),
    N_("Fukuoka"): (1.73, 0.93, 1.39),
}

ONE_DIGIT = "probable misprint in p: 1162.9 gal as printed, but both verdicts on the dowelled stone at 6-upper require 1342 to 1409 gal; 1362.9 fits"

ROUNDED_SHARE = 0.0250001
"""Rounding of rates above 0.1, printed in steps of 0.05."""


@cache
def aoyama() -> Cemetery:
    """Return the reconstructed survey of Aoyama."""
    return read_cemetery("aoyama.csv")


def _criterion() -> Iterator[Case]:
    """Yield the cases on eqs. (8) to (10) and section 3(4)."""
    yield Case(
        "furukawa-8-p", "[Furukawa2009]_ eq. (8), text", "p of the fit, printed as 8.268 without a unit", "m/s^2", 8.268, 1e-9,
        lambda: float(overturning_level(0.0)), note="826.8 gal in eq. (9): 8.268 in the text is in m/s^2",
    )  # fmt: skip
    yield Case(
        "furukawa-10-q", "[Furukawa2009]_ eq. (10), text", "largest relative change of a(f) up to 3 Hz, q = 1.85 (text) for 1.84 (eq.)", "1",
        0.0, 1e-3, _largest_change, status="differs", kind="print", today=expected_difference(0.0109051303), note="inconsistent print: q = 1.85 in the text, 1.84 in the equation; the program uses the equation",
    )  # fmt: skip
    yield Case(
        "furukawa-static", "[Furukawa2009]_ section 3(4)a", "number of curves of 0.5, 1 and 1.5 Hz below the static one, g/PGA", "1", 3.0,
        0.0, lambda: float(sum(100.0 * float(overturning_level(f)) < GRAVITY_GAL for f in (0.5, 1.0, 1.5))),
    )  # fmt: skip
    yield Case(
        "furukawa-fig8", "[Furukawa2009]_ fig. 8", "number of frequencies (of six) with Housner's criterion above eq. (9), H/B 2.6", "1", 6.0, 0.0,
        lambda: float(np.count_nonzero(_housner_ratios() > 1.0)), note="eq. (6) as printed, width 242 mm",
    )  # fmt: skip
    yield Case(
        "furukawa-fig8-growth", "[Furukawa2009]_ fig. 8", "number of steps of frequency (of five) over which the two move apart, H/B 2.6", "1", 5.0,
        0.0, lambda: float(np.count_nonzero(np.diff(_housner_ratios()) > 0.0)), status="differs", today=expected_difference(2.0),
        note="their ratio is largest at 1.5 Hz, 1.72, and 1.15 at 3 Hz: eq. (9) rises with the power 2.3 of the frequency, eq. (6) linearly",
    )  # fmt: skip
    yield Case(
        "furukawa-table-3-choice", "[Furukawa2009]_ table 3, section 3(5)e", "records except Tokachi for which PGA/(2 pi PGV) is closest to 2 Hz", "1",
        3.0, 0.0, _nearest, kind="print", note="from the printed frequencies; the records cannot be redistributed",
    )  # fmt: skip
    yield Case(
        "furukawa-table-3-tokachi", "[Furukawa2009]_ section 3(5)e", "mean of the three frequencies of Tokachi, printed as about 4.5 Hz", "Hz", 4.5, 0.11,
        lambda: float(np.mean(TABLE_3["Tokachi"])), kind="print", note="from the printed frequencies",
    )  # fmt: skip


def _housner_ratios() -> FloatArray:
    """Return eq. (6) as printed over eq. (9) at 0.5 to 3 Hz, (6,), sao of 242 mm and H/B 2.6."""
    width, frequencies = 0.242, (0.5, 1.0, 1.5, 2.0, 2.5, 3.0)
    return np.array(
        [housner_acceleration_as_printed(width, RATIO * width, f, GRAVITY_GAL * GAL) * RATIO / overturning_level(f) for f in frequencies]
    )


def _largest_change() -> float:
    """Return the largest relative change of eq. (10) with the value of q in the text."""
    f = np.linspace(0.0, 3.0, 3001)
    text = overturning_level(f, GravestoneFit(DOWELLED.p_m_s2, 1.85, DOWELLED.r))
    return float(np.abs(text / overturning_level(f, DOWELLED) - 1.0).max())


def _nearest() -> float:
    """Return the number of records for which method 1 is the closest to 2 Hz."""
    return float(sum(int(np.argmin(np.abs(np.subtract(f, 2.0)))) == 0 for name, f in TABLE_3.items() if name != "Tokachi"))


def _table_4() -> Iterator[Case]:
    """Yield the equivalent frequencies of the shaking table, from the PGA and PGV printed beside them."""
    for direction, (peaks, speeds, printed_frequencies) in TABLE_4.items():
        for level, pga, pgv, f in zip(LEVELS, peaks, speeds, printed_frequencies, strict=True):
            frequency = pga / (2.0 * math.pi * pgv)
            rounding = 0.05 + frequency * (0.5 / pga + 0.5 / pgv)
            differs = (direction, level) == ("x", "7")
            is_borderline = (direction, level) == ("y", "6-upper")
            yield Case(
                f"furukawa-table-4c-{direction}-{level}", "[Furukawa2009]_ table 4(c)",
                f"PGA/(2 pi PGV), direction {direction}, intensity {level}", "Hz", f, rounding, partial(float, frequency),
                status="differs" if differs else "holds", kind="print", today=expected_difference(2.0240356893) if differs else None,
                note="inconsistent print: tables 4(a) and (b) give 2.02, printed 2.2" if differs
                else "2.07, printed 2.0: possible only at the limit of the rounding of 818 gal and 63 kine" if is_borderline
                else "tolerance: rounding of the printed peaks and of the frequency",
            )  # fmt: skip


def _table_5() -> Iterator[Case]:
    """Yield the verdicts on the shaking-table stone with the printed frequencies, and the p required by the two other cells."""
    for direction, rows in TABLE_5.items():
        peaks, _, frequencies = TABLE_4[direction]
        for name, fit, row in (("plain", PLAIN, rows[0]), ("dowelled", DOWELLED, rows[1])):
            for level, pga, f, expected in zip(LEVELS, peaks, frequencies, row, strict=True):
                differs = (name, level) == ("dowelled", "6-upper")
                yield Case(
                    f"furukawa-table-5-{direction}-{name}-{level}", f"[Furukawa2009]_ table 5({'a' if direction == 'x' else 'b'})",
                    f"{name} stone of H/B 2.6, direction {direction}, intensity {level} ({CODES})", "1", expected, 0.0,
                    partial(_verdict, pga, f, fit), status="differs" if differs else "holds", note=ONE_DIGIT if differs else "",
                    today=(OVERTURNS, 0.0) if differs else None,
                )  # fmt: skip
    for name, fit, row in (("plain", PLAIN, TABLE_5C[0]), ("dowelled", GravestoneFit(13.629, 1.84, 4.5), TABLE_5C[1])):
        for level, pga, f, expected in zip(LEVELS, TABLE_4["x"][0], TABLE_4["x"][2], row, strict=True):
            yield Case(
                f"furukawa-table-5c-{name}-{level}", "[Furukawa2009]_ table 5(c)",
                f"{name} stone on the shaking table at {level}, evaluated in direction x ({CODES})", "1", expected, 0.0,
                partial(_verdict, pga, f, fit), note="with p = 1362.9 gal" if name == "dowelled" else "",
                kind="rebuilt" if name == "dowelled" else "computed",
            )  # fmt: skip
    for key, label, direction, threshold, expected in (
        ("least", "smallest", "x", RATIO + BORDERLINE_TOLERANCE, 1341.9), ("most", "largest", "y", RATIO + BORDERLINE_TOLERANCE, 1409.1),
    ):  # fmt: skip
        yield Case(
            f"furukawa-table-5-p-{key}", "[Furukawa2009]_ table 5", f"{label} p of eq. (10) for the printed verdicts on the dowelled stone, 6-upper",
            "gal", expected, 0.5, partial(_needed_p, direction, threshold), kind="derived", note="printed: 1162.9",
        )  # fmt: skip


def _verdict(pga_gal: float, frequency: float, fit: GravestoneFit) -> float:
    """Return the code of the verdict on the shaking-table stone."""
    return CODE[predict(RATIO, float(overturning_ratio(pga_gal * GAL, frequency, fit)))]


def _needed_p(direction: str, threshold: float) -> float:
    """Return the p, gal, at which [Furukawa2009]_ eq. (10) has a given threshold in a direction at 6-upper."""
    pga, f = TABLE_4[direction][0][1], TABLE_4[direction][2][1]
    return threshold * pga * DOWELLED.p_m_s2 / float(overturning_level(f, DOWELLED))


def _table_6() -> Iterator[Case]:
    """Yield the frequencies of table 6, its estimated rates from the reconstructed survey, and the scatter of the surveyed rates."""
    for survey in SURVEYS:
        rounding = 0.005 + survey.frequency * (0.5 / survey.pga_gal + 0.5 / survey.pgv_kine)
        yield Case(
            f"furukawa-table-6-f-{survey.name}", "[Furukawa2009]_ table 6", f"equivalent frequency at {survey.name}", "Hz",
            survey.printed_frequency_hz, rounding, partial(getattr, survey, "frequency"), kind="print", note="row of the scan, completed by PGA/(2 pi PGV)",
        )  # fmt: skip
        estimates = (("plain", survey.estimate, False), ("dowelled", survey.estimate_reinforced, True))
        for name, estimate, reinforced in estimates:
            if estimate is not None:
                tolerance = ROUNDED_SHARE if estimate >= 0.1 else 0.0050001
                yield Case(
                    f"furukawa-table-6-{name}-{survey.name}", "[Furukawa2009]_ table 6", f"estimated overturning rate at {survey.name}, {name} stones",
                    "1", estimate, tolerance, partial(_rate, survey, reinforced), kind="rebuilt", note="aoyama.csv was reconstructed to give this value",
                )  # fmt: skip
    for name, printed_rate, reinforced, today in (("plain", 0.05, False, 0.10), ("dowelled", 0.0, True, 0.04)):
        yield Case(
            f"furukawa-table-6-{name}-Sakaiminato", "[Furukawa2009]_ table 6", f"estimated overturning rate at Sakaiminato, {name} stones", "1", printed_rate,
            0.005, partial(_rate, SURVEYS[-1], reinforced), status="differs", kind="rebuilt", today=expected_difference(today),
            note=(
                "inconsistent print: 0.05 here, but 0.10 at Hakuta with nearly the same threshold H/B (3.88 and 3.85)"
                if not reinforced
                else "inconsistent print: 0 here, but 0.02 at Hakuta with a higher threshold H/B (5.46 and 5.77)"
            ),
        )  # fmt: skip
    yield Case(
        "furukawa-table-6-scatter", "[Furukawa2009]_ table 6", "rms of ln(PGA required by the curve for the surveyed rate / recorded PGA)",
        "1", 0.3, 0.1, scatter, kind="rebuilt", note="model uncertainty of the inverse analysis; 0.23 without Hino, whose rate is near saturation",
    )  # fmt: skip


def _rate(survey: SurveyedRate, reinforced: bool) -> float:
    """Return the overturning rate of the reconstructed Aoyama stones at a station."""
    return overturning_rate(aoyama().with_dowels() if reinforced else aoyama(), survey.pga, survey.frequency).rate


def scatter(surveys: tuple[SurveyedRate, ...] = SURVEYS) -> float:
    """Return the rms deviation of the surveyed rates from the curves, in ln PGA."""
    # PGA at which the curve gives the surveyed rate, over the recorded PGA
    residuals = [math.log(float(overturning_level(s.frequency)) / _quantile(s.rate) / s.pga) for s in surveys]
    return math.sqrt(sum(r * r for r in residuals) / len(residuals))


def _quantile(rate: float) -> float:
    """Return the H/B exceeded by a share of the stones of Aoyama."""
    return float(np.quantile(aoyama().ratios, 1.0 - rate))


CASES = (*_criterion(), *_table_4(), *_table_5(), *_table_6())
"""Cases of this paper on the criterion and on overturning rates."""

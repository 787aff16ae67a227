"""Table 6 of [Furukawa2009]_, corrected: shaking and overturning rates after the 2000 western Tottori earthquake."""

from __future__ import annotations

import math
from dataclasses import dataclass

from seisblock.core.units import GAL, KINE


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
    SurveyedRate("Hakuta", 720, 36, 3.18, 0.05, 0.10, 0.02),
    SurveyedRate("Kofu", 725, 42, 2.75, 0.30, 0.35, 0.08),
    SurveyedRate("Yonago", 280, 27, 1.65, 0.07, 0.10, 0.04),
    SurveyedRate("Nichinan", 629, 36, 2.78, 0.40, 0.20, 0.05),
    SurveyedRate("Hino", 927, 113, 1.31, 0.90, 1.0, None),
    SurveyedRate("Sakaiminato", 213, 90, 0.38, 0.36, None, None),
)
"""Rows of table 6 in printed order. The estimates of the last row, 0.05 and 0, contradict the other rows and are omitted."""

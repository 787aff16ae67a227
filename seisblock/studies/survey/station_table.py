"""Stations with a surveyed overturning rate, from a CSV ([Furukawa2009]_ table 6, fig. 20)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from os import PathLike
from pathlib import Path

from seisblock.core import checks
from seisblock.core.errors import BodyError
from seisblock.core.i18n import lazy_gettext
from seisblock.core.io.csv_table import normalize_heading, parse_number_cell
from seisblock.core.io.spreadsheet import read_sheet
from seisblock.core.units import GAL, KINE
from seisblock.measures.frequency import pga_pgv_frequency

COLUMNS: dict[str, tuple[str, ...]] = {
    "station": ("station", "観測点"),
    "pga": ("pga", "pgagal", "pga(gal)", "最大加速度", "最大加速度(gal)"),
    "pgv": ("pgv", "pgvkine", "pgv(kine)", "pgv(cm/s)", "最大速度", "最大速度(kine)"),
    "frequency": ("frequency", "frequencyhz", "frequency(hz)", "振動数", "等価振動数", "等価振動数(hz)"),
    "rate": ("rate", "surveyed", "surveyedrate", "転倒率"),
}
"""Column headings, without blanks and underscores, in lower case."""


@dataclass(frozen=True)
class SurveyedStation:
    """Station with the overturning rate surveyed around it.

    Parameters
    ----------
    name : str
    pga_m_s2, frequency_hz : float
        Frequency: given, or PGA/(2 pi PGV).
    rate : float, 1
    """

    name: str
    pga_m_s2: float
    frequency_hz: float
    rate: float


def read_stations(name: str | PathLike[str]) -> tuple[SurveyedStation, ...]:
    """Return the stations of a CSV with the columns ``station``, ``pga`` (gal), ``pgv`` (kine) or ``frequency`` (Hz), and ``rate``.

    A rate is a share from 0 to 1, or in per cent with the sign (``35%``).

    Raises
    ------
    BodyError
        If the file cannot be read, a column is missing, or a value is not a number within its range; the message names the line.
    """
    path = Path(name)
    if path.is_dir():
        raise BodyError("{name} is a folder: give a CSV file of stations", name=path)
    sheet = read_sheet(path, str(path))
    if len(sheet.rows) < 2:
        raise BodyError("{name}: no stations; give a header and at least one line", name=path)
    meanings = {word: key for key, words in COLUMNS.items() for word in words}
    header = [meanings.get(normalize_heading(cell), "") for cell in sheet.rows[0][1]]
    missing = [key for key in ("station", "pga", "rate") if key not in header]
    if not {"pgv", "frequency"} & set(header):
        missing.append("pgv/frequency")
    if missing:
        raise BodyError("{name}: missing columns: {missing}; expected station, pga, pgv or frequency, rate", name=path, missing=missing)

    def parse_row(cells: Mapping[str, str], line: int) -> SurveyedStation:
        pga = _positive(cells, "pga")
        frequency = (
            _positive(cells, "frequency") if cells.get("frequency") else pga_pgv_frequency(pga * GAL, _positive(cells, "pgv") * KINE)
        )
        text = cells.get("rate", "")
        rate = parse_number_cell(text.removesuffix("%").strip(), "rate") * (0.01 if text.endswith("%") else 1.0)
        if not 0.0 <= rate <= 1.0:
            raise BodyError("the rate must lie between 0 and 1, or carry a per cent sign; found {text}", text=text)
        name = cells.get("station") or lazy_gettext("{name}, line {line}", name=path, line=line)
        return SurveyedStation(name, pga * GAL, frequency or math.nan, rate)

    return tuple(sheet.parse_rows(header, sheet.rows[1:], parse_row))


def _positive(cells: Mapping[str, str], key: str) -> float:
    """Return a positive, finite number of a row."""
    return checks.positive(key, parse_number_cell(cells.get(key, ""), key), error=BodyError)

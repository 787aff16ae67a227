"""Stations with a surveyed overturning rate, from a CSV ([Furukawa2009]_ table 6, fig. 20)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from os import PathLike
from pathlib import Path

from seisblock.core.errors import BodyError
from seisblock.core.i18n import lazy_gettext
from seisblock.core.io.csv_table import normalize_heading, parse_number_cell, row_dict
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
    rows = read_sheet(path, str(path)).rows
    if len(rows) < 2:
        raise BodyError("{name}: no stations; give a header and at least one line", name=path)
    meanings = {word: key for key, words in COLUMNS.items() for word in words}
    header = [meanings.get(normalize_heading(cell), "") for cell in rows[0][1]]
    missing = [key for key in ("station", "pga", "rate") if key not in header]
    if not {"pgv", "frequency"} & set(header):
        missing.append("pgv/frequency")
    if missing:
        raise BodyError("{name}: missing columns: {missing}; expected station, pga, pgv or frequency, rate", name=path, missing=missing)
    return tuple(_station(path, number, row_dict(header, cells)) for number, cells in rows[1:])


def _station(path: Path, line: int, cells: Mapping[str, str]) -> SurveyedStation:
    """Return the station of one line."""
    place = lazy_gettext("{name}, line {line}", name=path, line=line)
    pga = _number(place, cells, "pga")
    if cells.get("frequency"):
        frequency = _number(place, cells, "frequency")
    else:
        frequency = pga_pgv_frequency(pga * GAL, _number(place, cells, "pgv") * KINE) or math.nan
    text = cells.get("rate", "")
    rate = parse_number_cell(text.removesuffix("%").strip(), lazy_gettext("{where}: rate", where=place)) * (
        0.01 if text.endswith("%") else 1.0
    )
    if not 0.0 <= rate <= 1.0:
        raise BodyError("{where}: the rate must lie between 0 and 1, or carry a per cent sign; found {text}", where=place, text=text)
    return SurveyedStation(cells.get("station") or place, pga * GAL, frequency, rate)


def _number(where: str, cells: Mapping[str, str], key: str) -> float:
    """Return a positive, finite number of a line."""
    value = parse_number_cell(cells.get(key, ""), lazy_gettext("{where}: {key}", where=where, key=key))
    if not (value > 0.0 and math.isfinite(value)):
        raise BodyError("{where}: {key} must be positive, found {value}", where=where, key=key, value=value)
    return value

"""Hazard tables: intensity levels with exceedance frequencies or probabilities."""

from __future__ import annotations

import math
import re
import unicodedata
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from seisblock.core import checks
from seisblock.core.errors import BodyError, HazardError, InputError
from seisblock.core.i18n import lazy_gettext
from seisblock.core.io.csv_table import normalize_heading, parse_number_cell, row_dict
from seisblock.core.io.spreadsheet import Row, read_sheet
from seisblock.core.units import ACCELERATION_UNITS, LENGTH_UNITS, VELOCITY_UNITS
from seisblock.samples import resolve_file_or_sample
from seisblock.studies.fragility.intensity import IntensityMeasure, intensity_measure
from seisblock.studies.hazard.curve import Hazard, HazardCurve

UNITS_OF: Mapping[str, Mapping[str, float]] = {
    "m/s^2": ACCELERATION_UNITS,
    "m/s": VELOCITY_UNITS,
    "m": LENGTH_UNITS,
    "1": {},
}
"""Accepted units of each measure and their size in the internal unit."""

_MEASURE = re.compile(
    r"(pga|pgv|pgd|arias|cav|p\*?pgv|(?:sa|rotd100|rotd50)[\s_(=:]*\d*\.?\d+\s*s?\)?)(?:[\s_]*[(\[]\s*(\S.*?)\s*[)\]]|_(\w[\w/^]*))?\s*\Z",
    re.IGNORECASE,
)
_SPECTRAL = re.compile(r"(sa|rotd100|rotd50)[^\d.]*(\d*\.?\d+)")
_RATES = frozenset(
    {"annualrate", "annualfrequency", "rate", "frequency", "lambda", "annualrateofexceedance", "年超過頻度", "年超過率", "頻度"}
)
_ANNUAL_PROBABILITIES = frozenset({"annualprobability", "annualpoe", "probability", "poe", "年超過確率"})
_IN_YEARS = re.compile(r"(?:poe|probability)(?:in)?(\d+)(?:years?|yr|y)|(\d+)年超過確率")
_BRANCH_COLUMNS = {"branch": "branch", "枝": "branch", "分枝": "branch", "weight": "weight", "重み": "weight"}

COLUMN_EXAMPLES = "pgv_m_s, pga_g, pga_gal, pgd_cm, sa(0.5)_g, rotd50(0.5)_g, arias_m_s, cav_m_s, p*pgv"
"""Level headings quoted in messages."""


class _Row(NamedTuple):
    """One level of one branch, SI and 1/year."""

    branch: str
    level: float
    rate: float
    weight: float | None


class _Columns(NamedTuple):
    """Interpretation of the columns of a table."""

    names: list[str]
    measure: IntensityMeasure
    factor: float
    years: float | None  # of a probability; None of a frequency
    notes: tuple[str, ...]


def read_hazard(path: str | Path, *, im: str | None = None) -> Hazard:
    """Return the site hazard of a CSV file, or of the bundled synthetic one by name.

    The header names a column of levels with its unit (``pgv_m_s``, ``pga (g)``, ``sa(0.5)_gal``), and one of how often each is exceeded:
    annual frequencies (``annual_rate``), annual probabilities (``annual_poe``), or probabilities in some years (``poe_50_years``,
    50年超過確率); where there are several curves, ``branch`` and ``weight``. Lines that begin with # are comments.

    Parameters
    ----------
    path : str or Path
    im : str or None
        Intensity measure, if the table contains several.

    Returns
    -------
    Hazard

    Raises
    ------
    HazardError
        If the file cannot be read, a column is missing, a unit is unknown, a number is wrong, or a curve rises or has one level.

    Examples
    --------
    >>> from seisblock.fragility import read_hazard
    >>> hazard = read_hazard("synthetic_hazard.csv")
    >>> hazard.im, hazard.unit, [branch.name for branch in hazard.branches]
    ('pgv', 'm/s', ['often', 'rare'])
    """
    try:
        rows = read_sheet(_path(path), str(path)).rows
    except BodyError as error:
        raise HazardError("{text}", text=error.message) from None
    try:
        return _hazard(rows, None if im is None else intensity_measure(im))
    except InputError as error:
        raise HazardError("{source}: {text}", source=Path(path).name, text=error.message) from None


def _path(name: str | Path) -> Path:
    """Return the path of a file or of a bundled hazard."""
    path = Path(checks.path(name))
    return resolve_file_or_sample(path, "hazard") or path


def _hazard(rows: Sequence[Row], measure: IntensityMeasure | None) -> Hazard:
    if len(rows) < 2:
        raise HazardError("the table is empty; expected a header and one line per level")
    columns = _columns(rows[0][1], measure)
    rows_by_branch: dict[str, list[_Row]] = {}
    for line, cells in rows[1:]:
        try:
            row = _row(row_dict(columns.names, cells), columns)
        except InputError as error:
            raise HazardError("line {line}: {text}", line=line, text=error.message) from None
        rows_by_branch.setdefault(row.branch, []).append(row)
    branches, notes = _branches(rows_by_branch, columns.factor)
    return Hazard(columns.measure.name, columns.measure.unit, branches, (*columns.notes, *notes), columns.factor)


def measure_of(heading: str) -> tuple[IntensityMeasure, float] | None:
    """Return the intensity measure of a heading and its unit in SI; None for other headings.

    Raises
    ------
    HazardError
        If it names a measure without its unit, or with one that is unknown.

    Examples
    --------
    >>> measure_of("sa(0.5)_g")
    (IntensityMeasure(kind='sa', period_s=0.5), 9.80665)
    """
    match = _MEASURE.match(unicodedata.normalize("NFKC", heading).strip())
    if match is None:
        return None
    name, unit = re.sub(r"\s", "", match[1]).lower(), (match[2] or match[3] or "").lower()
    spectral = _SPECTRAL.match(name)
    measure = intensity_measure(f"{spectral[1]}={spectral[2]}" if spectral else name.replace("ppgv", "p*pgv"))
    units = UNITS_OF[measure.unit]
    unit_factors = {**units, **{key.replace("/", "_").replace("^", ""): value for key, value in units.items()}} or {"": 1.0, "1": 1.0}
    if unit not in unit_factors:
        unit_names = [*units]
        if not unit:
            raise HazardError("column {heading!r} has no unit; name it for example {known}", heading=heading[:40], known=COLUMN_EXAMPLES)
        raise HazardError(
            "column {heading!r}: unknown unit {unit!r}; use one of {known}", heading=heading[:40], unit=unit, known=unit_names
        )
    return measure, unit_factors[unit]


def _columns(cells: Sequence[str], requested: IntensityMeasure | None) -> _Columns:
    """Interpret headings; a column of the requested measure is preferred to one of another definition of the same spectral ordinate."""
    available = [match[0] for match in map(measure_of, cells) if match is not None]
    expected_measure = requested
    if requested is not None and requested not in available:
        expected_measure = next((measure for measure in available if measure.is_comparable(requested)), requested)
    names, ignored, measures, other_measures, rates = [], [], {}, [], {}
    for cell in cells:
        heading_measure, key = measure_of(cell), normalize_heading(cell)
        years = _IN_YEARS.fullmatch(key)
        if heading_measure is not None and expected_measure in (None, heading_measure[0]):
            measures[cell] = heading_measure
            names.append("level")
        elif key in _RATES or key in _ANNUAL_PROBABILITIES or years:
            rates[cell] = None if key in _RATES else float(next(filter(None, years.groups()))) if years else 1.0
            names.append("rate")
        else:
            names.append(_BRANCH_COLUMNS.get(key, ""))
            other_measures += [] if heading_measure is None else [heading_measure[0].name]
            ignored += [] if names[-1] or not cell else [cell]
    if not measures and other_measures and requested is not None:
        text = "the levels are of {found}, but {im} is required; give a hazard in {im} or a fragility in {found}"
        raise HazardError(text, found=other_measures, im=requested.name)
    if len(measures) != 1:
        text = "expected one column of levels, such as {known}; found {found}"
        raise HazardError(text, known=COLUMN_EXAMPLES, found=list(measures) or list(cells))
    if len(rates) != 1:
        text = "expected one of the columns annual_rate, annual_poe, poe_50_years; found {found}"
        raise HazardError(text, found=list(rates) or list(cells))
    if names.count("branch") > 1 or names.count("weight") > 1:
        raise HazardError("duplicate columns: keep one branch and one weight")
    notes: tuple[str, ...] = (lazy_gettext("unused columns of the hazard: {columns}", columns=ignored),) if ignored else ()
    ((measure, factor),) = measures.values()
    if requested is not None and measure != requested:
        text = (
            "the fragility is in {im} and the hazard in {found}, another definition of the horizontal motion: the frequency is biased; "
            "give both in one measure"
        )
        notes += (lazy_gettext(text, im=requested.name, found=measure.name),)
    return _Columns(names, measure, factor, next(iter(rates.values())), notes)


def _row(cells: Mapping[str, str], columns: _Columns) -> _Row:
    level = checks.positive("the level", parse_number_cell(cells.get("level", ""), "level")) * columns.factor
    value = parse_number_cell(cells.get("rate", ""), "rate")
    if columns.years is None:
        rate = checks.non_negative("the annual frequency", value)
    else:
        probability = checks.fraction("the exceedance probability", value)
        rate = -math.log1p(-probability) / columns.years if probability < 1.0 else math.inf
    weight = parse_number_cell(cells["weight"], "weight") if cells.get("weight") else None
    return _Row(cells.get("branch", ""), level, rate, weight)


def _branches(rows_by_branch: Mapping[str, Sequence[_Row]], unit: float) -> tuple[tuple[HazardCurve, ...], list[str]]:
    """Return the curves of a table and the number of omitted levels."""
    curves, dropped = [], 0
    for name, rows in rows_by_branch.items():
        used_rows = sorted((row for row in rows if 0.0 < row.rate < math.inf), key=lambda row: row.level)
        dropped += len(rows) - len(used_rows)
        weights = {row.weight for row in rows if row.weight is not None}
        if len(weights) > 1:
            raise HazardError("branch {name!r} has several weights: {weights}", name=name, weights=sorted(weights))
        weight = weights.pop() if weights else 1.0 if len(rows_by_branch) == 1 else None
        if weight is None:
            raise HazardError("branch {name!r} has no weight; add a column weight with one value per branch", name=name)
        try:
            rates = [row.rate for row in used_rows]
            # errors quote levels in the unit of the table, so validate in that unit first
            HazardCurve([row.level / unit for row in used_rows], rates)
            curves.append(HazardCurve([row.level for row in used_rows], rates, name, weight))
        except InputError as error:
            raise (HazardError("branch {name!r}: {text}", name=name, text=error.message) if name else error) from None
    text = lazy_gettext("{count} levels of the hazard with an exceedance probability of 0 or 1 are omitted", count=dropped)
    return tuple(curves), [text] if dropped else []

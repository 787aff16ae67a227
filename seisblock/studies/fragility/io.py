"""Reader of fragility documents printed by ``seisblock fragility``."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import InputError, ParameterError, UnitError
from seisblock.core.i18n import lazy_gettext
from seisblock.core.io.files import read_bytes
from seisblock.core.units import parse_quantity
from seisblock.studies.fragility.intensity import intensity_measure
from seisblock.studies.fragility.lognormal import Lognormal
from seisblock.studies.hazard.curve import Hazard
from seisblock.studies.hazard.table import UNITS_OF

SCHEMA_PREFIX = "seisblock/fragility/"


@dataclass(frozen=True, repr=False)
class FragilityCurve(DisplayMixin):
    """Lognormal fragility curve with its body, limit state and intensity measure.

    Parameters
    ----------
    body, limit : str
        Empty if unknown.
    im, unit : str
        Intensity measure, and the unit of the median, SI.
    curve : Lognormal
    """

    body: str
    limit: str
    im: str
    unit: str
    curve: Lognormal


def read_fragility(path: str | Path) -> tuple[FragilityCurve, ...]:
    """Return the curves of a JSON document of ``seisblock fragility``.

    Parameters
    ----------
    path : str or Path

    Returns
    -------
    tuple of FragilityCurve
        In the order of the document.

    Raises
    ------
    ParameterError
        If the file cannot be read, is not such a document, or contains no curve.

    Examples
    --------
    >>> from seisblock.fragility import read_fragility
    >>> read_fragility("nothing.json")
    Traceback (most recent call last):
    seisblock.core.errors.ParameterError: cannot read nothing.json: No such file or directory
    """
    name, source = str(path), Path(checks.path(path))
    data = read_bytes(source, name, ParameterError)
    try:
        document = json.loads(data)
    except (ValueError, RecursionError) as error:
        raise ParameterError("{name} is not a JSON document; expected the JSON output of seisblock fragility", name=name) from error
    if not (isinstance(document, dict) and str(document.get("schema", "")).startswith(SCHEMA_PREFIX)):
        raise ParameterError("{name} is not a fragility document; expected the JSON output of seisblock fragility", name=name)
    try:
        curves = tuple(_curve_from_entry(entry) for entry in document["results"] if entry["median"] is not None)
    except (KeyError, TypeError, InputError) as error:
        raise ParameterError("{name} is a damaged fragility document; create it again with seisblock fragility", name=name) from error
    if not curves:
        raise ParameterError("{name} contains no fragility curve (all fits failed)", name=name)
    return curves


def _curve_from_entry(entry: dict[str, Any]) -> FragilityCurve:
    measure = intensity_measure(entry["im"])
    if entry["unit"] != measure.unit:
        raise ParameterError("{im} must be in {unit}, found {found}", im=measure.name, unit=measure.unit, found=entry["unit"])
    return FragilityCurve(str(entry["body"]), str(entry["limit"]), measure.name, measure.unit, Lognormal(entry["median"], entry["beta"]))


def fragility_from_median(hazard: Hazard, median: str | float, beta: float) -> FragilityCurve:
    """Return the fragility curve of a median in the intensity measure of a hazard.

    Parameters
    ----------
    hazard : Hazard
    median : str or float
        With a unit (``0.4g``, ``60cm/s``); a bare number is in SI, provided that the hazard's table is, too.
    beta : float, 1

    Raises
    ------
    UnitError
        If the unit is missing and ambiguous, or unknown.
    ParameterError
        If a number is not positive.
    """
    measure = intensity_measure(hazard.im)
    value, unit_text = parse_quantity(median, UNITS_OF[measure.unit], quantity=lazy_gettext("the median"))
    if not unit_text and hazard.table_unit != 1.0:
        unit_names = [*UNITS_OF[measure.unit]]
        raise UnitError(
            "the median {median} has no unit, and the hazard is not in SI; add a unit: {known}", median=median, known=unit_names
        )
    return FragilityCurve("", "", measure.name, measure.unit, Lognormal(value, beta))


def check_measure(curves: Sequence[FragilityCurve], hazard: Hazard) -> tuple[FragilityCurve, ...]:
    """Return curves after a check that they use the intensity measure of a hazard, or another definition of the same spectral ordinate.

    Raises
    ------
    ParameterError
        If a curve uses another measure.
    """
    for curve in curves:
        if curve.im != hazard.im and not intensity_measure(curve.im).is_comparable(intensity_measure(hazard.im)):
            raise ParameterError(
                "the fragility is in {im} and the hazard in {found}; use a hazard in {im}, or a fragility in {found}",
                im=curve.im,
                found=hazard.im,
            )
    return tuple(curves)

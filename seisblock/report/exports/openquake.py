"""OpenQuake fragility models (NRML 0.5): continuous (lognormal) or discrete (observed fractions at the levels)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from xml.etree import ElementTree

from seisblock import __version__
from seisblock.core.errors import OutputError
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.report.exports.identifiers import ascii_identifiers
from seisblock.studies.fragility.estimate import CLOUD
from seisblock.studies.fragility.intensity import ARIAS, PGA, PGD, PGV, ROTD50, SA, IntensityMeasure
from seisblock.studies.fragility.lognormal import Lognormal
from seisblock.studies.fragility.results import Fragility, FragilityStudy

NAMESPACE = "http://openquake.org/xmlns/nrml/0.5"
SHAPES = ("logncdf", "discrete")

_IMTS = {
    PGA: ("PGA", STANDARD_GRAVITY),
    PGV: ("PGV", 0.01),
    PGD: ("PGD", 0.01),
    SA: ("SA", STANDARD_GRAVITY),
    ROTD50: ("SA", STANDARD_GRAVITY),
    ARIAS: ("IA", 1.0),
}
"""OpenQuake name of each intensity measure, and its unit in SI (g, cm/s, cm, m/s)."""

UPPER_PROBABILITY = 0.9999
"""Probability at the upper end of a continuous curve; the lower end is at its complement."""


def imt_of(measure: IntensityMeasure) -> tuple[str, float]:
    """Return the OpenQuake name of an intensity measure, and the size of its unit in SI.

    Raises
    ------
    OutputError
        If OpenQuake has no such measure.
    """
    if measure.kind not in _IMTS:
        raise OutputError("intensity measure {im} not supported by OpenQuake: use pga, pgv, pgd, sa, rotd50 or arias", im=measure.name)
    name, size = _IMTS[measure.kind]
    return (name if measure.period_s is None else f"{name}({measure.period_s:g})"), size


def nrml(study: FragilityStudy, *, shape: str = "logncdf") -> str:
    """Return a fragility model in NRML 0.5: one function per body, one limit state per limit with a curve.

    Parameters
    ----------
    study : FragilityStudy
    shape : str
        ``logncdf``: mean and standard deviation of the intensity; ``discrete``: observed fractions at the levels, made monotonic.

    Raises
    ------
    OutputError
        If OpenQuake has no such measure, no body has a curve for every limit, or a discrete shape is requested of a cloud analysis.

    Notes
    -----
    The mean of a lognormal intensity is median exp(beta^2/2), its standard deviation mean sqrt(exp(beta^2) - 1) (derived here).
    """
    imt, size = imt_of(study.measure)
    if shape not in SHAPES:
        raise OutputError("unknown shape {shape!r} of a fragility model: expected {known}", shape=str(shape)[:40], known=list(SHAPES))
    if shape == "discrete" and study.method == CLOUD:
        raise OutputError("a cloud analysis has no intensity levels for a discrete shape: use the shape logncdf or the method stripes")
    bodies = dict.fromkeys(curve.body for curve in study.curves if curve.curve is not None)
    limits = list(dict.fromkeys(curve.limit for curve in study.curves if shape == "discrete" or curve.curve is not None))
    complete = {body: [c for c in study.curves if c.body == body and c.limit in limits] for body in bodies}
    complete = {body: curves for body, curves in complete.items() if shape == "discrete" or all(c.curve is not None for c in curves)}
    if not complete:
        raise OutputError(
            "a fragility model requires a curve for every limit state, and no body has all of them: omit a limit or choose other levels"
        )
    states = list(ascii_identifiers(limits, prefix="state").values())
    root = ElementTree.Element("nrml", xmlns=NAMESPACE)
    model = ElementTree.SubElement(root, "fragilityModel", id="seisblock", assetCategory="contents", lossCategory="contents")
    text = f"seisblock {__version__}: {study.solver}, {study.method}, {study.curves[0].records} records"
    ElementTree.SubElement(model, "description").text = text
    ElementTree.SubElement(model, "limitStates").text = " ".join(states)
    names = ascii_identifiers(complete)
    for body, curves in complete.items():
        _add_function(model, names[body], imt, curves, states, size, continuous=shape == "logncdf")
    ElementTree.indent(root)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + ElementTree.tostring(root, encoding="unicode") + "\n"


def _add_function(
    model: ElementTree.Element, name: str, imt: str, curves: Sequence[Fragility], states: Sequence[str], size: float, *, continuous: bool
) -> None:
    """Add the fragility function of one body to the model."""
    from scipy.optimize import isotonic_regression

    levels = [level.im / size for level in curves[0].levels]
    if continuous:
        function = ElementTree.SubElement(model, "fragilityFunction", id=name, format="continuous", shape="logncdf")
        with_curve = [curve.curve for curve in curves if curve.curve is not None]
        low = min(min(levels), *(curve.quantile(1.0 - UPPER_PROBABILITY) / size for curve in with_curve))
        top = max(max(levels), *(curve.quantile(UPPER_PROBABILITY) / size for curve in with_curve))
        ElementTree.SubElement(function, "imls", imt=imt, minIML=_format_number(low), maxIML=_format_number(top))
        for state, curve in zip(states, with_curve, strict=True):
            mean, deviation = lognormal_moments(curve)
            ElementTree.SubElement(function, "params", ls=state, mean=_format_number(mean / size), stddev=_format_number(deviation / size))
        return
    function = ElementTree.SubElement(model, "fragilityFunction", id=name, format="discrete")
    ElementTree.SubElement(function, "imls", imt=imt).text = " ".join(map(_format_number, levels))
    for state, fragility in zip(states, curves, strict=True):
        runs = [level.runs for level in fragility.levels]
        # the most likely fractions of those that do not fall
        shares = isotonic_regression([level.exceeding / level.runs for level in fragility.levels], weights=runs).x
        ElementTree.SubElement(function, "poes", ls=state).text = " ".join(map(_format_number, shares))


def _format_number(value: float) -> str:
    """Return a number to 12 significant digits."""
    return f"{value:.12g}"


def lognormal_moments(curve: Lognormal) -> tuple[float, float]:
    """Return mean, median exp(beta^2/2), and standard deviation, mean sqrt(exp(beta^2) - 1), of a lognormal (derived here)."""
    mean = curve.median * math.exp(curve.beta**2 / 2.0)
    return mean, mean * math.sqrt(math.expm1(curve.beta**2))

"""Fragility models for pelicun and its model library DLML: ``fragility.csv`` and ``fragility.json``."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

from seisblock import __version__
from seisblock.core.errors import OutputError
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.report.exports.identifiers import ascii_identifiers
from seisblock.studies.fragility.intensity import PGA, PGD, PGV, SA, IntensityMeasure
from seisblock.studies.fragility.results import Fragility, FragilityStudy

_DEMANDS = {
    PGA: ("Peak Floor Acceleration", "g", STANDARD_GRAVITY),
    PGV: ("Peak Floor Velocity", "mps", 1.0),
    PGD: ("Peak Floor Displacement", "m", 1.0),
    SA: ("Spectral Acceleration", "g", STANDARD_GRAVITY),
}
"""Pelicun demand type of each intensity measure, its unit, and that unit in SI."""

DIRECTIONAL = 1
"""``Demand-Directional``: 1, demand in one direction, as analysed (0: the larger of both, as for the shelves of DLML)."""


def demand_of(measure: IntensityMeasure, *, ground: bool = False) -> tuple[str, str, float]:
    """Return the pelicun demand type of an intensity measure, its unit, and that unit in SI.

    Parameters
    ----------
    measure : IntensityMeasure
    ground : bool
        Measure of the ground motion below the building, else of the floor motion at the object.

    Raises
    ------
    OutputError
        If pelicun has no such demand type.
    """
    if measure.kind not in _DEMANDS:
        raise OutputError("intensity measure {im} not supported by pelicun: use pga, pgv, pgd or sa", im=measure.name)
    name, unit, size = _DEMANDS[measure.kind]
    name = name.replace("Floor", "Ground") if ground else name
    return (name if measure.period_s is None else f"{name}|{measure.period_s:g}"), unit, size


def pelicun_rows(study: FragilityStudy) -> tuple[list[str], list[list[Any]]]:
    """Return header and rows of ``fragility.csv``: one row per body, limit states in order.

    Parameters
    ----------
    study : FragilityStudy

    Raises
    ------
    OutputError
        If pelicun has no such demand type.
    """
    demand, unit, size = demand_of(study.measure, ground=study.floor is not None)
    bodies = _curves_by_name(study)
    states = max(len(curves) for curves in bodies.values())
    header = ["ID", "Incomplete", "Demand-Type", "Demand-Unit", "Demand-Offset", "Demand-Directional"]
    for state in range(1, states + 1):
        header += [f"LS{state}-{key}" for key in ("Family", "Theta_0", "Theta_1", "DamageStateWeights")]
    rows = []
    for name, curves in bodies.items():
        row: list[Any] = [name, 0, demand, unit, 0, DIRECTIONAL]
        for curve in curves:
            row += ["lognormal", (curve.median or 0.0) / size, curve.beta, ""]
        rows.append(row + [""] * (len(header) - len(row)))
    return header, rows


def pelicun_metadata(study: FragilityStudy) -> str:
    """Return ``fragility.json``: descriptions of the bodies and limit states, in English.

    Parameters
    ----------
    study : FragilityStudy
    """
    name = f"seisblock {__version__}, {study.solver}, {study.method}"
    content: dict[str, Any] = {
        "_GeneralInformation": {
            "ShortName": "seisblock",
            "Description": f"Fragilities of free-standing objects computed by {name}.",
            "Version": __version__,
        }
    }
    location = "at the object's feet" if study.floor is None else "of the ground under its storey"
    for identifier, curves in _curves_by_name(study).items():
        first = curves[0]
        content[identifier] = {
            "Description": first.body,
            "Comments": f"{first.records} records, {first.motions} motions; {name}; intensity {location}, along one direction.",
            "SuggestedComponentBlockSize": "1 EA",
            "RoundUpToIntegerQuantity": "True",
            "LimitStates": {
                f"LS{number}": {f"DS{number}": {"Description": curve.limit, "RepairAction": ""}} for number, curve in enumerate(curves, 1)
            },
        }
    return json.dumps(content, indent=2, ensure_ascii=False) + "\n"


def _curves_by_name(study: FragilityStudy) -> dict[str, Sequence[Fragility]]:
    """Return the curves of each body with at least one, by identifier."""
    with_curve = [curve for curve in study.curves if curve.curve is not None]
    identifiers = ascii_identifiers(dict.fromkeys(curve.body for curve in with_curve))
    return {name: [curve for curve in with_curve if curve.body == body] for body, name in identifiers.items()}

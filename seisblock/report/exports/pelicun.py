"""A fragility as pelicun and its library of models, DLML, hold it: a row of parameters, and what it means beside it."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

from seisblock import __version__
from seisblock.core.errors import OutputError
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.report.exports.names import ascii_identifiers
from seisblock.studies.fragility.intensity import PGA, PGD, PGV, SA, IntensityMeasure
from seisblock.studies.fragility.results import Fragility, FragilityStudy

_DEMANDS = {
    PGA: ("Peak Floor Acceleration", "g", STANDARD_GRAVITY),
    PGV: ("Peak Floor Velocity", "mps", 1.0),
    PGD: ("Peak Floor Displacement", "m", 1.0),
    SA: ("Spectral Acceleration", "g", STANDARD_GRAVITY),
}
"""What pelicun calls a measure at the object's feet, the unit told, and that unit in SI."""

DIRECTIONAL = 1
"""The demand of one direction counts, as the object was shaken; the library's own shelves take the larger of both (0)."""


def demand_of(measure: IntensityMeasure, *, ground: bool = False) -> tuple[str, str, float]:
    """Return what pelicun calls a measure, its unit, and that unit in SI.

    Parameters
    ----------
    measure : IntensityMeasure
    ground : bool
        Whether it is that of the ground under a storey, not that at the object's feet.

    Raises
    ------
    OutputError
        If pelicun has none such.
    """
    if measure.kind not in _DEMANDS:
        raise OutputError("pelicun knows no demand {im}: take pga, pgv, pgd or sa", im=measure.name)
    name, unit, size = _DEMANDS[measure.kind]
    name = name.replace("Floor", "Ground") if ground else name
    return (name if measure.period_s is None else f"{name}|{measure.period_s:g}"), unit, size


def pelicun_rows(study: FragilityStudy) -> tuple[list[str], list[list[Any]]]:
    """Return the header and the rows of a ``fragility.csv``: a body each, its limit states in their order.

    Parameters
    ----------
    study : FragilityStudy

    Raises
    ------
    OutputError
        If pelicun has no such demand.
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
    """Return the ``fragility.json`` that stands beside the rows: what each body and each of its states is, in English.

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
    """Return the curves of each body that has any, under the names of the file."""
    with_curve = [curve for curve in study.curves if curve.curve is not None]
    identifiers = ascii_identifiers(dict.fromkeys(curve.body for curve in with_curve))
    return {name: [curve for curve in with_curve if curve.body == body] for body, name in identifiers.items()}

"""FEMA P-58: nine overturning fragilities of unanchored bookcases and filing cabinets as a constant times those of the rocking block.

Sizes and medians are printed in the descriptions of the components ([FEMAP58]_ table of components E.20.22, as in the model library of
pelicun). The ground motions behind the medians are not documented: [Boore2003]_ records of magnitude 7 at 20 km on rock are used
instead, their horizontal motion alone. The constant depends on the suite (1.26 to 1.57 for seven suites); the evidence is that a single
number fits all nine.
"""

from __future__ import annotations

from functools import cache

import numpy as np

from seisblock.bodies.block import Block
from seisblock.core.typing import FloatArray
from seisblock.core.units import LENGTH_UNITS
from seisblock.records.synthetic.suite import synthetic_suite
from seisblock.studies.fragility.run import run_fragility
from seisblock.validation.case import Case

INCH = LENGTH_UNITS["in"]

SHELVES = {
    "E.20.22.102a": (12.625, 29.0, 0.724),
    "E.20.22.103a": (12.625, 41.0, 0.493),
    "E.20.22.104a": (12.625, 56.0, 0.361),
    "E.20.22.105a": (12.625, 71.0, 0.290),
    "E.20.22.106a": (12.625, 81.25, 0.251),
    "E.20.22.112a": (15.0, 24.0, 1.229),
    "E.20.22.114a": (15.0, 52.0, 0.498),
    "E.20.22.124a": (18.6, 52.5, 0.688),
    "E.20.22.125a": (18.6, 67.75, 0.526),
}
"""Bookcases of two to six shelves, vertical cabinets of two and four drawers, lateral ones of two and four: depth along the shaking and
height, inches, and median peak floor velocity of overturning, m/s."""

SCATTER_TOLERANCE = 0.05
"""Admissible standard deviation of the ratios of the medians over their mean."""

RECORDS = 40
PGV_LEVELS = np.geomspace(0.1, 5.0, 24)
"""Peak velocities to which each motion is scaled, m/s."""


@cache
def ratios() -> FloatArray:
    """Return the median of the rocking block over that of P-58 for each shelf, (9,), 1."""
    bodies = {name: Block(depth * INCH, height * INCH) for name, (depth, height, _) in SHELVES.items()}
    suite = synthetic_suite(7.0, 20.0, RECORDS)
    study = run_fragility(suite, bodies, "rock", im="pgv", levels=PGV_LEVELS, bootstrap=2, vertical=False)
    medians = {curve.body: curve.median or np.nan for curve in study.curves}
    return np.array([medians[name] / p58_median for name, (_, _, p58_median) in SHELVES.items()])


def constant() -> float:
    """Return the mean of the nine ratios."""
    return float(ratios().mean())


def scatter() -> float:
    """Return the standard deviation of the nine ratios over their mean."""
    return float(ratios().std() / ratios().mean())


CASES = (
    Case(
        "fema-p58-scatter",
        "[FEMAP58]_ table of components E.20.22.102a to 125a",
        "coefficient of variation of nine ratios of medians, rocking block over P-58",
        "1",
        0.0,
        SCATTER_TOLERANCE,
        scatter,
        kind="rebuilt",
        note="40 synthetic records of magnitude 7 at 20 km instead of the motions behind P-58; 0 means a constant ratio; the medians "
        "themselves range from 0.25 to 1.23 m/s",
        quick=False,
    ),
    Case(
        "fema-p58-constant",
        "[FEMAP58]_ table of components E.20.22.102a to 125a",
        "mean of nine ratios of medians, rocking block over P-58",
        "1",
        1.0,
        0.05,
        constant,
        status="differs",
        kind="rebuilt",
        today=(1.3616, 0.005),
        note="a rigid block with sharp edges that rocks in its plane resists 1.26 to 1.57 times the medians of P-58, depending on the "
        "suite (1.26 for white noise, 1.47 for the far-field records of P-695, 1.57 for 18 records of pySLAMMER and for magnitude "
        "7.5); cause unknown: P-58 does not document edges, contents and walls of the shelves",
        quick=False,
    ),
)
"""Scatter and mean of the ratios."""

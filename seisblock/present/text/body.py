"""How a scanned body is told: what it is, on what it stands, and how easily it turns in each direction."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from seisblock.bodies.scan.body import weakest
from seisblock.bodies.scan.directions import ScanAzimuth
from seisblock.bodies.scan.scan import Scanned
from seisblock.present.files import write_table
from seisblock.present.scales import acceleration_unit, length_cell, length_unit, told_length
from seisblock.present.text.tables import acceleration, fixed, line, number, table
from seisblock.words import noted, tell

PLANE = noted(
    "in the vertical plane of the azimuth: about the level line across it that touches the base; turning aside about a corner is left out"
)
"""What the numbers of a direction hold for."""


def tables(found: Scanned, directions: Sequence[ScanAzimuth], *, gal: bool) -> Iterator[Any]:
    """Yield what the body is in a sentence, its numbers, and a row for each azimuth."""
    body = found.body
    alpha, azimuth = weakest(body)
    yield line(
        tell(
            "{name}: {mass:.4g} kg; alpha is least towards azimuth {azimuth:.0f}: {alpha:.2f} degrees.",
            name=body.name,
            mass=body.mass,
            azimuth=azimuth,
            alpha=math.degrees(alpha),
        ),
        "bold",
    )
    yield table("", ["", ""], [[tell(what), *cells] for what, cells in _whole(found, gal=gal)])
    level, arm = acceleration_unit(gal=gal), length_unit((each.arm_m for each in directions), gal=gal)
    headings = (
        tell("azimuth (deg)"), f"b ({arm.name})", tell("alpha (deg)"), tell("R (m)"), tell("I_O (kg m²)"), tell("p (rad/s)"),
        f"g b/h ({level.name})",
    )  # fmt: skip
    rows = [
        [
            f"{each.azimuth_deg:g}",
            length_cell(each.arm_m, arm),
            f"{math.degrees(each.slenderness_rad):.2f}",
            number(each.radius_m),
            number(each.pivot_inertia_kg_m2),
            f"{each.frequency_parameter_rad_s:.3f}",
            acceleration(each.threshold_m_s2, gal=gal),
        ]
        for each in directions
    ]
    yield table(tell("Towards each azimuth"), headings, rows, caption=tell(PLANE))


def _whole(found: Scanned, *, gal: bool) -> Iterator[tuple[str, list[str]]]:
    """Yield what is the same in all directions."""
    body = found.body
    yield noted("volume (m³)"), [number(found.volume)]
    yield noted("height (m)"), [number(body.height)]
    yield noted("centre of gravity x, y, z (m)"), [", ".join(fixed(value, 4) for value in body.centre)]
    yield noted("inertia about it xx, yy, zz (kg m²)"), [", ".join(number(body.inertia[i][i]) for i in range(3))]
    yield noted("  xy, xz, yz (kg m²)"), [", ".join(number(body.inertia[i][k]) for i, k in ((0, 1), (0, 2), (1, 2)))]
    yield noted("base: corners, points that touch"), [f"{len(body.base)}, {found.touching}"]
    unit = length_unit([body.inset_m, found.tolerance], gal=gal)
    yield noted("  inset, tolerance"), [f"{told_length(body.inset_m, unit)}, {told_length(found.tolerance, unit)}"]


def write(path: Path, directions: Sequence[ScanAzimuth]) -> None:
    """Write the rows of the azimuths, SI units."""
    names = list(vars(directions[0]))
    write_table(path, names, ([getattr(each, name) for name in names] for each in directions))

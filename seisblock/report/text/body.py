"""Text report of a scanned body: properties, base polygon and overturning angle by azimuth."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

from seisblock.bodies.scan.azimuths import ScanAzimuth
from seisblock.bodies.scan.body import min_slenderness
from seisblock.bodies.scan.scan import Scan
from seisblock.core.i18n import N_, gettext
from seisblock.output.io.history_csv import CsvTable
from seisblock.output.text.tables import Part, acceleration_cell, format_fixed, format_number, styled_line, table
from seisblock.output.units_display import acceleration_unit, format_length, length_cell, length_unit

PLANE = N_(
    "in the vertical plane of the azimuth, about the horizontal tangent line of the base; rotation about a corner to "
    "one side is not considered"
)
"""Validity of the values by azimuth."""

SHORT_ROWS = 12
"""Most azimuths in the shortened table."""


def tables(scan: Scan, directions: Sequence[ScanAzimuth], *, gal: bool) -> Iterator[Any]:
    """Yield a summary sentence, the table of properties and a row for each azimuth."""
    body = scan.body
    alpha, azimuth = min_slenderness(body)
    yield styled_line(
        gettext(
            "{name}: {mass:.4g} kg, smallest overturning angle {alpha:.2f}° towards azimuth {azimuth:.0f}°.",
            name=body.name,
            mass=body.mass,
            azimuth=azimuth,
            alpha=math.degrees(alpha),
        ),
        "bold",
    )
    yield table("", ["", ""], [[gettext(name), *cells] for name, cells in _scan_rows(scan, gal=gal)])
    level, arm = acceleration_unit(gal=gal), length_unit((direction.arm_m for direction in directions), gal=gal)
    headings = (
        gettext("azimuth (deg)"), f"b ({arm.name})", gettext("alpha (deg)"), gettext("R (m)"), gettext("I_O (kg m²)"), gettext("p (rad/s)"),
        f"g b/h ({level.name})",
    )  # fmt: skip
    rows = [
        [
            f"{direction.azimuth_deg:g}",
            length_cell(direction.arm_m, arm),
            f"{math.degrees(direction.slenderness_rad):.2f}",
            format_number(direction.radius_m),
            format_number(direction.pivot_inertia_kg_m2),
            f"{direction.frequency_parameter_rad_s:.3f}",
            acceleration_cell(direction.threshold_m_s2, gal=gal),
        ]
        for direction in directions
    ]
    title, caption = gettext("By azimuth"), gettext(PLANE)
    step = math.ceil(len(rows) / SHORT_ROWS)
    full = table(title, headings, rows, caption=caption)
    yield full if step == 1 else Part((full,), (table(title, headings, rows[::step], caption=caption),))


def _scan_rows(scan: Scan, *, gal: bool) -> Iterator[tuple[str, list[str]]]:
    """Yield the properties that do not depend on the azimuth."""
    body = scan.body
    yield N_("volume (m³)"), [format_number(scan.volume)]
    yield N_("height (m)"), [format_number(body.height)]
    yield N_("centre of gravity x, y, z (m)"), [", ".join(format_fixed(value, 4) for value in body.centre)]
    yield N_("moments of inertia xx, yy, zz (kg m²)"), [", ".join(format_number(body.inertia[i][i]) for i in range(3))]
    yield N_("  xy, xz, yz (kg m²)"), [", ".join(format_number(body.inertia[i][k]) for i, k in ((0, 1), (0, 2), (1, 2)))]
    yield N_("base: corners, contact points"), [f"{len(body.base)}, {scan.touching}"]
    unit = length_unit([body.inset_m, scan.tolerance], gal=gal)
    yield N_("  inset, tolerance"), [f"{format_length(body.inset_m, unit)}, {format_length(scan.tolerance, unit)}"]


def csv_columns(directions: Sequence[ScanAzimuth]) -> CsvTable:
    """Return the values by azimuth, SI units."""
    names = list(vars(directions[0]))
    return names, ([getattr(direction, name) for name in names] for direction in directions)

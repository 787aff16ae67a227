"""Quality checks of a scan."""

from __future__ import annotations

import math
from collections.abc import Iterator

from seisblock.bodies.scan.body import min_slenderness
from seisblock.bodies.scan.hull import HULL_TOLERANCE_SHARE
from seisblock.bodies.scan.scan import Scan
from seisblock.core.i18n import Message, lazy_gettext

MIN_EXTENT, MAX_EXTENT = 0.02, 20.0
"""Range of plausible extents, m; outside it the unit is probably wrong."""

MAX_UNREPORTED_TILT = math.radians(0.5)
"""Largest levelling rotation that is not reported, rad."""

SLENDERNESS_TOLERANCE = 0.1
"""Relative change of the smallest alpha, by half or twice the tolerance, that is reported."""


def scan_qc_messages(scan: Scan) -> Iterator[Message]:
    """Yield the quality warnings of a scan.

    Examples
    --------
    >>> from seisblock.bodies.scan.scan import scan_body
    >>> len(list(scan_qc_messages(scan_body("boulder.ply", unit="km"))))
    2
    """
    largest = max(scan.size)
    if not MIN_EXTENT <= largest <= MAX_EXTENT:
        yield lazy_gettext(
            "{name} measures {size:.3g} m, read in {unit}: mesh files do not state their unit; check the unit",
            name=scan.body.name,
            size=largest,
            unit=scan.unit,
        )
    if scan.tilt > MAX_UNREPORTED_TILT:
        yield lazy_gettext("{name} was turned by {tilt:.2g}° to rest on level ground", name=scan.body.name, tilt=math.degrees(scan.tilt))
    if scan.pieces > 1:
        yield lazy_gettext(
            "{name} has {count} separate surfaces: they move as one body",
            name=scan.body.name,
            count=scan.pieces,
        )
    if len(scan.body.hull) < scan.hull_vertices:
        yield lazy_gettext(
            "{name}: {count} of the {total} vertices of the convex hull used; the others are within {distance:.2g} mm of it",
            name=scan.body.name,
            count=len(scan.body.hull),
            total=scan.hull_vertices,
            distance=1000.0 * HULL_TOLERANCE_SHARE * largest,
        )
    sharp_slenderness = min_slenderness(scan.body.with_wear(0.0))[0]
    tolerance_slendernesses = [
        alpha for alpha in (scan.slenderness_half_tolerance, scan.slenderness_double_tolerance) if not math.isnan(alpha)
    ]
    if len(tolerance_slendernesses) < 2 or any(
        abs(alpha / sharp_slenderness - 1.0) > SLENDERNESS_TOLERANCE for alpha in tolerance_slendernesses
    ):
        yield lazy_gettext(
            "{name}: the support polygon depends on the tolerance: smallest alpha {alpha:.3g} degrees, {nearer} with half the "
            "tolerance, {wider} with twice",
            name=scan.body.name,
            alpha=math.degrees(sharp_slenderness),
            nearer=_format_degrees(scan.slenderness_half_tolerance),
            wider=_format_degrees(scan.slenderness_double_tolerance),
        )
    if not scan.body.inset_m:
        yield lazy_gettext(
            "sharp edges are unconservative: scans of two granite rocks gave angles 1.4 to 2.5 times those that explain their "
            "overturning on a shaking table; give `inset`, or estimate it by a fit to observed overturning"
        )


def _format_degrees(alpha: float) -> str:
    """Return an angle as text, or "none"."""
    return lazy_gettext("none (overturns)") if math.isnan(alpha) else f"{math.degrees(alpha):.3g}"

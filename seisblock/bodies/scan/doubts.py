"""What a careful reader of a scan notices before he believes it."""

from __future__ import annotations

import math
from collections.abc import Iterator

from seisblock.bodies.scan.body import weakest
from seisblock.bodies.scan.scan import Scanned
from seisblock.words import Said, said

SMALLEST, LARGEST = 0.02, 20.0
"""Extents, m, beyond which no object is shaken that anybody asks about: the unit was another."""

TURNED = math.radians(0.5)
"""A turn beyond which a scan was not level."""

UNSURE = 0.1
"""Change of the least alpha, as a share, by half or twice the tolerance, from which on the base is a matter of taste."""


def scan_doubts(found: Scanned) -> Iterator[Said]:
    """Yield what is doubtful about a scan, in sentences.

    Examples
    --------
    >>> from seisblock.bodies.scan.scan import scan_body
    >>> len(list(scan_doubts(scan_body("boulder.ply", unit="km"))))
    2
    """
    largest = max(found.size)
    if not SMALLEST <= largest <= LARGEST:
        yield said(
            "{name} measures {size:.3g} m, read as {unit}: files of meshes do not say their unit; give the right one",
            name=found.body.name,
            size=largest,
            unit=found.unit,
        )
    if found.tilt > TURNED:
        yield said(
            "{name} was turned by {tilt:.2g} degrees so that it rests on level ground", name=found.body.name, tilt=math.degrees(found.tilt)
        )
    if found.pieces > 1:
        yield said(
            "{name} has {count} surfaces that do not touch each other: all of them move as one body",
            name=found.body.name,
            count=found.pieces,
        )
    sharp = weakest(found.body.worn(0.0))[0]
    others = [alpha for alpha in (found.nearer, found.wider) if not math.isnan(alpha)]
    if len(others) < 2 or any(abs(alpha / sharp - 1.0) > UNSURE for alpha in others):
        yield said(
            "{name}: which points carry depends on the tolerance: the least alpha in degrees is {alpha:.3g}, with half of it {nearer}, "
            "with twice as much {wider}",
            name=found.body.name,
            alpha=math.degrees(sharp),
            nearer=_degrees(found.nearer),
            wider=_degrees(found.wider),
        )
    if not found.body.inset_m:
        yield said(
            "sharp edges are the unsafe end: scans of two granite rocks gave angles 1.4 to 2.5 times those that explain their falls on a "
            "shaking table; give an inset, or find it with fit from what fell and what stood"
        )


def _degrees(alpha: float) -> str:
    """Return an angle, or that there is none."""
    return said("none, as it falls") if math.isnan(alpha) else f"{math.degrees(alpha):.3g}"

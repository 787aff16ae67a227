"""Make seisblock/report/coastline.npz again: ``python -m tests.make_coastline land-10m.json``.

The argument is Natural Earth's land at 1:10 million (public domain) as TopoJSON: ``land-10m.json`` of the npm package world-atlas 2.0.2.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

import numpy as np

from seisblock.core.typing import FloatArray
from seisblock.report.coastline import OUTLINE, OUTLINE_STEP

TOLERANCE = 0.02
"""Largest distance of a removed point from the outline, degrees of latitude (2.2 km)."""

SMALLEST = 0.03
"""Smallest extent of an island, degrees."""

DATE_LINE = 179.99
"""Longitude beyond which a segment is the edge of the map and no coast, degrees."""

SOUTH = -60.0
"""Latitude beyond which land is left out, degrees."""


def simplify(points: FloatArray, tolerance: float) -> FloatArray:
    """Return the line without points closer than the tolerance (Douglas and Peucker)."""
    scaled = points * [np.cos(np.radians(points[:, 1].mean())), 1.0]
    keep = np.zeros(len(points), dtype=bool)
    keep[[0, -1]] = True
    pending = [(0, len(points) - 1)]
    while pending:
        first, last = pending.pop()
        if last - first < 2:
            continue
        chord, offsets = scaled[last] - scaled[first], scaled[first + 1 : last] - scaled[first]
        length = float(chord @ chord)
        along = np.clip(offsets @ chord / length, 0.0, 1.0) if length else np.zeros(len(offsets))
        distances = np.linalg.norm(offsets - along[:, None] * chord, axis=1)
        if distances.max() > tolerance:
            middle = first + 1 + int(distances.argmax())
            keep[middle] = True
            pending += [(first, middle), (middle, last)]
    return points[keep]


def main(source: str) -> None:
    """Write the outline: lengths of the lines, and the differences of their points in steps."""
    topology = json.loads(Path(source).read_text(encoding="utf-8"))
    scale, shift = (np.array(topology["transform"][key]) for key in ("scale", "translate"))
    lines = []
    for arc in topology["arcs"]:
        points = np.cumsum(np.array(arc), axis=0) * scale + shift
        points[:, 0] = np.unwrap(points[:, 0], period=360.0)
        cuts = np.abs(points[:, 0]) > DATE_LINE
        for part in np.split(points, np.flatnonzero(cuts[1:] & cuts[:-1]) + 1):
            if len(part) < 2 or part[:, 1].max() < SOUTH or np.ptp(part, axis=0).max() < SMALLEST:
                continue
            line = np.round(simplify(part, TOLERANCE) / OUTLINE_STEP).astype(np.int32)
            if len(line) > 2:
                lines.append(line)
    steps = np.concatenate([np.diff(line, axis=0, prepend=0) for line in lines]).astype("<i2")
    lengths = np.array([len(line) for line in lines], dtype="<u2")
    np.savez_compressed(OUTLINE, lengths=lengths, east=steps[:, 0], north=steps[:, 1])
    print(f"{len(lines)} lines, {lengths.sum()} points, {OUTLINE.stat().st_size} bytes")


if __name__ == "__main__":
    main(*sys.argv[1:])

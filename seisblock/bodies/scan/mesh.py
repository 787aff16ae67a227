"""Triangle meshes from STL, PLY and OBJ files, with merged vertices."""

from __future__ import annotations

import hashlib
import io
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from seisblock.core import checks
from seisblock.core.errors import BodyError
from seisblock.core.i18n import N_, join_alternatives
from seisblock.core.io.files import read_bytes
from seisblock.core.limits import check_limit
from seisblock.core.typing import FloatArray, IntArray
from seisblock.core.units import LENGTH_UNITS
from seisblock.samples import find_sample

SUFFIXES = (".stl", ".ply", ".obj")
"""Mesh formats."""

AXIS_ROTATIONS = {
    "x": ((2, -1), (1, 1), (0, 1)),
    "y": ((0, 1), (2, -1), (1, 1)),
    "z": ((0, 1), (1, 1), (2, 1)),
    "-x": ((2, 1), (1, 1), (0, -1)),
    "-y": ((0, 1), (2, 1), (1, -1)),
    "-z": ((0, 1), (1, -1), (2, -1)),
}
"""Axis and sign of the file that become x, y and z, for each upward axis.

The body rotates about the file's x, which stays x; where x points up or down, about y.
"""

HEADER_BYTES = 2**14
"""Largest size of a file header, bytes."""

_HASH_MULTIPLIERS = np.array([0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9], dtype=np.uint64)
"""Odd multipliers of the coordinate hash."""


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangle mesh.

    Parameters
    ----------
    vertices : (n, 3) array, m
        z upwards.
    faces : (k, 3) array of int
        Vertex indices, counter-clockwise seen from outside.
    source, sha256 : str
        File name and SHA-256 digest.
    """

    vertices: FloatArray
    faces: IntArray
    source: str = ""
    sha256: str = ""


def read_mesh(name: str | Path, *, unit: str = "m", up: str = "z") -> Mesh:
    """Return the mesh of an STL, PLY or OBJ file or of a bundled one, with equal vertices merged.

    Parameters
    ----------
    name : path
    unit : str
        Unit of the file's coordinates, one of ``LENGTH_UNITS``; mesh formats do not state it.
    up : str
        The file's axis that points upwards: x, y, z, -x, -y or -z.

    Raises
    ------
    BodyError
        If there is no such file, it is not a mesh, or a coordinate is not finite.
    ParameterError
        If the mesh exceeds the limit, or trimesh is not installed.

    Examples
    --------
    >>> mesh = read_mesh("boulder.ply")
    >>> mesh.faces.shape[1], bool(mesh.vertices[:, 2].max() > 0.5)
    (3, True)
    """
    if unit not in LENGTH_UNITS:
        raise BodyError("unknown unit {unit!r} of a mesh; known: {known}", unit=str(unit)[:40], known=list(LENGTH_UNITS))
    if up not in AXIS_ROTATIONS:
        raise BodyError("unknown upward axis {up!r} of a mesh; known: {known}", up=str(up)[:40], known=list(AXIS_ROTATIONS))
    data = _read_mesh_file(name)
    suffix = Path(name).suffix.lower()
    check_limit(N_("triangles"), _declared_triangles(data, suffix), "SEISBLOCK_TRIANGLES", source=str(name), error=BodyError)
    vertices, faces = _load_triangles(io.BytesIO(data), suffix, str(name))
    if faces.size == 0:
        raise BodyError("{name} contains no triangles: export a surface from the scan software", name=str(name))
    is_finite = np.isfinite(vertices[:, 0]) & np.isfinite(vertices[:, 1]) & np.isfinite(vertices[:, 2])
    if not is_finite[faces].all():
        raise BodyError("{name} has vertices that are not finite numbers: fill the holes and export the mesh again", name=str(name))
    vertices, faces = _merge_vertices(vertices * LENGTH_UNITS[unit], faces)
    rotated = np.column_stack([sign * vertices[:, axis] for axis, sign in AXIS_ROTATIONS[up]])
    return Mesh(rotated, faces, str(name), hashlib.sha256(data).hexdigest())


def _read_mesh_file(name: str | Path) -> bytes:
    """Return the bytes of a mesh file after checks of name and size."""
    path = Path(checks.path(name))
    bundled = find_sample(path.name) if path.parent == Path() and not path.exists() else None
    path = path if bundled is None else bundled
    if path.suffix.lower() not in SUFFIXES:
        raise BodyError(
            "{name}: the file name of a mesh must end in {suffixes}", name=str(name)[:200], suffixes=join_alternatives(SUFFIXES)
        )
    data = read_bytes(path, str(name), BodyError)
    if not data.strip():
        raise BodyError("{name} is empty", name=str(name))
    return data


def _declared_triangles(data: bytes, suffix: str) -> int:
    """Return the number of triangles that a file declares or has room for, before parsing."""
    if suffix == ".obj":
        return data.count(b"\nf ") + data.startswith(b"f ")
    if suffix == ".ply":
        match = re.search(rb"element\s+face\s+(\d{1,18})\b", data[:HEADER_BYTES])
        return int(match[1]) if match else 0
    return data.count(b"endfacet") if data[:5] == b"solid" and b"facet" in data[:HEADER_BYTES] else (len(data) - 84) // 50


def _load_triangles(stream: io.BytesIO, suffix: str, name: str) -> tuple[FloatArray, IntArray]:
    """Return vertices and faces of a file; files that it references are not opened."""
    try:
        import trimesh
    except ImportError as error:
        raise BodyError("reading a mesh requires trimesh: pip install 'seisblock[scan]'") from error
    try:
        with np.errstate(all="ignore"):  # non-finite vertices raise an error below
            mesh: Any = trimesh.load_mesh(stream, file_type=suffix[1:], process=False)
        faces = np.asarray(mesh.faces, dtype=np.int64).reshape(-1, 3)
        vertices = np.asarray(mesh.vertices, dtype=np.float64).reshape(-1, 3)
        indices_valid = faces.size == 0 or (faces.min() >= 0 and faces.max() < len(vertices))
    except MemoryError:
        raise
    except Exception as error:
        raise BodyError("{name} is damaged or not a mesh: export it again", name=name) from error
    if not indices_valid:
        raise BodyError("{name} is damaged: a triangle refers to a vertex that does not exist", name=name)
    return vertices, faces


def _merge_vertices(vertices: FloatArray, faces: IntArray) -> tuple[FloatArray, IntArray]:
    """Return a mesh with equal vertices merged, without degenerate triangles and unused vertices."""
    vertex_ids, faces = np.unique(faces, return_inverse=True)
    points = np.ascontiguousarray(vertices[vertex_ids]) + 0.0  # -0.0 becomes 0.0
    bits = points.view(np.uint64)
    bits = (bits ^ (bits >> np.uint64(29))) * _HASH_MULTIPLIERS
    hashes = (bits ^ (bits >> np.uint64(32))).sum(axis=1, dtype=np.uint64)
    _, first, number = np.unique(hashes, return_index=True, return_inverse=True)
    if not np.array_equal(points[first][number], points):  # hash collision: exact comparison, slower
        _, first, number = np.unique(points, axis=0, return_index=True, return_inverse=True)
    corners = number.reshape(-1)[faces.reshape(-1, 3)]
    is_nondegenerate = (corners[:, 0] != corners[:, 1]) & (corners[:, 1] != corners[:, 2]) & (corners[:, 2] != corners[:, 0])
    return points[first], corners[is_nondegenerate]

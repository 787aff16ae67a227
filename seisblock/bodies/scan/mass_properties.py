"""Mass properties of a closed triangle mesh: volume, centre and inertia, with closure checks."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from seisblock.bodies.scan.mesh import Mesh
from seisblock.core.errors import BodyError
from seisblock.core.typing import FloatArray, IntArray

CHUNK_SIZE = 2**17
"""Triangles per chunk."""


MIN_VOLUME_SHARE = 1e-9
"""Smallest volume, a share of the cube of the largest extent."""


@dataclass(frozen=True, eq=False)
class MassProperties:
    """Mass properties of the homogeneous solid inside a surface.

    Parameters
    ----------
    volume : float, m^3
    centre : (3,) array, m
    gyration : (3, 3) array, m^2
        Inertia tensor about the centre for unit mass.
    pieces : int
        Number of connected surfaces; an inner one oriented inwards is a cavity.
    """

    volume: float
    centre: FloatArray
    gyration: FloatArray
    pieces: int


def mass_properties(mesh: Mesh) -> MassProperties:
    """Return volume, centre and inertia of a mesh.

    Each triangle (a, b, c) and the middle o of the vertices span a tetrahedron of 6 V = (a - o) . (b - o) x (c - o), positive where o lies
    inside; over it the integral of x x' is V/20 (s s' + the sum of the corners' own), s their sum (derived here).

    Parameters
    ----------
    mesh : Mesh

    Raises
    ------
    BodyError
        If the surface is open, not manifold, inconsistently oriented or inside out, or encloses no volume.

    Examples
    --------
    >>> from seisblock.bodies.scan.mesh import read_mesh
    >>> round(mass_properties(read_mesh("boulder.ply")).volume, 3)
    0.117
    """
    edges = np.concatenate([mesh.faces[:, [first, (first + 1) % 3]] for first in range(3)])
    _check_closed(mesh.source, edges)
    middle = 0.5 * (mesh.vertices.min(axis=0) + mesh.vertices.max(axis=0))
    volume, first_moment, second_moment = 0.0, np.zeros(3), np.zeros((3, 3))
    for begin in range(0, len(mesh.faces), CHUNK_SIZE):
        a, b, c = (mesh.vertices[mesh.faces[begin : begin + CHUNK_SIZE, corner]] - middle for corner in range(3))
        six_volumes = np.einsum("ij,ij->i", a, np.cross(b, c))
        total = a + b + c
        volume += float(six_volumes.sum()) / 6.0
        first_moment += six_volumes @ total / 24.0
        second_moment += sum((vector * six_volumes[:, None]).T @ vector for vector in (a, b, c, total)) / 120.0
    size = float(np.ptp(mesh.vertices, axis=0).max())
    if volume < 0.0:
        raise BodyError(
            "{source} is inside out: its triangles are clockwise seen from outside; reverse the normals and export the mesh again",
            source=mesh.source,
        )
    if not volume > MIN_VOLUME_SHARE * size**3:
        raise BodyError("{source} encloses no volume: {volume:.3g} m^3", source=mesh.source, volume=volume)
    centre = first_moment / volume
    second_central_moment = second_moment / volume - np.outer(centre, centre)
    return MassProperties(
        volume,
        centre + middle,
        np.trace(second_central_moment) * np.eye(3) - second_central_moment,
        _count_pieces(edges, len(mesh.vertices)),
    )


def _check_closed(source: str, edges: IntArray) -> None:
    """Raise an error for an open surface: each edge needs one triangle on either side."""
    count = int(edges.max()) + 1
    low, high = edges.min(axis=1), edges.max(axis=1)
    order = np.argsort(low * count + high, kind="stable")
    edge_keys = (low * count + high)[order]
    group_starts = np.flatnonzero(np.concatenate([[True], edge_keys[1:] != edge_keys[:-1]]))
    face_counts = np.diff(np.append(group_starts, edge_keys.size))
    open_ends, shared_edges = int((face_counts == 1).sum()), int((face_counts > 2).sum())
    if open_ends:
        raise BodyError(
            "{source} is open: {count} edges belong to only one triangle; close the holes, above all in the base, and export the "
            "mesh again",
            source=source,
            count=open_ends,
        )
    if shared_edges:
        raise BodyError(
            "{source} is not manifold: {count} edges belong to more than two triangles; repair the mesh in the scan software",
            source=source,
            count=shared_edges,
        )
    forward = (edges[:, 0] < edges[:, 1])[order]
    flipped_edges = int((forward[group_starts] == forward[group_starts + 1]).sum())
    if flipped_edges:
        raise BodyError(
            "{source} has inconsistent normals: two triangles with opposite orientation at {count} edges; unify the normals and "
            "export the mesh again",
            source=source,
            count=flipped_edges,
        )


def _count_pieces(edges: IntArray, vertices: int) -> int:
    """Return the number of connected components of the surface."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    ends = edges[edges[:, 0] < edges[:, 1]]
    adjacency = coo_array((np.ones(len(ends), dtype=np.int8), (ends[:, 0], ends[:, 1])), shape=(vertices, vertices))
    labels = connected_components(adjacency, directed=False)[1]
    return int(np.unique(labels[ends[:, 0]]).size)

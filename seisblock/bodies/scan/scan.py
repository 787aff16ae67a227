"""Scanned body from a mesh file."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from seisblock.bodies.block import DENSITY
from seisblock.bodies.edge_wear import SHARP_EDGES, EdgeWear
from seisblock.bodies.scan.body import EAST, Pair, ScannedBody, Triple, min_slenderness
from seisblock.bodies.scan.hull import hull_vertices
from seisblock.bodies.scan.mesh import Mesh, read_mesh
from seisblock.bodies.scan.polygon import convex_hull, interior_distance
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import BodyError
from seisblock.core.typing import FloatArray, IntArray

MAX_TILT = math.radians(10.0)
"""Largest levelling rotation of a scan, rad."""

MAX_ITERATIONS = 60
"""Largest number of trial planes; each improves on the one before."""

PLANE_TOLERANCE = 1e-9
"""Largest distance of a point on a plane, a share of the body's size."""


@dataclass(frozen=True, eq=False)
class RestingPose:
    """Body on level ground.

    Parameters
    ----------
    rotation : (3, 3) array
        Rotation that levels the scan.
    tilt : float, rad
        Angle of the rotation.
    ground_height : float, m
        Height of the ground, along the scan's z after the rotation.
    base : (n, 2) array, m
        Corners of the support polygon, counter-clockwise.
    touching : int
        Vertices within the tolerance of the ground.
    """

    rotation: FloatArray
    tilt: float
    ground_height: float
    base: FloatArray
    touching: int


def find_resting_pose(vertices: FloatArray, centre: FloatArray, *, tolerance: float, source: str) -> RestingPose:
    """Return the resting pose of a body on level ground nearest to its scanned position.

    The support plane is the plane below all points whose intersection with the vertical through the centre of gravity is highest: the
    face of the convex hull below the centre (derived here). The support points are those within the tolerance of that plane.

    Parameters
    ----------
    vertices : (n, 3) array, m
        z upwards.
    centre : (3,) array, m
        Centre of gravity.
    tolerance : float, m
        Largest height above the ground of a support point.
    source : str
        Name for messages.

    Raises
    ------
    BodyError
        If the body rests on a point or an edge, or its centre of gravity does not lie above its support polygon.

    Examples
    --------
    >>> corners = np.array([(x, y, z) for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 2.0)])
    >>> pose = find_resting_pose(corners, corners.mean(axis=0), tolerance=0.01, source="a box")
    >>> pose.tilt, pose.touching
    (0.0, 4)
    """
    turn, tilt = _levelling_rotation(_support_plane_slopes(vertices, centre))
    height = vertices @ turn[2]
    floor = float(height.min())
    in_contact = height - floor <= tolerance
    base = convex_hull((vertices[in_contact] @ turn.T)[:, :2])
    if not interior_distance(base, (turn @ centre)[:2]) > 0.0:
        raise BodyError(
            "{source} has no stable base: {count} point(s) within {tolerance:.3g} m of the ground do not surround the centre of "
            "gravity; change `up`, increase `tolerance`, or cut the base level",
            source=source,
            count=int(in_contact.sum()),
            tolerance=tolerance,
        )
    return RestingPose(turn, tilt, floor, base, int(in_contact.sum()))


def _support_plane_slopes(vertices: FloatArray, centre: FloatArray) -> FloatArray:
    """Return the slopes along x and y of the support plane, within the largest rotation.

    The plane t + p x + q y below all points, highest at the centre, solves a linear programme with one constraint per point, few of which
    are active: constraints violated by the last plane are added until none is (constraint generation).
    """
    from scipy.optimize import linprog

    size = float(np.ptp(vertices, axis=0).max())
    points = (vertices - centre) / size
    max_slope = math.tan(MAX_TILT)
    active_rows = {int(np.argmin(points @ (p, q, 1.0))) for p in (-max_slope, 0.0, max_slope) for q in (-max_slope, 0.0, max_slope)}
    bounds = [(-max_slope, max_slope), (-max_slope, max_slope), (None, None)]
    solution = np.zeros(3)
    for _ in range(MAX_ITERATIONS):
        rows = points[sorted(active_rows)]
        conditions = np.column_stack([rows[:, :2], np.ones(len(rows))])
        solution = linprog((0.0, 0.0, -1.0), A_ub=conditions, b_ub=rows[:, 2], bounds=bounds, method="highs").x
        clearance = points[:, 2] - points[:, :2] @ solution[:2] - solution[2]
        lowest = np.argpartition(clearance, min(8, clearance.size - 1))[:8]
        violated_rows = {int(index) for index in lowest if clearance[index] < -PLANE_TOLERANCE} - active_rows
        if not violated_rows:
            break
        active_rows |= violated_rows
    return solution[:2]


def _levelling_rotation(slopes: FloatArray) -> tuple[FloatArray, float]:
    """Return the smallest rotation that levels a plane of these slopes, and its angle, rad."""
    normal_vector = np.array([-slopes[0], -slopes[1], 1.0])
    normal = normal_vector / np.linalg.norm(normal_vector)
    tilt = math.atan2(math.hypot(normal[0], normal[1]), normal[2])
    if tilt < PLANE_TOLERANCE:
        return np.eye(3), 0.0
    from scipy.spatial.transform import Rotation

    axis = np.cross(normal, (0.0, 0.0, 1.0))
    return Rotation.from_rotvec(tilt * axis / np.linalg.norm(axis)).as_matrix(), tilt


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


DEFAULT_TOLERANCE_SHARE = 0.002
"""Default support tolerance, a share of the body's largest extent: typical roughness of a scanned plane."""


ROUND_OFF_SHARE = 1e-12
"""Products of inertia below this share of the trace are round-off."""


@dataclass(frozen=True, repr=False)
class Scan(DisplayMixin):
    """Scanned body with the properties of its scan.

    Parameters
    ----------
    body : ScannedBody
    volume : float, m^3
    density : float, kg/m^3
    tolerance : float, m
        Largest height above the ground of a support point.
    tilt : float, rad
        Angle of the levelling rotation.
    triangles, touching, pieces : int
        Numbers of triangles, support points and connected surfaces.
    size : three floats, m
        Extents along x, y and z.
    outline : pairs of floats, m
        Corners of the convex hull in plan.
    slenderness_half_tolerance, slenderness_double_tolerance : float, rad
        Smallest alpha with half and with twice the tolerance; NaN where the body overturns.
    source, sha256 : str
    unit, up : str
        Unit and upward axis of the file.
    hull_vertices : int
        Number of vertices of the mesh's convex hull, of which a part is kept if there are many.
    """

    body: ScannedBody
    volume: float
    density: float
    tolerance: float
    tilt: float
    triangles: int
    touching: int
    pieces: int
    size: Triple
    outline: tuple[Pair, ...]
    slenderness_half_tolerance: float
    slenderness_double_tolerance: float
    source: str
    sha256: str
    unit: str
    up: str
    hull_vertices: int


def scan_body(
    name: str | Path,
    *,
    density: float = DENSITY,
    inset: EdgeWear | float = SHARP_EDGES,
    tolerance: float | None = None,
    unit: str = "m",
    up: str = "z",
    facing: float = EAST,
    body_name: str | None = None,
) -> Scan:
    """Return the body of a scan: mass properties of the enclosed solid and support polygon.

    Parameters
    ----------
    name : path
        STL, PLY or OBJ file, or a bundled one: a closed triangle mesh.
    density : float, kg/m^3
        Without effect on the motion.
    inset : EdgeWear or float
        Distance of the worn edges from each side of the base: a length, or a share of the smallest base width.
    tolerance : float, m
        Largest height above the ground of a support point; default 0.002 of the largest extent.
    unit : str
        Unit of the file's coordinates: m, cm, mm, in, ft ...
    up : str
        The file's axis that points upwards: x, y, z, -x, -y or -z.
    facing : float, degrees
        Azimuth of +x, clockwise from north.
    body_name : str, optional
        Name of the body, default the file name.

    Returns
    -------
    Scan

    Raises
    ------
    BodyError
        If the file is not a mesh, the surface is not closed, or the body has no stable pose.
    ParameterError
        If a number lies outside its range.

    Examples
    --------
    >>> from seisblock.bodies import scan_body
    >>> scan = scan_body("boulder.ply")
    >>> round(scan.body.mass), round(scan.body.block_toward(0.0).slenderness, 2)
    (310, 0.22)
    """
    checks.positive("the density", density, "kg/m^3", error=BodyError)
    mesh = read_mesh(name, unit=unit, up=up)
    size = np.ptp(mesh.vertices, axis=0)
    contact_tolerance = (
        DEFAULT_TOLERANCE_SHARE * float(size.max())
        if tolerance is None
        else checks.positive("`tolerance`", tolerance, "m", error=BodyError)
    )
    properties = mass_properties(mesh)
    mass = density * properties.volume

    hull, hull_count = hull_vertices(mesh.vertices)

    def body_at_tolerance(tolerance_m: float, wear: EdgeWear) -> tuple[ScannedBody, float, int]:
        """Return the body for a tolerance, its levelling rotation and its number of support points."""
        pose = find_resting_pose(mesh.vertices, properties.centre, tolerance=tolerance_m, source=mesh.source)
        centre = pose.rotation @ properties.centre
        tensor = mass * pose.rotation @ properties.gyration @ pose.rotation.T
        tensor = 0.5 * (tensor + tensor.T)
        tensor[np.abs(tensor) < ROUND_OFF_SHARE * np.trace(tensor)] = 0.0
        top = float((mesh.vertices @ pose.rotation[2]).max())
        body = ScannedBody(
            body_name or Path(name).stem,
            mass,
            top - pose.ground_height,
            (float(centre[0]), float(centre[1]), float(centre[2]) - pose.ground_height),
            tuple(tuple(row) for row in tensor.tolist()),  # type: ignore[arg-type]
            tuple(tuple(corner) for corner in pose.base.tolist()),  # type: ignore[misc]
            wear,
            facing,
            tuple((x, y, z - pose.ground_height) for x, y, z in (hull @ pose.rotation.T).tolist()),
        )
        return body, pose.tilt, pose.touching

    def slenderness_at_tolerance(tolerance_m: float) -> float:
        """Return the smallest alpha for another tolerance."""
        try:
            return min_slenderness(body_at_tolerance(tolerance_m, SHARP_EDGES)[0])[0]
        except BodyError:
            return math.nan

    body, tilt, support_points = body_at_tolerance(contact_tolerance, inset if isinstance(inset, EdgeWear) else EdgeWear(share=inset))
    return Scan(
        body,
        properties.volume,
        density,
        contact_tolerance,
        tilt,
        len(mesh.faces),
        support_points,
        properties.pieces,
        (float(size[0]), float(size[1]), float(size[2])),
        tuple((x, y) for x, y in convex_hull(mesh.vertices[:, :2]).tolist()),
        slenderness_at_tolerance(contact_tolerance / 2),
        slenderness_at_tolerance(2 * contact_tolerance),
        mesh.source,
        mesh.sha256,
        unit,
        up,
        hull_count,
    )

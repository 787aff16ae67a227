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
from seisblock.bodies.scan.mass_properties import mass_properties
from seisblock.bodies.scan.mesh import read_mesh
from seisblock.bodies.scan.polygon import convex_hull
from seisblock.bodies.scan.resting_pose import find_resting_pose
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import BodyError

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

"""From a scanner's file to the body that stands there."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from seisblock import checks
from seisblock.bodies.block import DENSITY
from seisblock.bodies.inset import SHARP, Inset
from seisblock.bodies.scan.body import EAST, Pair, ScannedBody, Triple, weakest
from seisblock.bodies.scan.enclosed import enclosed_by
from seisblock.bodies.scan.mesh import read_mesh
from seisblock.bodies.scan.polygon import hull
from seisblock.bodies.scan.resting import resting
from seisblock.errors import BodyError

TOLERANCE = 0.002
"""How far above the ground a point may lie that carries, a share of the body's largest extent: what scanners leave of a plane."""


ROUND_OFF = 1e-12
"""A product of inertia below this share of the trace is what sums over triangles leave of zero."""


@dataclass(frozen=True)
class Scanned:
    """A body from a scan, and what the scan was like.

    Parameters
    ----------
    body : ScannedBody
    volume : float, m^3
    density : float, kg/m^3
    tolerance : float, m
        How far above the ground a point may lie that carries.
    tilt : float, rad
        By how much the scan was turned so that it rests.
    triangles, touching, pieces : int
        Triangles, vertices that touch the ground, surfaces that do not touch each other.
    size : three floats, m
        Extents along x, y and z.
    outline : pairs of floats, m
        x and y of the corners of its convex hull seen from above.
    nearer, wider : float, rad
        The least alpha with half and with twice the tolerance; NaN where it would not stand.
    source, sha256 : str
    unit, up : str
        As the file was read.
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
    nearer: float
    wider: float
    source: str
    sha256: str
    unit: str
    up: str


def scan_body(
    name: str | Path,
    *,
    density: float = DENSITY,
    inset: Inset | float = SHARP,
    tolerance: float | None = None,
    unit: str = "m",
    up: str = "z",
    facing: float = EAST,
    called: str | None = None,
) -> Scanned:
    """Return the body of a scan: mass, centre and inertia of what its surface encloses, on the polygon of the points that carry it.

    Parameters
    ----------
    name : path
        An STL, PLY or OBJ file, or a bundled one: a closed surface of triangles.
    density : float, kg/m^3
        The motion does not depend on it.
    inset : Inset or float
        How far in from each side of the base it turns: a length, or a share of the base's least width.
    tolerance : float, m
        How far above the ground a point may lie that carries; 0.002 of the largest extent when left out.
    unit : str
        Of the file's numbers, m, cm, mm, in, ft ...
    up : str
        The file's axis that points upwards: x, y, z, -x, -y or -z.
    facing : float, degrees
        Azimuth of +x, clockwise from north.
    called : str, optional
        Name of the body; that of the file when left out.

    Returns
    -------
    Scanned

    Raises
    ------
    BodyError
        If the file is no mesh, its surface is not closed, or what it encloses does not stand.
    ParameterError
        If a number lies outside its range.

    Examples
    --------
    >>> found = scan_body("boulder.ply")
    >>> round(found.body.mass), round(found.body.towards(0.0).slenderness, 2)
    (310, 0.22)
    """
    checks.positive("the density", density, "kg/m^3", error=BodyError)
    mesh = read_mesh(name, unit=unit, up=up)
    size = np.ptp(mesh.vertices, axis=0)
    near = TOLERANCE * float(size.max()) if tolerance is None else checks.positive("`tolerance`", tolerance, "m", error=BodyError)
    solid = enclosed_by(mesh)
    mass = density * solid.volume

    def standing(within: float, worn: Inset) -> tuple[ScannedBody, float, int]:
        """Return the body on the points within a tolerance, by how much it was turned, and how many points they are."""
        on = resting(mesh.vertices, solid.centre, tolerance=within, source=mesh.source)
        centre = on.turn @ solid.centre
        tensor = mass * on.turn @ solid.gyration @ on.turn.T
        tensor = 0.5 * (tensor + tensor.T)
        tensor[np.abs(tensor) < ROUND_OFF * np.trace(tensor)] = 0.0
        top = float((mesh.vertices @ on.turn[2]).max())
        body = ScannedBody(
            called or Path(name).stem,
            mass,
            top - on.floor,
            (float(centre[0]), float(centre[1]), float(centre[2]) - on.floor),
            tuple(tuple(row) for row in tensor.tolist()),  # type: ignore[arg-type]
            tuple(tuple(corner) for corner in on.base.tolist()),  # type: ignore[misc]
            worn,
            facing,
        )
        return body, on.tilt, on.touching

    def least(within: float) -> float:
        """Return the least alpha with another tolerance."""
        try:
            return weakest(standing(within, SHARP)[0])[0]
        except BodyError:
            return math.nan

    body, tilt, touching = standing(near, inset if isinstance(inset, Inset) else Inset(share=inset))
    return Scanned(
        body,
        solid.volume,
        density,
        near,
        tilt,
        len(mesh.faces),
        touching,
        solid.pieces,
        (float(size[0]), float(size[1]), float(size[2])),
        tuple((x, y) for x, y in hull(mesh.vertices[:, :2]).tolist()),
        least(near / 2),
        least(2 * near),
        mesh.source,
        mesh.sha256,
        unit,
        up,
    )

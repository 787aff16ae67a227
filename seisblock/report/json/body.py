"""JSON document of ``seisblock body``."""

from __future__ import annotations

import math

import numpy as np
from msgspec import Struct

from seisblock.bodies.scan.azimuths import ScanAzimuth
from seisblock.bodies.scan.body import Pair, Triple, min_slenderness
from seisblock.bodies.scan.qc import scan_qc_messages
from seisblock.bodies.scan.scan import Scan
from seisblock.output.json.schema import Document, DocumentSchema, Result, fill
from seisblock.references import papers


class BodyParameters(Struct, frozen=True, kw_only=True):
    """Parameters of the command.

    Parameters
    ----------
    density_kg_m3 : float
    tolerance_m : float
        Largest height above the ground of a contact point.
    inset_m : float
        Inset of the rotation lines from each side of the base.
    unit, up : str
        Of the file's numbers, and its axis that points upwards.
    facing_deg : float
        Azimuth of +x.
    step_deg : float
        Between azimuths.
    gravity_m_s2 : float
    """

    density_kg_m3: float
    tolerance_m: float
    inset_m: float
    unit: str
    up: str
    facing_deg: float
    step_deg: float
    gravity_m_s2: float


class ScanResult(Result, frozen=True, kw_only=True):
    """One scanned body; x and y as in the scan, z above the ground.

    Parameters
    ----------
    name : str
    source, sha256 : str
        The file, and its digest.
    triangles_count, touching_count, pieces_count : int
        Triangles; vertices that touch the ground; surfaces that do not touch each other.
    size_m : three floats
        Extents of the file.
    volume_m3, mass_kg, height_m : float
    centre_m : three floats
        Centre of gravity.
    inertia_kg_m2 : three rows of three floats
        Tensor about it.
    tilt_deg : float
        Rotation of the scan to its rest position.
    base_m, carrying_m : list of pairs
        Corners of the base polygon, sharp and with worn edges; counter-clockwise.
    base_area_m2 : float
        Within its worn edges.
    slenderness_rad, slenderness_azimuth_deg : float
        Smallest overturning angle alpha, and its azimuth.
    slenderness_interval_rad : list of two floats or None
        Smallest alpha of sharp edges with half and with twice the tolerance; null if unstable.
    directions : list
        By azimuth, from north.
    """

    name: str
    source: str
    sha256: str
    triangles_count: int
    touching_count: int
    pieces_count: int
    size_m: Triple
    volume_m3: float
    mass_kg: float
    height_m: float
    centre_m: Triple
    inertia_kg_m2: tuple[Triple, Triple, Triple]
    tilt_deg: float
    base_m: tuple[Pair, ...]
    carrying_m: tuple[Pair, ...]
    base_area_m2: float
    slenderness_rad: float
    slenderness_azimuth_deg: float
    slenderness_interval_rad: tuple[float | None, float | None]
    directions: list[ScanAzimuth]


BODY = DocumentSchema("body", BodyParameters, ScanResult)


def document(scan: Scan, directions: list[ScanAzimuth], *, step_deg: float, gravity: float) -> Document:
    """Return the document of a scan."""
    body = scan.body
    x, y = body.support_polygon.T
    result = fill(
        ScanResult,
        body,
        scan,
        source=scan.source.replace("\\", "/").rsplit("/", 1)[-1],
        triangles_count=scan.triangles,
        touching_count=scan.touching,
        pieces_count=scan.pieces,
        tilt_deg=math.degrees(scan.tilt),
        carrying_m=tuple((point[0], point[1]) for point in body.support_polygon.tolist()),
        base_area_m2=0.5 * float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y)),
        slenderness_rad=min_slenderness(body)[0],
        slenderness_azimuth_deg=min_slenderness(body)[1],
        slenderness_interval_rad=(_finite_or_none(scan.slenderness_half_tolerance), _finite_or_none(scan.slenderness_double_tolerance)),
        directions=directions,
    )
    parameters = fill(BodyParameters, body, scan, facing_deg=body.facing, step_deg=step_deg, gravity_m_s2=gravity)
    return BODY.document(parameters, [(None, result)], citations=papers("a scan's arms"), warnings=scan_qc_messages(scan))


def _finite_or_none(value: float) -> float | None:
    return None if math.isnan(value) else value

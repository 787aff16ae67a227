"""Make the bundled scan again: ``python -m tests.make_boulder`` writes boulder.ply and boulder.toml into sample_records/.

A synthetic boulder of 0.9 m: an egg with bumps of low order, on a base that is level to the millimetre, as a scanner leaves one. Its
surface is known in closed form, so that tests can measure what it encloses without its triangles.
"""

from __future__ import annotations

import struct

import numpy as np
from scipy.spatial import ConvexHull

from seisblock.bodies.scan.scan import scan_body
from seisblock.bodies.scan.toml import scan_to_toml
from seisblock.samples import sample_directory

VERTICES = 1500
SEED = 20161114
EGG = np.array([0.27, 0.22, 0.50])
"""Half axes, m."""

CUT = 0.42
"""Depth of the base below the middle, m."""


def sphere(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return points spread evenly over the unit sphere, and triangles between them, counter-clockwise seen from outside."""
    steps = np.arange(count) + 0.5
    polar, round_about = np.arccos(1.0 - 2.0 * steps / count), np.pi * (1.0 + np.sqrt(5.0)) * steps
    points = np.column_stack([np.cos(round_about) * np.sin(polar), np.sin(round_about) * np.sin(polar), np.cos(polar)])
    faces = ConvexHull(points).simplices
    a, b, c = (points[faces[:, corner]] for corner in range(3))
    inwards = np.einsum("ij,ij->i", a, np.cross(b, c)) < 0.0
    faces[inwards] = faces[inwards][:, [0, 2, 1]]
    return points, faces


def bumpy(towards: np.ndarray) -> np.ndarray:
    """Return the points of the boulder's surface in some directions, before its base is cut, m."""
    rng = np.random.default_rng(SEED)
    share = np.ones(len(towards))
    for order in (1.5, 2.5, 4.0):
        for _ in range(4):
            share += 0.05 / order * np.sin(order * towards @ rng.normal(size=3) + rng.uniform(0.0, 2.0 * np.pi))
    return towards * EGG * share[:, None]


def boulder() -> tuple[np.ndarray, np.ndarray]:
    """Return vertices and triangles of the boulder; those below the cut are pushed up to it, and left as rough as a scan."""
    towards, faces = sphere(VERTICES)
    points = bumpy(towards)
    low = points[:, 2] < -CUT
    points[low, 2] = -CUT + 1e-3 * np.random.default_rng(SEED + 1).uniform(size=int(low.sum()))
    return points + np.array([0.0, 0.0, CUT]), faces


def main() -> None:
    """Write both files."""
    points, faces = boulder()
    head = (
        "ply\nformat binary_little_endian 1.0\ncomment synthetic, not a scan: tests/make_boulder.py of seisblock\n"
        f"element vertex {len(points)}\nproperty float x\nproperty float y\nproperty float z\n"
        f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    triangles = b"".join(struct.pack("<B3i", 3, *face) for face in faces.tolist())
    path = sample_directory() / "boulder.ply"
    path.write_bytes(head.encode() + points.astype("<f4").tobytes() + triangles)
    (sample_directory() / "boulder.toml").write_text(scan_to_toml(scan_body(path)), encoding="utf-8")


if __name__ == "__main__":
    main()

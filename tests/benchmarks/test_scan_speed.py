"""A scan of a million triangles: how long a body is in the making."""

import numpy as np
import pytest

from seisblock.bodies.scan.mesh import Mesh, read_mesh
from seisblock.bodies.scan.polygon import convex_hull
from seisblock.bodies.scan.scan import find_resting_pose, mass_properties
from tests.bodies.meshes import frustum, write_stl

SIDES = 250_000


@pytest.fixture(scope="module")
def million_triangles(tmp_path_factory):
    """Return the file of a frustum of a million triangles, rough to a tenth of a millimetre."""
    vertices, faces = frustum(SIDES, 0.3, 0.25, 0.9)
    return write_stl(
        tmp_path_factory.mktemp("scan") / "scan.stl", vertices + 1e-4 * np.random.default_rng(1).uniform(size=vertices.shape), faces
    )


@pytest.mark.slow
def test_read_mesh_of_a_million_triangles(benchmark, million_triangles):
    """From the file to shared vertices."""
    mesh = benchmark.pedantic(read_mesh, (million_triangles,), rounds=1, warmup_rounds=0)
    assert len(mesh.faces) > 0.9e6


def test_scan_body_of_a_million_triangles(benchmark):
    """Closed or not, volume, inertia, resting plane and base."""
    mesh = Mesh(*frustum(SIDES, 0.3, 0.25, 0.9))

    def body():
        properties = mass_properties(mesh)
        return (
            properties,
            find_resting_pose(mesh.vertices, properties.centre, tolerance=1e-3, source="a scan"),
            convex_hull(mesh.vertices[:, :2]),
        )

    result, on, outline = benchmark.pedantic(body, rounds=1, warmup_rounds=0)
    assert result.volume == pytest.approx(np.pi * 0.9 * (0.3**2 + 0.3 * 0.25 + 0.25**2) / 3.0, rel=1e-6)
    assert on.touching == SIDES + 1 and 1000 < len(outline) < 10_000

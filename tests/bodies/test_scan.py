"""Bodies from scans: what a surface encloses, on what it stands, and how it turns towards each azimuth, against closed forms."""

import math
import re

import numpy as np
import pytest
from numpy.polynomial import Polynomial
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

from seisblock import Block, Motion, motion_of, read, solve_rock
from seisblock.bodies.convex import ConvexBody, convex_body
from seisblock.bodies.edge_wear import EdgeWear
from seisblock.bodies.factory import block_for_motion, load_block
from seisblock.bodies.scan.azimuths import scan_azimuths
from seisblock.bodies.scan.body import ScannedBody, min_slenderness
from seisblock.bodies.scan.hull import HULL_TOLERANCE_SHARE, hull_vertices
from seisblock.bodies.scan.mesh import AXIS_ROTATIONS, Mesh, read_mesh
from seisblock.bodies.scan.polygon import convex_hull, interior_distance, min_width, offset_polygon, support_distance
from seisblock.bodies.scan.qc import scan_qc_messages
from seisblock.bodies.scan.scan import mass_properties, scan_body
from seisblock.bodies.scan.toml import load_scan, scan_from_table, scan_to_toml
from seisblock.bodies.toml import read_body_toml
from seisblock.core.errors import BodyError, ComponentError, InputError
from seisblock.models.rigid3d.describe import contact_summary
from seisblock.samples import sample_directory
from tests import make_boulder
from tests.bodies.meshes import box, frustum, write_obj, write_ply, write_stl

NUMBER = re.compile(r"-?\d+\.\d+(?:e[-+]?\d+)?")
EXACT = 1e-12
"""Sums of some hundred terms, relative."""


def polygon_properties(sides, radius):
    """Return area, and second moment about a line through the middle, of a regular polygon."""
    turn = 2.0 * math.pi / sides
    return 0.5 * sides * radius**2 * math.sin(turn), sides * radius**4 / 24.0 * math.sin(turn) * (2.0 + math.cos(turn))


@pytest.mark.parametrize(
    ("below", "above"), [(0.3, 0.3), (0.3, 0.1), (0.25, 0.0), (0.1, 0.3)], ids=["cylinder", "frustum", "cone", "upside down"]
)
@pytest.mark.parametrize("sides", [3, 4, 17, 300])
def test_scan_volume_centre_and_inertia_of_frusta(sides, below, above):
    """Volume, centre and inertia of prisms, frusta and cones over regular polygons are integrals of polynomials in z."""
    height, distant = 0.9, np.array([3.0, -2.0, 5.0])
    vertices, faces = frustum(sides, below, above, height)
    used = np.unique(faces)
    properties = mass_properties(Mesh(*_merge_vertices(vertices[used] + distant, np.searchsorted(used, faces))))
    z = Polynomial([0.0, 1.0])
    radius = below + (above - below) / height * z
    area, moment = polygon_properties(sides, 1.0)
    volume = (area * radius**2).integ()(height)
    centre = (area * radius**2 * z).integ()(height) / volume
    across = (moment * radius**4).integ()(height) / volume
    along_z = (area * radius**2 * (z - centre) ** 2).integ()(height) / volume
    assert properties.volume == pytest.approx(volume, rel=EXACT * 1e3)
    assert properties.centre - distant == pytest.approx((0.0, 0.0, centre), abs=1e-12)
    expected = np.diag([across + along_z, across + along_z, 2.0 * across])
    assert properties.gyration == pytest.approx(expected, abs=1e-12)
    assert properties.pieces == 1


def _merge_vertices(vertices, faces):
    """Return a mesh without the doubled apex of a cone."""
    _, first, number = np.unique(vertices.round(12), axis=0, return_index=True, return_inverse=True)
    corners = number.reshape(-1)[faces]
    full = [len(set(face)) == 3 for face in corners.tolist()]
    return vertices[first], corners[full]


@pytest.fixture(scope="module")
def box_scan(tmp_path_factory):
    """Return the body of a box of 0.3 x 0.4 x 0.9 m with a density of 2000 kg/m^3."""
    path = write_ply(tmp_path_factory.mktemp("box") / "box.ply", *box(0.3, 0.4, 0.9))
    return scan_body(path, density=2000.0)


def test_scanned_box_equals_block_along_its_sides(box_scan):
    """+x is east: towards 90 degrees it is as wide as along x. Mass, centre, inertia, alpha and p are those of the rectangle."""
    for azimuth, width, depth in ((90.0, 0.3, 0.4), (0.0, 0.4, 0.3), (270.0, 0.3, 0.4), (180.0, 0.4, 0.3)):
        result, expected = box_scan.body.block_toward(azimuth), Block(width, 0.9, depth, density=2000.0)
        assert result.total_mass == pytest.approx(expected.total_mass, rel=EXACT)
        for name in ("arms", "radii", "slendernesses", "corner_inertias", "lever_ratios", "restitutions"):
            assert getattr(result, name) == pytest.approx(getattr(expected, name), rel=EXACT), name
        assert result.frequency_parameter() == pytest.approx(math.sqrt(3.0 * 9.80665 / (4.0 * math.hypot(width, 0.9) / 2.0)), rel=EXACT)


@pytest.mark.parametrize("sides", [4, 12])
def test_zero_products_of_inertia_are_exactly_zero(sides, tmp_path):
    """Sums over triangles leave 1e-18 of round-off, which was reported as a value."""
    path = write_ply(tmp_path / "body.ply", *frustum(sides, 0.3, 0.1, 0.9))
    inertia = np.array(scan_body(path).body.inertia)
    assert (inertia[~np.eye(3, dtype=np.bool_)] == 0.0).all() and (np.diag(inertia) > 1.0).all()


@pytest.mark.parametrize("azimuth", [13.0, 45.0, 100.0, 222.0, 359.0])
def test_scanned_box_pivots_at_corner_between_sides(box_scan, azimuth):
    """The arm is the reach of the corner, the inertia that about a level line: of a box turned by an angle both are closed forms."""
    angle = math.radians(90.0 - azimuth)
    c, s = abs(math.cos(angle)), abs(math.sin(angle))
    result = box_scan.body.block_toward(azimuth)
    mass = 2000.0 * 0.3 * 0.4 * 0.9
    assert result.arms == pytest.approx(((0.3 * c + 0.4 * s) / 2,) * 2, rel=EXACT)
    about_y, about_x = mass * (0.3**2 + 0.9**2) / 12, mass * (0.4**2 + 0.9**2) / 12
    assert result.gyration_squared * mass == pytest.approx(about_y * c * c + about_x * s * s, rel=1e-11)


def test_facing_rotates_the_body(box_scan):
    """A body and a motion both turned by 40 degrees give the same response."""
    rotated = ScannedBody(**{**vars_of(box_scan.body), "facing": 130.0})
    for azimuth in (0.0, 17.0, 200.0):
        before, after = box_scan.body.block_toward(azimuth), rotated.block_toward(azimuth + 40.0)
        assert before.arms == pytest.approx(after.arms, rel=1e-12) and before.gyration_squared == pytest.approx(
            after.gyration_squared, rel=1e-12
        )


def vars_of(body):
    """Return the fields of a body."""
    return {name: getattr(body, name) for name in ScannedBody.__dataclass_fields__}


@pytest.mark.parametrize("write", [write_stl, write_obj, write_ply])
def test_scan_formats_agree(write, tmp_path):
    """STL (single precision, no shared vertices), OBJ and PLY hold the same box; millimetres are a thousandth of metres."""
    vertices, faces = box(300.0, 400.0, 900.0)
    path = write(tmp_path / f"box.{write.__name__[-3:]}", vertices, faces)
    mesh = read_mesh(path, unit="mm")
    assert len(mesh.vertices) == 10 and len(mesh.faces) == 16
    assert mass_properties(mesh).volume == pytest.approx(0.108, rel=1e-7)


@pytest.mark.parametrize("up", AXIS_ROTATIONS)
def test_scan_accepts_any_up_axis(up, tmp_path):
    """Whatever axis is up, volume and height are the same, nothing is mirrored, and the body stands."""
    vertices, faces = frustum(5, 0.3, 0.2, 0.8, sheared=(0.05, 0.02))
    shuffled = np.empty_like(vertices)
    for column, (axis, sign) in enumerate(AXIS_ROTATIONS[up]):
        shuffled[:, axis] = sign * vertices[:, column]
    remaining = 1 if up.endswith("x") else 0
    assert AXIS_ROTATIONS[up][remaining] == (remaining, 1)
    body = scan_body(write_ply(tmp_path / "body.ply", shuffled, faces), up=up).body
    upright = scan_body(write_ply(tmp_path / "upright.ply", vertices, faces)).body
    assert body.centre == pytest.approx(upright.centre, abs=1e-12)
    assert body.block_toward(77.0).arms == pytest.approx(upright.block_toward(77.0).arms, abs=1e-12)


def test_tilted_scan_is_levelled(tmp_path, box_scan):
    """A box turned by 4 degrees about any level axis rests on its base again; the turn is reported."""
    vertices, faces = box(0.3, 0.4, 0.9)
    leaning = vertices @ Rotation.from_rotvec(math.radians(4.0) * np.array([math.cos(1.0), math.sin(1.0), 0.0])).as_matrix().T
    scan = scan_body(write_ply(tmp_path / "leaning.ply", leaning + 0.7, faces), density=2000.0)
    assert math.degrees(scan.tilt) == pytest.approx(4.0, abs=1e-6)
    assert scan.body.height == pytest.approx(0.9, abs=1e-8)
    assert min_slenderness(scan.body)[0] == pytest.approx(min_slenderness(box_scan.body)[0], abs=1e-7)
    assert np.array(scan.body.inertia) == pytest.approx(np.array(box_scan.body.inertia), abs=1e-6)
    assert any("turned by 4°" in doubt for doubt in scan_qc_messages(scan))


def test_base_is_hull_of_contact_points(tmp_path):
    """The base is the hull of what touches: a box whose base is hollow but for its rim stands as a box does."""
    vertices, faces = box(0.3, 0.4, 0.9)
    vertices[8, 2] = 0.05  # the middle of the base
    assert scan_body(write_ply(tmp_path / "hollow.ply", vertices, faces)).touching == 4
    scan = scan_body(write_ply(tmp_path / "hollow.ply", vertices, faces)).body
    assert scan.block_toward(90.0).arms == pytest.approx((0.15, 0.15), rel=1e-9)


def test_base_tolerance_selects_contact_points(tmp_path):
    """A foot 3 mm short carries with a tolerance of 4 mm, and not with one of 1 mm: then three others do, as a table rocks."""
    vertices, faces = frustum(8, 0.3, 0.3, 0.6)
    vertices[0, 2] = 0.003
    path = write_ply(tmp_path / "short.ply", vertices, faces)
    wide, narrow = (scan_body(path, tolerance=tolerance).body for tolerance in (0.004, 0.001))
    assert wide.block_toward(90.0).arms[0] == pytest.approx(0.3, abs=1e-3)
    assert narrow.block_toward(90.0).arms[0] == pytest.approx(0.3 * math.cos(math.pi / 4.0), abs=1e-3)
    assert "depends on the tolerance" in " ".join(scan_qc_messages(scan_body(path, tolerance=0.002)))


def test_irregular_scan_equals_grid_integration():
    """A boulder of 40 000 vertices against its own inequality at a million points: volume, centre and inertia to 0.5 %."""
    towards, faces = make_boulder.sphere(40_000)
    points = make_boulder.bumpy(towards)
    points[:, 2] = np.maximum(points[:, 2], -make_boulder.CUT)
    properties = mass_properties(Mesh(points, faces))
    spacing = 0.011
    axes = [np.arange(low + spacing / 2, high, spacing) for low, high in zip(points.min(axis=0), points.max(axis=0), strict=True)]
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    scaled = grid / make_boulder.EGG
    away = np.linalg.norm(scaled, axis=1)
    surface = np.linalg.norm(make_boulder.bumpy(scaled / away[:, None]) / make_boulder.EGG, axis=1)
    inside = grid[(away <= surface) & (grid[:, 2] >= -make_boulder.CUT)]
    assert properties.volume == pytest.approx(len(inside) * spacing**3, rel=5e-3)
    assert properties.centre == pytest.approx(inside.mean(axis=0), abs=1e-3)
    spread = np.cov(inside.T, bias=True)
    assert properties.gyration == pytest.approx(np.trace(spread) * np.eye(3) - spread, abs=5e-3 * np.trace(spread))


@pytest.mark.parametrize("sides", [3, 4, 7, 60])
def test_inset_of_regular_polygon_is_similar(sides):
    """Moving all sides inwards leaves a similar polygon; its corners move by more than its sides."""
    turn = 2.0 * np.pi * np.arange(sides) / sides
    corners = np.column_stack([np.cos(turn), np.sin(turn)])
    left = offset_polygon(corners, 0.1)
    share = 1.0 - 0.1 / math.cos(math.pi / sides)
    assert len(left) == sides
    assert np.sort(np.linalg.norm(left, axis=1)) == pytest.approx(np.full(sides, share), rel=1e-9)
    assert interior_distance(left, (0.0, 0.0)) == pytest.approx(math.cos(math.pi / sides) - 0.1, rel=1e-9)


def test_hull_keeps_extreme_points():
    """Of random points all corners; of a round base as many as a millionth of its size asks for, not one for each of its vertices."""
    rng = np.random.default_rng(3)
    towards = np.stack([np.cos(np.arange(0.0, 6.3, 0.01)), np.sin(np.arange(0.0, 6.3, 0.01))])
    for points in (rng.normal(size=(20_000, 2)), rng.uniform(size=(300, 2))):
        assert (convex_hull(points) @ towards).max(axis=0) == pytest.approx((points @ towards).max(axis=0), abs=1e-6 * np.ptp(points))
    turn = np.linspace(0.0, 2.0 * np.pi, 30_000, endpoint=False)
    ring = np.column_stack([np.cos(turn), np.sin(turn)])
    corners = convex_hull(ring)
    assert 500 < len(corners) < 5000
    assert (corners @ towards).max(axis=0) == pytest.approx(np.ones(towards.shape[1]), abs=1e-5)
    assert len(convex_hull([(0.0, 0.0), (1.0, 1.0), (2.0, 2.0)])) < 3


def test_inset_may_remove_a_side():
    """A short side between two long ones vanishes with the inset; beyond the deepest point nothing remains."""
    roof = convex_hull([(-2.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.9, 1.1), (-2.0, 1.1)])
    assert len(offset_polygon(roof, 0.2)) == 4 and len(roof) == 5
    assert len(offset_polygon(roof, 0.6)) == 0
    assert min_width(roof) == pytest.approx(1.1)
    assert support_distance(roof, (0.0, 1.0)) == pytest.approx(1.1)


def test_inset_moves_every_side_of_base(box_scan):
    """10 mm in: arms shrink by 10 mm towards sides, by more towards corners; a share is one of the least width, 0.3 m."""
    worn = box_scan.body.with_wear(EdgeWear(length_m=0.01))
    assert worn.block_toward(90.0).arms == pytest.approx((0.14, 0.14), rel=EXACT)
    assert worn.block_toward(45.0).arms == pytest.approx(((0.28 + 0.38) / 2 / math.sqrt(2.0),) * 2, rel=EXACT)
    assert worn.block_toward(90.0).inset == pytest.approx(0.01, rel=1e-9)
    assert box_scan.body.with_wear(0.1).inset_m == pytest.approx(0.03, rel=EXACT)
    with pytest.raises(BodyError, match="exceeds the distance of the centre of gravity"):
        box_scan.body.with_wear(EdgeWear(length_m=0.16))


def test_opposite_azimuth_swaps_sides_of_block():
    """Arms and restitutions change sides, mass and inertia stay: the two sides of a boulder differ."""
    body = load_scan("boulder")
    for azimuth in (0.0, 33.0, 120.0):
        first, behind = body.block_toward(azimuth), body.block_toward(azimuth + 180.0)
        assert first.arms == pytest.approx(behind.arms[::-1], rel=1e-12)
        assert first.restitutions == pytest.approx(behind.restitutions[::-1], rel=1e-12)
        assert abs(first.arms[0] - first.arms[1]) > 1e-3


def test_azimuth_table_equals_blocks():
    """b, alpha, R, I_O, p and the threshold towards an azimuth are those of the block's right corner; the least alpha is among them."""
    body = load_scan("boulder").with_wear(0.05)
    around = scan_azimuths(body, step_deg=1.0)
    for item in around[::37]:
        block = body.block_toward(item.azimuth_deg)
        assert (item.arm_m, item.slenderness_rad, item.radius_m) == (block.arms[0], block.slendernesses[0], block.radii[0])
        inertia = block.gyration_squared * body.mass + body.mass * item.radius_m**2
        assert item.pivot_inertia_kg_m2 == pytest.approx(inertia, rel=1e-12)
        assert item.frequency_parameter_rad_s == pytest.approx(math.sqrt(body.mass * 9.80665 * item.radius_m / inertia), rel=1e-12)
        assert item.threshold_m_s2 == pytest.approx(9.80665 * math.tan(item.slenderness_rad), rel=1e-12)
    alpha, azimuth = min_slenderness(body)
    minimum = min(around, key=lambda entry: entry.slenderness_rad)
    assert alpha <= minimum.slenderness_rad == pytest.approx(alpha, rel=1e-3)
    assert abs(azimuth - minimum.azimuth_deg) <= 1.0


def test_scanned_box_rocks_like_block(box_scan):
    """Towards its side, a scanned box leans, hits and falls as the block of its sizes, at the same times."""
    pulse = Motion.from_arrays(4.2 * np.sin(np.linspace(0.0, 4.0 * np.pi, 401)), 0.01, name="90")
    scanned = solve_rock(block_for_motion(box_scan.body, pulse), pulse).outcome
    result = solve_rock(Block(0.3, 0.9), pulse).outcome
    assert scanned.rocks and scanned.impacts == result.impacts
    assert scanned.max_rotation_rad == pytest.approx(result.max_rotation_rad, rel=1e-9)


def test_scan_requires_azimuth_of_motion():
    """An azimuth or the code of a component defines +x; a motion of bare numbers does not, and a scan rejects it."""
    record = read("synthetic_jma.csv")
    assert [motion_of(record, name).azimuth_deg for name in ("NS", "EW", "37")] == [0.0, 90.0, 37.0]
    body, bare = load_scan("boulder"), Motion.from_arrays([0.0, 1.0], 0.01)
    assert body.block_for_motion(motion_of(record, "EW")) == body.block_toward(90.0)
    assert bare.azimuth_deg is None
    with pytest.raises(ComponentError, match="depend on the azimuth"):
        block_for_motion(body, bare)
    assert block_for_motion(load_block("gravestone"), bare) == load_block("gravestone")


def test_scan_body_round_trips_through_toml(tmp_path):
    """Every number of the TOML keeps its digits; a name with quotation marks is one."""
    scan = scan_body("boulder.ply", inset=EdgeWear(length_m=0.004), facing=12.5, body_name='a "stone" \\ 石')
    path = tmp_path / "stone.toml"
    path.write_text(scan_to_toml(scan), encoding="utf-8")
    assert load_scan(path) == scan.body
    content = (make_boulder.sample_directory() / "boulder.toml").read_text(encoding="utf-8")
    now, then = ("".join(text.splitlines(keepends=True)[1:20]) for text in (scan_to_toml(scan_body("boulder.ply")), content))
    assert NUMBER.sub("#", now) == NUMBER.sub("#", then)
    # sums of thousands of facets end otherwise in the last digits on another processor
    np.testing.assert_allclose([float(n) for n in NUMBER.findall(now)], [float(n) for n in NUMBER.findall(then)], rtol=1e-9, atol=1e-12)


BOX = box(0.3, 0.4, 0.9)


def faulty_box(quantity):
    """Return vertices and faces of a box of which something is wrong."""
    vertices, faces = BOX[0].copy(), BOX[1].copy()
    if quantity == "open":
        return vertices, faces[1:]
    if quantity == "inside out":
        return vertices, faces[:, ::-1]
    if quantity == "in part":
        faces[3] = faces[3, ::-1]
    if quantity == "meets itself":
        return np.concatenate([vertices, vertices[:2], [[0.3, 0.4, 0.9]]]), np.concatenate([faces, np.array([[0, 1, 12], [1, 0, 12]])])
    if quantity == "flat":
        vertices[:, 2] *= 1e-11
    if quantity == "a point":
        vertices, faces = frustum(12, 0.3, 0.0, 0.8)
        vertices = vertices * (1.0, -1.0, -1.0)
    if quantity == "top-heavy":
        vertices, faces = frustum(12, 0.1, 0.1, 0.8, sheared=(0.25, 0.0))
    if quantity == "not a number":
        vertices[3, 1] = np.nan
    return vertices, faces


@pytest.mark.parametrize(
    ("quantity", "told_so"),
    [
        ("open", "is open: 3 edges"),
        ("inside out", "is inside out: its triangles are clockwise"),
        ("in part", "has inconsistent normals: two triangles with opposite orientation at 3 edges"),
        ("meets itself", "is not manifold: 1 edges belong to more than two"),
        ("flat", "encloses no volume"),
        ("a point", "has no stable base"),
        ("top-heavy", "has no stable base"),
        ("not a number", "not finite numbers"),
    ],
)
def test_scan_rejects_invalid_surfaces(quantity, told_so, tmp_path):
    """Open, inside out, non-manifold, flat, on its tip, top-heavy, not finite: each in its own sentence."""
    with pytest.raises(BodyError, match=told_so):
        scan_body(write_ply(tmp_path / "wrong.ply", *faulty_box(quantity)))


@pytest.mark.parametrize(
    ("name", "data", "told_so"),
    [
        ("empty.stl", b"", "is empty"),
        ("words.stl", b"hello " * 40, "contains no triangles"),
        ("words.ply", b"hello " * 40, "is damaged or not a mesh"),
        ("words.obj", b"hello " * 40, "contains no triangles"),
        ("far.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "is damaged"),
        ("cut.ply", b"ply\nformat binary_little_endian 1.0\nelement vertex 9\nproperty float x\nend_header\n\0", "is damaged"),
        ("shape.step", b"ISO", "the file name of a mesh must end in"),
    ],
)
def test_scan_rejects_other_files(name, data, told_so, tmp_path):
    """Empty, other words, damaged, another format."""
    (tmp_path / name).write_bytes(data)
    with pytest.raises(BodyError, match=told_so):
        read_mesh(tmp_path / name)


def test_scan_limits_bytes_and_triangles(tmp_path, monkeypatch):
    """Bytes and triangles, each with the variable that lifts it; counted before a triangle is made."""
    monkeypatch.setattr("seisblock.bodies.scan.mesh.MAX_TRIANGLES", 10)
    for write in (write_ply, write_obj, write_stl):
        path = write(tmp_path / f"box.{write.__name__[-3:]}", *BOX)
        with monkeypatch.context() as patch:
            patch.setattr("seisblock.bodies.scan.mesh._load_triangles", None)
            with pytest.raises(BodyError, match=r"16 triangles exceed the limit of 10: .* SEISBLOCK_LIMIT_FACTOR"):
                read_mesh(path)
    monkeypatch.setenv("SEISBLOCK_MEMORY_MIB", "1")
    path.write_bytes(path.read_bytes() + bytes(2**21))
    with pytest.raises(BodyError, match="SEISBLOCK_MEMORY_MIB"):
        read_mesh(path)


def test_scan_flags_implausible_unit():
    """A gravestone of 300 m, and one of 1 mm."""
    for unit in ("km", "mm"):
        assert any("mesh files do not state their unit" in doubt for doubt in scan_qc_messages(scan_body("boulder.ply", unit=unit)))
    assert not any("unit" in doubt for doubt in scan_qc_messages(scan_body("boulder.ply", inset=0.1)))


def test_scan_without_inset_warns_of_sharp_edges():
    """A scan without an inset warns of sharp edges (two granite rocks); with one it does not."""
    assert "1.4 to 2.5 times" in " ".join(scan_qc_messages(scan_body("boulder.ply")))
    assert list(scan_qc_messages(scan_body("boulder.ply", inset=0.1))) == []


def test_scan_reports_separate_surfaces(tmp_path):
    """A second, separate surface is reported; an unused vertex is not."""
    vertices, faces = BOX
    target = write_ply(
        tmp_path / "both.ply", np.concatenate([vertices, vertices * 0.1 + (0.0, 0.0, 1.2)]), np.concatenate([faces, faces + 10])
    )
    assert any("2 separate surfaces" in doubt for doubt in scan_qc_messages(scan_body(target)))
    stray = write_ply(tmp_path / "stray.ply", np.concatenate([vertices, [[0.0, 0.0, -9.0]]]), faces)
    assert scan_body(stray).body.height == pytest.approx(0.9, rel=EXACT)


@pytest.mark.parametrize(
    ("change", "told_so"),
    [
        ({"mass": -1.0}, "mass must be positive"),
        ({"height": "x"}, "height"),
        ({"centre": [0.0, 0.0]}, "centre must have 3 numbers"),
        ({"centre": [0.0, 0.0, 2.0]}, "between the ground and the top"),
        ({"centre": [1.0, 0.0, 0.4]}, "does not lie above the base"),
        ({"inertia": [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]}, "symmetric 3 x 3 matrix"),
        ({"inertia": [[9.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]}, "principal moments"),
        ({"inertia": 3}, "must be a list of rows"),
        ({"base": [[0.0, 0.0], [1.0, 0.0]]}, "three corners or more"),
        ({"base": [[-0.2, -0.2], [-0.2, 0.2], [0.2, 0.2], [0.2, -0.2]]}, "counter-clockwise"),
        ({"base": [[-0.2, -0.2], [0.2, -0.2], [0.0, 0.1], [0.2, 0.2], [-0.2, 0.2]]}, "convex"),
        ({"inset": "1m"}, "exceeds the distance of the centre of gravity"),
        ({"facing": "north"}, "facing"),
        ({"turned": 3}, "unknown entries"),
    ],
)
def test_scan_body_toml_rejects_errors(change, told_so):
    """Each slip in the TOML of a body is one sentence."""
    with pytest.raises(InputError, match=told_so):
        scan_from_table({**read_body_toml("boulder"), **change})


def test_functions_of_one_block_reject_scan():
    """Functions that need one block for all directions reject a scan and name the missing azimuth."""
    with pytest.raises(BodyError, match="dimensions depend on the azimuth"):
        load_block("boulder")
    with pytest.raises(BodyError, match='kind must be "scan"'):
        load_scan("gravestone")


def test_read_body_toml_names_the_command_that_makes_a_body_of_a_mesh():
    with pytest.raises(BodyError, match="is a mesh: give the TOML file that `seisblock body` writes"):
        read_body_toml(sample_directory() / "boulder.ply")


def test_contact_summary_compares_contacts_with_the_support_polygon():
    """A rough scan stands on three vertices, whose triangle is nearer to the centre of gravity than the polygon within the tolerance."""
    text = str(contact_summary(convex_body(load_scan("boulder"))))
    assert "stands on 3 of 1097 hull vertices" in text
    assert re.search(r"0\.3 cm \(contacts\), 7\.9 cm \(support polygon", text), text
    assert "stands on 4 of 8 hull vertices" in str(contact_summary(ConvexBody.box(0.3, 0.3, 0.9)))


def dome(count):
    """Return points on the upper part of a sphere of radius 1, and on the circle of its flat base."""
    points = np.random.default_rng(count).normal(size=(count, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    angles = np.linspace(0.0, 2.0 * math.pi, 200, endpoint=False)
    rim = 0.8 * np.column_stack([np.cos(angles), np.sin(angles), np.full(200, -0.75)])
    return np.vstack([points[points[:, 2] > -0.6], rim])


def test_fine_hull_is_reduced_within_its_tolerance():
    """Each vertex left out lies within the tolerance of the planes of the others; a hull of up to 2000 vertices is whole."""
    points = dome(20_000)
    corners, whole = hull_vertices(points)
    assert 4 * len(corners) < whole == len(ConvexHull(points).vertices)
    planes = ConvexHull(corners).equations
    largest = max(float((points @ plane[:3] + plane[3]).max()) for plane in planes)
    assert 0.0 < largest <= HULL_TOLERANCE_SHARE * np.ptp(points, axis=0).max()
    few = dome(1500)
    assert len(hull_vertices(few)[0]) == hull_vertices(few)[1] == len(ConvexHull(few).vertices)


def test_scan_with_a_reduced_hull_says_so_and_keeps_its_mass(tmp_path):
    """Mass and inertia are those of the mesh."""
    points = dome(6000)
    hull = ConvexHull(points)
    faces = np.array([face if np.linalg.det(points[face]) > 0.0 else face[::-1] for face in hull.simplices])
    path = tmp_path / "dome.stl"
    write_stl(path, points, faces)
    scan = scan_body(path, density=1000.0)
    assert scan.body.mass == pytest.approx(1000.0 * hull.volume, rel=1e-6)
    assert len(scan.body.hull) < scan.hull_vertices
    (message,) = (text for text in map(str, scan_qc_messages(scan)) if "convex hull" in text)
    assert message.startswith(f"dome: {len(scan.body.hull)} of the {scan.hull_vertices} vertices of the convex hull used")

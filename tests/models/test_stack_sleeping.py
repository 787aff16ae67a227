"""Support forces of sleeping stones: in equilibrium with the load, pressing, within Coulomb's cone, and found where there are any."""

import numpy as np
import pytest
from scipy.optimize import linprog

from seisblock.models.stack.sleeping import (
    POINT_FORCE,
    POINT_FRICTION,
    POINT_OFFSET,
    SUPPORT_COLUMNS,
    SUPPORT_NORMAL,
    _distribute_load,
    _support_moments,
)

pytestmark = pytest.mark.kernel


def support(rng, count, friction):
    """Return axes, offsets from the centre of a stone, and the rows of its support points on a plane in a random direction."""
    axes = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    offsets = np.column_stack([rng.uniform(-1.0, 1.0, (count, 2)), np.full(count, -0.7)]) @ axes.T
    points = np.zeros((count + 1, SUPPORT_COLUMNS))
    points[0, SUPPORT_NORMAL : SUPPORT_NORMAL + 3] = axes[:, 2]
    points[1:, POINT_OFFSET : POINT_OFFSET + 3] = offsets
    points[1:, POINT_FRICTION] = friction
    return axes, offsets, points


def lines(points):
    """Return whether points in a plane nearly lie on a line."""
    spread = np.linalg.svd(points - points.mean(axis=0))[1]
    return spread[1] < 0.1 * spread[0]


@pytest.mark.parametrize("count", [3, 4, 6])
def test_support_forces_balance_the_load(count):
    """Three or four points carry every load that any pressing forces carry; more do so as an elastic bed."""
    rng, results = np.random.default_rng(count), []
    for _ in range(60):
        axes, offsets, points = support(rng, count, 3.0)
        if lines((offsets @ axes)[:, :2]):
            continue
        assert _support_moments(count, points)
        shares = rng.uniform(-0.4, 1.0, count)
        friction = 0.2 * rng.normal(size=(count, 2)) * np.abs(shares)[:, None]
        forces = np.column_stack([friction, shares]) @ axes.T
        force, torque = forces.sum(axis=0), np.cross(offsets, forces).sum(axis=0)
        carries = _distribute_load(count, *force, *torque, points)
        # pressures with this resultant and these moments in the plane
        local = offsets @ axes
        moments = np.vstack([np.ones(count), local[:, 1], -local[:, 0]])
        height = np.cross([0.0, 0.0, -0.7], axes.T @ force)
        wanted = np.array([shares.sum(), *((axes.T @ torque - height)[:2])])
        possible = linprog(np.zeros(count), A_eq=moments, b_eq=wanted).status == 0
        results.append(carries)
        if carries:
            found = points[1:, POINT_FORCE : POINT_FORCE + 3]
            np.testing.assert_allclose(found.sum(axis=0), force, atol=1e-9)
            np.testing.assert_allclose(np.cross(offsets, found).sum(axis=0), torque, atol=1e-9)
            pressure = found @ axes[:, 2]
            assert pressure.min() >= -1e-12
            assert (np.linalg.norm(found - np.outer(pressure, axes[:, 2]), axis=1) <= 3.0 * pressure + 1e-9).all()
        assert possible or not carries
        if count < 6:
            assert carries == possible
    assert 10 < sum(results) < len(results) - 5


def test_support_slides_beyond_its_friction():
    """A push through the centre of pressure slides off at mu, a twist about it where one point reaches mu."""
    rng = np.random.default_rng(2)
    for _ in range(10):
        axes, offsets, points = support(rng, 3, 0.4)
        if lines((offsets @ axes)[:, :2]):
            continue
        assert _support_moments(3, points)
        centre = offsets.mean(axis=0)
        for share, holds in ((0.399, True), (0.401, False)):
            force = axes[:, 2] + share * axes[:, 0]
            assert _distribute_load(3, *force, *np.cross(centre, force), points) == holds
        arms = np.linalg.norm(offsets - centre, axis=1)
        # friction P/3 r w of each point: the moment at which the farthest slides
        twist = 0.4 * (arms**2).sum() / 3.0 / arms.max()
        for share, holds in ((0.999, True), (1.001, False)):
            torque = np.cross(centre, axes[:, 2]) + share * twist * axes[:, 2]
            assert _distribute_load(3, *axes[:, 2], *torque, points) == holds


def test_points_on_a_line_support_nothing():
    """Nor does a load that lifts."""
    rng = np.random.default_rng(3)
    axes, offsets, points = support(rng, 4, 0.4)
    points[1:, POINT_OFFSET : POINT_OFFSET + 3] = np.linspace(-1.0, 1.0, 4)[:, None] * axes[:, 0]
    assert not _support_moments(4, points)
    points[1:, POINT_OFFSET : POINT_OFFSET + 3] = offsets
    assert _support_moments(4, points)
    assert not _distribute_load(4, *(-axes[:, 2]), 0.0, 0.0, 0.0, points)

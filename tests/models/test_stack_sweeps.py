"""Sweeps over contacts: each one obeys its law with the others fixed; the impulses do the work that the kinetic energy changes by."""

import numpy as np
import pytest

from seisblock.models.stack.constraint_row import (
    BILATERAL,
    CONE_CENTRE,
    IMPULSE,
    MIN_NORMAL_VELOCITY,
    MU,
    NORMAL,
    ROTATION_BIAS,
    W,
    apply_impulses,
    relative_velocity,
)
from seisblock.models.stack.pgs import _relax_contact, impulse_work
from tests.models.contact_network import jacobian, mass_matrix, network

pytestmark = pytest.mark.kernel


def relaxed(seed, *, minimises_energy=False):
    """Yield rows of random contacts after many updates of each alone, with normal, velocity above its bound, and impulse."""
    rng = np.random.default_rng(seed)
    ids, rows, masses, _, velocities = network(rng, mu=float(rng.uniform(0.02, 0.15)))
    for k, (pair, row) in enumerate(zip(ids, rows, strict=True)):
        normal = row[NORMAL : NORMAL + 3]
        # friction so small that it never presses a contact that it should open (Painleve)
        row[CONE_CENTRE : CONE_CENTRE + 3] *= 0.0 if minimises_energy else 0.3
        row[MIN_NORMAL_VELOCITY] = rng.choice([0.0, -0.1, 0.05])
        row[ROTATION_BIAS : ROTATION_BIAS + 3] = rng.normal(0.0, 0.02, 3)
        start = velocities.copy()
        if k % 3 == 0:
            # a bias that an impulse within the cone stops
            response, across = row[W : W + 9].reshape(3, 3), np.cross(normal, rng.normal(size=3))
            stopping = normal + row[CONE_CENTRE : CONE_CENTRE + 3] + 0.8 * row[MU] * across / np.linalg.norm(across)
            free = np.array(relative_velocity(*pair[:2], row, start)) - response @ row[IMPULSE : IMPULSE + 3]
            row[ROTATION_BIAS : ROTATION_BIAS + 3] = row[MIN_NORMAL_VELOCITY] * normal - response @ stopping - free
        for _ in range(400):
            change = _relax_contact(*pair[:2], len(masses), masses, row, minimises_energy, start)
        assert change < 1e-6
        velocity = np.array(relative_velocity(*pair[:2], row, start)) + row[ROTATION_BIAS : ROTATION_BIAS + 3]
        yield row, normal, velocity - row[MIN_NORMAL_VELOCITY] * normal, row[IMPULSE : IMPULSE + 3].copy()


def test_contact_alone_obeys_signorini_and_coulomb():
    """Open, sticking, sliding and bilateral contacts, with cones about the normal and beside it."""
    states = {"open": 0, "sticks": 0, "slides": 0, "bilateral": 0}
    for seed in range(4):
        for row, normal, velocity, impulse in relaxed(seed):
            pressing, speed = impulse @ normal, velocity @ normal
            slip, friction = velocity - speed * normal, impulse - pressing * (normal + row[CONE_CENTRE : CONE_CENTRE + 3])
            if row[BILATERAL]:
                states["bilateral"] += 1
                assert abs(speed) < 1e-9
                np.testing.assert_allclose(impulse, pressing * normal, atol=1e-9)
            elif pressing == 0.0:
                states["open"] += 1
                assert speed >= 0.0 and not impulse.any()
            else:
                assert pressing > 0.0 and abs(speed) < 1e-8
                limit = row[MU] * pressing
                assert np.linalg.norm(friction) <= limit * (1.0 + 1e-9)
                if np.linalg.norm(slip) < 1e-6:
                    states["sticks"] += 1
                else:
                    states["slides"] += 1
                    np.testing.assert_allclose(friction, -limit * slip / np.linalg.norm(slip), atol=1e-6 * limit)
    assert min(states.values()) > 2


def test_contact_with_least_energy_obeys_cone_complementarity():
    """The impulse lies in the cone, the velocity in its dual, and they are orthogonal."""
    slides = 0
    for seed in range(4):
        for row, normal, velocity, impulse in relaxed(seed, minimises_energy=True):
            if row[BILATERAL]:
                continue
            pressing, speed = impulse @ normal, velocity @ normal
            friction, slip = np.linalg.norm(impulse - pressing * normal), np.linalg.norm(velocity - speed * normal)
            assert friction <= row[MU] * pressing + 1e-9
            assert speed >= row[MU] * slip - 1e-6
            assert abs(impulse @ velocity) < 1e-6
            slides += pressing > 0.0 and slip > 1e-3
    assert slides > 2


def test_work_of_impulses_is_the_change_of_kinetic_energy():
    """With the impulses on all bodies; a tolerance of the velocities takes away its product with each impulse."""
    ids, rows, masses, inverses, velocities = network(np.random.default_rng(3))
    mass, count = mass_matrix(masses, inverses), len(masses)
    after = velocities[:count, :6].ravel().copy()
    before = after - np.linalg.solve(
        mass, sum(jacobian(pair, row, count).T @ row[IMPULSE : IMPULSE + 3] for pair, row in zip(ids, rows, strict=True))
    )
    change = 0.5 * (after @ mass @ after - before @ mass @ before)
    for tolerance in (0.0, 0.01):
        lost = tolerance * np.linalg.norm(rows[:, IMPULSE : IMPULSE + 3], axis=1).sum()
        assert impulse_work(len(rows), ids, rows, count, masses, tolerance, velocities) == pytest.approx(change - lost, rel=1e-9)
    np.testing.assert_allclose(velocities[:count, :6].ravel(), after, rtol=1e-12)
    apply_impulses(len(rows), ids, rows, count, masses, -1.0, velocities)
    np.testing.assert_allclose(velocities[:count, :6].ravel(), before, rtol=1e-9)

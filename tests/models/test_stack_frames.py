"""Rotation, spin and contact forces of a body of a pile, against rotations of scipy and the laws of Newton and Euler."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from seisblock.bodies.pile.contact import PileContact
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import PileStone
from seisblock.models.stack.arrays import pile_arrays
from seisblock.models.stack.frames import (
    BODY,
    BOX,
    INERTIA,
    INVERSE,
    F,
    L,
    Q,
    R,
    T,
    V,
    W,
    X,
    apply_contact_force,
    box_offset,
    relative_state,
    rotate,
    update_rotation_matrix,
    update_spin,
)

pytestmark = pytest.mark.kernel


def random_body(rng):
    """Return the row of a body with a random position, orientation, velocity and spin."""
    body = np.zeros(BODY)
    body[X : X + 3], body[V : V + 3], body[W : W + 3] = rng.normal(size=(3, 3))
    quaternion = rng.normal(size=4)
    body[Q : Q + 4] = quaternion / np.linalg.norm(quaternion)
    update_rotation_matrix(body)
    return body


def matrix(body):
    """Return the rotation matrix of a body, from its axes to those of the ground."""
    return body[R : R + 9].reshape(3, 3)


def rotation(body):
    """Return the rotation of a body's quaternion, whose scalar scipy has last."""
    return Rotation.from_quat(np.roll(body[Q : Q + 4], -1))


def test_spin_of_dowelled_stones_follows_from_their_inertia():
    """Two stones off each other's axes have products of inertia about all axes: L = I w, in the axes of the ground."""
    stones = PileStone("base", 0.5, 0.4, 0.3), PileStone("top", 0.2, 0.3, 0.4, on="base", offset=(0.1, -0.08))
    pile, rng = pile_arrays(Pile("eccentric", stones, dowels=(("base", "top"),)), PileContact(), 2), np.random.default_rng(1)
    tensor = pile.inertias[0, INERTIA:INVERSE].reshape(3, 3)
    assert np.abs(tensor - np.diag(np.diag(tensor)))[np.triu_indices(3, 1)].min() > 0.01 * np.abs(tensor).max()
    body = random_body(rng)
    body[L : L + 3] = rng.normal(size=3)
    update_spin(body, pile.inertias[0])
    in_ground_axes = matrix(body) @ tensor @ matrix(body).T
    np.testing.assert_allclose(in_ground_axes @ body[W : W + 3], body[L : L + 3], rtol=1e-12)


def test_rotation_matrix_and_step_equal_those_of_scipy():
    """A step turns a body about its spin by 2 atan(w dt/2), whatever its orientation."""
    rng = np.random.default_rng(2)
    for dt in (1e-3, 0.4):
        body = random_body(rng)
        before, spin = rotation(body), body[W : W + 3]
        np.testing.assert_allclose(matrix(body), before.as_matrix(), atol=1e-14)
        rotate(body, dt)
        size = np.linalg.norm(spin)
        turn = Rotation.from_rotvec(spin / size * 2.0 * np.arctan(0.5 * size * dt))
        np.testing.assert_allclose(rotation(body).as_matrix(), (turn * before).as_matrix(), atol=1e-14)


def test_relative_state_is_that_seen_from_the_partner():
    """Axes, centre and velocity of a box in the axes of another, and its velocity relative to the other's material at its centre."""
    rng = np.random.default_rng(3)
    bodies, boxes = np.array([random_body(rng), random_body(rng)]), np.zeros((2, BOX))
    boxes[:, 3:] = rng.normal(size=(2, 3))
    relative = np.zeros(18)
    relative_state(0, 1, bodies, boxes, np.array([0, 1]), np.zeros((2, 3)), relative)
    (carrier, partner), arms = bodies, [matrix(body) @ box[3:] for body, box in zip(bodies, boxes, strict=True)]
    centre = carrier[X : X + 3] + arms[0]
    velocity = carrier[V : V + 3] + np.cross(carrier[W : W + 3], arms[0])
    material = partner[V : V + 3] + np.cross(partner[W : W + 3], centre - partner[X : X + 3])
    into_partner = matrix(partner).T
    np.testing.assert_allclose(relative[:9].reshape(3, 3), into_partner @ matrix(carrier), atol=1e-14)
    np.testing.assert_allclose(relative[9:12], into_partner @ (centre - partner[X : X + 3] - arms[1]), rtol=1e-12)
    np.testing.assert_allclose(relative[12:15], into_partner @ (velocity - material), rtol=1e-12)
    np.testing.assert_allclose(relative[15:18], into_partner @ (carrier[W : W + 3] - partner[W : W + 3]), rtol=1e-12)
    offset = np.ones(3)
    box_offset(carrier, boxes[0], offset)
    np.testing.assert_allclose(offset, arms[0], rtol=1e-12)
    box_offset(carrier, np.zeros(BOX), offset)
    assert not offset.any()


def test_contact_forces_are_opposite_and_create_no_moment():
    """Force and moment on two bodies about any common point are opposite."""
    rng = np.random.default_rng(4)
    carrier, partner = random_body(rng), random_body(rng)
    arms, total = rng.normal(size=(2, 3)), rng.normal(size=6)
    force, couple = matrix(partner) @ total[:3], matrix(partner) @ total[3:]
    apply_contact_force(carrier, partner, arms, total)
    np.testing.assert_allclose(carrier[F : F + 3], force, rtol=1e-12)
    np.testing.assert_allclose(carrier[T : T + 3], couple + np.cross(arms[0], force), rtol=1e-12)
    np.testing.assert_allclose(carrier[F : F + 3] + partner[F : F + 3], 0.0, atol=1e-14)
    moments = [np.cross(body[X : X + 3], body[F : F + 3]) + body[T : T + 3] for body in (carrier, partner)]
    np.testing.assert_allclose(sum(moments), 0.0, atol=1e-13)
    assert not total.any()

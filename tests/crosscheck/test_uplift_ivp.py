"""A block on corner springs against scipy's DOP853, written from forces on corners and not from the solver's equations."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from seisblock.bodies.spring_block import SpringBlock
from seisblock.models.uplift.constants import PROPAGATORS, STEP, SUBSTEPS, TURN_X, VA, VZ, Z
from seisblock.models.uplift.model import parameters
from seisblock.models.uplift.solve import solve_uplift
from seisblock.records.motion import Motion
from tests.models.uplift_motions import shaking

G = 9.80665
SIGNS = np.array([(1, 1), (1, -1), (-1, 1), (-1, -1)])


def acceleration_of(body: SpringBlock, q: np.ndarray, v: np.ndarray, ground: np.ndarray, holding: np.ndarray) -> np.ndarray:
    """Return the accelerations of (x, y, z, theta_x, theta_y, theta_z), summing force vectors at the corners and their moments."""
    half = np.array([body.width / 2, body.depth / 2])
    stiffness = np.array(body.stiffness)
    dashpot = 2 * body.damping * stiffness / np.sqrt(4 * stiffness / body.mass)
    force, moment = np.array([0, 0, -body.mass * G]), np.zeros(3)
    for (sx, sy), on in zip(SIGNS, holding, strict=True):
        arm = np.array([sx * half[0], sy * half[1], -body.height / 2])
        at_corner = -stiffness * (q[:3] + np.cross(q[3:], arm)) - dashpot * (v[:3] + np.cross(v[3:], arm))
        at_corner[2] *= on
        force = force + at_corner
        moment = moment + np.cross(arm, at_corner)
    a, b, h = body.width, body.depth, body.height
    inertia = body.mass / 12 * np.array([b * b + h * h, a * a + h * h, a * a + b * b])
    return np.concatenate([force / body.mass - ground, moment / inertia])


def heights(body: SpringBlock, q: np.ndarray) -> np.ndarray:
    """Return the vertical displacement of the four corners."""
    return q[2] + q[3] * SIGNS[:, 1] * body.depth / 2 - q[4] * SIGNS[:, 0] * body.width / 2


def reference(body: SpringBlock, motion: Motion) -> tuple[np.ndarray, list[tuple[float, int]]]:
    """Integrate sample by sample, stopping at each contact change; return corner heights at the samples, and the changes."""
    state = np.zeros(12)
    state[2] = -body.mass * G / (4 * body.stiffness[2])
    holding = np.ones(4, dtype=bool)
    rows, changes = [heights(body, state[:6])], []
    for k in range(motion.samples - 1):
        t, end = k * motion.dt, (k + 1) * motion.dt
        first, slope = motion.acceleration[:, k], (motion.acceleration[:, k + 1] - motion.acceleration[:, k]) / motion.dt

        def rate(t, s, first=first, slope=slope, k=k):
            ground = first + slope * (t - k * motion.dt)
            return np.concatenate([s[6:], acceleration_of(body, s[:6], s[6:], ground, holding)])

        while t < end:
            events = []
            for i in range(4):
                crossing = lambda _, s, i=i: heights(body, s[:6])[i]  # noqa: E731
                crossing.terminal, crossing.direction = True, 1.0 if holding[i] else -1.0
                events.append(crossing)
            answer = solve_ivp(rate, (t, end), state, method="DOP853", rtol=1e-12, atol=1e-14, events=events)
            t, state = answer.t[-1], answer.y[:, -1].copy()
            if answer.status == 1:
                i = next(i for i in range(4) if answer.t_events[i].size)
                holding[i] = not holding[i]
                changes.append((t, i))
        rows.append(heights(body, state[:6]))
    return np.array(rows), changes


@pytest.mark.parametrize(
    "body",
    [
        SpringBlock.from_frequency(0.6, 0.6, 1.8, frequency_vertical=6.0, beta=0.707, damping=0.05),
        SpringBlock(0.9, 0.6, 1.5, 700.0, (1.2e5, 2.0e5, 4.0e5), damping=0.2),
    ],
    ids=["square", "rectangular, kx != ky"],
)
@pytest.mark.slow
def test_agrees_with_dop853_to_a_nanometre(body):
    """Corner displacements at every sample agree to 1e-9 m, contact changes to 1e-9 s, through many liftings and landings."""
    motion = shaking(2.5, 0.02, peaks=(6.0, 5.0, 3.0))
    response = solve_uplift(body, motion)
    expected, changes = reference(body, motion)
    assert len(changes) > 15
    at_sample = np.isin(np.round(response.time / motion.dt, 9), np.arange(motion.samples))
    computed = np.column_stack([response[f"uplift_{i}"] for i in (1, 2, 3, 4)])[at_sample]
    np.testing.assert_allclose(computed, expected, rtol=0, atol=1e-9)
    assert [int(event.name[7]) - 1 for event in response.events] == [i for _, i in changes]
    np.testing.assert_allclose([event.time_s for event in response.events], [t for t, _ in changes], rtol=0, atol=1e-9)


@pytest.mark.parametrize("dt", [0.005, 0.03])
@pytest.mark.parametrize("mode", range(16))
def test_propagator_agrees_with_dop853_in_every_contact_state(mode, dt):
    """One sample, in one step and in several: 1e-11 of the amplitude."""
    body = SpringBlock(0.9, 0.6, 1.5, 700.0, (1.2e5, 2.0e5, 4.0e5), damping=0.2)
    rng, holding = np.random.default_rng(mode), (mode >> np.arange(4) & 1).astype(bool)
    q, v, ground = rng.normal(size=6) * 1e-4, rng.normal(size=6) * 1e-2, rng.normal(size=(3, 2))
    q[5] = v[5] = 0.0
    p, y = parameters([body], G, dt)[0], np.zeros(20)
    y[TURN_X : Z + 1] = [q[3] * body.depth, q[4] * body.depth, q[0], q[1], q[2] + body.static_settlement(G)]
    y[VA : VZ + 1] = [v[3] * body.depth, v[4] * body.depth, *v[:3]]
    matrix = p[PROPAGATORS:].reshape(16, 17, 10)[mode]
    substeps, step = int(p[SUBSTEPS]), p[STEP]
    slope = (ground[:, 1] - ground[:, 0]) / dt
    for part in range(substeps):
        load = np.column_stack([ground[:, 0] + slope * part * step, slope]).ravel()
        y[TURN_X : VZ + 1] = np.concatenate([[1.0], y[TURN_X : VZ + 1], load]) @ matrix

    def rate(t, s):
        return np.concatenate([s[6:], acceleration_of(body, s[:6], s[6:], ground @ [1.0 - t / dt, t / dt], holding)])

    end = solve_ivp(rate, (0.0, dt), np.concatenate([q, v]), method="DOP853", rtol=1e-13, atol=1e-13).y[:, -1]
    assert substeps == (1 if dt == 0.005 else 3)
    settled = [*end[:2], end[2] + body.static_settlement(G)]
    np.testing.assert_allclose(y[TURN_X : Z + 1], [*end[3:5] * body.depth, *settled], rtol=0, atol=1e-11)
    np.testing.assert_allclose(y[VA : VZ + 1], [*end[9:11] * body.depth, *end[6:9]], rtol=0, atol=1e-9)

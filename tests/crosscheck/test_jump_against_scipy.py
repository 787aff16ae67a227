"""The whole chain of the jump against scipy: Newton-Euler with a linear solve, no formula of the program's."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from seisblock.bodies.two_layer import Contact, TwoLayerBlock
from seisblock.models.jump.solve import solve_jump
from seisblock.records import Motion
from seisblock.validation.sugimoto import GRAVITY, MOTION_PARTS, PRINTED_CASES, motion_part, table_chain
from tests.motions import half_sine, real_motions

G = 9.8
SHORT = TwoLayerBlock(2.08, 2.50, 1.06, 1.84, 1303.7, 160.0)
LONG = TwoLayerBlock(2.50, 2.08, 1.06, 1.84, 1303.7, 160.0)
TIGHT = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-14}


def pieces(motion: Motion, t0: float):
    """Yield the linear pieces of the ground acceleration from t0 on: start, end, value function."""
    for i in range(motion.samples - 1):
        a, b = i * motion.dt, (i + 1) * motion.dt
        if b <= t0:
            continue
        z0, z1 = motion.horizontal[i], motion.horizontal[i + 1]
        yield max(a, t0), b, lambda t, z0=z0, z1=z1, a=a: z0 + (z1 - z0) * (t - a) / motion.dt


def march(motion, t0, y0, rate, event):
    """Integrate piece by piece until the event falls through zero; return its time and state."""
    y = np.array(y0, dtype=float)
    for a, b, z in pieces(motion, t0):
        solution = solve_ivp(lambda t, y, z=z: rate(t, y, z(t)), (a, b), y, dense_output=True, **TIGHT)
        grid = np.linspace(a, b, 9)
        values = np.array([event(solution.sol(t)) for t in grid])
        down = np.flatnonzero((values[:-1] > 0) & (values[1:] <= 0))
        if down.size:
            t = brentq(lambda t, sol=solution.sol: event(sol(t)), grid[down[0]], grid[down[0] + 1], xtol=1e-15, rtol=1e-15)
            return t, solution.sol(t)
        y = solution.y[:, -1]
    return None, y


def inertias(block):
    """Return mass, centroid height and centroid inertia by summing slices of the two layers."""
    m, y = 0.0, 0.0
    layers = ((block.lower_mass, 0.0, block.lower_height), (block.upper_mass, block.lower_height, block.height))
    for mass, bottom, top in layers:
        m += mass
        y += mass * (bottom + top) / 2
    y /= m
    inertia = sum(mass * ((block.width**2 + (top - bottom) ** 2) / 12 + ((bottom + top) / 2 - y) ** 2) for mass, bottom, top in layers)
    return m, y, inertia


def chain(block, motion, contact, ratio, drop, printed=False):
    """Return onset, impact, landing, end and displacements of the first chain, in the frame of its direction.

    With `printed`, the foot that sticks feels the opposite shaking, and tilt and slip gain half of their accelerations after the landing.
    """
    m, h, inertia = inertias(block)
    half = block.width / 2
    threshold = G * half / h
    ts = np.arange(motion.samples) * motion.dt
    first = int(np.argmax(np.abs(motion.horizontal) > threshold))
    sign = np.sign(motion.horizontal[first])
    z = sign * motion.horizontal
    onset = ts[first - 1] + motion.dt * (threshold - z[first - 1]) / (z[first] - z[first - 1])
    mirrored = Motion.from_arrays(z, motion.dt)

    def rocking(_, y, shake):
        # moments about the fixed left corner, counter-clockwise; the centroid is at (half, h) turned by theta
        theta, omega = y
        px = half * np.cos(theta) - h * np.sin(theta)
        py = half * np.sin(theta) + h * np.cos(theta)
        return [omega, m * (shake * py - G * px) / (inertia + m * (half**2 + h**2))]

    impact, (_, omega) = march(mirrored, onset, [0.0, 0.0], rocking, lambda y: y[0] if abs(y[0]) > 1e-13 or y[1] < 0 else 1.0)
    spin, vx, vy = ratio * omega, -contact.restitution_x * omega * h, -contact.restitution_y * omega * half

    def lowest(y):
        theta, rise = y[0], y[4]
        return rise + h - h * np.cos(theta) - half * abs(np.sin(theta)) + drop

    def flight(_, y, shake):
        return [y[1], 0.0, y[3], -shake, y[5], -G]

    started = [0.0, spin, 0.0, vx, 0.0, vy]
    landing, state = march(mirrored, impact, started, flight, lambda y: lowest(y) if y[5] < 0.9 * vy or drop > 0 else 1.0)
    side = 1.0 if state[0] < 0 else -1.0
    jumped = state[2]

    def contact_solve(theta, omega, shake, slip):
        # unknowns: theta'', foot's acceleration relative to the ground, horizontal and normal force; corner (cx, cy) from the centroid
        cx = side * half * np.cos(theta) + h * np.sin(theta)
        cy = side * half * np.sin(theta) - h * np.cos(theta)
        a = np.zeros((4, 4))
        b = np.zeros(4)
        # centroid = foot - corner arm; arm'' = theta'' x arm - omega^2 arm
        a[0] = [m * cy, m, -1.0, 0.0]
        b[0] = -m * shake - m * omega**2 * cx
        a[1] = [-m * cx, 0.0, 0.0, -1.0]
        b[1] = -m * G - m * omega**2 * cy
        a[2] = [inertia, 0.0, cy, -cx]
        if slip is None:
            a[3, 1] = 1.0
        else:
            a[3] = [0.0, 0.0, 1.0, slip * contact.kinetic]
        return np.linalg.solve(a, b)

    opposite = -1.0 if printed else 1.0
    shake = np.interp(landing, ts, z)
    _, _, push, normal = contact_solve(state[0], state[1], opposite * shake, None)
    slides = abs(push) > contact.mu * normal
    slip = -np.sign(push) if slides else None

    def landed(_, y, shake):
        turn, foot, _, _ = contact_solve(y[0], y[1], (1.0 if slides else opposite) * shake, slip)
        share = 0.5 if printed else 1.0
        return [y[1], share * turn, y[3], share * foot]

    end, final = march(mirrored, landing, [state[0], state[1], 0.0, 0.0], landed, lambda y: -side * y[0])
    stops = slides and np.sign(final[3]) != slip
    arm_before = side * half * np.cos(state[0]) + h * np.sin(state[0])
    moved = final[2] + arm_before - side * half
    return onset, impact, landing, end, sign * jumped, sign * moved, slides, stops


CASES = [
    pytest.param(half_sine(sign * peak, duration, 3.0), block, spin, drop, id=f"{sign * peak}-{duration}-{spin}-{drop}-{block.width}")
    for sign, peak, duration, block, spin, drop in [
        (1, 6.5, 0.6, SHORT, 0.1895, 0.3),
        (-1, 6.5, 0.6, SHORT, 0.1895, 0.0),
        (1, 7.0, 0.5, LONG, 0.278, 0.3),
        (1, 7.0, 0.5, LONG, -0.2, 0.3),
        (1, 7.0, 0.5, LONG, -0.166, 0.0),
    ]
]


PRINTED = [
    pytest.param(half_sine(6.5, 0.6, 3.0), SHORT, Contact(0.18, 0.17, 0.95, 0.85), 0.3, True, id="slips"),
    pytest.param(half_sine(-6.5, 0.6, 3.0), SHORT, Contact(0.9, 0.8, 0.95, 0.70), 0.3, False, id="sticks"),
]


@pytest.mark.parametrize(("motion", "block", "contact", "drop", "slips"), PRINTED)
def test_printed_landing_equals_dop853(motion, block, contact, drop, slips):
    """The scheme of the tables agrees with DOP853 on its equations, with a foot that slips and one that sticks."""
    result = solve_jump(block, motion, contact=contact, drop=drop, spin="ratio=0.19", gravity=G, landing="printed").outcome.chains[0]
    _, _, landing, end, jumped, moved, slides, stops = chain(block, motion, contact, 0.19, drop, printed=True)
    assert not stops
    assert (result.slid, slides) == (slips, slips)
    np.testing.assert_allclose(
        [result.landing_s, result.end_s, result.jump_displacement_m, result.rock_slide_displacement_m],
        [landing, end, jumped, moved],
        atol=2e-9,
    )
    ordinary = solve_jump(block, motion, contact=contact, drop=drop, spin="ratio=0.19", gravity=G).outcome.chains[0]
    assert result.rock_slide_duration_s > 1.2 * ordinary.rock_slide_duration_s


def test_case_16_by_the_printed_scheme_equals_dop853():
    """Case 16 on the reconstructed motion: 607 mm by the scheme of the tables, where the paper prints 616 mm."""
    case, motion = PRINTED_CASES["16"], motion_part("d")
    expected = table_chain("16", "printed")
    ratio = float(case.table_spin.removeprefix("ratio="))
    _, impact, landing, end, jumped, moved, slides, stops = chain(SHORT, motion, case.contact, ratio, case.drop, printed=True)
    assert slides and not stops
    assert GRAVITY == G
    start = MOTION_PARTS["d"][1]
    times = [start + impact, start + landing, start + end]
    np.testing.assert_allclose([expected.impact_s, expected.landing_s, expected.end_s], times, rtol=0, atol=1e-8)
    np.testing.assert_allclose(abs(expected.jump_displacement_m + expected.rock_slide_displacement_m), abs(jumped + moved), atol=2e-9)
    assert 1e3 * abs(jumped + moved) == pytest.approx(607, abs=0.5)


@pytest.mark.parametrize(("motion", "block", "spin", "drop"), CASES)
def test_jump_under_pulse_equals_dop853(motion, block, spin, drop):
    """Onset, impact, landing, end and displacements agree with DOP853 at 1e-12."""
    contact = Contact(0.18, 0.17, 0.95, 0.85)
    result = solve_jump(block, motion, contact=contact, drop=drop, spin=f"ratio={spin}", gravity=G).outcome.chains[0]
    onset, impact, landing, end, jumped, moved, slides, stops = chain(block, motion, contact, spin, drop)
    assert not stops, "the reference does not model a second slip; choose another case"
    assert result.slid == slides
    assert result.landing_corner == ("leading" if spin > 0 else "trailing")
    np.testing.assert_allclose(
        [
            result.rocking_start_s,
            result.impact_s,
            result.landing_s,
            result.end_s,
            result.jump_displacement_m,
            result.rock_slide_displacement_m,
        ],
        [onset, impact, landing, end, jumped, moved],
        atol=2e-9,
    )


@pytest.mark.parametrize("friction", [(0.4, 0.3), (0.9, 0.9)])
def test_jump_with_sticking_foot_equals_dop853(friction):
    """With friction enough the foot sticks, and the chain is that of eq. (12)."""
    contact = Contact(*friction, 0.95, 0.70)
    motion = half_sine(6.5, 0.6, 3.0)
    result = solve_jump(SHORT, motion, contact=contact, drop=0.3, spin="ratio=0.22", gravity=G).outcome.chains[0]
    *times, slides, stops = chain(SHORT, motion, contact, 0.22, 0.3)
    assert not stops
    assert result.slid == slides
    np.testing.assert_allclose(
        [result.landing_s, result.end_s, result.rock_slide_displacement_m], [times[2], times[3], times[5]], atol=2e-9
    )


@pytest.mark.parametrize("index", range(3))
def test_jump_under_real_records_equals_dop853(index):
    """Three real records, scaled until the block jumps: the same, to ten nanoseconds."""
    motion = real_motions(6.0)[index]
    contact = Contact(0.18, 0.17, 0.95, 0.85)
    slender = TwoLayerBlock(1.0, 1.0, 1.06, 1.84, 1303.7, 160.0)
    result = solve_jump(slender, motion, contact=contact, drop=0.1, spin="ratio=0.2", gravity=G).outcome.chains[0]
    onset, impact, landing, end, jumped, moved, _, stops = chain(slender, motion, contact, 0.2, 0.1)
    assert not stops
    np.testing.assert_allclose(
        [
            result.rocking_start_s,
            result.impact_s,
            result.landing_s,
            result.end_s,
            result.jump_displacement_m,
            result.rock_slide_displacement_m,
        ],
        [onset, impact, landing, end, jumped, moved],
        atol=1e-8,
    )

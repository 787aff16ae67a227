"""Newton's method for the impulses of a step: contact laws of its solution, agreement with the sweeps, symmetry, settled steps."""

import math

import numpy as np
import pytest

from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import PileStone
from seisblock.models.stack import newton
from seisblock.models.stack import solve as solve_module
from seisblock.models.stack.arrays import pile_arrays
from seisblock.models.stack.constraint_row import (
    ARM_A,
    ARM_B,
    CONE_CENTRE,
    FORCE_SLOPE,
    IMPULSE,
    LAW_CHANGE,
    MIN_NORMAL_VELOCITY,
    MU,
    NORMAL,
    PROJECTED,
    ROW_COLUMNS,
    SLIDING_DIRECTION,
    SLIP_SLOPE,
    VELOCITY_COLUMNS,
    WI,
    W,
    apply_impulses,
    relative_velocity,
    set_delassus_block,
)
from seisblock.models.stack.newton import GRADIENT, STEP, WORK_COLUMNS, solve_newton
from seisblock.models.stack.pgs import solve_pgs, sweep_impact
from seisblock.models.stack.recorder import SOLVED, UNCONVERGED
from seisblock.models.stack.solve import solve_stack
from seisblock.records import Motion
from tests.models.contact_network import jacobian, mass_matrix, network
from tests.models.shaken_piles import shaking

TOLERANCE = 1e-5
SIDE, HEIGHT, MASS = 0.4, 0.3, 100.0
CORNERS = np.array([[1, 1], [-1, 1], [1, -1], [-1, -1]]) * SIDE / 2.0


def tower(rng, count, mu, points=4):
    """Return contact bodies, rows, masses, inverse inertias and velocities of a tower in which every joint is struck."""
    ids, rows = np.zeros((points * count, 8), dtype=np.int64), np.zeros((points * count, ROW_COLUMNS))
    masses = np.zeros((count, 19))
    masses[:, 0] = MASS * rng.uniform(0.2, 1.0, count)
    moments = np.array([SIDE**2 + HEIGHT**2, SIDE**2 + HEIGHT**2, 2.0 * SIDE**2]) / 12.0
    inverses = np.array([np.diag(1.0 / (mass * moments)).ravel() for mass in masses[:, 0]] + [np.zeros(9)])
    velocities = np.zeros((count + 1, VELOCITY_COLUMNS))
    velocities[:count, :2] = rng.normal(0.0, 0.05, (count, 2))
    velocities[:count, 2] = rng.normal(-0.03, 0.01, count)
    velocities[:count, 3:6] = rng.normal(0.0, 0.3, (count, 3))
    for i in range(count):
        for q, corner in enumerate(CORNERS[:points]):
            row, k = rows[points * i + q], points * i + q
            ids[k, :2] = i, i - 1 if i > 0 else count
            row[ARM_A : ARM_A + 3] = *corner, -HEIGHT / 2.0
            row[ARM_B : ARM_B + 3] = *corner, HEIGHT / 2.0
            row[NORMAL + 2] = 1.0
            row[MU] = mu
            if rng.random() < 0.5:
                # half of the friction acts against an old direction of slip, as where a point slides on
                angle = rng.uniform(0.0, 2.0 * math.pi)
                row[CONE_CENTRE : CONE_CENTRE + 2] = 0.5 * mu * math.cos(angle), 0.5 * mu * math.sin(angle)
                row[MU] = 0.5 * mu
            set_delassus_block(ids[k, 0], ids[k, 1], count, masses, inverses, row)
    return ids, rows, masses, inverses, velocities


def point_velocity(body, arm, velocities):
    return velocities[body, :3] + np.cross(velocities[body, 3:6], arm)


@pytest.mark.parametrize(("count", "mu"), [(2, 0.1), (2, 0.5), (6, 0.1), (6, 0.5), (20, 0.1), (20, 0.5), (40, 0.3)])
def test_solve_newton_obeys_signorini_and_coulomb(count, mu):
    """Every tower is solved; momentum to round-off; gap rate, cone and direction of friction within the tolerance, checked anew."""
    rng = np.random.default_rng(count)
    slides = opens = 0
    for _ in range(10):
        ids, rows, masses, inverses, velocities = tower(rng, count, mu)
        start = velocities.copy()
        blocks, work = np.zeros((count + 1, count + 1, 36)), np.zeros((count + 1, WORK_COLUMNS))
        assert solve_newton(len(rows), ids, rows, count, masses, inverses, TOLERANCE, velocities, blocks, work) > 0
        change = np.zeros((count, 6))
        for (a, b, *_), row in zip(ids, rows, strict=True):
            impulse = row[IMPULSE : IMPULSE + 3]
            for body, arm, sign in ((a, row[ARM_A : ARM_A + 3], 1.0), (b, row[ARM_B : ARM_B + 3], -1.0)):
                if body < count:
                    change[body, :3] += sign * impulse / masses[body, 0]
                    change[body, 3:] += sign * inverses[body].reshape(3, 3) @ np.cross(arm, impulse)
            slip = point_velocity(a, row[ARM_A : ARM_A + 3], velocities) - point_velocity(b, row[ARM_B : ARM_B + 3], velocities)
            normal, friction = impulse[2], impulse[:2] - impulse[2] * row[CONE_CENTRE : CONE_CENTRE + 2]
            assert normal >= 0.0
            assert slip[2] > row[MIN_NORMAL_VELOCITY] - 2.0 * TOLERANCE
            if normal == 0.0:
                opens += 1
                np.testing.assert_allclose(impulse, 0.0)
                continue
            assert slip[2] < 2.0 * TOLERANCE
            size, speed, limit = np.hypot(*friction), np.hypot(*slip[:2]), row[MU] * normal
            assert size <= limit * (1.0 + 1e-9)
            if speed > 20.0 * TOLERANCE:
                slides += 1
                assert size == pytest.approx(limit, rel=1e-9)
                # friction against the slip: their directions differ by the tolerance over the speed
                assert abs(friction @ slip[:2] + size * speed) < 2.0 * size * TOLERANCE
        np.testing.assert_allclose(velocities[:count, :6] - start[:count, :6], change, atol=1e-12)
    assert slides > 10 * count
    assert opens > 0


@pytest.mark.parametrize("state", ["sticks", "slides", "slides in a shifted cone"])
def test_slope_of_law_is_derivative_of_projected_impulse(state):
    """The impulse of a contact, as it follows from its trial impulse, changes with the velocity as linearised where the law holds."""
    _, rows, *_ = tower(np.random.default_rng(1), 1, 0.5)
    row, velocity = rows[0], np.array([0.0, 0.0, 0.0] if state == "sticks" else [0.3, 0.1, 0.0])
    row[CONE_CENTRE : CONE_CENTRE + 2] = (-0.2, 0.1) if state == "slides in a shifted cone" else (0.0, 0.0)
    row[MU] = 0.25
    along = row[CONE_CENTRE : CONE_CENTRE + 3] - (row[MU] * velocity / max(np.linalg.norm(velocity), 1e-300))
    row[IMPULSE : IMPULSE + 3] = 2.0 * (np.array([0.0, 0.0, 1.0]) + (along if state != "sticks" else np.array([0.1, 0.0, 0.0])))
    assert newton._linearise(row, 1e-2, *velocity) < 1e-12
    # a solution of the law is its own projection, and its linearised law asks for no change
    np.testing.assert_allclose(row[PROJECTED : PROJECTED + 3], row[IMPULSE : IMPULSE + 3], rtol=1e-12, atol=1e-15)
    np.testing.assert_allclose(row[LAW_CHANGE : LAW_CHANGE + 3], 0.0, atol=1e-9)
    if state == "sticks":
        return
    # friction turns with the slip: its derivative is -mu P_n / |u| across the slip, 0 along it
    across = np.array([-velocity[1], velocity[0], 0.0]) / np.linalg.norm(velocity)
    expected = 0.25 * 2.0 / np.linalg.norm(velocity) * across
    np.testing.assert_allclose(newton._law_slope(row, *across), expected, rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(newton._law_slope(row, *velocity), 0.0, atol=1e-12)


@pytest.mark.kernel
def test_contacts_respond_as_the_dense_system():
    """Delassus block J M^-1 J', its inverse, relative velocity J v, and M^-1 J' p of impulses on both bodies."""
    ids, rows, masses, inverses, velocities = network(np.random.default_rng(7))
    count = len(masses)
    inverse, before = np.linalg.inv(mass_matrix(masses, inverses)), velocities[:count, :6].ravel().copy()
    places = [jacobian(pair, row, count) for pair, row in zip(ids, rows, strict=True)]
    for pair, row, place in zip(ids, rows, places, strict=True):
        np.testing.assert_allclose(row[W : W + 9].reshape(3, 3), place @ inverse @ place.T, rtol=1e-9)
        np.testing.assert_allclose(row[WI : WI + 9].reshape(3, 3) @ row[W : W + 9].reshape(3, 3), np.eye(3), atol=1e-9)
        np.testing.assert_allclose(relative_velocity(*pair[:2], row, velocities), place @ before, rtol=1e-9)
    apply_impulses(len(rows), ids, rows, count, masses, 0.7, velocities)
    change = 0.7 * inverse @ sum(place.T @ row[IMPULSE : IMPULSE + 3] for place, row in zip(places, rows, strict=True))
    np.testing.assert_allclose(velocities[:count, :6].ravel(), before + change, rtol=1e-9)
    assert not velocities[count].any()


def begun(seed):
    """Return a network of contacts (see :func:`network`) with blocks and work arrays, after the preparation of both Newton methods."""
    ids, rows, masses, inverses, velocities = network(np.random.default_rng(seed))
    count = len(masses)
    blocks, work = np.zeros((count + 1, count + 1, 36)), np.zeros((count + 1, WORK_COLUMNS))
    newton._begin(len(rows), ids, rows, count, masses, inverses, velocities, work)
    return ids, rows, masses, inverses, velocities, blocks, work


@pytest.mark.kernel
@pytest.mark.parametrize("seed", range(3))
def test_step_on_all_laws_solves_the_balance_of_momentum(seed):
    """M dv = sum of J' dP with dP = R - A J dv, solved as a dense system; laws that stick, slide, pull and do not act among them."""
    ids, rows, masses, inverses, velocities, blocks, work = begun(seed)
    count = len(masses)
    system, load, slopes = mass_matrix(masses, inverses), np.zeros(6 * count), []
    for pair, row in zip(ids, rows, strict=True):
        place = jacobian(pair, row, count)
        newton._linearise(row, 1e-2, *(place @ velocities[:count, :6].ravel()))
        normal, direction = row[NORMAL : NORMAL + 3], row[SLIDING_DIRECTION : SLIDING_DIRECTION + 3]
        across = np.eye(3) - np.outer(normal, normal) - np.outer(direction, direction)
        slope = np.outer(row[FORCE_SLOPE : FORCE_SLOPE + 3], normal) + row[SLIP_SLOPE] * across
        np.testing.assert_allclose([newton._law_slope(row, *axis) for axis in np.eye(3)], slope.T, atol=1e-9)
        if not row[FORCE_SLOPE : FORCE_SLOPE + 3].any():
            slope[:] = 0.0
        system += place.T @ slope @ place
        load += place.T @ row[LAW_CHANGE : LAW_CHANGE + 3]
        slopes.append(row[SLIP_SLOPE])
    assert len({value > 0.0 for value in slopes}) == 2
    work[:count, GRADIENT : GRADIENT + 6] = -load.reshape(count, 6)
    newton._assemble(len(rows), ids, rows, count, masses, blocks, work)
    assert newton._factorise(count, blocks, work)
    newton._newton_step(count, blocks, work)
    np.testing.assert_allclose(work[:count, STEP : STEP + 6].ravel(), np.linalg.solve(system, load), rtol=1e-7, atol=1e-10)


@pytest.mark.kernel
@pytest.mark.parametrize("seed", range(3))
def test_step_of_convex_function_solves_its_hessian(seed):
    """Gradient by the sum of momenta and impulses, Hessian by differences of that, and the step that solves both as a dense system."""
    ids, rows, masses, inverses, velocities, blocks, work = begun(seed)
    count = len(masses)
    free, mass = velocities[:count, :6].ravel().copy(), mass_matrix(masses, inverses)
    places = [jacobian(pair, row, count) for pair, row in zip(ids, rows, strict=True)]
    free -= np.linalg.solve(mass, sum(place.T @ row[IMPULSE : IMPULSE + 3] for place, row in zip(places, rows, strict=True)))
    newton._errors(len(rows), ids, rows, count, masses, inverses, velocities, work)

    def gradient(change):
        moved = velocities[:count, :6].ravel() + change
        impulses = [newton._penalty_impulse(row, *(place @ moved), True)[:3] for place, row in zip(places, rows, strict=True)]
        return mass @ (moved - free) - sum(place.T @ impulse for place, impulse in zip(places, impulses, strict=True))

    newton._linearise_penalties(len(rows), ids, rows, count, masses, velocities, work)
    newton._assemble(len(rows), ids, rows, count, masses, blocks, work)
    here = gradient(np.zeros(6 * count))
    np.testing.assert_allclose(work[:count, GRADIENT : GRADIENT + 6].ravel(), here, rtol=1e-9, atol=1e-9)
    step = 1e-7
    hessian = np.array([(gradient(step * axis) - gradient(-step * axis)) / (2.0 * step) for axis in np.eye(6 * count)])
    assert newton._factorise(count, blocks, work)
    newton._newton_step(count, blocks, work)
    np.testing.assert_allclose(hessian @ work[:count, STEP : STEP + 6].ravel(), -here, rtol=1e-5, atol=1e-5 * np.abs(here).max())


@pytest.mark.parametrize("by_course", [True, False])
def test_touching_stones_of_a_wall_have_close_indices(by_course):
    """Five courses of ten to six stones, in any order: at most five bodies lie between two that touch, and few blocks are factorised."""
    stones = [
        PileStone(
            f"s{row}_{i}",
            0.5,
            0.3,
            0.25,
            on="ground" if row == 0 else f"s{row - 1}_{i}",
            offset=(0.501 * i, 0.0) if row == 0 else (0.2505, 0.0),
        )
        for row, i in (
            [(r, i) for r in range(5) for i in range(10 - r)] if by_course else [(r, i) for i in range(10) for r in range(5) if i < 10 - r]
        )
    ]
    pile = pile_arrays(Pile("wall", tuple(stones)), None, 2)
    gaps = [abs(int(pile.owner[c]) - int(pile.owner[p])) for c, p in pile.joints[:, :2] if max(c, p) < len(stones)]
    assert len(gaps) == 60
    assert max(gaps) <= 5


@pytest.mark.parametrize("count", [2, 5])
def test_solve_newton_agrees_with_converged_sweeps(count):
    """Velocities agree within the tolerance where three points carry a stone: with four, its twist depends on how they share the load."""
    rng = np.random.default_rng(7)
    compared = 0
    for _ in range(20):
        ids, rows, masses, inverses, velocities = tower(rng, count, 0.3, points=3)
        sweep_rows, sweep_velocities = rows.copy(), velocities.copy()
        fine = 1e-4 * TOLERANCE
        if not 0 < solve_pgs(len(rows), ids, sweep_rows, count, masses, fine, fine, sweep_velocities) < 1000:
            continue
        blocks, work = np.zeros((count + 1, count + 1, 36)), np.zeros((count + 1, WORK_COLUMNS))
        if solve_newton(len(rows), ids, rows, count, masses, inverses, 0.01 * TOLERANCE, velocities, blocks, work) == 0:
            continue
        np.testing.assert_allclose(velocities[:count, :3], sweep_velocities[:count, :3], atol=TOLERANCE)
        np.testing.assert_allclose(velocities[:count, 3:6], sweep_velocities[:count, 3:6], atol=TOLERANCE / SIDE)
        compared += 1
    assert compared >= 15


def test_convex_method_starts_from_the_impulses_of_all_laws():
    """Twenty struck stones take 20 steps on average, not 42: impulses of laws that have not settled are kept."""
    steps = []
    for seed in range(20):
        ids, rows, masses, inverses, velocities = tower(np.random.default_rng(seed), 20, 0.3)
        blocks, work = np.zeros((21, 21, 36)), np.zeros((21, WORK_COLUMNS))
        steps.append(solve_newton(len(rows), ids, rows, 20, masses, inverses, TOLERANCE, velocities, blocks, work))
    assert min(steps) > 0
    assert np.mean(steps) < 30


@pytest.mark.parametrize("mu", [0.3, 0.7])
def test_impact_does_not_pass_on_by_one_joint_a_step(mu):
    """The top of twenty stones at rest is struck: Newton's method takes a step per joint, and a third of these after a sweep."""
    count, steps = 20, []
    stones = tuple(PileStone(f"s{i}", SIDE, SIDE, HEIGHT, on="ground" if i == 0 else f"s{i - 1}") for i in range(count))
    pile = pile_arrays(Pile("tower", stones, mu=mu), None, 2)
    for is_swept in (False, True):
        ids, rows, masses, inverses, velocities = tower(np.random.default_rng(1), count, mu)
        rows[:, CONE_CENTRE : CONE_CENTRE + 3], rows[:, MU] = 0.0, mu
        velocities[:] = 0.0
        velocities[count - 1, 2] = -0.5
        memory = pile.memory()._replace(contact_ids=ids, constraint_rows=rows, inverses=inverses, body_velocities=velocities)
        if is_swept:
            sweep_impact(len(rows), count, pile.layout._replace(inertias=masses), memory)
        scratch = memory.newton_blocks, memory.newton_bodies
        steps.append(solve_newton(len(rows), ids, rows, count, masses, inverses, TOLERANCE, velocities, *scratch))
    assert steps[0] > count
    assert 0 < steps[1] < count / 3


@pytest.mark.parametrize("count", [5, 14])
def test_sliding_slabs_settle_in_every_step(count, monkeypatch):
    """Slabs that slide on each other in both directions: no step is left with forces that have not converged."""
    ledgers = []
    monkeypatch.setattr(solve_module, "_convergence_warnings", lambda ledger, motion: ledgers.append(ledger.copy()) or ())
    time = np.arange(0.0, 1.5, 0.01)
    motion = Motion(np.array([5.0 * np.sin(12.6 * time), 3.0 * np.sin(17.2 * time + 0.3), np.sin(29.0 * time)]), 0.01)
    stones = tuple(PileStone(f"s{i}", 0.6, 0.6, 0.08, on="ground" if i == 0 else f"s{i - 1}") for i in range(count))
    outcome = solve_stack(Pile("slabs", stones, mu=0.3), motion, law="rigid").outcome
    assert ledgers[0][SOLVED] > 400
    assert ledgers[0][UNCONVERGED] == 0
    assert outcome.lost_j > 100.0
    assert outcome.created_j < 1e-3 * outcome.lost_j


@pytest.mark.parametrize("seed", [1, 32, 42])
def test_images_of_square_stone_rock_alike(seed):
    """The eight images of a square stone and its shaking tilt alike within 1 %: with the tolerance of many contacts up to 10 % apart."""
    rng = np.random.default_rng(seed)
    motion = shaking(rng)
    ratio, width, mu, factor = rng.uniform(2.0, 4.5), rng.uniform(0.2, 0.6), rng.uniform(0.5, 0.9), rng.uniform(0.25, 0.8)
    body = Pile("one", (PileStone("one", width, width, ratio * width),), mu=mu)
    x, y, z = factor * np.array(motion.acceleration)
    tilts = []
    for mirrored in (y, -y):
        for along, across in ((x, mirrored), (-mirrored, x), (-x, -mirrored), (mirrored, -x)):
            tilts.append(solve_stack(body, Motion(np.array([along, across, z]), motion.dt), law="rigid").outcome.max_tilt_rad["one"])
    assert tilts[0] > 0.03
    np.testing.assert_allclose(tilts, tilts[0], rtol=1e-2)

"""A block on corner springs under records: threshold, energy, limits, symmetry, and what is reported."""

from __future__ import annotations

import dataclasses
import itertools

import numpy as np
import pytest

from seisblock.bodies.spring_block import SpringBlock
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.dynamics import integrate
from seisblock.models.uplift.advance import BEYOND, _is_quiet, _undecided
from seisblock.models.uplift.batch import uplift_many
from seisblock.models.uplift.constants import ALL_CORNERS, GLUED, TURN_X, TURN_Y, VA, VB, VX, VZ, F, U, X
from seisblock.models.uplift.harmonic import uplift_thresholds
from seisblock.models.uplift.minima import uplift_minima
from seisblock.models.uplift.model import UPLIFT, contact_name, parameters, rotations, static_state
from seisblock.models.uplift.modes import natural_modes
from seisblock.models.uplift.outcome import warnings
from seisblock.models.uplift.solve import solve_uplift
from seisblock.records.motion import Motion, motion_of
from seisblock.records.record import Component, Record
from tests.models.uplift_motions import harmonic, shaking
from tests.models.uplift_series import UPLIFT_SERIES

G = STANDARD_GRAVITY
SLENDER = SpringBlock.from_frequency(0.6, 0.6, 1.8, frequency_vertical=6.0, beta=0.707, damping=0.05)


@pytest.mark.parametrize(
    ("ratio", "phi", "rho"), [(0.6, 30.0, 90.0), (1.0, 30.0, 60.0), (1.75, 30.0, 60.0), (1.83, 30.0, 60.0), (2.7, 10.0, 80.0)]
)
def test_harmonic_uplift_threshold_matches_time_domain(ratio, phi, rho):
    """Below 0.98 of the harmonic threshold no corner opens; above 1.02 those opens that the threshold names."""
    body = SpringBlock.from_ratios(1.0, 0.707, frequency_vertical=2.0, damping=0.10)
    thresholds = uplift_thresholds(body, [ratio], phi_deg=phi, rho_deg=rho, damping="dashpots")[:, 0]
    omega = ratio * natural_modes(body).omega_1
    below = solve_uplift(body, harmonic(omega, 0.98 * thresholds.min() * G, phi, rho))
    above = solve_uplift(body, harmonic(omega, 1.02 * thresholds.min() * G, phi, rho))
    assert not below.outcome.uplifts
    governing = np.flatnonzero(thresholds <= thresholds.min() * (1.0 + 1e-9)) + 1
    assert above.outcome.corner in governing


def test_corner_1_lifts_first_with_vertical_motion():
    """With a vertical part there are frequencies at which the corner opposite to the paper's lifts first, in time too."""
    body = SpringBlock.from_ratios(1.0, 0.707, frequency_vertical=2.0, damping=0.05)
    ratio = 1.7
    thresholds = uplift_thresholds(body, [ratio], phi_deg=45.0, rho_deg=60.0, damping="dashpots")[:, 0]
    assert thresholds[3] > 1.3 * thresholds[0]
    motion = harmonic(ratio * natural_modes(body).omega_1, 1.05 * thresholds[0] * G, 45.0, 60.0)
    assert solve_uplift(body, motion).outcome.corner == 1


def _energy(states, body, modes):
    """Return kinetic, elastic and potential energy over the mass, J/kg, of rows of states."""
    (tx, ty), (rx, ry) = rotations(states, body), (states[:, VA] / body.depth, states[:, VB] / body.depth)
    jx, jy, _ = (j * body.depth**2 for j in body.inertia)
    wx, wy, wz = body.omega
    u, z, vz = states[:, U : U + 4], states[:, U : U + 4].mean(axis=1), states[:, VZ]
    holding = (np.asarray(modes)[:, None] >> np.arange(4)) & 1
    kinetic = 0.5 * (states[:, VX] ** 2 + states[:, VX + 1] ** 2 + vz**2 + jx * rx**2 + jy * ry**2)
    slide_x, slide_y = states[:, X] - 0.5 * body.height * ty, states[:, X + 1] + 0.5 * body.height * tx
    elastic = 0.5 * (wx**2 * slide_x**2 + wy**2 * slide_y**2) + 0.5 * wz**2 / 4.0 * (holding * u**2).sum(axis=1)
    return kinetic + elastic + G * z


def test_undamped_free_rocking_conserves_energy():
    """After the ground has come to rest an undamped block lifts and lands many times and loses less than 1e-10 of its energy."""
    body = dataclasses.replace(SLENDER, damping=0.0)
    pulse = shaking(1.0, 0.01, peaks=(5.0, 4.0, 2.0)).acceleration
    motion = Motion(np.hstack([pulse, np.zeros((3, 900))]), 0.01)
    trajectory = integrate(UPLIFT, motion, parameters([body], G, motion.dt)[0], static_state(body, G), 15, gains=(1.0, 1.0, 1.0))
    time, states, modes = trajectory.table()
    free = time > 1.02
    energy = _energy(states[free], body, modes[free])
    energy -= _energy(static_state(body, G)[None], body, [15])
    assert sum(change.time > 1.02 for change in trajectory.events) > 30
    np.testing.assert_allclose(energy, energy[0], rtol=1e-10)


def test_stiff_springs_converge_to_rigid_rocking():
    """The first excursion tends, as 1 over the frequency of the springs, to that of a rigid block about its edge (no P-delta)."""
    a, h, dt = 0.6, 1.8, 0.002
    time = dt * np.arange(501)
    pulse = 1.3 * G * a / h * np.sin(np.pi * np.minimum(time, 0.5) / 0.5)
    # I theta'' = m (A h - g a) / 2 about the edge, from the instant at which A exceeds g a / h
    drive = 1.5 * (pulse * h - G * a) / (a * a + h * h)
    first = int(np.argmax(drive > 0.0))
    rate = np.concatenate([np.zeros(first + 1), np.cumsum(0.5 * dt * (drive[first + 1 :] + drive[first:-1]))])
    lean = np.concatenate([[0.0], np.cumsum(0.5 * dt * (rate[1:] + rate[:-1]))])
    errors = []
    for frequency in (50.0, 100.0, 200.0, 400.0):
        body = SpringBlock.from_frequency(a, a, h, frequency_vertical=frequency, beta=1.0, damping=0.5)
        response = solve_uplift(body, Motion.from_arrays(pulse, dt))
        rows = np.searchsorted(response.time, time[: int(np.argmax(lean))])
        errors.append(np.abs(response["rotation"][rows] + lean[: rows.size]).max() / lean.max())
    assert errors[-1] < 0.01
    assert all(later < 0.7 * earlier for earlier, later in itertools.pairwise(errors))


def test_uplift_scale_separates_contact_from_uplift():
    """A record at 0.9999 of its uplift scale lifts nothing; at 1.0001 it does."""
    motion = shaking(6.0, 0.01)
    scale = solve_uplift(SLENDER, motion).outcome.uplift_scale
    for factor, lifts in ((0.9999, False), (1.0001, True)):
        scaled = Motion(motion.acceleration * scale * factor, motion.dt)
        assert solve_uplift(SLENDER, scaled).outcome.uplifts is lifts


def test_mirrored_motion_exchanges_corners():
    """Reversing the motion along x exchanges corners 1 and 3, 2 and 4."""
    motion = shaking(3.0, 0.01)
    counterpart = solve_uplift(SLENDER, motion)
    back = solve_uplift(SLENDER, Motion(motion.acceleration * np.array([[-1.0], [1.0], [1.0]]), motion.dt))
    for first, second in ((1, 3), (2, 4)):
        np.testing.assert_allclose(back[f"uplift_{first}"], counterpart[f"uplift_{second}"], rtol=0, atol=1e-12)
    np.testing.assert_allclose(back["rotation"], -counterpart["rotation"], rtol=0, atol=1e-12)


def test_scaled_block_and_motion_give_similar_response():
    """A block four times as large, shaken half as fast, moves four times as far at the same angles."""
    motion = shaking(3.0, 0.01)
    small = solve_uplift(SLENDER, motion)
    large = SpringBlock.from_frequency(2.4, 2.4, 7.2, frequency_vertical=3.0, beta=0.707, damping=0.05)
    big = solve_uplift(large, Motion(motion.acceleration, 2 * motion.dt))
    np.testing.assert_allclose(big["rotation"], small["rotation"], rtol=0, atol=1e-10)
    assert big.outcome.max_uplift_m == pytest.approx(4.0 * small.outcome.max_uplift_m, rel=1e-9)


def test_resampling_piecewise_linear_motion_changes_nothing():
    """The same polygon with a vertex added in each side is the same motion."""
    motion = shaking(3.0, 0.01)
    coarse = np.arange(motion.samples)
    fine = np.arange(2 * motion.samples - 1) / 2
    refined = Motion(np.array([np.interp(fine, coarse, row) for row in motion.acceleration]), motion.dt / 2)
    first, two = solve_uplift(SLENDER, motion).outcome, solve_uplift(SLENDER, refined).outcome
    assert two.max_uplift_m == pytest.approx(first.max_uplift_m, rel=1e-9)
    assert two.contact_changes == first.contact_changes


def test_mass_scales_forces_only():
    """A block described by its frequencies moves the same whatever its mass; forces are proportional to it."""
    motion = shaking(3.0, 0.01)
    heavy = SpringBlock.from_frequency(0.6, 0.6, 1.8, frequency_vertical=6.0, beta=0.707, mass=5000.0)
    first, five = solve_uplift(SLENDER, motion).outcome, solve_uplift(heavy, motion).outcome
    assert five.max_uplift_m == pytest.approx(first.max_uplift_m, rel=1e-9)
    assert five.max_contact_force_n == pytest.approx(5.0 * first.max_contact_force_n, rel=1e-9)
    assert five.max_contact_force_ratio == pytest.approx(first.max_contact_force_ratio, rel=1e-9)


def test_outcome_agrees_with_channels_and_phases():
    """Uplifts, forces, durations and shares in the outcome are those of the channels and phases."""
    response = solve_uplift(SLENDER, shaking(4.0, 0.01))
    outcome = response.outcome
    assert sum(outcome.share_on_corners.values()) == pytest.approx(1.0)
    assert outcome.share_on_corners["4"] == pytest.approx(1.0 - outcome.uplift_duration_s / 4.0)
    assert outcome.contact_changes == len(response.events) >= len(response.phases) - 1
    assert outcome.first_uplift_s == response.events[0].time_s
    assert response.events[0].name == f"corner {outcome.corner} lifts"
    for corner in outcome.corners:
        u, force = response[f"uplift_{corner.corner}"], response[f"contact_force_{corner.corner}"]
        assert u.max() <= corner.max_uplift_m <= u.max() + 1e-4
        assert force.max() <= corner.max_contact_force_n + 1e-9
        in_air = [p for p in response.phases if p.name == "in the air" or (p.name != "on all corners" and str(corner.corner) not in p.name)]
        assert corner.uplift_duration_s == pytest.approx(sum(p.duration_s for p in in_air))
        assert 0.0 < corner.longest_uplift_s <= corner.uplift_duration_s
        assert np.all(force[u > 1e-9] == 0.0)


@pytest.mark.parametrize("seed", range(20))
def test_contact_changes_are_separated_by_more_than_round_off(seed):
    """No corner opens and closes again within round-off of one instant, however close to a sample."""
    response = solve_uplift(SLENDER, shaking(5.0, 0.01, seed=seed))
    for corner in "1234":
        items = [event for event in response.events if event.name[7] == corner]
        assert [event.name[9:] for event in items] == ["lifts", "lands"] * (len(items) // 2) + ["lifts"] * (len(items) % 2)
        assert np.diff([event.time_s for event in items]).min(initial=1.0) > 1e-9


@pytest.mark.parametrize("rows", [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 3.0), (1.0, 0.0, 1.0)])
def test_symmetric_corners_move_identically(rows):
    """Under motion along one side, or straight up, corners that are images of each other move alike to the last bit."""
    motion = shaking(6.0, 0.01, peaks=(9.0, 9.0, 9.0))
    stiff = SpringBlock.from_frequency(0.6, 0.6, 1.8, frequency_vertical=60.0, beta=1.0, damping=0.3)
    for body in (SLENDER, stiff):
        response = solve_uplift(body, Motion(motion.acceleration * np.array(rows)[:, None], motion.dt))
        u = [response[f"uplift_{i}"] for i in (1, 2, 3, 4)]
        outcome = response.outcome
        assert outcome.corner == outcome.first_corners[0]
        assert len(outcome.first_corners) == (4 if rows == (0.0, 0.0, 3.0) else 2)
        if rows[1] == 0.0:
            assert np.array_equal(u[0], u[1])
            assert np.array_equal(u[2], u[3])
        if rows[0] == 0.0:
            assert np.array_equal(u[0], u[2])
            assert np.array_equal(u[1], u[3])


def test_block_at_rest_carries_a_quarter_of_weight_per_corner():
    """Without motion the block stays at its static settlement and each corner carries a quarter of the weight."""
    outcome = solve_uplift(SLENDER, Motion(np.zeros((3, 50)), 0.01)).outcome
    assert not outcome.uplifts
    assert outcome.first_uplift_s is None
    assert outcome.corner is None
    assert outcome.uplift_scale is None
    assert outcome.max_uplift_m == 0.0
    assert outcome.max_contact_force_ratio == pytest.approx(1.0, rel=1e-12)


@pytest.mark.kernel
def test_upward_jolt_throws_block_off_all_springs():
    """A sharp upward jolt that is taken away throws the whole block off its springs, and it falls back with gravity."""
    up = np.zeros((3, 40))
    up[2, :10] = 40.0
    up[2, 10:14] = -60.0
    response = solve_uplift(SpringBlock.from_frequency(0.6, 0.6, 0.6, frequency_vertical=15.0, beta=1.0), Motion(up, 0.01))
    assert "in the air" in [phase.name for phase in response.phases]
    assert response["rotation"] == pytest.approx(0.0, abs=1e-12)
    assert contact_name(9) == "on corners 1 4"


def test_landing_corner_force_starts_at_dashpot_force():
    """A corner that comes down presses with c times its speed at that instant, before its spring does; without a dashpot with nothing."""
    up = np.zeros((3, 200))
    up[2, :10], up[2, 10:14] = 40.0, -60.0
    for damping in (0.0, 0.3, 0.9):
        body = SpringBlock.from_frequency(0.6, 0.6, 0.6, frequency_vertical=15.0, beta=1.0, damping=damping, mass=80.0)
        response = solve_uplift(body, Motion(up, 0.01))
        # four dashpots c = 2 zeta k / omega, four springs k = m omega^2 / 4
        c = 2.0 * damping * body.mass * body.omega[2] / 4.0
        landings = [event for event in response.events if event.name.endswith("lands")]
        assert len(landings) >= 4
        for event in landings:
            corner = int(event.name.split()[1]) - 1
            # it falls without a rotation
            speed = event.before[VZ]
            assert speed < -0.1
            assert body.mass * event.after[F + corner] == pytest.approx(-c * speed, rel=1e-12, abs=1e-9)
            assert body.mass * event.before[F + corner] == 0.0
        force = body.mass * max(event.after[F + int(event.name.split()[1]) - 1] for event in landings)
        assert response.outcome.max_contact_force_n >= force


def test_force_between_samples_after_slow_motion():
    """The largest force of a burst after a slow wave is that of the same motion in finer steps: slopes raise the bound of a step."""
    dt, finer = 0.01, 16
    slow = 6.0 * np.sin(np.pi * np.arange(800) / 200.0) * np.sin(np.pi * np.arange(800) / 800.0) ** 2
    body = SpringBlock.from_frequency(1.0, 1.0, 2.0, frequency_vertical=3.7, beta=0.5, damping=0.9)
    for peak in np.arange(10.0, 30.0, 0.5):
        up = np.concatenate([slow, [0.0, *peak * np.array([1.0, -1.0, 1.0, -1.0]), 0.0], np.zeros(50)])
        times = np.arange(up.size) * dt
        fine_times = np.linspace(0.0, times[-1], (up.size - 1) * finer + 1)
        coarse, fine = (
            uplift_many([body], Motion(np.array([0.0 * row, 0.0 * row, row]), step))
            for row, step in ((up, dt), (np.interp(fine_times, times, up), dt / finer))
        )
        assert coarse.max_contact_force_n[0] == pytest.approx(fine.max_contact_force_n[0], rel=1e-9)


def test_large_tilt_warns_beyond_model_validity():
    """Beyond a tenth of the slenderness the outcome states that the model is invalid and refers to rock (N16)."""
    response = solve_uplift(SLENDER, shaking(6.0, 0.01, peaks=(9.0, 9.0, 3.0)))
    assert any("seisblock rock" in message for message in response.warnings)
    assert response.outcome.within_model is False
    assert response.outcome.lean_ratio > 0.1
    slenderness = np.array([SLENDER.height / SLENDER.width, SLENDER.height / SLENDER.depth])
    leans = np.abs(np.array([response["rotation"], response["rotation_across"]])).max(axis=1) * slenderness
    # the largest lean lies between two samples: above theirs by at most theta'' dt^2/8, a few millionths of it
    assert leans.max() <= response.outcome.lean_ratio == pytest.approx(leans.max(), rel=1e-5)
    weak = solve_uplift(SLENDER, shaking(6.0, 0.01, peaks=(1.0, 0.8, 0.5))).outcome
    assert weak.within_model
    assert weak.lean_ratio < 0.1


def test_motion_that_round_off_decides_is_reported():
    """Two thousand contact changes on stiff springs amplify any change to the size of the result, which then states this."""
    stiff = SpringBlock.from_frequency(0.6, 0.6, 1.8, frequency_vertical=60.0, beta=0.707)
    result = solve_uplift(stiff, shaking(60.0, 0.01))
    (warned,) = (message for message in result.warnings if "sensitive" in message)
    assert ("mm" in warned) == result.outcome.within_model, "no height is told where none can be believed"
    assert solve_uplift(SLENDER, shaking(3.0, 0.01, peaks=(1.0, 0.8, 0.5))).warnings == ()


@pytest.mark.parametrize(("damping", "frequency", "width", "height"), [(0.0, 4.0, 0.9, 1.2), (0.03, 8.0, 0.6, 1.8)])
def test_sensitive_motion_of_soft_springs_is_reported(damping, frequency, width, height):
    """Runs by propagators and by series differ by more than the tolerance: their series converge before the last orders, which hide it."""
    body, motion = (
        SpringBlock.from_frequency(width, 0.6, height, frequency_vertical=frequency, beta=0.707, damping=damping),
        shaking(60.0, 0.01, peaks=(8.0, 6.4, 4.0), seed=4),
    )
    p, start = parameters([body], G, motion.dt)[0], static_state(body, G)
    run, series = (integrate(model, motion, p, start, ALL_CORNERS, gains=(1.0, 1.0, 1.0)) for model in (UPLIFT, UPLIFT_SERIES))
    assert abs(run.extrema[:4, 0].max() / series.extrema[:4, 0].max() - 1.0) > 1e-3
    assert any("sensitive" in message for message in solve_uplift(body, motion).warnings)


def test_results_that_a_billionth_of_the_motion_changes_are_reported():
    """Maximum rise of blocks under motions changed by 1e-9: those that change by more than 0.1 % are sensitive, those within are not."""
    numbers = np.random.default_rng(5).uniform([0.4, 0.4, 0.6, 5.0, 0.5, 0.02], [1.2, 1.2, 2.0, 15.0, 1.5, 0.3], (24, 6))
    bodies = [SpringBlock.from_frequency(a, b, h, frequency_vertical=f, beta=beta, damping=z) for a, b, h, f, beta, z in numbers]
    motion = shaking(30.0, 0.01, peaks=(6.0, 5.0, 3.0))
    result, *changed = (uplift_many(bodies, motion, gains=np.full((24, 3), 1.0 + change)) for change in (0.0, -1e-9, 1e-9))
    difference = np.max([np.abs(other.rise_m / result.rise_m - 1.0) for other in changed], axis=0)
    assert (difference > 1e-3).sum() > 5
    assert result.sensitive[difference > 1e-3].all()
    same_counts = np.all([other.contact_changes == result.contact_changes for other in changed], axis=0)
    assert same_counts.sum() > 10
    assert not result.sensitive[same_counts & (difference < 1e-5)].any()
    said = [any("sensitive" in message for message in warnings(motion, result, row)) for row in range(24)]
    assert said == result.sensitive.tolist()


def test_sensitive_numbers_beside_a_maximum_that_is_not():
    """The message names what changes: contact changes of an undamped block that rises highest at the beginning."""
    parts = shaking(8.0, 0.01, peaks=(5.0, 4.0, 2.0), seed=1), shaking(120.0, 0.01, peaks=(1.2, 0.9, 0.6), seed=2)
    body = SpringBlock.from_frequency(0.9, 0.6, 1.2, frequency_vertical=20.0, beta=0.8, damping=0.0)
    response = solve_uplift(body, Motion(np.hstack([part.acceleration for part in parts]), 0.01))
    assert (
        max(corner.max_uplift_time_s for corner in response.outcome.corners if corner.max_uplift_m == response.outcome.max_uplift_m) < 8.0
    )
    assert response.outcome.contact_changes > 5000
    assert "the maximum uplift does not" in response.warnings[-1]


@pytest.mark.parametrize("frequency", [50.0, 400.0])
def test_quiet_end_of_record_does_not_slow_integration(frequency):
    """Motions that have died away to nothing neither stop nor slow the integration."""
    pulse = shaking(1.0, 0.01).acceleration
    motion = Motion(np.hstack([pulse, np.zeros((3, 3000))]), 0.01)
    body = SpringBlock.from_frequency(0.6, 0.6, 1.8, frequency_vertical=frequency, beta=1.0, damping=0.5)
    response = solve_uplift(body, motion)
    assert response["uplift_1"][-1] == pytest.approx(-body.static_settlement(), rel=1e-9)


def test_record_without_vertical_component_is_solved_and_reported():
    """Without a vertical component the vertical motion is zero, with a warning."""
    motion = shaking(2.0, 0.01)
    record = Record((Component("NS", motion.transverse), Component("EW", motion.horizontal)), 0.01)
    response = solve_uplift(SLENDER, motion_of(record, "EW"))
    assert any("no vertical component" in message for message in response.warnings)


def test_run_without_uplift_needs_one_integration(monkeypatch):
    """The glued run of a block that does not lift has the largest rise of its run, so that neither it nor the repetition is integrated."""
    motion, gains = shaking(20.0, 0.01), (0.1, 0.1, 0.1)
    p, start = parameters([SLENDER], G, motion.dt)[0], static_state(SLENDER, G)
    scaled = Motion(0.1 * np.array(motion.acceleration), 0.01)
    run = integrate(UPLIFT, motion, p, start, ALL_CORNERS, gains=gains)
    glued = integrate(UPLIFT, motion, p, start, GLUED, gains=gains, keep_path=False, keep_events=False)
    np.testing.assert_allclose(run.extrema[:4, 0] - start[:4], glued.extrema[:4, 0] - start[:4], rtol=1e-12)
    calls = []
    monkeypatch.setattr("seisblock.models.uplift.solve.integrate", lambda *a, **k: calls.append(a[0]) or integrate(*a, **k))
    outcome = solve_uplift(SLENDER, scaled).outcome
    assert not outcome.uplifts
    assert len(calls) == 1
    assert outcome.uplift_scale > 1.0
    assert solve_uplift(SLENDER, motion).outcome.uplifts
    assert len(calls) == 4


def test_batch_of_lifting_and_resting_blocks_equals_single_runs():
    """Rows that lift between rows that do not keep their places."""
    motion, factors = shaking(20.0, 0.01), (0.1, 1.0, 0.05, 1.5)
    batch = uplift_many([SLENDER], motion, gains=[(factor, factor, factor) for factor in factors])
    assert batch.uplifts.tolist() == [False, True, False, True]
    for row, factor in enumerate(factors):
        outcome = solve_uplift(SLENDER, Motion(factor * np.array(motion.acceleration), 0.01)).outcome
        assert batch.uplift_scale[row] * factor == pytest.approx(outcome.uplift_scale * factor, rel=1e-9)
        assert batch.max_uplift_m[row] == pytest.approx(outcome.max_uplift_m, rel=1e-9)


@pytest.mark.parametrize(("rho_deg", "modes"), [(90.0, [0, 4]), (0.0, [2])])
def test_undamped_minima_are_the_frequencies_of_excited_modes(rho_deg, modes):
    """Without damping any acceleration lifts at resonance; rocking modes answer horizontal shaking only, the vertical one vertical."""
    body = SpringBlock.from_ratios(1.0, 0.707, frequency_vertical=2.0, damping=0.0)
    omega = natural_modes(body).omega
    minima = uplift_minima(body, rho_deg=rho_deg)
    assert [m.frequency_ratio for m in minima] == pytest.approx([omega[i] / omega[0] for i in modes], rel=1e-9)
    assert [m.acceleration_ratio for m in minima] == [0.0] * len(modes)


@pytest.mark.parametrize("seed", range(4))
def test_propagation_from_sample_to_sample_equals_the_series(seed):
    """States at every sample, extrema with their times, and events are those of the engine's power series, also of glued corners.

    The series are of all states and converge over each step; the propagators have one or several steps per sample.
    """
    rng = np.random.default_rng(seed)
    lifted = 0
    for k in range(15):
        body = SpringBlock.from_frequency(
            *rng.uniform(0.4, 1.0, 2),
            rng.uniform(0.8, 2.0),
            frequency_vertical=rng.uniform(4.0, 25.0),
            beta=0.7,
            damping=rng.uniform(0.0, 0.1 if k % 5 else 0.8),
        )
        rows = [np.convolve(row, np.hanning(int(rng.integers(3, 20))), "same") for row in rng.normal(size=(3, 300))]
        motion = Motion(np.array([rng.uniform(0.5, 8.0) * row / np.abs(row).max() for row in rows]), 0.01)
        mode = GLUED if k % 3 == 2 else ALL_CORNERS
        gains = (1.0, 0.0, 1.0) if k % 2 else (1.0, 0.4, 0.0)
        p, start = parameters([body], G, motion.dt)[0], static_state(body, G)
        fast, slow = (integrate(model, motion, p, start, mode, gains=gains) for model in (UPLIFT, UPLIFT_SERIES))
        assert fast.n_events == slow.n_events
        np.testing.assert_allclose(fast.events.time, slow.events.time, rtol=0, atol=1e-9)
        scale = np.abs(slow.states).max(axis=0)
        np.testing.assert_allclose(fast.states, slow.states, rtol=1e-8, atol=1e-9 * scale.max())
        # of corners only the maxima are used, of glued ones those of the displacement
        for rows, columns in [(slice(4), slice(2))] if mode == GLUED else [(slice(8), slice(2)), (slice(8, 10), slice(4))]:
            np.testing.assert_allclose(fast.extrema[rows, columns], slow.extrema[rows, columns], rtol=1e-7, atol=1e-10)
        lifted += slow.n_events > 0
    assert lifted >= 5


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_motion_along_one_axis_is_propagated_after_a_lift(axis):
    """A rotation that stays exactly zero does not send the samples of a flight to the power series, which takes ten times as long."""
    p, start = parameters([SLENDER], G, 0.01)[0], static_state(SLENDER, G)
    # in the air, moving in the plane of one axis
    start[U : U + 4] = 0.1 + np.array([[-0.01, -0.01, 0.01, 0.01], [0.01, -0.01, 0.01, -0.01], [0.0] * 4])[axis]
    start[TURN_X], start[TURN_Y] = np.array([[0.0, -0.02], [0.02, 0.0], [0.0, 0.0]])[axis]
    end = start.copy()
    end[X + axis] += 0.001
    extrema = np.zeros((10, 4))
    extrema[:, 0], extrema[:, 2] = np.where(start[:10] == 0.0, 0.0, [[1.0], [-1.0]])
    assert _undecided(0, p, start, end, np.zeros((3, 2)), 0.01, 100.0, extrema) & (BEYOND - 1) == 0
    assert _is_quiet(0, p, start, end, 0.01, 100.0, extrema, np.ones(8), np.zeros(8)), "decided without the closer bounds"

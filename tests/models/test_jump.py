"""The jump beyond the paper's one chain: rises, landings that friction can bear, every chain, windows, still ground."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from seisblock.bodies.two_layer import Contact, TwoLayerBlock
from seisblock.core.errors import ParameterError
from seisblock.models.jump import modes
from seisblock.models.jump.chain import ChainOutcome
from seisblock.models.jump.solve import solve_jump
from seisblock.readers import read
from seisblock.records import Motion, motion_of
from tests.motions import half_sine

G = 9.8
SHORT = TwoLayerBlock(2.08, 2.50, 1.06, 1.84, 1303.7, 160.0)
LONG = TwoLayerBlock(2.50, 2.08, 1.06, 1.84, 1303.7, 160.0)
CONTACT = Contact(0.18, 0.17, 0.95, 0.85)
PULSE = half_sine(6.5, 0.6, 3.0)
NEAR_ROUND_OFF = 1e-9
"""Times and states at events are located to about 1e-11; energies and impulses are quadratic in them."""


def flight_rows(response):
    """Return the rows of a response that belong to its first flight."""
    index = next(i for i, phase in enumerate(response.phases) if phase.name == "flight")
    phase = response.phases[index]
    return (response.time >= phase.start_s) & (response.time <= phase.end_s)


@pytest.mark.parametrize("spin", [0.0, 0.3, 0.6, 0.8, -0.8])
def test_rise_equals_flight_path_cut_short_by_spin(spin):
    """A foot that a fast spin brings down before the top of the path leaves v_y T - g T^2/2, what the history shows too (N2)."""
    response = solve_jump(SHORT, PULSE, contact=CONTACT, spin=f"ratio={spin}", gravity=G)
    chain = response.outcome.chains[0]
    up, flown = 0.85 * chain.impact_velocity_rad_s * 1.04, chain.jump_duration_s
    early = flown < up / G
    assert early == (abs(spin) >= 0.6)
    expected = up * flown - G * flown**2 / 2 if early else up**2 / (2 * G)
    assert chain.max_rise_m == pytest.approx(expected, rel=1e-9)
    observed = float(response["height"][flight_rows(response)].max()) - SHORT.centroid_height
    assert observed <= chain.max_rise_m * (1.0 + 1e-9)
    assert chain.max_rise_m - observed <= G * PULSE.dt**2 / 8 + 1e-12


def test_landing_of_the_paper_can_create_energy_and_warns():
    """Without horizontal rebound the long side lands with more energy than it had, and needs far more friction than there is (N3)."""
    response = solve_jump(LONG, PULSE, contact=Contact(0.18, 0.17, 0.0, 0.85), gravity=G)
    before, after = response.outcome.chains[0].landing_energy_j
    assert after > 5.0 * before
    assert any("landings increase the energy" in text for text in response.warnings)
    assert response.outcome.landing == "paper"
    assert response.outcome.friction_needed_at_landing > 1.0
    assert any("more than mu 0.18" in text for text in response.warnings)


def test_landing_friction_demand_equals_impulse_ratio():
    """P_x/P_y follows from the change of the centroid's velocity, which the history has on both sides of the landing."""
    response = solve_jump(SHORT, PULSE, contact=CONTACT, spin="ratio=0.19", gravity=G)
    chain = response.outcome.chains[0]
    touch = next(i for i, t in enumerate(response.time) if t == chain.landing_s)
    step = slice(touch - 1, touch + 3)
    t, x, y = (values[step] for values in (response.time, response["displacement"], response["height"]))
    # the ground stands still: before the landing a parabola, after it a circle about the right corner
    vx = 0.95 * chain.impact_velocity_rad_s * SHORT.centroid_height
    vy = 0.85 * chain.impact_velocity_rad_s * 1.04 - G * chain.jump_duration_s
    assert (x[1] - x[0]) / (t[1] - t[0]) == pytest.approx(vx, rel=1e-9)
    omega = 0.19 * chain.impact_velocity_rad_s
    corner = np.array([x[1], y[1]]) - np.array([0.0, 0.0])
    lean = float(response["rotation"][touch])
    arm = np.array(
        [-1.04 * math.cos(lean) + SHORT.centroid_height * math.sin(lean), 1.04 * math.sin(lean) + SHORT.centroid_height * math.cos(lean)]
    )
    after = omega * np.array([arm[1], -arm[0]])
    assert corner[1] == pytest.approx(arm[1], rel=1e-9)
    assert chain.friction_needed_at_landing == pytest.approx(abs(after[0] - vx) / (after[1] - vy), rel=1e-8)


contacts = st.builds(
    lambda mu, share, x, y: Contact(mu, mu * share, x, y),
    st.floats(0.0, 0.4),
    st.floats(0.3, 1.0),
    st.floats(0.0, 1.0),
    st.floats(0.3, 1.0),
)


@given(contacts, st.floats(-0.7, 0.7), st.sampled_from([SHORT, LONG]), st.floats(6.0, 9.0))
@settings(max_examples=60, deadline=None)
def test_friction_landing_keeps_cone_and_creates_no_energy(contact, spin, block, peak):
    """Under the rule of friction no impulse leaves the cone and no landing makes energy (N3)."""
    assume(contact.restitution_y > abs(spin))
    outcome = solve_jump(block, half_sine(peak, 0.6, 2.0), contact=contact, landing="friction", spin=f"ratio={spin}", gravity=G).outcome
    for chain in outcome.chains:
        if chain.landing_s is None:
            continue
        assert chain.friction_needed_at_landing <= contact.kinetic + NEAR_ROUND_OFF
        before, after = chain.landing_energy_j
        assert after <= before * (1.0 + NEAR_ROUND_OFF)


def test_frictionless_landing_keeps_horizontal_velocity():
    """Mu = 0 cannot stop anything: the centroid goes on as it flew, which the paper's landing forbids (N3)."""
    icy = Contact(0.0, 0.0, 0.95, 0.85)
    response = solve_jump(SHORT, PULSE, contact=icy, landing="friction", spin="ratio=0.1", gravity=G)
    chain = response.outcome.chains[0]
    speed = 0.95 * chain.impact_velocity_rad_s * SHORT.centroid_height
    moments, rows = np.unique(response.time[response.time >= chain.landing_s], return_index=True)
    path = response["displacement"][response.time >= chain.landing_s][rows]
    np.testing.assert_allclose(path, path[0] + speed * (moments - moments[0]), rtol=1e-9)
    assert chain.outcome == "still moving a minute after the record"
    stopped = solve_jump(SHORT, PULSE, contact=icy, spin="ratio=0.1", gravity=G).outcome.chains[0]
    assert abs(stopped.rock_slide_displacement_m) < 0.01


def test_sticking_landing_conserves_angular_momentum_about_corner():
    """A corner that sticks keeps the body's angular momentum about itself: I_O omega = I_G omega + m (r x v)."""
    contact = Contact(4.0, 4.0, 0.95, 0.85)
    response = solve_jump(SHORT, PULSE, contact=contact, landing="friction", spin="ratio=0.19", gravity=G)
    chain = response.outcome.chains[0]
    event = next(event for event in response.events if event.name == "landing")
    assert chain.friction_needed_at_landing < 4.0
    speed, lean = chain.impact_velocity_rad_s, float(event.before[0])
    arm = np.array(
        [-1.04 * math.cos(lean) + SHORT.centroid_height * math.sin(lean), 1.04 * math.sin(lean) + SHORT.centroid_height * math.cos(lean)]
    )
    velocity = np.array([0.95 * speed * SHORT.centroid_height, 0.85 * speed * 1.04 - G * chain.jump_duration_s])
    momentum = SHORT.centroid_inertia * -0.19 * speed + SHORT.mass * (arm[0] * velocity[1] - arm[1] * velocity[0])
    rows = np.flatnonzero(response.time >= chain.landing_s)[1:4]
    bend = np.polyfit(response.time[rows] - chain.landing_s, response["rotation"][rows], 2)
    assert -bend[1] == pytest.approx(momentum / SHORT.corner_inertia, rel=2e-3)


def test_corner_that_sticks_after_landing_is_a_pendulum_on_shaken_ground():
    """After the landing the tilt about the right corner is that of scipy's integration, under ground that shakes from then on.

    psi, the angle of the centroid's arm: I_O psi'' = -m R (g cos(psi) + a sin(psi)). The rate at the landing is fitted.
    """
    contact = Contact(4.0, 4.0, 0.95, 0.85)
    first, time = 90, np.arange(PULSE.samples) * PULSE.dt
    shaking = 4.0 * np.random.default_rng(2).normal(size=PULSE.samples) * (np.arange(PULSE.samples) >= first)
    motion = Motion.from_arrays(PULSE.horizontal + shaking, PULSE.dt)
    response = solve_jump(SHORT, motion, contact=contact, landing="friction", spin="ratio=0.19", gravity=G)
    landing = response.outcome.chains[0].landing_s
    assert (first - 1) * PULSE.dt < landing < response.phases[3].end_s - 0.15
    rows = np.flatnonzero((response.time > landing) & (response.time <= landing + 0.15))
    angle = 0.5 * math.pi - SHORT.slenderness + response["rotation"]
    start, step = angle[rows[0]], response.time[rows] - response.time[rows[0]]
    factor = SHORT.mass * SHORT.radius / SHORT.corner_inertia

    def rates(t, state):
        ground = np.interp(t + response.time[rows[0]], time, motion.horizontal)
        return state[1], -factor * (G * math.cos(state[0]) + ground * math.sin(state[0]))

    def path(rate):
        return solve_ivp(rates, (0.0, step[-1]), (start, rate), t_eval=step, rtol=1e-11, atol=1e-13, max_step=PULSE.dt).y[0]

    rate = brentq(lambda rate: path(rate)[-1] - angle[rows[-1]], -2.0, 2.0, xtol=1e-14)
    np.testing.assert_allclose(path(rate), angle[rows], rtol=0.0, atol=1e-8)
    assert np.ptp(np.diff(angle[rows], 2)) > 1e-4


def test_slip_after_landing_stops_at_kinetic_friction_distance():
    """A flat block that still slides on ground at rest goes on for v^2/(2 mu' g), and stops there."""
    response = solve_jump(SHORT, PULSE, contact=Contact(0.1, 0.1, 0.95, 0.85), landing="friction", spin="ratio=0", gravity=G)
    chain = response.outcome.chains[0]
    speed, fall = chain.impact_velocity_rad_s * SHORT.centroid_height * 0.95, 0.85 * chain.impact_velocity_rad_s * 1.04
    assert chain.outcome == ChainOutcome.JUMPED
    assert [event.name for event in response.events][-2:] == ["landing", "end"]
    assert chain.friction_needed_at_landing == pytest.approx(0.1, rel=1e-6)
    # at most the impulse of one flat landing and at least that of two comes off the speed before it slides flat
    maximum, minimum = (max(speed - 0.1 * share * fall, 0.0) ** 2 / (2 * 0.1 * G) for share in (1.0, 3.0))
    assert minimum < chain.rock_slide_displacement_m < maximum


def test_outcome_sums_all_chains_and_reports_final_state():
    """The first chain barely moves the block, later ones do: the outcome has the sum and the end, not the first chain (N4)."""
    motion = motion_of(read("synthetic_jma.csv"), "NS")
    all_cases = solve_jump(SHORT, motion, contact=CONTACT)
    first = solve_jump(SHORT, motion, contact=CONTACT, first=True)
    chains = all_cases.outcome.chains
    assert len(chains) == 3
    assert first.outcome.chains == chains[:1]
    assert all_cases.outcome.total_displacement_m == pytest.approx(sum(chain.total_displacement_m for chain in chains), rel=1e-12)
    assert all_cases.outcome.final_displacement_m == pytest.approx(all_cases.outcome.total_displacement_m, abs=1e-12)
    assert all_cases["displacement"][-1] == all_cases.outcome.final_displacement_m
    assert all_cases.outcome.total_displacement_m < 0.0 < first.outcome.total_displacement_m
    assert all_cases.outcome.friction_needed_at_landing == max(chain.friction_needed_at_landing for chain in chains)


def test_jump_before_smaller_chain_is_reported():
    """The last chain need not be the one that matters: it jumped, and stands where that took it."""
    small = half_sine(4.75, 0.1, 2.0).horizontal
    motion = Motion.from_arrays(np.concatenate([PULSE.horizontal, small]), 0.01)
    outcome = solve_jump(SHORT, motion, contact=CONTACT, spin="ratio=0.19", gravity=G).outcome
    assert len(outcome.chains) == 2
    assert outcome.chains[0].total_displacement_m == pytest.approx(
        solve_jump(SHORT, PULSE, contact=CONTACT, spin="ratio=0.19", gravity=G).outcome.final_displacement_m
    )
    assert outcome.outcome == ChainOutcome.JUMPED
    stays = solve_jump(SHORT, PULSE, contact=CONTACT, spin="ratio=0.9", gravity=G).outcome
    assert (stays.outcome, stays.final_displacement_m) == (ChainOutcome.NO_JUMP, 0.0)


def test_window_limits_onset_but_not_later_motion():
    """The chain that starts in a window of 0.1 s goes on for a second beyond it, as in the whole record (N5)."""
    motion = motion_of(read("synthetic_jma.csv"), "EW")
    full = solve_jump(SHORT, motion, contact=CONTACT).outcome.chains
    inside = solve_jump(SHORT, motion, contact=CONTACT, windows=[(26.1, 26.2)]).outcome.chains
    assert inside == (full[1],)
    assert inside[0].end_s > 26.9
    two = solve_jump(SHORT, motion, contact=CONTACT, windows=[(27.0, None), (None, 25.6)]).outcome.chains
    assert two == (full[0], full[2])


def test_window_opening_above_threshold_starts_rocking_there():
    """Rocking starts at the opening of a window at which the ground exceeds the threshold, also between two samples."""
    plateau = Motion.from_arrays(np.concatenate([np.full(60, 5.0), np.zeros(300)]), 0.01)
    for begins in (0.2, 0.2345):
        chain = solve_jump(SHORT, plateau, contact=CONTACT, windows=[(begins, None)], gravity=G).outcome.chains[0]
        assert chain.rocking_start_s == pytest.approx(begins, abs=1e-12)


@pytest.mark.parametrize("window", [(100.0, 200.0), (-5.0, -1.0), (2.0, 1.0)])
def test_solve_jump_rejects_window_without_motion(window):
    """One sentence."""
    with pytest.raises(ParameterError, match=r"window .* does not overlap the motion"):
        solve_jump(SHORT, PULSE, contact=CONTACT, windows=[window])


@pytest.mark.parametrize("landing", ["paper", "friction"])
def test_motion_continues_after_end_of_record(landing):
    """Cut after its pulse the record has the chain of the longer one, which ends with three seconds of still ground (N5)."""
    samples = int(np.flatnonzero(PULSE.horizontal)[-1]) + 2
    short = Motion.from_arrays(PULSE.horizontal[:samples], PULSE.dt)
    (full,), (cut,) = (
        solve_jump(SHORT, m, contact=CONTACT, landing=landing, spin="ratio=0.19", gravity=G).outcome.chains for m in (PULSE, short)
    )
    assert cut.outcome == full.outcome == ChainOutcome.JUMPED
    for key in ("impact_s", "landing_s", "end_s", "total_displacement_m", "max_rotation_rad", "friction_needed_at_landing"):
        assert getattr(cut, key) == pytest.approx(getattr(full, key), abs=1e-11)
    assert cut.end_s > short.time[-1]


def test_ground_acceleration_is_zero_after_last_sample():
    """A record that ends in mid-push stops pushing there: the same as one whose last interval, a hundredth as long, ramps down."""
    push = Motion.from_arrays(np.full(41, 6.5), 0.01)
    steep = Motion.from_arrays(np.concatenate([np.full(40_001, 6.5), np.zeros(20_000)]), 1e-5)
    result, ramp = (solve_jump(SHORT, motion, contact=CONTACT, spin="ratio=0.19", gravity=G).outcome.chains[0] for motion in (push, steep))
    assert result.impact_s == pytest.approx(ramp.impact_s, abs=2e-4)
    response = solve_jump(SHORT, push, contact=CONTACT, spin="ratio=0.19", gravity=G)
    after = response.time > push.time[-1]
    assert after.any()
    assert not response["ground_acceleration"][after].any()


def test_outcome_reports_angular_velocity_at_return_to_zero_tilt():
    """The angular velocity with which the tilt comes back to zero: the paper's model makes nothing of it."""
    response = solve_jump(SHORT, PULSE, contact=CONTACT, spin="ratio=0.19", gravity=G)
    chain = response.outcome.chains[0]
    rows = np.flatnonzero((response.time > chain.end_s - 0.02) & (response.time <= chain.end_s))
    slope = abs(np.diff(response["rotation"][rows[-3:-1]]) / np.diff(response.time[rows[-3:-1]]))[0]
    assert chain.end_angular_velocity_rad_s == pytest.approx(slope, rel=0.05)


@pytest.mark.kernel
def test_mode_constants_match_mode_names():
    """Each kind of motion about a corner has its name in the model's list."""
    from seisblock.models.jump.flight import FLIGHT_MODEL

    for corner, side in ((modes.LEFT, "left"), (modes.RIGHT, "right")):
        for kind, name in ((modes.STICK, "stick"), (modes.HOLD, "hold"), (modes.SLIP_BACKWARD, "back"), (modes.SLIP_FORWARD, "forth")):
            assert FLIGHT_MODEL.modes[modes.contact_mode(corner, kind)] == f"{name} {side}"
        assert FLIGHT_MODEL.modes[modes.contact_mode(corner, modes.FLAT_BACKWARD)] == "flat, back"
        assert FLIGHT_MODEL.modes[modes.contact_mode(corner, modes.FLAT_FORWARD)] == "flat, forth"
    assert [FLIGHT_MODEL.modes[mode] for mode in (modes.JAMMED, modes.OVERTURNED, modes.END)] == ["jammed", "overturned", "end"]

"""Impacts: Housner's factor, Routh's path, landings, trips, both corners at once, the user's ratio, Painleve's limit and jams."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from seisblock.bodies.block import Block
from seisblock.core.units import STANDARD_GRAVITY as G
from seisblock.models.respond import respond_params, solve_respond
from seisblock.models.respond.impact_laws import CLOSED_BOTH, CLOSED_LEFT, CLOSED_NONE, CLOSED_RIGHT, both_corners_impact, routh
from seisblock.models.respond.options import RespondOptions
from seisblock.records import Motion
from tests.models.respond.cases import SLENDER, SQUAT, at_lean, sequence, still_ground

pytestmark = pytest.mark.kernel

UNEQUAL = Block(0.4, 1.0, centroid_offset=0.05, centroid_height=0.6, centroid_inertia=40.0, mass=300.0)


def impact_of(response):
    """Return the angular velocities before and after the first impact."""
    event = next(event for event in response.events if event.name.startswith(("impact", "landing")))
    return event.before[2], event.after[2]


@pytest.mark.parametrize("block", [SLENDER, UNEQUAL, Block(0.5, 0.9)])
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_plastic_impact_without_slip_has_housner_ratio(block, side):
    """Plastic and without slip: (k2 + h^2 - b1 b2)/(k2 + h^2 + b_B^2) of the corner B that is struck (Housner)."""
    response = solve_respond(block, still_ground(), mu=5.0, initial=at_lean(block, 0.05 * side))
    before, after = impact_of(response)
    onto = block.restitutions[1 if side > 0.0 else 0]
    assert after / before == pytest.approx(onto, rel=1e-12)


def test_struck_corner_slips_below_required_friction():
    """Below b_B h/(k2 + h^2) the struck corner slips, above it sticks."""
    block = Block(0.5, 0.9)
    b, h, k2 = 0.25, 0.45, block.gyration_squared
    required = b * h / (k2 + h * h)
    for mu, slides in ((required * (1 - 1e-9), True), (required * (1 + 1e-9), False)):
        start = at_lean(block, 1e-3)
        outcome = solve_respond(block, still_ground(), mu=mu, initial=start).outcome
        assert sequence(outcome)[0] == "rock right"
        assert ("left +" in sequence(outcome)[1]) == slides or ("left -" in sequence(outcome)[1]) == slides


def test_plastic_impact_of_broad_block_ends_in_rest():
    """With b1 b2 > k2 + h^2 both corners stay in contact: a plastic impact ends the motion at once."""
    block = Block(1.2, 0.5)
    outcome = solve_respond(block, still_ground(), mu=3.0, initial=at_lean(block, 0.05)).outcome
    assert sequence(outcome) == ["rock right", "rest"]
    assert outcome.impacts == 1


def test_impact_with_restitution_ends_in_flight():
    """With e > 0 the struck corner rebounds and the other lifts: flight after the first impact."""
    outcome = solve_respond(SLENDER, still_ground(), mu=1.0, restitution=0.3, initial=at_lean(SLENDER, 0.05)).outcome
    assert sequence(outcome)[:2] == ["rock right", "flight"]
    assert outcome.settled


def test_flat_landing_with_horizontal_velocity_rebounds_without_spin():
    """Dropped flat with a horizontal velocity: heights e^2, horizontal impulse mu (1 + e) w against the slip."""
    start = (0.0, 0.35, 0.0, 3.0, 0.0, 0.0)
    response = solve_respond(Block(0.8, 0.5), still_ground(), mu=0.2, restitution=0.5, initial=start)
    landing = next(event for event in response.events if event.name == "landing")
    w = math.sqrt(0.2 * G)
    assert landing.after[5] == pytest.approx(0.5 * w, rel=1e-12)
    assert landing.after[3] == pytest.approx(3.0 - 0.2 * 1.5 * w, rel=1e-12)


def test_sliding_landing_of_slender_block_tips_forward():
    """The resultant of friction would leave the base: it lands on the leading corner and turns forward."""
    block = Block(0.3, 1.5)
    response = solve_respond(block, still_ground(), mu=0.8, initial=(0.0, 0.95, 0.0, 3.0, 0.0, 0.0))
    assert sequence(response.outcome)[1].startswith(("rock right", "slide-rock right"))
    before, after = impact_of(response)
    assert before == 0.0 and after > 0.0


def test_sliding_landing_with_low_friction_stays_flat():
    """The same with little friction stays flat and slides."""
    response = solve_respond(Block(0.3, 1.5), still_ground(), mu=0.1, initial=(0.0, 0.95, 0.0, 3.0, 0.0, 0.0))
    assert sequence(response.outcome) == ["flight", "slide +", "rest"]


@given(
    u=st.floats(-5.0, -1e-6),
    v=st.floats(-5.0, 5.0),
    rx=st.floats(-1.0, 1.0),
    ry=st.floats(-2.0, -0.05),
    k2=st.floats(0.02, 2.0),
    mu=st.floats(0.0, 3.0),
    e=st.floats(0.0, 0.99),
)
@settings(max_examples=300, deadline=None)
def test_routh_impulse_lies_in_friction_cone_and_dissipates(u, v, rx, ry, k2, mu, e):
    """The impulse is compressive, inside the cone, ends with a separating velocity, and dissipates energy."""
    nn, tt, tn = 1.0 + rx * rx / k2, 1.0 + ry * ry / k2, -rx * ry / k2
    normal, tangential, u_after, v_after = routh(u, v, nn, tt, tn, mu, e, False)
    assert normal >= 0.0 and u_after >= 0.0
    assert abs(tangential) <= mu * normal * (1.0 + 1e-9) + 1e-12
    assert u_after == pytest.approx(u + nn * normal + tn * tangential, abs=1e-9 * (1.0 + normal * nn))
    assert v_after == pytest.approx(v + tn * normal + tt * tangential, abs=1e-9 * (1.0 + normal * tt))
    gained = normal * (u + u_after) + tangential * (v + v_after)
    assert gained <= 1e-9 * (1.0 + normal)
    if e == 0.0:
        assert u_after == 0.0
    if v != 0.0 and v_after != 0.0 and v * v_after > 0.0:
        assert tangential == pytest.approx(-math.copysign(mu * normal, v), rel=1e-9, abs=1e-12)


@given(
    omega=st.floats(-3.0, 3.0),
    rise=st.floats(-3.0, 0.5),
    speed=st.floats(-3.0, 3.0),
    width=st.floats(0.2, 2.0),
    height=st.floats(0.2, 2.0),
    offset=st.floats(-0.4, 0.4),
    mu=st.floats(0.0, 1.5),
)
@settings(max_examples=300, deadline=None)
def test_two_corner_impact_dissipates_without_penetration(omega, rise, speed, width, height, offset, mu):
    """Moreau's plastic impact: nothing moves down afterwards and no energy is made, whichever corners stay."""
    block = Block(width, height, centroid_offset=offset * width)
    right, left = block.arms
    if rise - right * omega > 0.0 and rise + left * omega > 0.0:
        return
    p = respond_params(block, options=RespondOptions(mu=mu)).parameters(0.01)
    stays, rotated, slip, loss = both_corners_impact(omega, rise, speed, p, False)
    assert loss >= -1e-12
    speed_after = slip + block.centre * rotated
    if stays == CLOSED_BOTH:
        assert rotated == 0.0
        rise_after = 0.0
    elif stays == CLOSED_NONE:
        return
    else:
        rise_after = (right if stays == CLOSED_RIGHT else -left) * rotated
        assert rotated >= 0.0 if stays == CLOSED_RIGHT else rotated <= 0.0
        assert stays in (CLOSED_LEFT, CLOSED_RIGHT)
    k2 = block.gyration_squared
    before = rise**2 + speed**2 + k2 * omega**2
    assert before - (rise_after**2 + speed_after**2 + k2 * rotated**2) == pytest.approx(2.0 * loss, abs=1e-9)


def test_given_restitution_scales_angular_velocity():
    """The rate of the lean is multiplied by r while friction lasts, as in a rocking model with a given restitution."""
    response = solve_respond(SLENDER, still_ground(), mu=5.0, rocking_restitution=0.8, initial=at_lean(SLENDER, 0.05))
    before, after = impact_of(response)
    assert after / before == pytest.approx(0.8, rel=1e-12)
    assert response.outcome.ratios_lowered == 0


def test_given_restitution_is_lowered_when_it_would_create_energy():
    """An asymmetric body falling from its far to its near corner: r = 1 gains energy and is reduced, with a warning."""
    response = solve_respond(UNEQUAL, still_ground(), mu=5.0, rocking_restitution=1.0, initial=at_lean(UNEQUAL, 0.05))
    assert response.outcome.ratios_lowered > 0
    assert any("energy" in text for text in response.warnings)
    assert response.outcome.energy_impacts_j >= -1e-9


def test_zero_restitution_stops_block_at_first_impact():
    """With r = 0 the first impact is the last."""
    outcome = solve_respond(SLENDER, still_ground(), mu=5.0, rocking_restitution=0.0, initial=at_lean(SLENDER, 0.05)).outcome
    assert sequence(outcome) == ["rock right", "rest"]


@pytest.mark.parametrize("restitution", [0.0, 0.5])
@pytest.mark.parametrize(("width", "height", "mu"), [(1.0, 3.0, 2.0), (1.0, 6.0, 5.0), (1.6, 6.8, 2.0)])
def test_zero_restitution_above_painleve_limit_decays_to_rest(width, height, mu, restitution):
    """Above Painleve's limit what slips on after r = 0 jams and is thrown up, ever less: below the smallest rate it rests."""
    block = Block(width, height, mass=1.0)
    response = solve_respond(block, still_ground(), mu=mu, restitution=restitution, rocking_restitution=0.0, initial=at_lean(block, 0.03))
    outcome = response.outcome
    assert outcome.settled
    assert outcome.jams > 3
    assert sequence(outcome)[-1] == "rest"
    total = outcome.energy_friction_j + outcome.energy_impacts_j
    lifted = G * (at_lean(block, 0.03)[1] - block.centre)
    assert total == pytest.approx(lifted, rel=1e-9)


def test_painleve_limit_of_rectangle_is_four_thirds():
    """2 sqrt(kappa (1 + kappa)) with kappa = 1/3 is 4/3 for any slenderness; above it there is a warning, below it none."""
    for block in (SLENDER, Block(1.0, 0.4)):
        assert respond_params(block, options=RespondOptions(mu=0.5)).rigid_body.friction_limit == pytest.approx(4.0 / 3.0, rel=1e-14)
        assert any("Painleve" in text for text in solve_respond(block, still_ground(0.1), mu=1.4).warnings)
        assert not solve_respond(block, still_ground(0.1), mu=1.3).warnings


def test_contact_denominator_changes_sign_at_painleve_limit():
    """Just below 4/3 the denominator P stays positive at every lean; just above there is a lean at which it does not."""
    lean = np.linspace(0.0, 1.5, 200001)
    block = Block(0.3, 1.2)
    rx = 0.15 * np.cos(lean) - 0.6 * np.sin(lean)
    ry = -0.15 * np.sin(lean) - 0.6 * np.cos(lean)
    for mu, positive in ((4.0 / 3.0 - 1e-6, True), (4.0 / 3.0 + 1e-6, False)):
        minimum = min((1.0 + rx * (rx + s * mu * ry) / block.gyration_squared).min() for s in (1.0, -1.0))
        assert (minimum > 0.0) == positive


def test_flat_slip_above_painleve_limit_jams_with_energy_loss():
    """With mu b h > k2 + b^2 and a sliding start: no sliding force is consistent; the slip ends at once, with a loss, and is counted."""
    block = Block(0.5, 1.0)
    assert block.gyration_squared + 0.25**2 < 3.0 * 0.25 * 0.5
    response = solve_respond(block, still_ground(), mu=3.0, initial=(0.0, 0.5, 0.0, 0.5, 0.0, 0.0))
    assert response.outcome.jams == 1
    assert sequence(response.outcome)[0] == "rock right"
    assert response.outcome.energy_impacts_j > 0.0
    assert any("jams: 1" in text for text in response.warnings)
    mirrored = solve_respond(block, still_ground(), mu=3.0, initial=(0.0, 0.5, 0.0, -0.5, 0.0, 0.0))
    assert sequence(mirrored.outcome)[0] == "rock left"


def test_jam_with_restitution_ends_in_flight():
    """The same with e > 0 ends in flight."""
    outcome = solve_respond(Block(0.5, 1.0), still_ground(), mu=3.0, restitution=0.4, initial=(0.0, 0.5, 0.0, 0.5, 0.0, 0.0)).outcome
    assert outcome.jams >= 1
    assert sequence(outcome)[0] == "flight"


def test_squat_asymmetric_block_with_restitution_comes_to_rest():
    """Rattling on two unequal corners with restitution ends in rest."""
    outcome = solve_respond(SQUAT, still_ground(), mu=0.4, restitution=0.5, initial=(0.0, 0.5, 0.3, 0.5, 0.0, -2.0)).outcome
    assert outcome.settled
    assert outcome.impacts > 10


def test_infinite_corner_clattering_is_resolved_as_two_corner_impact():
    """Ground that falls away (G < 0) under a compact body: each plastic landing throws the other corner down, ever sooner."""
    block = Block(1.0, 0.6, mass=1.0, centroid_inertia=0.05)
    away = Motion.from_arrays(np.zeros(31), 0.01, vertical=np.full(31, -1.5 * G))
    start = (0.0, 0.31, 0.004, 0.3, -1.0, 0.02)
    response = solve_respond(block, away, mu=0.3, initial=start, settle_s=0.0)
    last = [event for event in response.events if event.name.startswith(("landing", "impact"))][-1]
    assert (last.after[0], last.after[2]) == (0.0, 0.0)
    assert 3 < response.outcome.impacts < 20
    assert sequence(response.outcome)[-1] == "flight"
    times = np.array([event.time_s for event in response.events if event.name.startswith("landing")])
    shorter = np.diff(times)[1:] / np.diff(times)[:-1]
    assert (shorter[1:] < 0.1).all()


@given(
    omega=st.floats(-3.0, 3.0),
    rise=st.floats(-3.0, -0.1),
    speed=st.floats(-3.0, 3.0),
    width=st.floats(0.2, 2.0),
    height=st.floats(0.2, 2.0),
    mu=st.floats(0.0, 0.8),
)
@settings(max_examples=200, deadline=None)
def test_two_corner_impact_of_mirrored_state_is_mirrored(omega, rise, speed, width, height, mu):
    """The other corner stays, with the opposite spin and slip."""
    p = respond_params(Block(width, height), options=RespondOptions(mu=mu)).parameters(0.01)
    stays, rotated, slip, loss = both_corners_impact(omega, rise, speed, p, False)
    mirrored = both_corners_impact(-omega, rise, -speed, p, False)
    assert mirrored[0] == {CLOSED_LEFT: CLOSED_RIGHT, CLOSED_RIGHT: CLOSED_LEFT}.get(stays, stays)
    assert mirrored[1:] == pytest.approx((-rotated, -slip, loss), abs=1e-12)

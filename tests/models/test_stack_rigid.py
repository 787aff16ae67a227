"""A pile of rigid stones obeys the mechanics that are known without it."""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from seisblock.bodies.block import Block
from seisblock.bodies.pile.contact import PileContact
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import PileStone
from seisblock.bodies.pile.toml import load_pile
from seisblock.core.errors import ParameterError, SolverError
from seisblock.core.units import STANDARD_GRAVITY as G
from seisblock.models.respond.solve import solve_respond
from seisblock.models.stack.arrays import PLASTIC_RESTITUTION, pile_arrays
from seisblock.models.stack.buffers import STEPS_REMAINING
from seisblock.models.stack.joint_geometry import compute_effective_base, effective_base
from seisblock.models.stack.outcome import Track, rotate_vectors, stack_outcome, stone_channels
from seisblock.models.stack.rigid_run import run_rigid
from seisblock.models.stack.solve import solve_stack
from seisblock.models.stack.step import POINT
from seisblock.records import Motion
from tests.crosscheck.test_stack_against_housner import housner
from tests.models.shaken_piles import random_case
from tests.report.long_record import STONES, motion

WIDTH = 0.2424
FINE = 5e-4


def block(ratio=3.0, **extra):
    return Pile("block", (PileStone("block", WIDTH, WIDTH, ratio * WIDTH),), **extra)


def still_ground(seconds, dt=0.002):
    return Motion.from_arrays(np.zeros(round(seconds / dt)), dt)


def sine_cycle(pga, hertz, dt=0.01):
    """Return one cycle of a sine and 1.5 s of rest."""
    time = np.arange(0.0, 1.0 / hertz + 0.5 * dt, dt)
    return Motion.from_arrays(np.append(pga * np.sin(2.0 * math.pi * hertz * time), np.zeros(150)), dt)


def lean_of(response):
    return 2.0 * np.arctan2(response["block_qy"], response["block_qw"])


def restitution_at_impact(response, alpha, start):
    """Return the ratio of angular velocities, from the leans before and after the first impact."""
    lean = lean_of(response)
    crossed = int(np.argmax(lean < 0.0))
    beyond = -lean[crossed : crossed + int(np.argmax(np.diff(lean[crossed:]) > 0.0)) + 1].min()
    return math.sqrt((math.cos(alpha - beyond) - math.cos(alpha)) / (math.cos(alpha - start) - math.cos(alpha)))


@pytest.mark.parametrize(("start", "step"), [(0.6, None), (0.1, None), (0.6, 5e-3), (0.1, 5e-4)])
@pytest.mark.parametrize("ratio", [3.0, 4.0, 6.0])
def test_free_rocking_of_rigid_stone_follows_housner(ratio, start, step):
    """Six impacts, of large and of small rocking, at any step: times within 0.2 %, amplitudes within 0.1 % of the closed form.

    A step that passes over an impact leaves the weight on the edge that strikes: -54 % after six impacts of the small rocking.
    """
    alpha = math.atan(1.0 / ratio)
    times, amplitudes = housner(ratio, WIDTH, start, 6)
    response = solve_stack(block(ratio, mu=5.0), still_ground(times[-1] + 0.2, 0.005), tilts={"block": start * alpha}, step=step)
    lean, time = lean_of(response) / alpha, response.time
    crossings = np.flatnonzero(lean[1:] * lean[:-1] < 0.0)[:6]
    part = lean[crossings] / (lean[crossings] - lean[crossings + 1])
    np.testing.assert_allclose(time[crossings] + part * np.diff(time)[crossings], times, rtol=2e-3)
    for (a, b), amplitude in zip(pairwise(crossings), amplitudes[1:], strict=False):
        top = a + 1 + int(np.argmax(np.abs(lean[a + 1 : b + 1])))
        nearby = slice(top - 2, top + 3)
        curve = np.polynomial.Polynomial.fit(time[nearby], lean[nearby], 2)
        assert abs(curve(curve.deriv().roots()[0])) == pytest.approx(amplitude, rel=1e-3)


@pytest.mark.parametrize(("hertz", "limit"), [(1.0, 3.82), (2.0, 4.57)])
def test_rigid_stone_overturns_at_respond_threshold(hertz, limit):
    """Threshold amplitudes under one cycle of a sine agree within 0.3 %: just below both stand, just above both fall."""
    plane, pile = Block(WIDTH, 3.0 * WIDTH), block(mu=1.0)

    def falls(pga):
        return bool(solve_respond(plane, sine_cycle(pga, hertz), mu=1.0).outcome.overturned)

    low, high = 3.0, 6.0
    while high - low > 5e-4 * low:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if falls(middle) else (middle, high)
    assert high == pytest.approx(limit, abs=0.01)
    assert not solve_stack(pile, sine_cycle(0.997 * high, hertz), stop_at_fall=True).outcome.overturned_any
    assert solve_stack(pile, sine_cycle(1.003 * high, hertz), stop_at_fall=True).outcome.overturned_any


@pytest.mark.parametrize("arguments", [None, 0.7, 0.95])
def test_impact_has_housner_or_given_restitution(arguments):
    """Without a restitution Housner's ratio of the rotation remains; with one that value, above or below Housner's."""
    alpha = math.atan(0.25)
    response = solve_stack(block(4.0, mu=5.0), still_ground(1.2), tilts={"block": 0.6 * alpha}, restitution=arguments, step=FINE)
    expected = 1.0 - 1.5 * math.sin(alpha) ** 2 if arguments is None else arguments
    assert restitution_at_impact(response, alpha, 0.6 * alpha) == pytest.approx(expected, abs=0.008)
    assert effective_base(response).restitution == pytest.approx(expected, abs=1e-12)
    assert response.outcome.created_j < 1e-3 * response.outcome.lost_j


@pytest.mark.parametrize(("points", "contact"), [(5, None), (5, PileContact()), (5, PileContact(stiffness=1e9))])
def test_contact_grid_uses_reported_base_width_and_restitution(points, contact):
    """The stone falls beyond the overturning angle of the narrower base, and an impact leaves the stated ratio."""
    stone = block(3.0).stones[0]
    result = compute_effective_base(stone, points, contact, None, G)
    assert (result.stone, result.width_ratio) == ("block", 0.8)
    assert result.restitution > result.housner_ratio + 0.05
    alpha = math.atan(0.8 / 3.0)
    tall = block(3.0, mu=5.0)
    solution = solve_stack(tall, still_ground(1.2), points=points, contact=contact, tilts={"block": 0.6 * alpha})
    assert restitution_at_impact(solution, alpha, 0.6 * alpha) == pytest.approx(result.restitution, abs=0.02)
    assert solve_stack(tall, still_ground(3.0), points=points, contact=contact, tilts={"block": 1.04 * alpha}).outcome.overturned_any


@pytest.mark.parametrize("elsewhere", [0.4, 0.8])
def test_rigid_block_on_slope_slides_with_kinetic_friction(elsewhere):
    """Below the angle of static friction it stays; beyond it slides with g (sin - mu_k cos), whatever other joints of the pile have."""
    static, kinetic, seconds = 0.4, 0.3, 3.0
    ramp = np.minimum(np.arange(0.0, seconds, 0.01), 1.0)

    def slope(angle):
        return Motion.from_arrays(G * np.sin(ramp * angle), 0.01, vertical=G * (np.cos(ramp * angle) - 1.0))

    flat = block(0.5, mu=elsewhere)
    flat = replace(flat, stones=tuple(replace(stone, mu=static) for stone in flat.stones))
    below = solve_stack(flat, slope(math.atan(0.99 * static)), mu_kinetic=kinetic)
    assert below.outcome.stones[0].residual_slip_m < 1e-5
    angle = math.atan(1.1 * static)
    above = solve_stack(flat, slope(angle), mu_kinetic=kinetic)
    inside = (above.time > 1.2) & (above.time < seconds - 0.1)
    result = 2.0 * np.polynomial.Polynomial.fit(above.time[inside], above["block_x"][inside], 2).convert().coef[2]
    assert result == pytest.approx(-G * (math.sin(angle) - kinetic * math.cos(angle)), rel=1e-3)


@pytest.mark.parametrize("name", ["wagata", "lantern"])
def test_colliding_rigid_stones_lose_energy_and_conserve_momentum(name):
    """Momentum equals the impulse through rocking, sliding, tumbling and rest; fallen stones rest on a face."""
    rng = np.random.default_rng(3)
    shaking = np.cumsum(rng.normal(size=(3, 600)) * np.array([[6.0], [6.0], [3.0]]) * np.hanning(600), axis=1) * 0.2
    outcome = solve_stack(load_pile(name), Motion(shaking, 0.01)).outcome
    assert outcome.created_j < 1e-3 * outcome.lost_j
    assert outcome.momentum_error < 1e-12
    assert outcome.overturned_any


def test_rigid_pile_below_thresholds_stays():
    """Five stones under a shaking that moves none of them stay within a hundredth of a millimetre."""
    time = np.arange(0.0, 5.0, 0.01)
    response = solve_stack(load_pile("wagata"), Motion.from_arrays(1.5 * np.sin(12.0 * time), 0.01))
    assert max(float(np.ptp(response[f"{name}_{axis}"])) for name in response.body.names for axis in "xyz") < 1e-5
    assert all(stone.state == "standing" for stone in response.outcome.stones)


def test_sleeping_stones_carry_load_or_wake():
    """A stone that rocks on two that lie rocks as on the ground; a joint that has to slide or to open under it does."""
    stones = (PileStone("foot", 0.5, 0.5, 0.25), PileStone("middle", 0.36, 0.36, 0.25, on="foot"))
    head = PileStone("block", WIDTH, WIDTH, 3.0 * WIDTH)
    motion = sine_cycle(3.9, 2.0)
    single = solve_stack(Pile("alone", (head,), mu=0.8), motion).outcome
    above = solve_stack(Pile("above", (*stones, replace(head, on="middle")), mu=0.8), motion).outcome
    assert single.max_tilt_rad["block"] > 0.01
    assert above.max_tilt_rad["block"] == pytest.approx(single.max_tilt_rad["block"], rel=0.01)
    assert above.max_tilt_rad["middle"] < 1e-5
    narrow = PileStone("middle", 0.1, 0.36, 0.25, on="foot")
    assert (
        solve_stack(Pile("narrow", (stones[0], narrow, replace(head, on="middle")), mu=0.8), motion).outcome.max_tilt_rad["middle"] > 0.01
    )


def test_quarter_turn_of_rigid_pile_and_motion_changes_little():
    """A square pile shaken along y does what it does along x, to what the order of the points leaves."""
    stones = (PileStone("foot", 0.5, 0.5, 0.2), PileStone("head", WIDTH, WIDTH, 0.7, on="foot"))
    along = sine_cycle(4.0, 1.5)
    across = Motion(along.acceleration[[1, 0, 2]], along.dt)
    first, second = (solve_stack(Pile("two", stones), motion, stop_at_fall=True) for motion in (along, across))
    assert first.outcome.overturned == second.outcome.overturned
    assert first.outcome.max_tilt_rad["head"] == pytest.approx(second.outcome.max_tilt_rad["head"], rel=5e-3)


def test_slicing_a_rigid_run_changes_no_bit(monkeypatch):
    """Slices of a few steps end with the same state and books as one slice."""
    motion, body = sine_cycle(6.0, 2.0), load_pile("wagata")
    full = solve_stack(body, motion)
    monkeypatch.setattr("seisblock.models.stack.simulation.SLICE_TIME", 1e-4)
    assert solve_stack(body, motion).outcome == full.outcome


def test_slices_of_slow_steps_are_short(monkeypatch):
    """A slice lasts a tenth of a second whatever a step costs, so that an interrupt and the progress do not wait for a large pile."""
    clock, lengths = [0.0], []

    def run(*arguments):
        before = int(arguments[-2].counters[STEPS_REMAINING])
        status = run_rigid(*arguments)
        lengths.append(before - int(arguments[-2].counters[STEPS_REMAINING]))
        clock[0] += lengths[-1] / 64.0
        return status

    monkeypatch.setattr("seisblock.models.stack.simulation.run_rigid", run)
    monkeypatch.setattr("seisblock.models.stack.simulation.perf_counter", lambda: clock[0])
    solve_stack(load_pile("wagata"), sine_cycle(6.0, 2.0))
    assert set(lengths[1:-1]) == {6}


@pytest.mark.parametrize(
    ("extra", "message"),
    [
        ({"law": "jelly"}, "'rigid' or 'springs', found 'jelly'"),
        ({"law": "rigid", "contact": PileContact()}, "has no effect with rigid contact"),
        ({"law": "springs", "restitution": 0.9}, "have no effect with contact springs"),
        ({"restitution": 1.5}, "restitution of the joints"),
        ({"restitution": 0.9, "points": 5}, "requires contact at the edges"),
        ({"mu_kinetic": 0.9}, "must not exceed static friction"),
        ({"step": 0.1}, "is out of range for the pile"),
        ({"step": 1e-9}, "is out of range for the pile"),
    ],
)
def test_solve_stack_rejects_conflicting_options(extra, message):
    """Each in one sentence."""
    with pytest.raises(ParameterError, match=message):
        solve_stack(block(), sine_cycle(1.0, 1.0), **extra)


def test_contact_springs_reject_kinetic_friction():
    with pytest.raises(ParameterError, match="has a kinetic friction coefficient, but contact springs use a single one"):
        solve_stack(block().with_kinetic_friction(0.1), sine_cycle(1.0, 1.0), law="springs")


@pytest.mark.parametrize("seed", [13, 24, 43, 150, 152, 164, 188])
def test_collapsing_rigid_piles_create_no_energy(seed):
    """Piles that made up to 600 times their own energy while corners and edges pushed stones out of each other one by one."""
    outcome = solve_stack(*random_case(seed), law="rigid").outcome
    assert max(outcome.max_tilt_rad.values()) > 0.1
    assert outcome.created_j < 5e-4 * outcome.lost_j
    assert outcome.momentum_error < 1e-12


@pytest.mark.slow
def test_random_rigid_piles_create_no_energy():
    """At most 1e-4 of its weight times its height in any of them, as many of which fall as stand."""
    fell = []
    for pile, shaking in map(random_case, range(200)):
        outcome = solve_stack(pile, shaking, law="rigid").outcome
        tall = sum(stone.height for stone in pile.stones)
        assert outcome.created_j < 1e-4 * sum(stone.mass for stone in pile.stones) * G * tall
        fell.append(outcome.overturned_any)
    assert 80 < sum(fell) < 120


def test_small_falling_pile_creates_no_energy():
    """A fiftieth of the size, in times that go with its root: forces of points 2 cm apart, more than a stone, were carried over."""
    pile, shaking = random_case(34)
    stones = [
        replace(s, width=0.02 * s.width, depth=0.02 * s.depth, height=0.02 * s.height, offset=(0.02 * s.offset[0], 0.02 * s.offset[1]))
        for s in pile.stones
    ]
    small = replace(pile, stones=tuple(stones))
    outcome = solve_stack(
        small, Motion(shaking.acceleration, math.sqrt(0.02) * shaking.dt), law="rigid", step=2e-3 * math.sqrt(0.02)
    ).outcome
    assert outcome.overturned_any
    assert outcome.created_j < 5e-5 * sum(stone.mass * G for stone in stones) * sum(stone.height for stone in stones)


@pytest.mark.parametrize(("component", "factor"), [("NS", 1.5), ("EW", 1.2), ("EW", 1.5)])
def test_stone_falling_off_wide_base_creates_no_energy(component, factor):
    """Falls that rigid stones left to springs, with a warning: they are followed to the end now."""
    result = solve_stack(STONES, motion(component, factor))
    assert (result.options.law, result.warnings) == ("rigid", ())
    assert result.outcome.overturned == ("sao",)
    assert result.outcome.created_j < 5e-4 * result.outcome.lost_j


def test_created_energy_falls_back_to_finer_steps_then_springs(monkeypatch):
    """A run that creates energy is solved again with springs, with a warning; rigid contact alone raises an error."""
    refused = []

    def judged(pile, end, **further):
        if not pile.constants[:, POINT].any() and further["step"] > refused[0]:
            raise SolverError("they created energy")
        return stack_outcome(pile, end, **further)

    monkeypatch.setattr("seisblock.models.stack.solve.stack_outcome", judged)
    refused[:] = [1e-3]
    for extra in ({}, {"law": "rigid"}, {"restitution": 0.5}, {"mu_kinetic": 0.1}):
        result = solve_stack(block(), sine_cycle(3.0, 1.0), **extra)
        assert result.options.law == "rigid"
        assert result.outcome.step_s < 1e-3
        assert "solved with a finer step of" in result.warnings[0]
    with pytest.raises(SolverError, match="created"):
        solve_stack(block(), sine_cycle(3.0, 1.0), step=2e-3)
    refused[:] = [0.0]
    with pytest.raises(SolverError, match="created"):
        solve_stack(block(), sine_cycle(3.0, 1.0), law="rigid")
    result = solve_stack(block(), sine_cycle(3.0, 1.0))
    assert result.options.law == "springs"
    assert "solved with contact springs, since rigid contact failed" in result.warnings[0]


@pytest.mark.parametrize(("share", "falls"), [(0.98, False), (1.02, True)])
def test_run_goes_on_while_a_stone_turns_back(share, falls):
    """A stone that leans near its critical angle when the record ends, still for a moment, was left there as if it stood."""
    alpha = math.atan(1.0 / 3.0)
    outcome = solve_stack(block(), still_ground(0.004), tilts={"block": share * alpha}).outcome
    assert outcome.overturned_any == falls
    assert falls or outcome.stones[0].residual_tilt_rad < 1e-3


def test_rotation_of_support_is_not_counted_as_slip():
    """A beam held by a post that turns, at the middle of their joint, has not slid over it, however far off its own centre is."""
    posts = [PileStone(name, 0.3, 0.3, 0.9, on="ground", offset=(x, 0.0)) for name, x in (("left", -0.6), ("right", 0.6))]
    pile = pile_arrays(
        Pile("gate", (*posts, PileStone("beam", 1.7, 0.25, 0.2, on="left", offset=(0.6, 0.0)))), None, 2, PLASTIC_RESTITUTION
    )
    turn, along = 0.4, np.array([0.02, -0.01, 0.0])
    full, half = (np.array([math.cos(angle / 2.0), 0.0, 0.0, math.sin(angle / 2.0)]) for angle in (turn, 0.5 * turn))
    start = np.array(pile.body.centres())
    joint = np.array([-0.6, 0.0, 0.9])
    beam = joint + along + rotate_vectors(half, start[2] - joint)
    centres, quaternions = np.array([start, [start[0], start[1], beam]]), np.array([[[1.0, 0.0, 0.0, 0.0]] * 3, [full, full, half]])
    track = Track(np.arange(2.0), centres, quaternions)
    slips = {channel.name: channel.values for channel in stone_channels(pile, track) if channel.name.endswith("_slip")}
    assert slips["beam_slip"] == pytest.approx([0.0, float(np.hypot(*along[:2]))], abs=1e-12)
    assert slips["left_slip"] == pytest.approx([0.0, 0.0], abs=1e-12)

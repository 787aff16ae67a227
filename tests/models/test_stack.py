"""A pile of stones on springs obeys the mechanics that are known without it."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from seisblock.bodies.pile.contact import PileContact
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import PileStone
from seisblock.bodies.pile.toml import load_pile
from seisblock.core.errors import ParameterError, SolverError
from seisblock.core.quaternions import inverse_rotation, rotate_vectors
from seisblock.core.units import STANDARD_GRAVITY as G
from seisblock.models.stack.outcome import MAX_CREATED_ENERGY, Track, tilt_angle, twist_angle
from seisblock.models.stack.solve import solve_stack as solve_stack_by
from seisblock.records import Motion

WIDTH = 0.24


def solve_stack(body, motion, *, law="springs", points=5, **extra):
    """The paper's law, with its 5 x 5 points; rigid stones have a file of their own."""
    return solve_stack_by(body, motion, law=law, points=points, **extra)


STIFF = PileContact(stiffness=1e9)


def block(ratio=3.0, **extra):
    return Pile("block", (PileStone("block", WIDTH, WIDTH, ratio * WIDTH),), **extra)


def slope(angle, dt=0.01):
    """Return the level motion under which a body feels the weight it has on a slope of these angles (rad) against time."""
    return Motion.from_arrays(G * np.sin(angle), dt, vertical=G * (np.cos(angle) - 1.0))


def sine(pga, hertz, seconds, dt=0.01):
    return Motion.from_arrays(pga * np.sin(2.0 * math.pi * hertz * np.arange(0.0, seconds, dt)), dt)


@pytest.mark.kernel
def test_spring_block_at_rest_stays():
    """Nothing moves under a ground that does not move, whatever the number of points."""
    for points in (2, 3):
        response = solve_stack(block(), Motion.from_arrays(np.zeros(3), 0.01), points=points)
        assert np.ptp(response["block_x"]) == 0.0
        assert np.ptp(response["block_z"]) < 1e-9


@pytest.mark.slow
def test_spring_pile_at_rest_stays_for_100_s():
    """The five-stone pile drifts by less than 0.1 mm in 100 s."""
    response = solve_stack(load_pile("wagata"), Motion.from_arrays(np.zeros(10_001), 0.01))
    drift = max(float(np.ptp(response[f"{name}_{axis}"])) for name in response.body.names for axis in "xyz")
    assert drift < 1e-5
    assert all(stone.state == "standing" for stone in response.outcome.stones)


def test_spring_block_on_slope_slides_above_friction_angle():
    """Just below the angle of friction a block stays; above it slides with g (sin - mu cos)."""
    mu, seconds = 0.4, 4.0
    flat = block(0.5, mu=mu)
    ramp = np.minimum(np.arange(0.0, seconds, 0.01), 1.0)
    below = solve_stack(flat, slope(ramp * math.atan(0.998 * mu)))
    assert below.outcome.stones[0].residual_slip_m < 1e-3
    angle = math.atan(1.2 * mu)
    above = solve_stack(flat, slope(ramp * angle))
    time, x = above.time, above["block_x"]
    inside = (time > 1.2) & (time < seconds - 0.1)
    acceleration = 2.0 * np.polynomial.Polynomial.fit(time[inside], x[inside], 2).convert().coef[2]
    assert acceleration == pytest.approx(-G * (math.sin(angle) - mu * math.cos(angle)), rel=1e-4)
    just = math.atan(1.002 * mu)
    assert solve_stack(flat, slope(ramp * just)).outcome.stones[0].residual_slip_m > 0.02


def test_slow_tilt_overturns_at_critical_angle():
    """A ground tilted ever so slowly lets the block go at tan = B/H, to 0.1 %, towards the lower side."""
    ratio = 3.0
    critical = math.atan(1.0 / ratio)
    time = np.arange(0.0, 20.0, 0.01)
    response = solve_stack(block(ratio, mu=2.0), slope(critical * (0.97 + 0.06 * time / 20.0)), points=2, contact=STIFF)
    tilt = response["block_tilt"]
    leaves = response.time[np.argmax(tilt > 2e-3)]
    assert response.outcome.overturned == ("block",)
    assert 0.97 + 0.06 * leaves / 20.0 == pytest.approx(1.0, abs=3e-3)
    assert abs(response.outcome.stones[0].fell_towards_deg) == pytest.approx(180.0, abs=1.0)


@pytest.mark.parametrize("hertz", [1.0, 2.5])
def test_mirrored_motion_gives_mirrored_response(hertz):
    """Shaking to the other side moves every stone to the other side, to the last bit while they stand."""
    motion = sine(6.0, hertz, 3.0)
    second = solve_stack(load_pile("wagata"), motion, stop_at_fall=True)
    back = solve_stack(load_pile("wagata"), Motion(-motion.acceleration, motion.dt), stop_at_fall=True)
    assert second.outcome.overturned == back.outcome.overturned
    for name in second.body.names:
        np.testing.assert_array_equal(second[f"{name}_x"], -back[f"{name}_x"])
        np.testing.assert_array_equal(second[f"{name}_z"], back[f"{name}_z"])
        np.testing.assert_array_equal(second[f"{name}_tilt"], back[f"{name}_tilt"])


def test_quarter_turn_of_pile_and_motion_changes_nothing():
    """A square pile shaken along y does what it does along x."""
    stones = (PileStone("foot", 0.5, 0.5, 0.2), PileStone("head", WIDTH, WIDTH, 0.7, on="foot"))
    along = sine(5.0, 1.5, 3.0)
    across = Motion(along.acceleration[[1, 0, 2]], along.dt)
    first, second = (solve_stack(Pile("two", stones), motion, stop_at_fall=True) for motion in (along, across))
    assert first.outcome.overturned == second.outcome.overturned == ("head",)
    np.testing.assert_allclose(first["head_x"], second["head_y"], atol=1e-9)


@pytest.mark.parametrize(("law", "tolerance"), [("rigid", 2e-5), ("springs", 1e-9)])
def test_slab_off_an_oblong_stone_slides_alike_along_both_axes(law, tolerance):
    """An oblong slab slides over the edge of an oblong stone along x; with both axes exchanged it does the same along y."""
    along = sine(4.0, 1.0, 2.0)
    across = Motion(along.acceleration[[1, 0, 2]], along.dt)
    results = []
    for motion, (width, depth), axis in ((along, (0.5, 0.3), "x"), (across, (0.3, 0.5), "y")):
        offset = (0.14, 0.0) if axis == "x" else (0.0, 0.14)
        stones = (PileStone("foot", width, depth, 0.2), PileStone("slab", 0.8 * depth, 0.8 * width, 0.1, on="foot", offset=offset))
        response = solve_stack(Pile("two", stones, mu=0.15), motion, law=law)
        assert np.ptp(response[f"slab_{axis}"]) > 0.01
        results.append(response[f"slab_{axis}"])
    np.testing.assert_allclose(results[1], results[0], atol=tolerance)


@pytest.mark.parametrize("reinforced", [False, True])
def test_dissipation_never_decreases_and_momentum_is_conserved(reinforced):
    """Dissipation by friction and dashpots never decreases, through rocking, falling and rest; momentum equals the impulse."""
    rng = np.random.default_rng(3)
    shaking = rng.normal(size=(3, 800)) * np.array([[6.0], [6.0], [3.0]]) * np.hanning(800)
    response = solve_stack(load_pile("wagata", reinforced=reinforced), Motion(np.cumsum(shaking, axis=1) * 0.2, 0.01))
    outcome = response.outcome
    assert outcome.created_j < 1e-6 * outcome.lost_j
    assert outcome.momentum_error < 1e-12
    assert outcome.overturned_any


def test_toppled_block_rests_on_its_side():
    """A block pushed over ends on the ground, flat on its side, sunk by its weight on the springs and no more."""
    response = solve_stack(block(3.0), Motion.from_arrays(np.zeros(3), 0.01), tilts={"block": 0.4})
    fate = response.outcome.stones[0]
    assert (fate.state, fate.fell_onto) == ("fallen", "ground")
    assert fate.residual_tilt_rad == pytest.approx(math.pi / 2, abs=2e-3)
    assert response["block_z"][-1] == pytest.approx(WIDTH / 2, abs=1e-3)
    assert fate.fell_towards_deg == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize(("ratio", "falls_at"), [(3.0, 60.0), (0.5, math.degrees(math.atan(2.0) + 0.1))])
def test_stone_falls_at_60_degrees_or_beyond_critical_angle(ratio, falls_at):
    """Let go beyond its balance it counts as fallen as it passes 60 degrees, a squat one 0.1 rad beyond its critical angle."""
    lean = math.atan(1.0 / ratio) + 0.02
    response = solve_stack(block(ratio, mu=2.0), Motion.from_arrays(np.zeros(3), 0.01), points=2, contact=STIFF, tilts={"block": lean})
    fell_at = response.outcome.stones[0].fell_at_s
    assert fell_at is not None
    # rows are kept at samples, between which the stone turns by less than 2 degrees
    tilt = np.degrees(np.interp(fell_at, response.time, response["block_tilt"]))
    assert tilt == pytest.approx(falls_at, abs=0.5)


def test_free_rotation_conserves_energy():
    """A block that turns about all its axes in the air keeps its energy until it lands."""
    from seisblock.models.stack.arrays import pile_arrays
    from seisblock.models.stack.frames import L, X, update_rotation_matrix, update_spin
    from seisblock.models.stack.step import drift, kick, mechanical_energy

    pile = pile_arrays(block(2.0), PileContact(), 2)
    bodies = pile.bodies.copy()
    bodies[0, X + 2] = 100.0
    bodies[0, L : L + 3] = pile.inertias[0, 1] * np.array([3.0, 1.0, -2.0])
    update_rotation_matrix(bodies[0])
    update_spin(bodies[0], pile.inertias[0])
    before = mechanical_energy(1, bodies, pile.inertias, 0.0)
    for _ in range(2000):
        kick(1, bodies, pile.inertias, 0.0, 0.0, 0.0, 1e-3)
        drift(1, bodies, pile.inertias, 1e-3)
    update_spin(bodies[0], pile.inertias[0])
    assert mechanical_energy(1, bodies, pile.inertias, 0.0) == pytest.approx(before, rel=1e-6)


@pytest.mark.parametrize(("shift", "falls"), [(0.85, False), (1.15, True)])
def test_slab_tips_when_its_centre_passes_the_edge(shift, falls):
    """A slab slid over the border of a post tips over it once its centre of gravity is beyond, and not before."""
    post, slab = PileStone("post", 0.3, 0.3, 0.3), PileStone("slab", 0.3, 0.3, 0.06, on="post", mu=0.001)
    # a base that jumps to the side by the distance wanted: the slab, almost without friction, stays behind
    distance, seconds, dt = shift * 0.15, 0.25, 0.002
    pulse = sine(1.0, 1.0 / seconds, seconds, dt).acceleration[0]
    pulse = np.append(pulse, np.zeros(round(1.0 / dt)))
    moved = np.cumsum(np.cumsum(pulse)) * dt * dt
    body = replace(Pile("ledge", (post, slab)), fixed=("post",))
    response = solve_stack(body, Motion.from_arrays(-pulse * distance / moved[-1], dt), contact=PileContact(stiffness=3e8))
    assert response.outcome.overturned == (("slab",) if falls else ())
    if falls:
        assert response.outcome.stones[1].fell_onto == "ground"
    assert response.outcome.created_j < 1e-3


def test_vertical_and_transverse_false_omit_those_motions():
    """Without them a run is that of the first row alone."""
    rng = np.random.default_rng(5)
    full = Motion(rng.normal(size=(3, 200)), 0.01)
    single = Motion.from_arrays(full.horizontal, 0.01)
    left_out = solve_stack(block(), full, vertical=False, across=False)
    np.testing.assert_array_equal(left_out["block_x"], solve_stack(block(), single)["block_x"])
    assert not np.array_equal(solve_stack(block(), full)["block_x"], left_out["block_x"])


def test_halving_the_step_changes_rocking_by_less_than_1_percent():
    """The default step has converged: half of it gives the same rocking to 1 %."""
    motion = sine(4.0, 2.0, 2.0)
    body = load_pile("wagata")
    coarse = solve_stack(body, motion)
    fine = solve_stack(body, motion, step=0.5 * coarse.outcome.step_s)
    assert fine.outcome.max_tilt_rad["sao"] == pytest.approx(coarse.outcome.max_tilt_rad["sao"], rel=0.01)


@pytest.mark.parametrize(
    ("step", "message"),
    [
        (0.01, "exceeds the stability limit of the pile"),
        (1e-12, "is unnecessarily small"),
        (-1.0, "must be positive"),
        (math.nan, "positive"),
    ],
)
def test_solve_stack_rejects_unstable_or_tiny_step(step, message):
    """A step beyond the stability limit, or too fine to end, raises an error that names a suitable one."""
    with pytest.raises(ParameterError, match=message):
        solve_stack(block(), sine(1.0, 1.0, 0.1), step=step)


@pytest.mark.parametrize("slice_time", [0.0, 1e-4])
def test_slicing_a_spring_run_changes_no_bit(slice_time, monkeypatch):
    """Slices of one step, or of a few, give the same state, rows and ledger as one slice; progress is reported."""
    motion, body = sine(6.0, 2.0, 1.0), load_pile("wagata")
    full = solve_stack(body, motion)
    monkeypatch.setattr("seisblock.models.stack.simulation.SLICE_TIME", slice_time)
    collected = []
    parts = solve_stack(body, motion, progress=lambda result, total: collected.append((result, total)))
    assert parts.outcome == full.outcome
    for first, second in zip(parts.channels, full.channels, strict=True):
        np.testing.assert_array_equal(first.values, second.values)
    # the ground at rest after the record is counted by itself: stones that settle are not at 100 % of the record
    record, rest = ([pair for pair in collected if (pair[1] == motion.samples - 1) == shaken] for shaken in (True, False))
    assert collected == sorted(record) + sorted(rest) and 0 < rest[0][0] <= rest[-1][0] < rest[-1][1]


def test_run_that_creates_energy_raises(monkeypatch):
    """A run that creates energy is refused, whatever it answers."""
    from seisblock.models.stack import outcome as stack_outcome

    monkeypatch.setattr(stack_outcome, "MAX_CREATED_ENERGY", -1.0)
    with pytest.raises(SolverError, match="give a finer `step`"):
        solve_stack(block(), sine(1.0, 1.0, 0.1))
    assert MAX_CREATED_ENERGY == 1e-3


@pytest.mark.parametrize("below", [0.4, 0.5])
def test_flush_stones_slipping_on_corners_create_no_energy(below):
    """Points that stand on the border of the stone below keep their load as it slips to and fro; the answer does not hang on the step."""
    pile = Pile("flush", (PileStone("low", below, 0.4, 0.2), PileStone("high", 0.4, 0.4, 0.2, on="low")), mu=0.4)
    t = np.arange(0.0, 4.0, 0.01)
    shaking = Motion(np.array([6.0 * np.sin(6.0 * t), 5.0 * np.sin(9.0 * t), np.zeros(t.size)]), 0.01)
    coarse, fine = (solve_stack(pile, shaking, points=2, step=step).outcome for step in (None, 1e-4))
    for outcome in (coarse, fine):
        assert outcome.created_j < 1e-4 * outcome.lost_j
        assert max(outcome.max_tilt_rad.values()) < 0.02
        assert not outcome.overturned_any
    assert coarse.residual_slip_m["high"] > 5e-3
    assert coarse.residual_slip_m["high"] == pytest.approx(fine.residual_slip_m["high"], rel=0.05)


def test_solve_stack_rejects_options_out_of_range():
    """Gravity, points and stones that are not there are one sentence each."""
    motion = sine(1.0, 1.0, 0.1)
    with pytest.raises(ParameterError, match="gravity must be positive"):
        solve_stack(block(), motion, gravity=0.0)
    with pytest.raises(ParameterError, match="must be an integer of at least 2"):
        solve_stack(block(), motion, points=1)
    with pytest.raises(ParameterError, match="no free stone named 'nose'"):
        solve_stack(block(), motion, tilts={"nose": 0.1})


@pytest.mark.slow
def test_colliding_spring_stones_create_no_energy():
    """A lantern and a gravestone shaken to pieces: every tumble, edge on edge, keeps the books."""
    from seisblock.validation.furukawa_pile import kobe_like

    for seed in range(4):
        motion = kobe_like("7", seed)
        for name in ("lantern", "wagata"):
            outcome = solve_stack(load_pile(name), motion).outcome
            assert outcome.created_j < 1e-4 * outcome.lost_j
            assert outcome.overturned_any


def test_quaternion_rotation_equals_scipy():
    """Turned vectors, tilt and turn about the vertical, from quaternions, against rotation matrices."""
    quaternions = np.random.default_rng(3).normal(size=(50, 4))
    quaternions /= np.linalg.norm(quaternions, axis=1)[:, None]
    matrices = Rotation.from_quat(np.roll(quaternions, -1, axis=1)).as_matrix()
    vectors = np.random.default_rng(4).normal(size=(50, 3))
    np.testing.assert_allclose(rotate_vectors(quaternions, vectors), np.einsum("nij,nj->ni", matrices, vectors), atol=1e-14)
    np.testing.assert_allclose(rotate_vectors(inverse_rotation(quaternions), rotate_vectors(quaternions, vectors)), vectors, atol=1e-14)
    track = Track(np.arange(50.0), np.zeros((50, 1, 3)), quaternions[:, None, :])
    np.testing.assert_allclose(tilt_angle(track, 0), np.arccos(matrices[:, 2, 2]), atol=1e-12)
    # about the vertical alone, whatever the tilt: the turn that brings the stone nearest to where it is
    nearest = np.arctan2(matrices[:, 1, 0] - matrices[:, 0, 1], matrices[:, 0, 0] + matrices[:, 1, 1])
    np.testing.assert_allclose(np.exp(1j * twist_angle(track, 0)), np.exp(1j * nearest), atol=1e-12)

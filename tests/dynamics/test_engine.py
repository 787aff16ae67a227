"""The engine gives the known answers of models that have one."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import ellipk

from seisblock.core.errors import SolverError
from seisblock.core.results import Status
from seisblock.dynamics import Instant, integrate
from seisblock.records import Motion
from tests.dynamics.toy_models import BALL, COUNTED, FLIP, PENDULUM, RACE, SLED

pytestmark = pytest.mark.kernel

STILL = Motion.from_arrays(np.zeros(301), 0.01)


def test_bouncing_ball_bounces_in_a_geometric_series():
    """Bounce k comes at t1 + 2 t1 (e + ... + e^k), to round-off."""
    g, e = 9.8, 0.7
    answer = integrate(BALL, STILL, [g, e, 1e-6], [1.0, 0.0], 0)
    first = np.sqrt(2 / g)
    expected = [first + 2 * first * sum(e**j for j in range(1, k + 1)) for k in range(answer.n_events)]
    assert answer.status == Status.STOPPED
    assert answer.n_events > 30
    np.testing.assert_allclose([change.time for change in answer.events], expected, rtol=0, atol=1e-14)


def test_bouncing_ball_rises_to_e_squared_between_samples():
    """The extremum between bounces is the exact one, not that of a sample."""
    answer = integrate(BALL, STILL, [9.8, 0.7, 1e-6], [0.0, 3.0], 0)
    assert answer.extrema[0, 0] == pytest.approx(3.0**2 / (2 * 9.8), rel=1e-14)
    assert answer.extrema[0, 1] == pytest.approx(3.0 / 9.8, rel=1e-7)


def test_pendulum_period_is_the_elliptic_integral():
    """A series that does not end is converged to round-off: T = 4 K(sin(a/2)) / w."""
    amplitude, w2 = 2.0, 20.0
    period = 4 * ellipk(np.sin(amplitude / 2) ** 2) / np.sqrt(w2)
    dt = period / 150
    motion = Motion.from_arrays(np.zeros(301), dt)
    answer = integrate(PENDULUM, motion, [w2], [amplitude, 0.0], 0)
    np.testing.assert_allclose(answer.final, [amplitude, 0.0], atol=3e-12)


def test_pendulum_agrees_with_an_independent_integrator():
    """DOP853 at 1e-13 gives the same end."""
    answer = integrate(PENDULUM, STILL, [20.0], [1.0, 0.3], 0)
    second = solve_ivp(lambda _, y: [y[1], -20 * np.sin(y[0])], (0, 3), [1.0, 0.3], method="DOP853", rtol=1e-13, atol=1e-14)
    np.testing.assert_allclose(answer.final, second.y[:, -1], atol=1e-11)


def test_long_steps_are_cut_until_the_series_converges():
    """With one sample per 1.5 s the step rule cuts the step; the answer stays."""
    coarse = integrate(PENDULUM, Motion.from_arrays(np.zeros(3), 1.5), [20.0], [1.0, 0.3], 0)
    fine = integrate(PENDULUM, STILL, [20.0], [1.0, 0.3], 0)
    np.testing.assert_allclose(coarse.final, fine.final, atol=1e-11)


def test_piecewise_linear_input_is_integrated_exactly():
    """A free sled under a linear ramp follows its cubic, whatever the samples."""
    ramp = Motion.from_arrays(np.linspace(0.0, 3.0, 4), 1.0)
    answer = integrate(SLED, ramp, [0.0], [0.0, 0.0], 1)
    assert answer.final[0] == pytest.approx(-(3.0**3) / 6, rel=1e-15)


def test_touched_guard_does_not_fire():
    """A guard that is touched, over one sample or over a plateau, does not end the mode."""
    plateau = Motion.from_arrays([0.0, 0.3, 0.3, 0.3, 0.0, 0.3, 0.0], 0.1)
    assert integrate(SLED, plateau, [0.3], [0.0, 0.0], 0).n_events == 0
    assert integrate(SLED, plateau, [0.3 - 1e-9], [0.0, 0.0], 0).n_events > 0


def test_start_inside_a_sample():
    """Starting at an instant inside a sample continues the same trajectory."""
    ramp = Motion.from_arrays([0.0, 1.0, -2.0, 0.5], 0.5)
    full = integrate(SLED, ramp, [0.0], [0.0, 0.0], 1, start=Instant(1, 0.0))
    half = integrate(SLED, ramp, [0.0], [0.0, 0.0], 1, start=Instant(1, 0.2))
    a0, slope = 1.0 - 6.0 * 0.2, -6.0
    h = 0.3
    u1, v1 = -(a0 * h**2 / 2 + slope * h**3 / 6), -(a0 * h + slope * h**2 / 2)
    rest = integrate(SLED, ramp, [0.0], [u1, v1], 1, start=Instant(2, 0.0))
    np.testing.assert_allclose(half.final, rest.final, rtol=1e-14)
    assert half.path.first == 2
    assert full.path.first == 1


def test_chattering_raises_with_time():
    """Two modes that return to each other at one instant are an error with its time."""
    with pytest.raises(SolverError, match="two modes"):
        integrate(FLIP, STILL, [], [0.0], 0)


def test_first_of_guards_already_passed_fires():
    """Two gates behind the start are passed at once, the model's first one for the record."""
    answer = integrate(RACE, STILL, [-1.0, -2.0], [0.0], 0)
    assert [(change.time, change.guard) for change in answer.events] == [(0.0, 0)]


@pytest.mark.parametrize("at", [0.0, 0.013, 0.02, 0.005])
def test_first_of_simultaneous_guards_fires(at):
    """At one instant, inside a sample, on one, or at the start, the order of the model decides; else the earlier guard does."""
    late = at + 1e-9
    for gates, first in (((at, at), 0), ((at, late), 0), ((late, at), 1)):
        answer = integrate(RACE, STILL, gates, [0.0], 0)
        assert [change.guard for change in answer.events] == [first]
        assert answer.end_time == pytest.approx(at, abs=1e-16)


def test_mirrored_motion_gives_mirrored_result():
    """The mirrored motion gives the mirrored answer, bit by bit."""
    rng = np.random.default_rng(1)
    a = rng.normal(size=200)
    left = integrate(SLED, Motion.from_arrays(a, 0.02), [0.4], [0.0, 0.0], 0)
    right = integrate(SLED, Motion.from_arrays(-a, 0.02), [0.4], [0.0, 0.0], 0)
    np.testing.assert_array_equal(left.final, -right.final)
    np.testing.assert_array_equal(left.states, -right.states)


def test_trajectory_table_has_both_limits_of_each_event():
    """Times never fall, and every event stands twice."""
    answer = integrate(BALL, STILL, [9.8, 0.7, 1e-3], [1.0, 0.0], 0)
    time, states, _ = answer.table()
    assert np.all(np.diff(time) >= 0)
    assert time.size == answer.end.sample + 1 + 2 * answer.n_events
    np.testing.assert_array_equal(states[-1], answer.events[-1].after)


def test_result_is_independent_of_stored_path():
    """Without path and events the end and the extrema are the same."""
    remaining = integrate(BALL, STILL, [9.8, 0.7, 1e-3], [1.0, 0.0], 0)
    bare = integrate(BALL, STILL, [9.8, 0.7, 1e-3], [1.0, 0.0], 0, keep_path=False, keep_events=False)
    assert bare.n_events == remaining.n_events
    np.testing.assert_array_equal(bare.extrema, remaining.extrema)
    np.testing.assert_array_equal(bare.final, remaining.final)


def test_sharp_guard_lands_from_tiny_height():
    """A ball that starts 1e-19 m above the floor with 1e-9 m/s comes down when it is at the floor, not at the height it started from."""
    still = Motion.from_arrays(np.zeros(2), 0.01)
    height, speed = 1e-19, 1e-9
    for model, start in ((BALL, 0.0), (replace(BALL, sharp=1), height)):
        first = integrate(model, still, [9.8, 0.5, 1.0], [height, speed], 0).events[0]
        assert first.time == pytest.approx((speed + (speed**2 + 2 * 9.8 * start) ** 0.5) / 9.8, rel=1e-12)


def test_state_marked_constant_is_kept():
    """Its row of the series is not read, and it is kept at every sample."""
    path = integrate(COUNTED, Motion.from_arrays(np.zeros(11), 0.1), [], [0.0, 3.0], 0).states
    np.testing.assert_allclose(path[:, 0], 0.1 * np.arange(11), atol=1e-15)
    np.testing.assert_array_equal(path[:, 1], 3.0)

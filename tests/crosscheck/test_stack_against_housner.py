"""On stiff contacts one block of the pile rocks as Housner's."""

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from seisblock.bodies.pile.contact import PileContact
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import PileStone
from seisblock.core.units import STANDARD_GRAVITY as G
from seisblock.models.stack.solve import solve_stack
from seisblock.records import Motion


def housner(ratio, width, start, impacts):
    """Return times of the impacts, s, and amplitudes over alpha, of a rigid block let go at `start` ([Housner1963]_)."""
    alpha, radius = math.atan(1.0 / ratio), 0.5 * width * math.hypot(1.0, ratio)
    p = math.sqrt(0.75 * G / radius)
    remaining = (1.0 - 1.5 * math.sin(alpha) ** 2) ** 2

    def height(x):
        return math.cos(alpha * (1.0 - x)) - math.cos(alpha)

    def quarter(x):
        def down(_, y):
            return y[0]

        down.terminal = True
        path = solve_ivp(lambda _, y: [y[1], -p * p * math.sin(alpha * (1.0 - y[0])) / alpha], (0, 9), [x, 0.0], events=down, rtol=1e-10)
        return path.t_events[0][0]

    amplitudes, times = [start], [quarter(start)]
    for _ in range(impacts - 1):
        level = remaining * height(amplitudes[-1])
        amplitudes.append(brentq(lambda x, level=level: height(x) - level, 0.0, amplitudes[-1]))
        times.append(times[-1] + 2.0 * quarter(amplitudes[-1]))
    return np.array(times), np.array(amplitudes)


@pytest.mark.parametrize("ratio", [3.0, 4.0, 6.0])
def test_free_rocking_in_the_stiff_limit(ratio):
    """Six impacts: amplitudes within 2 % (here 0.5 %) and times of impact within 0.5 % of Housner's."""
    width, start = 0.2424, 0.6
    alpha = math.atan(1.0 / ratio)
    body = Pile("block", (PileStone("block", width, width, ratio * width),), mu=5.0)
    times, amplitudes = housner(ratio, width, start, 6)
    motion = Motion.from_arrays(np.zeros(math.ceil((times[-1] + 0.2) / 0.002)), 0.002)
    response = solve_stack(body, motion, points=2, contact=PileContact(stiffness=1e10, damping_ratio=3.0), tilts={"block": start * alpha})
    lean = 2.0 * np.arctan2(response["block_qy"], response["block_qw"]) / alpha
    crossings = np.flatnonzero(lean[1:] * lean[:-1] < 0.0)
    part = lean[crossings] / (lean[crossings] - lean[crossings + 1])
    result = response.time[crossings] + part * np.diff(response.time)[crossings]
    np.testing.assert_allclose(result[:6], times, rtol=5e-3)
    peaks = [np.abs(lean[a + 1 : b + 1]).max() for a, b in pairwise(crossings[:6])]
    np.testing.assert_allclose(peaks, amplitudes[1:], rtol=5e-3)

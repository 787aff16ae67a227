"""Sliding stones of a pile follow their events at the default step."""

import math
from itertools import pairwise

import numpy as np
import pytest

from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import PileStone
from seisblock.core.units import STANDARD_GRAVITY as G
from seisblock.models.stack.solve import solve_stack
from seisblock.records import Motion

DT, STATIC = 0.01, 0.42


def sine(pga, hertz, cycles, rest):
    """Return cycles of a sine, and rest."""
    time = np.arange(0.0, cycles / hertz + rest, DT)
    return pga * np.sin(2.0 * math.pi * hertz * time) * (time * hertz < cycles)


def slide(shaking, kinetic, fine=500):
    """Return the slip of a slab, m, by the events of its motion: it clings, slides with kinetic friction, and clings where it stops."""
    slip, speed, side, h, result = 0.0, 0.0, 0.0, DT / fine, []
    for left, right in pairwise(shaking):
        result.append(slip)
        for k in range(fine):
            ground = left + (right - left) * (k + 0.5) / fine
            if side == 0.0:
                if abs(ground) <= STATIC * G:
                    continue
                side = -math.copysign(1.0, ground)
            rate = -ground - side * kinetic * G
            slip, speed = slip + h * speed + 0.5 * h * h * rate, speed + h * rate
            if speed * side <= 0.0:
                speed, side = 0.0, 0.0
    return np.array([*result, slip])


@pytest.mark.parametrize("kinetic", [0.31, STATIC])
@pytest.mark.parametrize(("pga", "hertz"), [(5.0, 1.0), (6.0, 2.0), (8.0, 4.0)])
def test_sliding_slab_matches_event_solution(pga, hertz, kinetic):
    """Within 1 % of the largest slip at the default step.

    Friction by the velocity at the end of a step missed by 2 to 7 % where kinetic friction is less, and by 3 % at 4 Hz where it is not.
    """
    shaking = sine(pga, hertz, 3.0, 0.5)
    slab = Pile("slab", (PileStone("slab", 1.0, 1.0, 0.1),), mu=STATIC)
    result = solve_stack(slab, Motion.from_arrays(shaking, DT), mu_kinetic=kinetic)
    expected = slide(shaking, kinetic)
    remaining = np.round(result.time / DT).astype(int)
    remaining = remaining[remaining < len(shaking)]
    assert np.abs(expected).max() > 0.005
    np.testing.assert_allclose(result["slab_x"][: remaining.size], expected[remaining], atol=0.01 * np.abs(expected).max())


def slide_as_one_body(shaking, fine=200):
    """Return the way along and across of slabs with one friction in all joints, m, as one body: implicit steps, shorter than a pile's."""
    way, speed, h, result = 0j, 0j, DT / fine, []
    level, up = (shaking[0] + 1j * shaking[1]).tolist(), shaking[2].tolist()
    for left, right, low, high in zip(level, level[1:], up, up[1:], strict=False):
        result.append(way)
        for k in range(fine):
            part = (k + 0.5) / fine
            free = speed - h * (left + (right - left) * part)
            brake = h * STATIC * (G + low + (high - low) * part)
            speed = free * max(1.0 - brake / max(abs(free), 1e-30), 0.0)
            way += h * speed
    ways = np.array([*result, way])
    return np.array([ways.real, ways.imag]).T


@pytest.mark.parametrize(
    ("pga", "hertz", "across", "up"), [(9.5, 2.1, 0.0, 0.0), (8.0, 3.9, 0.0, 0.0), (9.5, 3.2, 0.0, 3.0), (9.5, 3.9, 6.0, 0.0)]
)
@pytest.mark.parametrize("number", [2, 3])
def test_slabs_with_equal_friction_slide_as_one_body(number, pga, hertz, across, up):
    """Within 1 % of the largest slip at the default step: what stands on a slab clings to it where it turns.

    Where all that might stop in a step were braked for all of it, the upper ones were off by 2 to 19 % (not three along two axes).
    """
    time = np.arange(0.0, 3.0, DT)
    fading = np.exp(-time)
    turn = 2.0 * math.pi * hertz * time
    shaking = np.array([pga * fading * np.sin(turn), across * fading * np.sin(0.8 * turn), up * fading * np.sin(1.3 * turn)])
    sizes = [1.5, 1.2, 0.8]
    names = ["base", "middle", "top"][:number]
    slabs = [PileStone(name, size, size, 0.1, on=on) for name, size, on in zip(names, sizes, ["ground", *names], strict=False)]
    result = solve_stack(Pile("slabs", tuple(slabs), mu=STATIC), Motion(shaking, DT))
    expected = slide_as_one_body(shaking)
    remaining = np.round(result.time / DT).astype(int)
    remaining = remaining[remaining < len(time)]
    maximum = np.hypot(*expected.T).max()
    for name in names:
        for k, axis in enumerate("xy"):
            np.testing.assert_allclose(result[f"{name}_{axis}"][: remaining.size], expected[remaining, k], atol=0.01 * maximum)


def test_twenty_slabs_slide_where_the_lowest_does():
    """Within 0.2 % of what one slab slides, at its joint with the ground; errors of many joints spread it over them, 7 % off."""
    time = np.arange(0.0, 2.0, DT)
    rows = [
        5.0 * np.sin(2.0 * math.pi * 2.0 * time),
        3.0 * np.sin(2.0 * math.pi * 2.74 * time + 0.3),
        np.sin(2.0 * math.pi * 4.6 * time),
    ]

    def slips(count):
        slabs = tuple(PileStone(f"s{i}", 0.6, 0.6, 0.08, on=f"s{i - 1}" if i else "ground") for i in range(count))
        return [stone.residual_slip_m for stone in solve_stack(Pile("slabs", slabs, mu=0.3), Motion(np.array(rows), DT)).outcome.stones]

    alone, each = slips(1)[0], slips(20)
    assert alone > 0.01
    assert each[0] == pytest.approx(alone, rel=2e-3)
    assert max(each[1:]) < 2e-3 * alone


def test_turning_and_sliding_slab_matches_fine_steps():
    """Under two sines of unlike frequency half of 24 slabs within 1 % of the largest slip, nine of ten within 3 %, at the default step.

    Where the turn of a slip was not followed within a step, half of such slabs were within 3 %, and nine of ten within 13 %.
    """
    rng, missed = np.random.default_rng(12), []
    time = np.arange(0.0, 5.0, DT)
    for _ in range(24):
        size, pga, across = rng.uniform(0.5, 4.0), STATIC * G * rng.uniform(1.2, 3.0), rng.uniform(0.3, 1.0)
        first, second = 2.0 * math.pi * rng.uniform(0.6, 6.0, 2)
        rows = pga * np.array([np.sin(first * time), across * np.sin(second * time + 1.0), np.zeros(time.size)]) * np.minimum(time, 1.0)
        result = solve_stack(Pile("slab", (PileStone("slab", size, size, 0.1),), mu=STATIC), Motion(rows, DT))
        expected = slide_as_one_body(rows, fine=100)
        remaining = np.round(result.time / DT).astype(int)
        remaining = remaining[remaining < len(time)]
        way = np.array([result["slab_x"], result["slab_y"]]).T[: remaining.size]
        missed.append(np.hypot(*(way - expected[remaining]).T).max() / np.hypot(*expected.T).max())
    assert np.median(missed) < 0.01
    assert np.quantile(missed, 0.9) < 0.03


def test_slabs_apart_slide_as_each_does_alone():
    """Two on the ground, with weights and frictions of their own: what one carries does not brake the other."""
    slabs = (
        PileStone("heavy", 1.0, 1.0, 0.4, mu=STATIC, mu_kinetic=0.25),
        PileStone("light", 0.8, 0.8, 0.1, (3.0, 0.5), mu=0.3, mu_kinetic=0.2),
    )
    motion = Motion(np.array([sine(7.0, 2.0, 2.0, 0.3), sine(4.0, 1.6, 1.6, 0.3), np.zeros(130)]), DT)
    both = solve_stack(Pile("both", slabs), motion)
    for slab in slabs:
        alone = solve_stack(Pile("alone", (slab,)), motion)
        assert np.ptp(alone[f"{slab.name}_x"]) > 0.01
        for axis in "xyz":
            name = f"{slab.name}_{axis}"
            # samples at which all stones rest have no row
            np.testing.assert_allclose(np.interp(alone.time, both.time, both[name]), alone[name], atol=1e-7)

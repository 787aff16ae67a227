"""The reference block itself: closed forms, before anything is compared with it."""

import math

import numpy as np
import pytest

from tests.crosscheck.respond.cases import Case, some_case
from tests.crosscheck.respond.contact import FLIGHT, LEFT, REST, RIGHT, Body, Push, consistent_mode, jacobians, lever, reaction
from tests.crosscheck.respond.impact import FRICTION, GROUND, OMEGA, PATH, THETA, VX, X, Y, kinetic
from tests.crosscheck.respond.reference import respond
from tests.lengths import all_but_slow

G = 9.80665
STILL = np.zeros(101)
EXACT = 1e-12
"""A few hundred operations in double precision."""


def rectangle(b, h, mu, **options):
    """Return a homogeneous block of half width b and half height h."""
    return Body((b, b), h, (b * b + h * h) / 3, mu, options.pop("mu_kinetic", mu), **options)


def leaning(body, corner, theta):
    """Return the six numbers of a block at rest on one corner."""
    rx, ry = lever(body, corner, theta)
    return -rx, -ry, theta, 0.0, 0.0, 0.0


def run(case):
    """Return the trace of a case."""
    return respond(case.body, case.along, case.up, case.dt, case.initial)


def test_projectile():
    """A thrown block falls on a parabola at a constant spin until a corner lands, at the time that the corner's own equation gives."""
    body = rectangle(0.2, 0.6, 0.5)
    start = (0.0, 1.5, 0.3, 1.0, 2.0, -1.0)
    trace = respond(body, STILL, STILL, 0.01, start)
    mode, landing = trace.events[0], trace.events[1][0]
    assert mode[1] == "flight"
    theta = 0.3 - landing
    gap = 1.5 + 2.0 * landing - G * landing**2 / 2 + min(lever(body, corner, theta)[1] for corner in (RIGHT, LEFT))
    assert gap == pytest.approx(0.0, abs=EXACT)


def test_housner():
    """From one corner to the other the spin keeps 1 - 1.5 sin^2 alpha, so the energy above standing its square."""
    b, h, theta = 0.15, 0.5, 0.2
    body = rectangle(b, h, 5.0)
    start = leaning(body, RIGHT, theta)
    trace = respond(body, STILL[:71], STILL[:71], 0.01, start, settle=0.0)
    assert [event[1:3] for event in trace.events] == [("rock", "right"), ("rock", "left")]
    remaining = 1 - 1.5 * math.sin(math.atan2(b, h)) ** 2
    assert (trace.energy() - G * h) / (G * (start[1] - h)) == pytest.approx(remaining**2, rel=EXACT)


def test_quarter_period():
    """The first fall lasts arcosh(1/(1 - theta/alpha))/p where the lean is small ([Housner1963] eq. (6))."""
    b, h = 0.05, 1.0
    body = rectangle(b, h, 5.0)
    alpha, p = math.atan2(b, h), math.sqrt(0.75 * G / math.hypot(b, h))
    trace = respond(body, STILL, STILL, 0.01, leaning(body, RIGHT, 0.5 * alpha), settle=0.0)
    assert trace.events[1][0] == pytest.approx(math.acosh(2.0) / p, rel=alpha**2)


def test_sliding():
    """A block set sliding at v stops after v/(mu g), having slid v^2/(2 mu g)."""
    body = rectangle(0.3, 0.4, 0.5, mu_kinetic=0.4)
    trace = respond(body, STILL, STILL, 0.01, (0.0, 0.4, 0.0, -1.3, 0.0, 0.0))
    assert [event[1:] for event in trace.events] == [("slide", None, "-"), ("rest", None, None)]
    assert trace.events[1][0] == pytest.approx(1.3 / (0.4 * G), rel=EXACT)
    assert trace.state[X] == pytest.approx(-(1.3**2) / (0.8 * G), rel=EXACT)
    assert trace.state[PATH] == pytest.approx(-trace.state[X], rel=EXACT)


@pytest.mark.parametrize(("b", "h", "mu"), [(0.2, 0.6, 0.9), (0.2, 0.6, 0.2), (0.4, 0.5, 0.6), (0.2, 0.6, 0.34)])
@pytest.mark.parametrize("push", [0.15, 0.3, 0.5, 0.7, 1.1])
def test_initiation(b, h, mu, push):
    """From rest a rectangle rests, slides, rocks or slides while rocking as Shenton's inequalities say (kinetic as static friction)."""
    body = rectangle(b, h, mu)
    k2, corner = body.k2, (0, None)
    if push <= min(mu, b / h):
        expected = REST
    elif mu < b / h:
        expected = (1, 1)
    else:
        turn = (h * push - b) / (k2 + h * h + b * b)
        holding = (push - h * turn) / (1 + b * turn) <= mu
        expected = corner if holding else (1, None)
    assert consistent_mode(body, 0.0, 0.0, 0.0, (RIGHT, LEFT), Push(-push * G, G)) == expected


def test_painleve():
    """A homogeneous rectangle reaches the paradox above mu = 4/3, at the tilt with kappa = tan^2 phi/(1 - tan^2 phi) = 1/3."""
    phi = math.atan(0.5)
    body = rectangle(0.3, 0.3, 4 / 3)
    theta = math.atan2(0.3, 0.3) - phi
    yields = reaction(body, jacobians(body, theta), 0.0, Push(0.0, G), (1, None)).mobility
    assert yields == pytest.approx(0.0, abs=EXACT)


def test_lift_of_the_ground():
    """Ground that falls faster than g lets the block fly."""
    assert consistent_mode(rectangle(0.2, 0.6, 0.5), 0.0, 0.0, 0.0, (RIGHT, LEFT), Push(0.0, -0.1)) == FLIGHT


@pytest.mark.parametrize("e", [0.2, 0.5, 0.8])
def test_hops_end(e):
    """A block dropped flat hops for sqrt(2 H/g) (1 + e)/(1 - e)."""
    body = rectangle(0.3, 0.4, 0.5, restitution=e)
    trace = respond(body, STILL, STILL, 0.01, (0.0, 0.5, 0.0, 0.0, 0.0, 0.0))
    assert trace.mode == "rest"
    assert trace.events[-1][0] == pytest.approx(math.sqrt(0.2 / G) * (1 + e) / (1 - e), rel=1e-10)


@pytest.mark.parametrize("seed", all_but_slow([7, 14, 57, 65, 95, 158], {7, 14, 57, 95, 158}))
def test_energy(seed):
    """Work of the ground, friction and impacts make up the change of energy; no impact gains any."""
    case = some_case(seed)
    trace = run(case)
    start = [0.0, case.body.h, 0.0, 0.0, 0.0, 0.0] if case.initial is None else list(case.initial)
    before = kinetic(case.body, start) + G * start[Y]
    after = before + trace.state[GROUND] - trace.state[FRICTION] - trace.impact_loss
    assert trace.energy() == pytest.approx(after, abs=1e-11)
    assert trace.impact_loss >= 0
    assert trace.counts["impacts"] > 0


@pytest.mark.parametrize("seed", [7, 12, 14])
def test_mirror(seed):
    """Seen from behind everything happens at the same times, on the other side."""
    case = some_case(seed)
    ours, theirs = run(case), run(case.mirrored())
    rotated = {"left": "right", "right": "left", "+": "-", "-": "+", None: None}
    assert [(m, rotated[c], rotated[s]) for _, m, c, s in ours.events] == [event[1:] for event in theirs.events]
    np.testing.assert_allclose([event[0] for event in ours.events], [event[0] for event in theirs.events], rtol=0, atol=1e-10)
    assert ours.state[THETA] == pytest.approx(-theirs.state[THETA], abs=1e-10)
    assert (ours.state[VX], ours.state[OMEGA]) == pytest.approx((-theirs.state[VX], -theirs.state[OMEGA]), abs=1e-9)


def test_cases_are_reproducible():
    """A seed is a case."""
    first, two = some_case(3), some_case(3)
    assert isinstance(first, Case)
    assert first.body == two.body
    np.testing.assert_array_equal(first.along, two.along)

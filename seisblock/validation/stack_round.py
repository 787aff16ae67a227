"""Validation of `stack` for cylinders: precession on the rim, rocking and rolling, rolling down a slope, and sliding to rolling.

Each cylinder is released in the motion of the closed form, without shaking, and integrated with the steps of a pile.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial

import numpy as np

from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import ROUND, PileStone
from seisblock.core.typing import FloatArray
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.models.stack.arrays import pile_arrays
from seisblock.models.stack.frames import L, Q, R, V, W, X
from seisblock.models.stack.options import EDGES
from seisblock.models.stack.outcome import SimulationResult
from seisblock.models.stack.simulation import Simulation
from seisblock.records.motion import Motion
from seisblock.validation.case import CONVERGED, Case

RADIUS = 0.2
STEP = 2e-3
NO_SLIP_FRICTION = 5.0
"""Friction coefficient that excludes sliding."""

RIM_CASES = ((1e-3, 0.5), (1e-3, 0.1), (0.1, 0.3), (0.2, 0.4), (1.6, 0.1))
"""Height, m, and lean, rad, of a disk, of drums and of a column."""

RATE_TOLERANCE = 2e-4
"""Relative tolerance of a rate: error of steps of 2 ms, second order in the step."""

DISTANCE_TOLERANCE = 1e-5
"""Tolerance of a distance, m: error of steps of 2 ms."""

TURNS = 5
SECONDS = 1.0
ROCKING_LEAN, OUT_OF_PLANE_RATE, UPRIGHT_TIME = 0.05, 1e-3, 0.1
"""Lean, rad, from which a drum rocks; its out-of-plane rate, rad/s; and the time by which it has come upright, s."""

FINE_STEP = 1e-4
"""Step, s, for a drum that rolls to the opposite side of its rim within half a millisecond."""

TURN_TOLERANCE = 0.02
"""Tolerance of the rotation of the lean, rad: the effect of the out-of-plane rate, with which it vanishes."""

SLOPE = 0.2
"""Angle of the slope, rad."""

SPEED = 2.0
LOW_FRICTION = 0.3
"""Friction coefficient of the drum thrown without spin."""

LYING_AXES = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
"""Axes of a cylinder on its side, its own axis along y."""


def drum(height: float) -> PileStone:
    """Return a cylinder of the radius of this module; a disk if it is low."""
    return PileStone("drum", 2.0 * RADIUS, 2.0 * RADIUS, height, shape=ROUND)


def ground_at_rest(seconds: float, step: float = STEP) -> Motion:
    """Return a motion without shaking, one sample per step."""
    return Motion.from_arrays(np.zeros(math.ceil(seconds / step) + 1), step)


def release(
    stone: PileStone, axes: FloatArray, height: float, velocity: FloatArray, spin: FloatArray, motion: Motion, mu: float = NO_SLIP_FRICTION
) -> SimulationResult:
    """Return the result of a stone released in motion: axes (columns), height, m, velocity, m/s, and spin, rad/s."""
    from scipy.spatial.transform import Rotation

    pile = pile_arrays(Pile("one", (stone,), mu=mu), None, EDGES)
    body = pile.bodies[0]
    body[X : X + 3] = 0.0, 0.0, height
    body[Q : Q + 4] = np.roll(Rotation.from_matrix(axes).as_quat(), 1)
    body[R : R + 9] = axes.ravel()
    body[V : V + 3], body[W : W + 3] = velocity, spin
    body[L : L + 3] = axes @ (stone.mass * stone.gyration_squared * (axes.T @ spin))
    return Simulation(pile, motion, (1.0, 1.0), STANDARD_GRAVITY, 1, True, False, {}).run()


def rim_rate(stone: PileStone, lean: float) -> float:
    """Return the precession rate of a cylinder on its rim whose centre is at rest, rad/s ([Moffatt2000]_ eq. (1)).

    The spin is along the line from the centre to the contact point; the moment of the weight about the centre turns the angular momentum:
    Omega^2 = g (R cos - h/2 sin) / (sin (A cos - C sin h/(2R))), with A = (3 R^2 + h^2)/12 and C = R^2/2 the squared radii of gyration
    across and along the axis (derived here for any height); 4 g/(R sin) for a thin disk.
    """
    s, c, half = math.sin(lean), math.cos(lean), 0.5 * stone.height
    transverse_squared, axial_squared = (3.0 * RADIUS**2 + stone.height**2) / 12.0, 0.5 * RADIUS**2
    return math.sqrt(STANDARD_GRAVITY * (RADIUS * c - half * s) / (s * (transverse_squared * c - axial_squared * s * half / RADIUS)))


def _axis(end: SimulationResult, seconds: float) -> tuple[FloatArray, FloatArray]:
    """Return times, s, (n,), and the axis of the stone, (n, 3)."""
    inside = end.track.time <= seconds
    w, x, y, z = end.track.quaternions[inside, 0].T
    return end.track.time[inside], np.array([2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)]).T


def tilted_axes(lean: float) -> FloatArray:
    """Return the axes of a leaning cylinder as columns."""
    s, c = math.sin(lean), math.cos(lean)
    return np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])


def roll_on_rim(stone: PileStone, lean: float) -> tuple[FloatArray, FloatArray, SimulationResult]:
    """Return times, s, (n,), the axis, (n, 3), and the result of a cylinder released in precession, over some turns."""
    rate, s, c, half = rim_rate(stone, lean), math.sin(lean), math.cos(lean), 0.5 * stone.height
    axes = tilted_axes(lean)
    spin = rate * s * (half / RADIUS * axes[:, 2] - axes[:, 0])
    seconds = 2.0 * math.pi * TURNS / rate
    end = release(stone, axes, RADIUS * s + half * c, np.zeros(3), spin, ground_at_rest(seconds))
    return *_axis(end, seconds), end


def turn_angle(stone: PileStone) -> float:
    """Return the angle by which the lean of a cylinder turns that rocks almost in a plane, rad ([SrinivasanRuina2008]_).

    The far side of the rim does not strike: the cylinder rolls there along the rim almost instantly. For small leans f in the direction q the
    velocities are those of a point in the plane, 2 T/m = (A + R^2) f'^2 + A f^2 q'^2, with A the squared radius of gyration about a diameter
    of the base; straight lines turn q by pi sqrt((A + R^2)/A) (derived here).
    """
    gyration_squared = (3.0 * RADIUS**2 + stone.height**2) / 12.0 + 0.25 * stone.height**2
    return math.pi * math.sqrt((gyration_squared + RADIUS**2) / gyration_squared)


def rock_and_roll(
    stone: PileStone, out_of_plane_rate: float = OUT_OF_PLANE_RATE, step: float = FINE_STEP
) -> tuple[float, float, SimulationResult]:
    """Return the rotation of the lean of a rocking cylinder, rad, its new lean over the initial one, and the result."""
    axes, spin = tilted_axes(ROCKING_LEAN), np.array([-out_of_plane_rate, 0.0, 0.0])
    foot = RADIUS * axes[:, 0] - 0.5 * stone.height * axes[:, 2]
    end = release(stone, axes, -foot[2], -np.cross(spin, foot), spin, ground_at_rest(2.0 * UPRIGHT_TIME, step))
    time, axis = _axis(end, 2.0 * UPRIGHT_TIME)
    lean = np.hypot(axis[:, 0], axis[:, 1])
    # smallest lean: passage through the upright position; the next maximum is the lean on the other side
    upright = int(np.argmin(np.where(time < UPRIGHT_TIME, lean, np.inf)))
    back = upright + int(np.argmax(lean[upright:]))
    angle = np.unwrap(np.arctan2(axis[:, 1], axis[:, 0]))
    return float(abs(angle[back] - angle[0])), float(lean[back] / lean[0]), end


def simulated_turn_angle(stone: PileStone) -> float:
    """Return the simulated angle by which the lean of a rocking cylinder turns, rad."""
    return rock_and_roll(stone)[0]


def simulated_rim_rate(height: float, lean: float) -> float:
    """Return the mean precession rate of a cylinder over some turns, rad/s."""
    time, axis, _ = roll_on_rim(drum(height), lean)
    angle = np.unwrap(np.arctan2(axis[:, 1], axis[:, 0]))
    return float(abs(angle[-1] - angle[0]) / np.ptp(time))


def roll_down_slope() -> tuple[float, SimulationResult]:
    """Return the acceleration of a drum on its side on a slope, m/s^2, and the result; the slope is an inclined gravity."""
    # a slope is level ground under inclined gravity: g sin along x, and the vertical component reduced to g cos
    even = np.full(round(SECONDS / STEP) + 1, STANDARD_GRAVITY)
    motion = Motion.from_arrays(-even * math.sin(SLOPE), STEP, vertical=even * (math.cos(SLOPE) - 1.0))
    end = release(drum(2.0 * RADIUS), LYING_AXES, RADIUS, np.zeros(3), np.zeros(3), motion)
    inside = end.track.time <= SECONDS
    way = np.polynomial.Polynomial.fit(end.track.time[inside], end.track.centres[inside, 0, 0], 2)
    return float(2.0 * way.convert().coef[2]), end


def simulated_slope_acceleration() -> float:
    """Return the acceleration of a drum on its side on a slope, m/s^2."""
    return roll_down_slope()[0]


def roll_on_level(height: float, speed: float = SPEED, rolls: bool = True, mu: float = NO_SLIP_FRICTION) -> tuple[FloatArray, FloatArray]:
    """Return times, s, (n,), and centres, m, (n, 3), of a cylinder on its side that rolls, or is thrown without spin."""
    spin = np.array([0.0, speed / RADIUS if rolls else 0.0, 0.0])
    end = release(drum(height), LYING_AXES, RADIUS, np.array([speed, 0.0, 0.0]), spin, ground_at_rest(SECONDS), mu)
    inside = end.track.time <= SECONDS
    return end.track.time[inside], end.track.centres[inside, 0]


def rolling_distance(height: float, rolls: bool = True, mu: float = NO_SLIP_FRICTION) -> float:
    """Return the distance covered by a cylinder on its side, m."""
    _, centres = roll_on_level(height, rolls=rolls, mu=mu)
    return float(centres[-1, 0])


def thrown_distance() -> float:
    """Return the distance of a drum thrown without spin, m: friction spins it up until it rolls at two thirds of its speed."""
    # sliding lasts until the circumferential speed equals the decreasing speed: v0 / (3 mu g)
    slips = SPEED / (3.0 * LOW_FRICTION * STANDARD_GRAVITY)
    return SPEED * slips - 0.5 * LOW_FRICTION * STANDARD_GRAVITY * slips**2 + 2.0 / 3.0 * SPEED * (SECONDS - slips)


def _rim_case(height: float, lean: float) -> Case:
    """Return the case of one cylinder on its rim."""
    expected = rim_rate(drum(height), lean)
    return Case(
        f"stack-round-rim-{height:g}-m-{lean:g}-rad",
        "[Moffatt2000]_ eq. (1)",
        f"precession rate of a cylinder on its rim, radius {RADIUS:g} m, height {height:g} m, base inclined by {lean:g} rad",
        "rad/s",
        expected,
        RATE_TOLERANCE * expected,
        partial(simulated_rim_rate, height, lean),
        note="expected: closed form for any height, derived here (the paper: thin disk); steps of 2 ms",
        kind="derived",
        quick=False,
    )


def _can_case() -> Case:
    """Return the case of a rocking drum."""
    stone = drum(2.0 * RADIUS)
    return Case(
        "stack-round-can",
        "[SrinivasanRuina2008]_",
        "rotation of the lean of a drum that rocks almost in a plane and rolls to the opposite side of its rim",
        "rad",
        turn_angle(stone),
        TURN_TOLERANCE,
        partial(simulated_turn_angle, stone),
        note="expected: pi sqrt(1 + m R^2/I), I about a diameter of the base, derived here; steps of 0.1 ms, since the drum rolls across "
        "within 0.5 ms",
        kind="derived",
        quick=False,
    )


def _rolling_case(key: str, quantity: str, unit: str, expected: float, tolerance: float, compute: Callable[[], float]) -> Case:
    """Return the case of a cylinder on its side."""
    return Case(
        f"stack-round-{key}",
        "[Jean1999]_ section 3",
        quantity,
        unit,
        expected,
        tolerance,
        compute,
        note="expected: closed form of rolling",
        kind="derived",
        quick=False,
    )


SLOPE_ACCELERATION = 2.0 / 3.0 * STANDARD_GRAVITY * math.sin(SLOPE)

CASES = (
    *(_rim_case(*stone) for stone in RIM_CASES),
    _can_case(),
    _rolling_case("slope", "acceleration of a drum rolling down a slope of 0.2 rad, (2/3) g sin(0.2)", "m/s^2", SLOPE_ACCELERATION, CONVERGED * SLOPE_ACCELERATION, simulated_slope_acceleration),
    _rolling_case("coin", "distance of a coin rolling at 2 m/s, after 1 s", "m", SPEED * SECONDS, DISTANCE_TOLERANCE, partial(rolling_distance, 1e-3)),
    _rolling_case(
        "thrown", "distance of a drum thrown at 2 m/s without spin, after 1 s; friction 0.3, finally rolling at 2/3 of the speed",
        "m", thrown_distance(), DISTANCE_TOLERANCE, partial(rolling_distance, 2.0 * RADIUS, rolls=False, mu=LOW_FRICTION),
    ),
)  # fmt: skip
"""Cases on cylinders."""

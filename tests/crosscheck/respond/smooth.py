"""Smooth motion of the reference block within one mode: its ground, its equations, its guards, and where a guard reaches zero."""

from __future__ import annotations

import math

import numpy as np
from scipy.integrate import DOP853
from scipy.optimize import brentq, minimize_scalar

from tests.crosscheck.respond.contact import LEFT, PAINLEVE, RIGHT, Body, Push, corner_acceleration, jacobians, reaction
from tests.crosscheck.respond.impact import (
    FRICTION,
    GAP,
    GROUND,
    OMEGA,
    PATH,
    RATE,
    SIZE,
    SLIP,
    THETA,
    VX,
    VY,
    Y,
)

PARTS = 8
"""Into how many parts a step is divided to look for zeros."""

AT_ONCE = 1e-6
"""Share of a sample after a threshold at which level blocks are judged."""

ACCURACY = {"rtol": 1e-13, "atol": 1e-16, "max_step": 0.05}
SHARP = {"xtol": 1e-18, "rtol": 1e-15}


class Ground:
    """Sampled acceleration, straight between samples and still after the last one; gravity is added to the vertical."""

    def __init__(self, along, up, dt: float, gravity: float):
        self.along, self.up, self.dt, self.gravity = list(map(float, along)), list(map(float, up)), dt, gravity

    def piece(self, k: int, offset: float):
        """Return the push as a function of the time since a moment within interval k."""
        if k >= len(self.along) - 1:
            return lambda tau: Push(0.0, self.gravity)
        slopes = (self.along[k + 1] - self.along[k]) / self.dt, (self.up[k + 1] - self.up[k]) / self.dt
        start = self.along[k] + slopes[0] * offset, self.gravity + self.up[k] + slopes[1] * offset
        return lambda tau: Push(start[0] + slopes[0] * tau, start[1] + slopes[1] * tau)

    def later(self, k: int, offset: float) -> Push:
        """Return the push a millionth of a sample after a moment."""
        offset += AT_ONCE * self.dt
        if offset > self.dt:
            k, offset = k + 1, offset - self.dt
        return self.piece(k, offset)(0.0)


def guard_functions(body: Body, mode, push):
    """Return a function of (tau, state) that gives the mode's guards, positive while it lives, and their names."""
    closed = [corner for corner in (RIGHT, LEFT) if mode[corner] is not None]
    ends = ["overturns", *(["a point touches"] * len(body.points))]

    def of_ends(state):
        s, c = math.sin(state[THETA]), math.cos(state[THETA])
        return [math.pi / 2 - abs(state[THETA]), *(state[Y] - xi * s + eta * c for xi, eta in body.points)]

    if len(closed) == 2:
        sign = mode[RIGHT]
        return lambda tau, state: [sign * state[SLIP], push(tau).weight], ["slip ends", "lifts"]
    if not closed:
        return lambda tau, state: [state[GAP], state[GAP + 1], *of_ends(state)], ["right lands", "left lands", *ends]
    corner = closed[0]
    contact = mode[corner]
    second = 1 - corner

    def gripping(tau, state):
        force = reaction(body, jacobians(body, state[THETA]), state[OMEGA], push(tau), mode)
        normal = force.normal[corner]
        hold = body.mu * normal
        return [hold - force.tangential, hold + force.tangential, normal, state[GAP + second], *of_ends(state)]

    def slipping(tau, state):
        now = push(tau)
        jacobian = jacobians(body, state[THETA])
        fall = corner_acceleration(jacobian[corner], state[OMEGA], (-now.along, -now.weight, 0.0))[0]
        yields = reaction(body, jacobian, state[OMEGA], now, mode).mobility
        return [contact * state[SLIP + corner], -fall, yields - PAINLEVE, state[GAP + second], *of_ends(state)]

    if contact == 0:
        return gripping, ["slips", "slips", "lifts", "other lands", *ends]
    return slipping, ["slip ends", "lifts", "jams", "other lands", *ends]


def equations(body: Body, mode, push):
    """Return the rates of change of the state in one mode."""
    closed = [corner for corner in (RIGHT, LEFT) if mode[corner] is not None]

    def rates(tau, state):
        now = push(tau)
        state = state.tolist()
        jacobian, omega = jacobians(body, state[THETA]), state[OMEGA]
        force = reaction(body, jacobian, omega, now, mode)
        ax, ay, turning = force.acceleration
        if len(closed) == 2:
            ay = turning = 0.0
        out = [state[VX], state[VY], omega, ax, ay, turning, *[0.0] * (SIZE - 6)]
        for corner in (RIGHT, LEFT):
            upwards, sideways = corner_acceleration(jacobian[corner], omega, (ax, ay, turning))
            if mode[corner] is None:
                out[GAP + corner], out[RATE + corner] = state[RATE + corner], upwards
            if mode[corner] != 0:
                out[SLIP + corner] = sideways
        if closed and mode[closed[0]]:
            speed = abs(state[SLIP + closed[0]])
            out[PATH], out[FRICTION] = speed, speed * abs(force.tangential)
        out[GROUND] = -(now.along * state[VX] + (now.weight - body.gravity) * state[VY])
        return out

    return rates


def integration_steps(rates, state, end: float, first: float):
    """Yield the steps of DOP853 from 0 to `end`: start, end, state at both, and the polynomial between."""
    solver = DOP853(rates, 0.0, state, end, **ACCURACY, first_step=min(first, end, 0.05))
    while solver.status == "running":
        before = solver.t, solver.y.tolist()
        message = solver.step()
        if solver.status == "failed":
            raise ArithmeticError(message)
        yield before[0], solver.t, before[1], solver.y.tolist(), solver.dense_output()


def first_zero(values, start: float, end: float, deaf) -> tuple[float, int] | None:
    """Return (time, index) of the first guard to reach zero within a step; each guard is unheeded up to its time in `deaf`."""
    nodes = {start + (end - start) * i / PARTS for i in range(PARTS + 1)} | {time for time in deaf if start < time < end}
    nodes = sorted(nodes)
    table = np.array([values(node) for node in nodes])
    nodes = np.array(nodes)
    result = [
        (time, i)
        for i, since in enumerate(deaf)
        if (time := guard_zero(lambda tau: values(tau)[i], nodes[nodes >= since], table[nodes >= since, i])) is not None  # noqa: B023
    ]
    return min(result, default=None)


def guard_zero(value, nodes, column) -> float | None:
    """Return where one guard turns negative between nodes, also in a dip that the nodes do not show."""
    if column.size > 1 and column[0] < 0 and column[1] < 0:
        return float(nodes[0])
    for k in range(1, column.size):
        if column[k] < 0:
            return brentq(value, nodes[k - 1], nodes[k], **SHARP) if column[k - 1] > 0 else float(nodes[k - 1])
        low = k + 1 < column.size and column[k] <= min(column[k - 1], column[k + 1])
        if low and column[k] < 0.3 * (column[k - 1] + column[k + 1]):
            nearby = {"xatol": 1e-9 * (nodes[-1] - nodes[0])}
            dip = minimize_scalar(value, bounds=(nodes[k - 1], nodes[k + 1]), method="bounded", options=nearby)
            if dip.fun < 0:
                return brentq(value, nodes[k - 1], dip.x, **SHARP)
    return None


def state_at_event(rates, before, length: float, start: float) -> list[float]:
    """Return the state at an event, integrated anew from the step's beginning instead of read off its polynomial."""
    solver = DOP853(lambda tau, state: rates(start + tau, state), 0.0, before, length, **ACCURACY, first_step=min(length, 0.05))
    while solver.status == "running":
        solver.step()
    return solver.y.tolist()

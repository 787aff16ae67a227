"""Impacts of the reference block: Routh's path through the space of impulses, Moreau's two corners, the user's factor, and the end of hops.

A state is a list: the centre, its velocities, then gap, rate of the gap and slip velocity of the right and the left corner, which are
kept beside the centre because hops of 1e-20 m cannot be seen in its coordinates; then slip path, work of friction and of the ground.
"""

from __future__ import annotations

import math

from tests.crosscheck.respond.contact import (
    FLIGHT,
    LEFT,
    RIGHT,
    Body,
    Push,
    component_along,
    consistent_mode,
    constraint_impulses,
    jacobians,
    lever,
    mobility,
    split_impulses,
    velocity_change,
)

X, Y, THETA, VX, VY, OMEGA = range(6)
GAP, RATE, SLIP = 6, 8, 10
PATH, FRICTION, GROUND = 12, 13, 14
SIZE = 15

AT_ONE_INSTANT = 1e-4
"""Time within which the other corner lands with the first, over that in which gravity gives the speed at which hops end."""


def kinetic(body: Body, state) -> float:
    """Return the kinetic energy per unit of mass."""
    return (state[VX] ** 2 + state[VY] ** 2 + body.k2 * state[OMEGA] ** 2) / 2


def apply_impulses(body: Body, state, columns, impulses) -> list[float]:
    """Return the state after impulses: velocities of the centre, and of both corners by their own rows."""
    after = list(state)
    change = velocity_change(body, columns, impulses)
    for i, step in enumerate(change):
        after[VX + i] += step
    for corner, (normal, tangent) in enumerate(jacobians(body, state[THETA])):
        after[RATE + corner] += component_along(normal, change)
        after[SLIP + corner] += component_along(tangent, change)
    return after


def align_with_corner(body: Body, state, corner: int) -> list[float]:
    """Return the state with the centre where a corner's own gap, rate and slip velocity put it."""
    after = list(state)
    rx, ry = lever(body, corner, state[THETA])
    after[Y] = state[GAP + corner] - ry
    after[VY] = state[RATE + corner] + rx * state[OMEGA]
    after[VX] = state[SLIP + corner] - ry * state[OMEGA]
    return after


def routh(body: Body, theta: float, corner: int, u: float, v: float, e: float) -> tuple[float, float, float, float]:
    """Return normal and tangential impulse and the velocities after an impact of one corner, Poisson's restitution.

    The normal impulse is the clock. Friction opposes slip; where slip ends it sticks if friction can hold it, else slip turns.
    """
    normal, tangent = jacobians(body, theta)[corner]
    nn, tt, tn = mobility(body, normal, normal), mobility(body, tangent, tangent), mobility(body, tangent, normal)
    pressed = rubbed = 0.0
    target = None
    sign = math.copysign(1.0, v) if v else slip_direction(tn, tt, body.mu_kinetic)
    while True:
        share = -tn / tt if sign == 0 else -sign * body.mu_kinetic
        du, dv = nn + tn * share, tn + tt * share
        stop = -v / dv if sign and v * dv < 0 else math.inf
        if target is not None:
            end = target - pressed
        else:
            end = -u / du if du > 0 else math.inf
        step = min(stop, end)
        pressed, rubbed, u, v = pressed + step, rubbed + share * step, u + du * step, v + dv * step
        if stop <= end:
            v, sign = 0.0, slip_direction(tn, tt, body.mu_kinetic)
        elif target is None:
            u, target = 0.0, (1 + e) * pressed
            if e == 0:
                break
        else:
            break
    return pressed, rubbed, u, 0.0 if sign == 0 else v


def slip_direction(tn: float, tt: float, mu: float) -> float:
    """Return 0 where friction holds a corner under an impulse along the normal, else the direction in which it is driven."""
    return 0.0 if abs(tn) <= mu * tt else math.copysign(1.0, tn)


def impact_of_corner(body: Body, state, corner: int, e: float) -> list[float]:
    """Return the state after an impact of one corner alone."""
    pressed, rubbed, u, v = routh(body, state[THETA], corner, state[RATE + corner], state[SLIP + corner], e)
    after = apply_impulses(body, state, jacobians(body, state[THETA])[corner], (pressed, rubbed))
    after[RATE + corner], after[SLIP + corner] = u, v
    if state[THETA] == 0.0:
        after[SLIP + 1 - corner] = v
    return align_with_corner(body, after, corner)


def impact_of_both(body: Body, state) -> list[float]:
    """Return the state after a plastic impact of both corners of a level block: the first state of contacts that is consistent."""
    first = 1 if state[VX] >= 0 else -1
    states = [(0, 0), (first, first), (-first, -first), (0, None), (1, None), (-1, None), (None, 0), (None, 1), (None, -1)]
    for mode in states:
        missing = {corner: (-state[RATE + corner], -state[SLIP + corner]) for corner in (RIGHT, LEFT)}
        columns, strengths = constraint_impulses(body, jacobians(body, 0.0), mode, missing)
        normal, tangential = split_impulses(body, mode, strengths)
        after = apply_impulses(body, state, columns, strengths)
        contact = next(way for way in mode if way is not None)
        for corner in (RIGHT, LEFT):
            if mode[corner] is not None:
                after[RATE + corner] = 0.0
            if contact == 0:
                after[SLIP + corner] = 0.0
        if None not in mode:
            after[OMEGA] = after[VY] = 0.0
            after[VX] = after[SLIP]
        rises = all(after[RATE + corner] >= 0 for corner in (RIGHT, LEFT))
        holding = abs(tangential) <= body.mu_kinetic * sum(normal) if contact == 0 else contact * after[SLIP] >= 0
        if rises and holding and min(normal) >= 0:
            return align_with_corner(body, after, RIGHT if mode[RIGHT] is not None else LEFT)
    return state


def impact_with_factor(body: Body, state, corner: int) -> tuple[list[float], bool]:
    """Return the state after a rocking impact whose spin keeps the user's share, and whether the share had to be lowered.

    The struck corner stays down; it sticks if friction can stop it, else it slips. Energy never grows.
    """

    def with_share(share: float) -> list[float]:
        after = list(state)
        after[OMEGA] = share * state[OMEGA]
        rx, ry = lever(body, corner, 0.0)
        pressed = rx * after[OMEGA] - state[VY]
        expected = -ry * after[OMEGA] - state[VX]
        after[RATE + corner] = 0.0
        after[SLIP + corner] = 0.0
        if abs(expected) > body.mu_kinetic * pressed:
            values = math.copysign(body.mu_kinetic * pressed, expected)
            after[SLIP + corner] = state[VX] + values + ry * after[OMEGA]
        second = 1 - corner
        after[SLIP + second] = after[SLIP + corner]
        after[RATE + second] = (rx - lever(body, second, 0.0)[0]) * after[OMEGA]
        return align_with_corner(body, after, corner)

    before = kinetic(body, state)
    share = body.rocking_restitution
    if kinetic(body, with_share(share)) <= before:
        return with_share(share), False
    low, high = 0.0, share
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if kinetic(body, with_share(middle)) <= before else (low, middle)
    return with_share(low), True


def remains_level(body: Body, state, push: Push) -> bool:
    """Say whether a level block with both feet down would rest or slide."""
    slip = 0.0 if abs(state[SLIP]) < body.slow else state[SLIP]
    mode = consistent_mode(body, 0.0, 0.0, slip, (RIGHT, LEFT), push)
    return mode is not None and None not in mode


def remains_closed(body: Body, state, corner: int, push: Push) -> bool:
    """Say whether a corner that has just been stopped stays on the ground."""
    return consistent_mode(body, state[THETA], state[OMEGA], state[SLIP + corner], (corner,), push) != FLIGHT


def set_level(state, slow: float) -> list[float]:
    """Return the state of a block whose rocking has died out: flat on both feet, sliding on if it slid."""
    after = list(state)
    after[THETA] = after[OMEGA] = after[VY] = 0.0
    slip = state[SLIP]
    after[VX] = 0.0 if abs(slip) < slow or state[VX] * slip <= 0 else state[VX]
    for corner in (RIGHT, LEFT):
        after[GAP + corner] = after[RATE + corner] = 0.0
        after[SLIP + corner] = after[VX]
    return after


def after_landing(body: Body, state, corner: int, push: Push) -> list[float]:
    """Return the state after a corner has come down from flight; the other corner is ignored, unless it comes down at once.

    A squat block whose ground falls away clatters: each plastic impact throws the other corner down, the gaps shrink quadratically,
    and within no time both feet are down. What no clock resolves is an impact of both.
    """
    after = impact_of_corner(body, state, corner, body.restitution)
    if 0 < after[RATE + corner] < body.slow:
        still = impact_of_corner(body, state, corner, 0.0)
        if remains_closed(body, still, corner, push):
            after = still
    second = 1 - corner
    approach = -after[RATE + second]
    if after[RATE + corner] == 0 and approach > 0 and after[GAP + second] < AT_ONE_INSTANT * approach * body.slow / body.gravity:
        after[THETA] = after[GAP + second] = 0.0
        return impact_of_both(body, align_with_corner(body, after, corner))
    return after


def after_rocking_impact(body: Body, state, corner: int, push: Push, later: Push) -> tuple[list[float], bool]:
    """Return the state after a rocking block has come down on its open corner, and whether the user's factor was lowered.

    `push` acts now; `later` decides whether the block, if level, would stay so.
    """

    def alone(e: float) -> list[float]:
        after = impact_of_corner(body, state, corner, e)
        return after if after[RATE + 1 - corner] > 0 else impact_of_both(body, state)

    lowered = False
    if body.rocking_restitution is not None:
        after, lowered = impact_with_factor(body, state, corner)
    else:
        after = alone(body.restitution)
        if 0 < after[RATE + corner] < body.slow:
            still = alone(0.0)
            if remains_closed(body, still, corner, push):
                after = still
    dying = after[RATE + corner] == 0 and 0 < after[RATE + 1 - corner] < body.slow
    if dying and remains_level(body, after, later):
        after = set_level(after, body.slow)
    return after, lowered


def after_flat_landing(body: Body, state, later: Push) -> list[float]:
    """Return the state after both feet have come down at once without spin: it bounces, stays, or trips over its leading foot."""

    def with_restitution(e: float) -> list[float]:
        missing = {corner: ((1 + e) * -state[RATE + corner], -state[SLIP + corner]) for corner in (RIGHT, LEFT)}
        mode = (0, 0)
        columns, strengths = constraint_impulses(body, jacobians(body, 0.0), mode, missing)
        normal, tangential = split_impulses(body, mode, strengths)
        if abs(tangential) > body.mu_kinetic * sum(normal):
            sign = int(math.copysign(1, state[SLIP]))
            mode = (sign, sign)
            columns, strengths = constraint_impulses(body, jacobians(body, 0.0), mode, missing)
            normal, tangential = split_impulses(body, mode, strengths)
        if min(normal) < 0:
            leading = RIGHT if state[SLIP] > 0 else LEFT
            after = impact_of_corner(body, state, leading, e)
            return after if after[RATE + 1 - leading] > 0 else impact_of_both(body, state)
        after = apply_impulses(body, state, columns, strengths)
        after[OMEGA] = 0.0
        for corner in (RIGHT, LEFT):
            after[RATE + corner] = e * -state[RATE + corner]
            after[SLIP + corner] = 0.0 if mode == (0, 0) else after[SLIP + RIGHT]
        return align_with_corner(body, after, RIGHT)

    e = body.restitution
    if 0 < e * -state[RATE] < body.slow and remains_level(body, with_restitution(0.0), later):
        e = 0.0
    return with_restitution(e)

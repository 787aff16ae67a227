"""An independent free-standing block: DOP853 between events, contact states enumerated at every instant, impacts in impulse space.

It follows the conventions of the model (which mode comes first, how hops end, what decides at a threshold) and shares none of its
formulas: accelerations come from Newton, Euler and the constraints of the mode, solved anew in every evaluation.
"""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import dataclass, field

import numpy as np

from tests.crosscheck.respond.contact import FLIGHT, LEFT, REST, RIGHT, Body, consistent_mode, jacobians, lever, reaction
from tests.crosscheck.respond.impact import (
    GAP,
    OMEGA,
    RATE,
    SIZE,
    SLIP,
    THETA,
    VX,
    VY,
    Y,
    after_flat_landing,
    after_landing,
    after_rocking_impact,
    align_with_corner,
    impact_of_corner,
    kinetic,
)
from tests.crosscheck.respond.smooth import AT_ONCE, Ground, equations, first_zero, guard_functions, integration_steps, state_at_event

OVERTURNED = "overturned"

STILL = 0.05
"""Stretch integrated at a time once the ground is still, s."""

MOST_EVENTS = 20000


@dataclass
class Trace:
    """Reference response: `events` as (time, mode, corner, slip), the state at every sample and at the end, counts, energies per mass."""

    body: Body
    events: list = field(default_factory=list)
    samples: list = field(default_factory=list)
    counts: Counter = field(default_factory=Counter)
    transitions: Counter = field(default_factory=Counter)
    state: list = field(default_factory=list)
    time: float = 0.0
    impact_loss: float = 0.0

    @property
    def mode(self) -> str:
        """Name of the last mode."""
        return self.events[-1][1]

    def energy(self) -> float:
        """Return kinetic and potential energy at the end, J/kg."""
        return kinetic(self.body, self.state) + self.body.gravity * self.state[Y]


def named(mode) -> tuple[str, str | None, str | None]:
    """Return a mode in the notation of the program: name, corner, slip."""
    if mode == OVERTURNED:
        return OVERTURNED, None, None
    closed = [corner for corner in (RIGHT, LEFT) if mode[corner] is not None]
    if not closed:
        return "flight", None, None
    contact = mode[closed[0]]
    slip = {0: None, 1: "+", -1: "-"}[contact]
    if len(closed) == 2:
        return ("rest" if contact == 0 else "slide"), None, slip
    return ("rock" if contact == 0 else "slide-rock"), ("right", "left")[closed[0]], slip


class Run:
    """One block on one ground: the present state, mode and moment, and the trace that grows."""

    def __init__(self, body: Body, ground: Ground):
        self.body, self.ground = body, ground
        self.trace = Trace(body)
        self.k, self.offset, self.start = 0, 0.0, 0.0
        self.mode = None
        self.state = [0.0] * SIZE
        self.deaf = 0.0

    @property
    def now(self) -> float:
        """Time since the first sample, s."""
        return self.start + self.offset

    def place(self, initial) -> None:
        """Put the block where it starts, snap corners that touch, and let the first mode follow."""
        body, state = self.body, self.state
        state[:6] = [float(value) for value in initial]
        for corner in (RIGHT, LEFT):
            rx, ry = lever(body, corner, state[THETA])
            gap, rate, slip = state[Y] + ry, state[VY] - rx * state[OMEGA], state[VX] + ry * state[OMEGA]
            state[GAP + corner] = 0.0 if abs(gap) <= 1e-12 * body.h else gap
            state[RATE + corner] = 0.0 if abs(rate) <= body.slow else rate
            state[SLIP + corner] = 0.0 if abs(slip) <= body.slow else slip
        down = [corner for corner in (RIGHT, LEFT) if state[GAP + corner] == 0]
        if down and all(state[RATE + corner] < 0 for corner in down):
            self.land(down)
        self.choose()

    def sample(self) -> None:
        """Keep the state at a sample."""
        self.trace.samples.append(list(self.state))

    def finished(self) -> Trace:
        """Return the trace with its last state."""
        self.trace.state, self.trace.time = list(self.state), self.now
        return self.trace

    def choose(self, exclude=None) -> None:
        """Let the mode follow from the touching corners; where none is consistent the corner jams, an impact without collision."""
        body = self.body
        while True:
            state = self.state
            touching = [corner for corner in (RIGHT, LEFT) if state[GAP + corner] == 0 and state[RATE + corner] == 0]
            if not touching:
                return self.enter(FLIGHT)
            push = self.ground.later(self.k, self.offset) if len(touching) == 2 else self.ground.piece(self.k, self.offset)(0.0)
            slip = state[SLIP + touching[0]]
            mode = consistent_mode(body, state[THETA], state[OMEGA], slip, touching, push, exclude)
            if mode is not None:
                return self.enter(mode)
            corner = touching[0] if len(touching) == 1 else (RIGHT if slip > 0 else LEFT)
            self.change(impact_of_corner(body, state, corner, body.restitution), "jams")
            exclude = None

    def change(self, after, kind: str = "impacts") -> None:
        """Take the state after an impact or a jam and count what it cost."""
        self.trace.impact_loss += kinetic(self.body, self.state) - kinetic(self.body, after)
        self.trace.counts[kind] += 1
        self.state = after

    def enter(self, mode) -> None:
        """Go on in a mode; a change of mode is an event."""
        if mode != self.mode:
            if self.mode is not None:
                self.trace.transitions[self.mode, mode] += 1
            self.trace.events.append((self.now, *named(mode)))
            self.mode = mode
        elif mode == FLIGHT:
            self.trace.transitions[mode, mode] += 1

    def land(self, corners) -> None:
        """Let one or both corners come down from flight."""
        state, body = self.state, self.body
        for corner in corners:
            state[GAP + corner] = 0.0
        flat = len(corners) == 2 and state[THETA] == 0 and state[OMEGA] == 0
        if flat:
            self.change(after_flat_landing(body, align_with_corner(body, state, RIGHT), self.ground.later(self.k, self.offset)))
        else:
            push = self.ground.piece(self.k, self.offset)(0.0)
            self.change(after_landing(body, align_with_corner(body, state, corners[0]), corners[0], push))

    def rock(self, corner: int) -> None:
        """Let the open corner of a rocking block come down."""
        body, state = self.body, self.state
        second = 1 - corner
        state[THETA] = 0.0
        state[GAP + corner] = state[RATE + second] = 0.0
        state[RATE + corner] = (lever(body, second, 0.0)[0] - lever(body, corner, 0.0)[0]) * state[OMEGA]
        state[SLIP + corner] = state[SLIP + second]
        push, later = self.ground.piece(self.k, self.offset)(0.0), self.ground.later(self.k, self.offset)
        after, lowered = after_rocking_impact(body, align_with_corner(body, state, second), corner, push, later)
        self.trace.counts["lowered"] += lowered
        self.change(after)

    def happen(self, name: str) -> None:
        """Do what a guard asks for."""
        closed = [corner for corner in (RIGHT, LEFT) if self.mode[corner] is not None]
        if name in ("overturns", "a point touches"):
            return self.enter(OVERTURNED)
        if name in ("right lands", "left lands"):
            corners = [RIGHT if name == "right lands" else LEFT]
            if self.state[THETA] == 0 and self.state[OMEGA] == 0:
                corners = [RIGHT, LEFT]
            self.land(corners)
            return self.choose()
        if name == "other lands":
            self.rock(1 - closed[0])
            return self.choose()
        if name == "slip ends":
            for corner in (RIGHT, LEFT):
                if self.mode[corner] is not None or self.state[THETA] == 0:
                    self.state[SLIP + corner] = 0.0
        self.state = align_with_corner(self.body, self.state, closed[0])
        return self.choose(exclude=self.mode)

    def wait(self, length: float) -> bool:
        """Rest up to a moment, or to the first threshold, both straight lines; say whether the moment was reached."""
        push, upright = self.ground.piece(self.k, self.offset), jacobians(self.body, 0.0)

        def slacks(tau):
            now = push(tau)
            force = reaction(self.body, upright, 0.0, now, REST)
            hold = self.body.mu * now.weight
            return [*force.normal, hold - force.tangential, hold + force.tangential]

        noise = 1e-15 * self.body.gravity
        zeros = [max(a, 0.0) / (max(a, 0.0) - b) for a, b in zip(slacks(0.0), slacks(length), strict=True) if b < -noise]
        zeros += [0.0 for a in slacks(0.0) if a < -noise]
        if not zeros:
            return True
        self.offset += min(zeros) * length
        self.choose(exclude=REST)
        self.deaf = self.now + AT_ONCE * self.ground.dt
        return False

    def move(self, length: float) -> bool:
        """Integrate up to a moment, or to the first event; say whether the moment was reached."""
        body, mode = self.body, self.mode
        push = self.ground.piece(self.k, self.offset)
        rates = equations(body, mode, push)
        values, names = guard_functions(body, mode, push)
        scale, deaf = self.thrown(rates, names)
        for start, end, before, after, dense in integration_steps(rates, self.state, length, 0.5 * scale):
            result = first_zero(lambda tau: values(tau, dense(tau).tolist()), start, end, deaf)  # noqa: B023
            if result is None:
                last = after
                continue
            time, index = result
            self.state = state_at_event(rates, before, time - start, start) if time > start else before
            self.offset += time
            self.happen(names[index])
            self.deaf = self.now + AT_ONCE * self.ground.dt
            return False
        self.state = last
        return True

    def thrown(self, rates, names) -> tuple[float, list[float]]:
        """Return the time scale of the smallest hop, and the time before which each guard is inactive.

        A gap or slip that has just been set to zero with its rate cannot be told from noise, nor can forces at their threshold; one
        that begins with a speed can.
        """
        state, scale = self.state, math.inf
        moving = rates(0.0, np.array(state))
        events = set()
        for corner, name in ((RIGHT, "right lands"), (LEFT, "left lands")):
            if self.mode[corner] is None and state[GAP + corner] == 0 and state[RATE + corner] > 0:
                fall = -moving[RATE + corner]
                scale = min(scale, state[RATE + corner] / fall) if fall > 0 else scale
            if self.mode[corner] is None and max(state[GAP + corner], state[RATE + corner]) > 0:
                events |= {name, "other lands"}
            if self.mode[corner] is not None and state[SLIP + corner] != 0:
                events.add("slip ends")
        return scale, [-1.0 if name in events else self.deaf - self.now for name in names]

    def jump(self) -> None:
        """Judge the mode by an input that has changed at once, at the end of the record."""
        if self.mode in (REST, OVERTURNED):
            return
        values, names = guard_functions(self.body, self.mode, self.ground.piece(self.k, self.offset))
        for value, name in zip(values(0.0, self.state), names, strict=True):
            if value < 0 and name in ("slips", "lifts", "jams"):
                self.happen(name)
                self.deaf = self.now + AT_ONCE * self.ground.dt
                return


def respond(body: Body, along, up, dt: float, initial=None, settle: float = 60.0) -> Trace:
    """Return what a block does on a ground whose acceleration is sampled, up to rest or fall, at most `settle` s after the record."""
    run = Run(body, Ground(along, up, dt, body.gravity))
    run.place((0.0, body.h, 0.0, 0.0, 0.0, 0.0) if initial is None else initial)
    last = len(along) - 1
    run.sample()
    while run.mode != OVERTURNED and len(run.trace.events) < MOST_EVENTS:
        shaking = run.k < last
        if not shaking and (run.mode == REST or run.offset >= settle):
            break
        until = dt if shaking else min((math.floor(run.offset / STILL + 1e-9) + 1) * STILL, settle)
        if not (run.wait if run.mode == REST else run.move)(until - run.offset):
            continue
        run.offset = until
        if shaking:
            run.k, run.offset, run.start = run.k + 1, 0.0, (run.k + 1) * dt
            run.sample()
            if run.k == last:
                run.jump()
    return run.finished()

"""Random objects on random grounds, made so that between them every change of mode happens that can."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from tests.crosscheck.respond.contact import LEFT, RIGHT, Body, lever


@dataclass(frozen=True)
class Case:
    """One block, one ground and one start: six numbers, or None for standing still."""

    body: Body
    along: np.ndarray
    up: np.ndarray
    dt: float
    initial: tuple[float, ...] | None = None

    def mirrored(self) -> Case:
        """Return the same case seen from behind."""
        rotated = None if self.initial is None else tuple(s * v for s, v in zip((-1, 1, -1, -1, 1, -1), self.initial, strict=True))
        return replace(self, body=replace(self.body, arms=self.body.arms[::-1]), along=-self.along, initial=rotated)


def some_body(rng: np.random.Generator) -> Body:
    """Return a block: squat or slender, often lopsided, sometimes so compact or so rough that a sliding corner can jam."""
    h = rng.uniform(0.2, 0.8)
    half = h * rng.choice([rng.uniform(0.12, 0.4), rng.uniform(0.4, 1.2)])
    shift = rng.choice([0.0, rng.uniform(-0.4, 0.4)]) * half
    arms = float(half - shift), float(half + shift)
    k2 = (half**2 + h**2) / 3 * rng.choice([1.0, rng.uniform(0.5, 1.3), rng.uniform(0.1, 0.3)])
    mu = min(half / h, 1.0) * rng.choice([rng.uniform(0.3, 1.0), rng.uniform(0.9, 2.0), rng.uniform(2.0, 5.0)])
    mu *= rng.random() > 0.04
    kinetic = mu * rng.choice([1.0, rng.uniform(0.5, 1.0)])
    e = rng.choice([0.0, rng.uniform(0.1, 0.8)])
    body_value = float(rng.uniform(0.0, 1.0)) if rng.random() < 0.2 else None
    return Body(arms, h, float(k2), float(mu), float(kinetic), float(e), body_value)


def shaking(rng: np.random.Generator, n: int, dt: float, strength: float) -> np.ndarray:
    """Return a random polygon of a given standard deviation, some starting or ending with a jump."""
    knots = np.arange(0.0, n * dt + 1.0, rng.uniform(0.06, 0.4))
    values = strength * rng.normal(size=knots.size)
    shape = np.interp(np.arange(n) * dt, knots, values)
    if rng.random() < 0.6:
        shape *= np.minimum(1.0, np.arange(n) / (0.2 * n))
    if rng.random() < 0.6:
        shape *= np.minimum(1.0, np.arange(n)[::-1] / (0.3 * n))
    return shape


def some_start(rng: np.random.Generator, body: Body) -> tuple[float, ...] | None:
    """Return standing still, leaning, sliding, thrown level, or thrown with a spin."""
    speed = math.sqrt(body.gravity * body.h)
    kind = rng.choice(["still", "leaning", "sliding", "level", "thrown"], p=[0.6, 0.1, 0.1, 0.1, 0.1])
    if kind == "leaning":
        corner = int(rng.integers(2))
        theta = (1 if corner == RIGHT else -1) * rng.uniform(0.2, 1.0) * math.atan2(body.arms[corner], body.h)
        rx, ry = lever(body, corner, theta)
        return -rx, -ry, theta, 0.0, 0.0, 0.0
    if kind == "sliding":
        return 0.0, body.h, 0.0, speed * rng.uniform(-0.5, 0.5), 0.0, 0.0
    if kind == "level":
        return 0.0, body.h * rng.uniform(1.01, 1.3), 0.0, speed * rng.uniform(-0.8, 0.8), speed * rng.uniform(-0.2, 0.2), 0.0
    if kind == "thrown":
        theta = rng.uniform(-0.3, 0.3)
        deep = min(lever(body, corner, theta)[1] for corner in (RIGHT, LEFT))
        velocities = speed * rng.uniform(-0.5, 0.5, 3) / np.array([1.0, 2.0, body.h])
        return 0.0, -deep + body.h * rng.uniform(0.01, 0.3), theta, *velocities.tolist()
    return None


def some_case(seed: int) -> Case:
    """Return the case of a seed."""
    rng = np.random.default_rng(seed)
    body = some_body(rng)
    dt = float(rng.choice([0.01, 0.02, 0.05]))
    n = round(rng.uniform(1.5, 4.0) / dt)
    threshold = body.gravity * min(max(body.mu, 0.05), min(body.arms) / body.h)
    along = shaking(rng, n, dt, threshold * rng.choice([rng.uniform(0.4, 1.0), rng.uniform(0.8, 2.5)]))
    up = shaking(rng, n, dt, body.gravity * rng.choice([0.2, 0.5, 1.0]))
    silent = rng.choice(["none", "up", "along"], p=[0.55, 0.4, 0.05])
    along, up = along * (silent != "along"), up * (silent != "up")
    return Case(body, along, up, dt, some_start(rng, body))


def plain(case: Case, rise: float = 1.0) -> Case:
    """Return a case for witnesses that know one coefficient of friction and plastic impacts, its vertical motion multiplied by `rise`."""
    body = replace(case.body, mu_kinetic=case.body.mu, restitution=0.0, rocking_restitution=None)
    return replace(case, body=body, up=rise * case.up)

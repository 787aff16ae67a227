"""Random runs in three dimensions in which energy must not grow: ``python -m tests.crosscheck.rigid3d_energy --runs 10000``.

Boxes, worn boxes, plates, needles, cylinders, random polyhedra and bodies with an eccentric centre of gravity are thrown, spun or
shaken. Friction is 0 to 1000, the coefficient of restitution 0 to 0.999. Each run prints nothing unless contacts and impacts created more
than 1e-9 of m g times the largest extent, a vertex penetrated the ground by more than 1e-7 of the extent, or the solver failed.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from seisblock import ConvexBody, Motion, Response, solve_rigid3d
from seisblock.core.errors import SolverError
from seisblock.models.rigid3d.outcome import Rigid3dOutcome

GRAVITY = 9.80665
LIMIT = 1e-9
"""Largest energy that a run may create, a share of m g times the largest extent of the body."""
DEPTH = 1e-7
"""Largest penetration, a share of the extent."""
FRICTIONS = (0.0, 0.05, 0.2, 0.6, 1.0, 2.0, 1000.0)
RESTITUTIONS = (0.0, 0.0, 0.2, 0.5, 0.9, 0.999)


@dataclass(frozen=True)
class Run:
    """Energy created and largest penetration of one run, shares of m g size and of the size, 1; the error of a run that failed."""

    seed: int
    created: float
    depth: float
    error: str = ""

    @property
    def is_sound(self) -> bool:
        """True if the run ended without energy, penetration or an error."""
        return not self.error and self.created <= LIMIT and self.depth <= DEPTH


def random_body(rng: np.random.Generator) -> ConvexBody:
    """Return a box, a plate, a needle, a worn box, a cylinder, a polyhedron or an eccentric polyhedron."""
    kind = rng.integers(7)
    if kind < 3:
        thin = 10.0 ** rng.uniform(-2.0, -0.5)
        sizes = rng.uniform(0.1, 1.0, 3) * ((1.0, 1.0, 1.0), (1.0, 1.0, thin), (thin, thin, 1.0))[kind]
        return ConvexBody.box(*sizes.tolist())
    if kind == 3:
        return ConvexBody.box(*rng.uniform(0.1, 1.0, 3).tolist(), inset=0.02)
    if kind == 4:
        return ConvexBody.cylinder(*rng.uniform(0.05, 1.0, 2).tolist(), sides=int(4 * rng.integers(2, 9)))
    points = rng.normal(size=(int(rng.integers(5, 40)), 3)) * rng.uniform(0.1, 0.6, 3)
    body = ConvexBody.polyhedron(points)
    if kind == 5:
        return body
    # a heavy inclusion of a fifth of the size around a vertex's half way moves the centre of gravity, by the parallel-axis theorem
    share = rng.uniform(0.1, 0.9)
    place = np.array(body.centre) + 0.4 * (body.points[rng.integers(len(body.points))] - np.array(body.centre))
    offset = place - np.array(body.centre)
    reduced = body.mass * share * (1.0 - share)
    inertia = (1.0 - share + 0.04 * share) * np.array(body.inertia)
    inertia += reduced * (offset @ offset * np.eye(3) - np.outer(offset, offset))
    return ConvexBody.polyhedron(points, mass=body.mass, centre=(np.array(body.centre) + share * offset).tolist(), inertia=inertia)


def random_motion(rng: np.random.Generator, seconds: float, dt: float = 0.01) -> Motion:
    """Return rest, or noise of three components with a peak of up to 30 m/s^2."""
    time = np.arange(0.0, seconds, dt)
    if rng.uniform() < 0.5:
        return Motion(np.zeros((3, time.size)), dt)
    tones = rng.uniform(0.3, 12.0, 6)
    rows = np.array([sum(rng.normal() * np.sin(2.0 * np.pi * f * time + rng.uniform(0.0, 6.3)) for f in tones) for _ in range(3)])
    return Motion(10.0 ** rng.uniform(-0.5, 1.5) * rows / np.abs(rows).max(), dt)


def random_run(seed: int) -> Run:
    """Solve one run and return what it created."""
    rng = np.random.default_rng(seed)
    body = random_body(rng)
    size = float(np.ptp(body.points, axis=0).max())
    initial: dict[str, list[float]] | None = None
    # a third starts from rest on its base, where it has one
    if rng.uniform() < 2.0 / 3.0:
        axis, turn = rng.normal(size=3), Rotation.random(random_state=rng)
        lowest = float((turn.as_matrix()[2] @ (body.points - np.array(body.centre)).T).min())
        initial = {
            "position": [0.0, 0.0, -lowest + size * float(rng.choice([0.0, 0.01, 1.0])) * rng.uniform()],
            "quaternion": np.roll(turn.as_quat(), 1).tolist(),
            "velocity": rng.normal(size=3).tolist(),
            "spin": (10.0 ** rng.uniform(-1.0, 1.5) * axis / np.linalg.norm(axis)).tolist(),
        }
    motion = random_motion(rng, float(rng.uniform(1.0, 4.0)))
    mu, restitution = float(rng.choice(FRICTIONS)), float(rng.choice(RESTITUTIONS))
    polygon_missing = initial is None and len(body.support_polygon) < 3
    if initial is None and (polygon_missing or not _stands(body)):
        initial = {"spin": [0.0, 0.0, 1.0]}
    try:
        response = solve_rigid3d(body, motion, mu=mu, restitution=restitution, initial=initial, settle_s=1.0)
    except SolverError as error:
        return Run(seed, 0.0, 0.0, str(error))
    return Run(seed, response.outcome.created_j / (body.mass * GRAVITY * size), penetration(response, body) / size)


def _stands(body: ConvexBody) -> bool:
    """Return whether the centre of gravity lies above the support polygon."""
    polygon = body.support_polygon - np.array(body.centre[:2])
    sides = np.roll(polygon, -1, axis=0) - polygon
    return bool((polygon[:, 0] * sides[:, 1] - polygon[:, 1] * sides[:, 0] > 0.0).all())


def penetration(response: Response[Rigid3dOutcome], body: ConvexBody) -> float:
    """Return the largest depth of a vertex below the ground at the samples, m."""
    turns = Rotation.from_quat(np.column_stack([response[name] for name in ("qx", "qy", "qz", "qw")])).as_matrix()[:, 2]
    return -float((turns @ (body.points - np.array(body.centre)).T + response["z"][:, None]).min())


def unsound(first: int, runs: int) -> Iterator[Run]:
    """Yield the runs that created energy, penetrated the ground or failed."""
    for seed in range(first, first + runs):
        run = random_run(seed)
        if not run.is_sound:
            yield run


def main() -> None:
    """Print the unsound runs, the largest energy created and the largest penetration."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=10_000)
    parser.add_argument("--first", type=int, default=0)
    arguments = parser.parse_args()
    created, depth, failures = 0.0, 0.0, 0
    for seed in range(arguments.first, arguments.first + arguments.runs):
        run = random_run(seed)
        created, depth = max(created, run.created), max(depth, run.depth)
        if not run.is_sound:
            failures += 1
            print(run, flush=True)
    print(f"{arguments.runs} runs: {failures} unsound, created at most {created:.2g} m g size, depth at most {depth:.2g} size")


if __name__ == "__main__":
    main()

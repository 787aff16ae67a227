"""Constants and initial state of a run in three dimensions, from a body and options."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from seisblock.bodies.convex import ConvexBody, hull_planes
from seisblock.bodies.scan.polygon import interior_distance
from seisblock.core import checks
from seisblock.core.errors import BodyError, ParameterError
from seisblock.core.typing import FloatArray
from seisblock.models.rigid3d.buffers import BASE_HEIGHT, SIZE, Q, RigidHull, V, W, X
from seisblock.models.rigid3d.options import Rigid3dOptions
from seisblock.models.rigid3d.run import MAX_ANGLE

GAP_SHARE, REST_SHARE = 1e-9, 1e-10
"""Gap below which a vertex touches the ground over the size of the body, and speed below which the body rests over sqrt(g size)."""

BASE_SHARE = 2e-3
"""Height above the lowest vertex up to which a vertex belongs to the base, a share of the size."""

BARRIER_SAMPLES = 200
"""Points of each edge of the base at which the height of a return is evaluated."""

MAX_INITIAL_RATE = 1e4
"""Largest initial spin plus speed over size, rad/s: a run takes a step per 0.01 rad."""

INITIAL_KEYS = {"position": 3, "quaternion": 4, "velocity": 3, "spin": 3}


def rigid_body(body: ConvexBody, options: Rigid3dOptions) -> RigidHull:
    """Return the constants of a run."""
    centre = np.array(body.centre)
    vertices = body.points - centre
    size = float(np.linalg.norm(vertices, axis=1).max())
    height = -float(vertices[:, 2].min())
    polygon = body.support_polygon - centre[:2]
    if len(polygon) < 3 or interior_distance(polygon, (0.0, 0.0)) <= 0.0:
        # thrown bodies need no base
        if options.initial is None:
            raise BodyError(
                "{name} has no base: its lowest points do not surround the centre of gravity; give an `initial` state", name=body.name
            )
        base = np.zeros((0, 3))
    else:
        sides = np.roll(polygon, -1, axis=0) - polygon
        normals = np.column_stack([sides[:, 1], -sides[:, 0]]) / np.hypot(sides[:, 0], sides[:, 1])[:, None]
        base = np.column_stack([normals, np.einsum("ij,ij->i", normals, polygon)])
    is_base = vertices[:, 2] <= -height + BASE_SHARE * 2.0 * size
    g = options.gravity
    constants = np.array(
        [
            body.mass,
            options.mu,
            options.restitution,
            g,
            size,
            GAP_SHARE * size,
            REST_SHARE * math.sqrt(g * size),
            math.sqrt(g / size),
            height,
        ]
    )
    return RigidHull(
        np.ascontiguousarray(vertices.T), np.ascontiguousarray(body.inertia, dtype=np.float64).ravel(), is_base, base, constants
    )


def return_barrier(body: ConvexBody, constants: RigidHull) -> tuple[float, float]:
    """Return lower bounds of the height of the centre of gravity on the ground: of all, and where it lies above an edge of the base, m.

    A body that has overturned passes the second one before it stands on its base again.
    """
    centre = np.array(body.centre)
    planes = hull_planes(body.points, body.name)
    lowest = -float((planes[:, :3] @ centre + planes[:, 3]).max())
    if not len(constants.base):
        return lowest, lowest
    size, height = constants.constants[[SIZE, BASE_HEIGHT]].tolist()
    polygon = body.support_polygon - centre[:2]
    shares = np.linspace(0.0, 1.0, BARRIER_SAMPLES, endpoint=False)[:, None, None]
    points = ((1.0 - shares) * polygon + shares * np.roll(polygon, -1, axis=0)).reshape(-1, 2)
    # directions down to the ground, in the body's axes; the base alone gives a lower bound
    down = np.column_stack([points, np.full(len(points), -height)])
    heights = (down @ constants.vertices[:, constants.is_base]).max(axis=1) / np.linalg.norm(down, axis=1)
    spacing = float(np.hypot(*(np.roll(polygon, -1, axis=0) - polygon).T).max()) / BARRIER_SAMPLES
    # between samples, and in a step across the edge, the height changes by its largest slope, the size, at most
    return lowest, float(heights.min()) - size * (spacing / height + 2.0 * MAX_ANGLE)


def initial_state(body: RigidHull, initial: Mapping[str, Sequence[float]] | None, state: FloatArray) -> None:
    """Write the initial state: standing at rest, or as given.

    Raises
    ------
    ParameterError
        If an entry of `initial` is unknown, has the wrong length, or the body penetrates the ground.
    """
    state[Q], state[X + 2] = 1.0, -body.vertices[2].min()
    if initial is None:
        return
    checks.instance(initial, Mapping)  # type: ignore[type-abstract]
    unknown = [repr(key) for key in initial if key not in INITIAL_KEYS]
    if unknown:
        raise ParameterError("`initial` has no entry {names}; entries: {known}", names=unknown, known=list(INITIAL_KEYS))
    values = {}
    for key, length in INITIAL_KEYS.items():
        if key in initial:
            values[key] = checks.float_vector("`initial`", initial[key])
            if not np.isfinite(values[key]).all():
                raise ParameterError("`initial[{key!r}]` must be finite", key=key)
            if values[key].size != length:
                raise ParameterError(
                    "`initial[{key!r}]` must have {length} numbers, found {found}", key=key, length=length, found=values[key].size
                )
    if "quaternion" in values:
        norm = float(np.linalg.norm(values["quaternion"]))
        if not 0.9 < norm < 1.1:
            raise ParameterError("`initial['quaternion']` must have the length 1, found {norm:.4g}", norm=norm)
        state[Q : Q + 4] = values["quaternion"] / norm
    rotation = quaternion_matrix(state[Q : Q + 4])
    lowest = -float((rotation[2] @ body.vertices).min())
    state[X + 2] = lowest
    if "position" in values:
        state[X : X + 3] = values["position"]
    depth = lowest - state[X + 2]
    size = float(np.abs(body.vertices).max())
    if depth > 1e-6 * size:
        raise ParameterError("`initial`: the lowest point of the body lies {depth:.4g} m below the ground; raise its position", depth=depth)
    state[X + 2] = max(state[X + 2], lowest)
    rate = float(np.linalg.norm(values.get("spin", np.zeros(3))) + np.linalg.norm(values.get("velocity", np.zeros(3))) / size)
    if rate > MAX_INITIAL_RATE:
        raise ParameterError(
            "`initial`: spin plus velocity over the size of the body must be at most {limit:g} rad/s, found {rate:.4g}",
            limit=MAX_INITIAL_RATE,
            rate=rate,
        )
    state[V : V + 3] = values.get("velocity", 0.0)
    state[W : W + 3] = rotation.T @ values.get("spin", np.zeros(3))


def quaternion_matrix(quaternion: FloatArray) -> FloatArray:
    """Return the rotation matrix of a unit quaternion, w first."""
    w, x, y, z = quaternion
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )

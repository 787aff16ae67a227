"""Registration of the solver of a rigid body in three dimensions."""

from __future__ import annotations

import numpy as np

from seisblock.bodies.block import Block
from seisblock.bodies.convex import ConvexBody, convex_body
from seisblock.bodies.from_spec import BLOCK_COLUMNS, friction_from_spec, rigid_body_from_spec, spec_values, without_friction
from seisblock.bodies.scan.body import ScannedBody
from seisblock.bodies.table import BodySpec
from seisblock.core.registry import Solver, SolverBody, ValueMap, register
from seisblock.models.rigid3d.options import Rigid3dOptions
from seisblock.models.rigid3d.outcome import Rigid3dOutcome
from seisblock.models.rigid3d.solve import solve_rigid3d


def _build_body(spec: BodySpec, values: ValueMap) -> SolverBody:
    friction = friction_from_spec(spec, values)["mu"]
    options = Rigid3dOptions(**{**without_friction(values), **spec_values(spec, "restitution"), "mu": friction})  # type: ignore[arg-type]
    return SolverBody(spec.name, rigid_body_from_spec(spec), options)


def _threshold(body: Block | ConvexBody | ScannedBody, options: Rigid3dOptions, axis: int = 0) -> tuple[float, float]:
    """Return the smaller one of g b/h and mu g for both directions of an axis."""
    solid = convex_body(body)
    along = solid.support_polygon[:, axis] - solid.centre[axis]
    height = solid.centre[2] - float(solid.points[:, 2].min())
    right, left = (float(np.max(side * along)) / height for side in (1.0, -1.0))
    return options.gravity * min(options.mu, right), options.gravity * min(options.mu, left)


SOLVER = register(
    Solver(
        name="rigid3d",
        options=Rigid3dOptions,
        outcome=Rigid3dOutcome,
        solve=solve_rigid3d,
        bodies=(Block, ScannedBody, ConvexBody),
        columns=(*BLOCK_COLUMNS, "mu", "mu_range", "surface", "restitution"),
        build_body=_build_body,
        event="overturned",
        overturned="overturned",
        displacement="max_displacement_m",
        damage_states={"slip": "max_displacement_m", "overturn": "overturned"},
        describe="seisblock.models.rigid3d.describe:describe",
        plot="seisblock.models.rigid3d.plot:figure",
        animate="seisblock.models.rigid3d.animate:animate",
        threshold=_threshold,
        spatial=True,
        topics=("rigid body in space",),
    )
)
"""Solver of one rigid convex body in three dimensions."""

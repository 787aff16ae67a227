"""Registration of the full-response solver."""

from __future__ import annotations

import math

from seisblock.bodies.block import Block
from seisblock.bodies.from_spec import BLOCK_COLUMNS, friction_from_spec, rigid_body_from_spec, spec_values
from seisblock.bodies.scan.body import ScannedBody
from seisblock.bodies.table import BodySpec
from seisblock.bodies.two_layer import TwoLayerBlock
from seisblock.core.registry import Solver, SolverBody, ValueMap, register
from seisblock.models.respond.options import RespondOptions
from seisblock.models.respond.outcome import RespondOutcome
from seisblock.models.respond.params import Body, rigid_body
from seisblock.models.respond.rows import solve_respond_rows
from seisblock.models.respond.solve import solve_respond

OWN_COLUMNS = ("restitution", "rocking_restitution", "tenon")


def _build_body(spec: BodySpec, values: ValueMap) -> SolverBody:
    body = rigid_body_from_spec(spec)
    options = RespondOptions(**{**values, **spec_values(spec, *OWN_COLUMNS), **friction_from_spec(spec, values)})
    return SolverBody(spec.name, body, options)


def _threshold(block: Body, options: RespondOptions) -> tuple[float, float]:
    """Return the smaller one of g b/h and mu g for each direction; feet with tenons do not slip."""
    body = rigid_body(block)
    friction = math.inf if options.tenon > 0.0 else options.mu
    return options.gravity * min(friction, body.right / body.height), options.gravity * min(friction, body.left / body.height)


SOLVER = register(
    Solver(
        name="respond",
        options=RespondOptions,
        outcome=RespondOutcome,
        solve=solve_respond,
        bodies=(Block, TwoLayerBlock, ScannedBody),
        columns=(*BLOCK_COLUMNS, "mu", "mu_range", "mu_kinetic", "surface", *OWN_COLUMNS),
        build_body=_build_body,
        event="overturned",
        overturned="overturned",
        displacement="max_displacement_m",
        solve_rows=solve_respond_rows,
        row_options=("mu", "mu_kinetic", "restitution", "rocking_restitution", "vertical", "gravity"),
        threshold=_threshold,
        describe="seisblock.models.respond.describe:describe",
        plot="seisblock.models.respond.plot:figure",
        animate="seisblock.models.respond.animate:animate",
        section="seisblock.models.respond.describe:SECTION",
        document="seisblock.models.respond.document:DOCUMENT",
        topics=("all modes", "two-layer body"),
        command_topics=("rigid body in space",),
    )
)

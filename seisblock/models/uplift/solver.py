"""Registration of the uplift solver."""

from __future__ import annotations

from collections.abc import Sequence

from seisblock.bodies.factory import block_from_table
from seisblock.bodies.from_spec import spec_values
from seisblock.bodies.spring_block import SpringBlock
from seisblock.bodies.spring_factory import spring_block, springs_from_table
from seisblock.bodies.table import BodySpec
from seisblock.core.errors import BodyError
from seisblock.core.registry import RowResult, Solver, SolverBody, ValueMap, register
from seisblock.models.uplift.batch import uplift_many
from seisblock.models.uplift.options import UpliftOptions
from seisblock.models.uplift.outcome import UpliftOutcome, warnings
from seisblock.models.uplift.solve import solve_uplift
from seisblock.records import Motion
from seisblock.records._validation import vertical_gain


def _build_body(spec: BodySpec, values: ValueMap) -> SolverBody:
    given = spec_values(spec, "width", "depth", "height", "mass", "frequency_vertical", "beta", "damping")
    try:
        if spec.description is not None and spec.description.get("kind") == "springs":
            body = springs_from_table(spec.description, **given)
        else:
            if spec.description is not None:
                block = block_from_table(spec.description, side=spec.parameters.get("side", "short"))
                given |= {"width": block.width, "depth": block.depth, "height": block.height, "mass": block.mass}
            body = spring_block(**given)
    except BodyError as error:
        raise BodyError("{source}: {why}", source=spec.source, why=error.message) from error
    return SolverBody(spec.name, body, UpliftOptions(**values))


def _solve_rows(bodies: Sequence[SolverBody], motion: Motion) -> dict[str, RowResult]:
    """Solve blocks on springs of one gravity; stopped runs are left out, for the reason of their single run."""
    gains = [(1.0, 1.0, vertical_gain(motion, body.options.vertical)) for body in bodies]
    result = uplift_many([body.body for body in bodies], motion, gains=gains, gravity=bodies[0].options.gravity)
    return {
        body.name: (result.row_dict(row, motion.start_s), warnings(motion, result, row))
        for row, body in enumerate(bodies)
        if not result.gave_up[row]
    }


def _threshold(body: SpringBlock, options: UpliftOptions) -> tuple[float, float]:
    """Return the acceleration that unloads two corners when it is applied slowly: m a H/(4 a_x) = m g/4 each, g a_x/H (derived here)."""
    threshold = options.gravity * body.width / body.height
    return threshold, threshold


SOLVER = register(
    Solver(
        name="uplift",
        options=UpliftOptions,
        outcome=UpliftOutcome,
        solve=solve_uplift,
        bodies=(SpringBlock,),
        columns=("width", "depth", "height", "mass", "frequency_vertical", "beta", "damping", "side"),
        build_body=_build_body,
        event="uplifts",
        displacement="max_uplift_m",
        solve_rows=_solve_rows,
        row_options=("vertical",),
        threshold=_threshold,
        describe="seisblock.models.uplift.describe:describe",
        plot="seisblock.models.uplift.plot:figure",
        animate="seisblock.models.uplift.animate:animate",
        section="seisblock.models.uplift.describe:SECTION",
        document="seisblock.models.uplift.document:DOCUMENT",
        topics=("uplift",),
    )
)

"""Registration of the rocking solver."""

from __future__ import annotations

from dataclasses import fields

from seisblock.bodies.block import Block
from seisblock.bodies.factory import table_restitution
from seisblock.bodies.from_spec import BLOCK_COLUMNS, rigid_body_from_spec, spec_values
from seisblock.bodies.table import BodySpec
from seisblock.core.registry import Solver, SolverBody, ValueMap, register
from seisblock.models.rock.options import RockOptions
from seisblock.models.rock.outcome import RockOutcome
from seisblock.models.rock.params import threshold_ratios
from seisblock.models.rock.rows import solve_rock_rows
from seisblock.models.rock.solve import solve_rock


def _build_body(spec: BodySpec, values: ValueMap) -> SolverBody:
    restitution = None if spec.description is None else table_restitution(spec.description, spec.source)
    from_file = {} if restitution is None else {"restitution": restitution}
    return SolverBody(spec.name, rigid_body_from_spec(spec), RockOptions(**{**values, **from_file, **spec_values(spec, "restitution")}))


def _threshold(block: Block, options: RockOptions) -> tuple[float, float]:
    """Return the accelerations at which the block begins to rock about its right and left lower corner, m/s^2."""
    right, left = threshold_ratios(block.slendernesses, linear=options.linear)
    return options.gravity * right, options.gravity * left


SOLVER = register(
    Solver(
        name="rock",
        options=RockOptions,
        outcome=RockOutcome,
        solve=solve_rock,
        bodies=(Block,),
        columns=(*BLOCK_COLUMNS, "restitution"),
        build_body=_build_body,
        event="overturned",
        overturned="overturned",
        solve_rows=solve_rock_rows,
        row_options=tuple(field.name for field in fields(RockOptions)),
        threshold=_threshold,
        describe="seisblock.models.rock.describe:describe",
        plot="seisblock.models.rock.plot:figure",
        animate="seisblock.models.rock.animate:animate",
        section="seisblock.models.rock.describe:SECTION",
        document="seisblock.models.rock.document:DOCUMENT",
        topics=("rocking",),
        command_topics=("overturning criteria", "scenario", "synthetic records"),
    )
)

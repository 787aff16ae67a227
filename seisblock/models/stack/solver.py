"""Registration of the solver of piles."""

from __future__ import annotations

from seisblock.bodies.from_spec import without_friction
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.toml import load_pile
from seisblock.bodies.table import BodySpec
from seisblock.core.errors import BodyError
from seisblock.core.registry import Solver, SolverBody, ValueMap, register
from seisblock.models.stack.joint_geometry import pile_thresholds
from seisblock.models.stack.options import StackOptions
from seisblock.models.stack.outcome import StackOutcome
from seisblock.models.stack.solve import solve_stack


def _build_body(spec: BodySpec, values: ValueMap) -> SolverBody:
    if spec.description is None or spec.description.get("kind") != "pile":
        raise BodyError("{source}: stack requires a pile of stones; give its file or a bundled one such as lantern", source=spec.source)
    pile = load_pile(str(spec.description["source"]), mu=spec.parameters.get("mu", values.get("mu")))
    return SolverBody(spec.name, pile, StackOptions(**without_friction(values)))


SOLVER = register(
    Solver(
        name="stack",
        options=StackOptions,
        outcome=StackOutcome,
        solve=solve_stack,
        bodies=(Pile,),
        columns=("mu",),
        build_body=_build_body,
        event="overturned_any",
        overturned="overturned_any",
        damage_states={"slip": "residual_slip_m", "overturn": "overturned_any"},
        spatial=True,
        threshold=lambda pile, options, axis=0: pile_thresholds(pile, options.points, options.gravity, axis),
        describe="seisblock.models.stack.describe:describe",
        plot="seisblock.models.stack.plot:figure",
        animate="seisblock.models.stack.animate:animate",
        document="seisblock.models.stack.document:DOCUMENT",
        topics=("rigid pile",),
    )
)

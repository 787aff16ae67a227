"""Registration of the jump solver."""

from __future__ import annotations

from collections.abc import Sequence

from seisblock.bodies.from_spec import spec_values, without_friction
from seisblock.bodies.table import BodySpec
from seisblock.bodies.two_layer import Contact, TwoLayerBlock, base_from_table, contact_from_table, two_layer_from_table
from seisblock.core.errors import BodyError
from seisblock.core.registry import RowResult, Solver, SolverBody, ValueMap, register
from seisblock.models.jump.batch import jump_many
from seisblock.models.jump.chain import ChainOutcome
from seisblock.models.jump.options import JumpOptions
from seisblock.models.jump.segments import chain_warnings
from seisblock.models.jump.solve import JumpOutcome, solve_jump
from seisblock.records import Motion


def _build_body(spec: BodySpec, values: ValueMap) -> SolverBody:
    if spec.description is None or spec.description.get("kind") != "two-layer":
        raise BodyError("{source}: jump requires a two-layer body; give its file or a bundled one such as chozusha", source=spec.source)
    contact_values = {**contact_from_table(spec.description), **spec_values(spec, "mu", "mu_kinetic")}
    if "mu" not in contact_values:
        contact_values |= {key: values[key] for key in ("mu", "mu_kinetic") if values.get(key) is not None}
    if "mu" not in contact_values:
        raise BodyError("{source}: friction required: give `mu` (static coefficient)", source=spec.source)
    block = two_layer_from_table(spec.description, spec.parameters.get("side", "short"))
    options = {
        **without_friction(values),
        "contact": Contact(**contact_values),
        **base_from_table(spec.description),
        **spec_values(spec, "drop", "tenon"),
    }
    return SolverBody(spec.name, block, JumpOptions(**options))


def _solve_rows(bodies: Sequence[SolverBody], motion: Motion) -> dict[str, RowResult]:
    """Solve two-layer blocks of equal options; jammed feet, stopped runs and time windows are left out, and tenons."""
    shared: JumpOptions = bodies[0].options
    if shared.windows or shared.tenon:
        return {}
    contacts, drop = [body.options.contact for body in bodies], [body.options.drop for body in bodies]
    result = jump_many(
        [body.body for body in bodies],
        motion,
        contacts=contacts,
        drop=drop,
        spin=shared.spin,
        direction=shared.direction,
        landing=shared.landing,
        first=shared.first,
        gravity=shared.gravity,
    )
    return {
        body.name: (
            {**result.row_dict(row), "landing": shared.landing},
            chain_warnings(motion, result.row_chains(row, motion.start_s), contact.mu),
        )
        for row, (body, contact) in enumerate(zip(bodies, contacts, strict=True))
        if not (result.jammed[row] or result.gave_up[row])
    }


def _threshold(block: TwoLayerBlock, options: JumpOptions) -> tuple[float, float]:
    """Return g x_G/y_G for both directions ([Sugimoto2017]_ eq. (2))."""
    threshold = block.rocking_threshold(options.gravity)
    return threshold, threshold


SOLVER = register(
    Solver(
        name="jump",
        options=JumpOptions,
        outcome=JumpOutcome,
        solve=solve_jump,
        bodies=(TwoLayerBlock,),
        columns=("side", "mu", "mu_kinetic", "drop", "tenon"),
        build_body=_build_body,
        event="outcome",
        event_values=(ChainOutcome.JUMPED,),
        overturned="outcome",
        overturned_values=(ChainOutcome.OVERTURNED_ROCKING, ChainOutcome.OVERTURNED_LANDED),
        displacement="total_displacement_m",
        solve_rows=_solve_rows,
        row_options=("contact", "drop"),
        threshold=_threshold,
        describe="seisblock.models.jump.describe:describe",
        plot="seisblock.models.jump.plot:figure",
        animate="seisblock.models.jump.animate:animate",
        section="seisblock.models.jump.describe:SECTION",
        document="seisblock.models.jump.document:DOCUMENT",
        topics=("jump",),
    )
)

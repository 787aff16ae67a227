"""Batch solvers: body construction, solution and result columns of each model."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from inspect import signature
from typing import Any

from seisblock.bodies.block import Block
from seisblock.bodies.edge_wear import EdgeWear
from seisblock.bodies.factory import block_from_table, body_from_table, table_friction, table_restitution
from seisblock.bodies.friction import surface
from seisblock.bodies.kinds import of_kind
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.toml import load_pile
from seisblock.bodies.scan.body import ScannedBody
from seisblock.bodies.sliding_base import SlidingBase, sliding_base
from seisblock.bodies.spring_block import SpringBlock
from seisblock.bodies.spring_factory import spring_block
from seisblock.bodies.table import BodySpec
from seisblock.bodies.two_layer import Contact, TwoLayerBlock, contact_from_table, two_layer_from_table
from seisblock.core.errors import BodyError, ParameterError
from seisblock.core.results import Response
from seisblock.models.jump.chain import JUMPED
from seisblock.models.jump.solve import JumpOutcome, solve_jump
from seisblock.models.respond.outcome import RespondOutcome
from seisblock.models.respond.solve import solve_respond
from seisblock.models.rock.outcome import RockOutcome
from seisblock.models.rock.solve import solve_rock
from seisblock.models.slide.solve import SlideOutcome, solve_slide
from seisblock.models.stack.outcome import StackOutcome
from seisblock.models.stack.solve import solve_stack
from seisblock.models.uplift.outcome import UpliftOutcome
from seisblock.models.uplift.solve import solve_uplift
from seisblock.records import Motion
from seisblock.studies.batch.scalar_fields import scalar_fields
from seisblock.studies.parallel import left_out_versions
from seisblock.studies.respond.probability import respond_probability
from seisblock.studies.rocking.perturb import perturb

ValueMap = Mapping[str, Any]
Row = dict[str, Any]

_BLOCK = ("width", "height", "depth", "mass", "density", "centroid_height", "centroid_offset", "centroid_inertia", "inset", "side", "kind")
_SIZES = _BLOCK[:-3]


@dataclass(frozen=True)
class SolverBody:
    """Body of a solver with its name and options."""

    name: str
    body: Any
    options: ValueMap


@dataclass(frozen=True)
class BatchModel:
    """Batch solver.

    Parameters
    ----------
    name : str
    kinds : tuple of type
        Body types accepted without conversion.
    columns : tuple of str
        Columns used of a table of bodies.
    build_body : callable
        ``build_body(spec, options) -> SolverBody``.
    solve : callable
        ``solve(body, motion, **options) -> Response``.
    outcome : type
        Outcome type; its scalar fields are columns of the table.
    happens : str
        Column of the event.
    chance : callable or None
        ``chance(solver_body, motion, runs, seed, options) -> Row``: probability columns; None for solvers without samples.
    chances : mapping of str to type
        Columns filled by `chance`.
    """

    name: str
    kinds: tuple[type, ...]
    columns: tuple[str, ...]
    build_body: Callable[[BodySpec, ValueMap], SolverBody]
    solve: Callable[..., Response[Any]]
    outcome: type
    happens: str
    chance: Callable[[SolverBody, Motion, int, int, ValueMap], Row] | None = None
    chances: Mapping[str, type] | None = None

    @cached_property
    def scalars(self) -> Mapping[str, type]:
        """Scalar fields of the outcome with their types."""
        return scalar_fields(self.outcome)

    def check_options(self, options: ValueMap) -> None:
        """Raise for options that neither the solver nor its bodies have.

        Raises
        ------
        ParameterError
            Naming them.
        """
        allowed = (*signature(self.solve).parameters, *(name for name in ("mu", "mu_kinetic") if name in self.columns))
        unknown = [f"`{name}`" for name in options if name not in allowed]
        if unknown:
            raise ParameterError("{solver} has no option {names}: omit it", solver=self.name, names=unknown)

    def event_occurred(self, row: ValueMap) -> bool:
        """Return whether the event of the solver occurred in a row with a result."""
        value = row[self.happens]
        return value == JUMPED if isinstance(value, str) else bool(value)

    def ignored_keys(self, spec: BodySpec) -> list[str]:
        """Return the keys of a body that the solver does not use."""
        return [key for key in spec.parameters if key not in self.columns]


def _rigid_body(spec: BodySpec) -> Block | ScannedBody:
    values = spec.parameters
    sizes = {key: values[key] for key in _SIZES if key in values}
    if spec.description is not None:
        if sizes or "kind" in values:
            raise BodyError("{source}: give either sizes (with or without `kind`) or `body`, not both", source=spec.source)
        body = body_from_table(spec.description, side=values.get("side", "short"))
    else:
        missing = [key for key in ("width", "height") if key not in sizes]
        if missing:
            raise BodyError("{source}: {missing} missing; a block requires width and height", source=spec.source, missing=missing)
        try:
            body = of_kind(Block(**sizes, name=spec.name), values.get("kind", "block"))
        except BodyError as error:
            raise BodyError("{source}: {why}", source=spec.source, why=error.message) from error
    inset = values.get("inset")
    return body.with_wear(inset) if isinstance(inset, EdgeWear) else body


def _friction(spec: BodySpec, options: ValueMap) -> dict[str, float | None]:
    """Return static and kinetic friction: from the row, its surface, its file, or the common options, in this order."""
    values = spec.parameters
    if "mu" in values or "surface" in values:
        if "mu" in values and "surface" in values:
            raise BodyError("{source}: give mu or surface, not both", source=spec.source)
        contact_surface = surface(values["surface"]) if "surface" in values else None
        mu, kinetic = (values["mu"], None) if contact_surface is None else (contact_surface.mu, contact_surface.mu_kinetic)
    else:
        mu, kinetic = (None, None) if spec.description is None else table_friction(spec.description, spec.source)
        if mu is None:
            mu, kinetic = options.get("mu"), options.get("mu_kinetic")
    if mu is None:
        raise BodyError("{source}: friction required: give mu (static coefficient)", source=spec.source)
    return {"mu": mu, "mu_kinetic": values.get("mu_kinetic", kinetic)}


def _without_friction(options: ValueMap) -> dict[str, Any]:
    """Return the options without friction, which belongs to the body or its contact."""
    return {key: value for key, value in options.items() if key not in ("mu", "mu_kinetic")}


def _row_values(spec: BodySpec, *names: str) -> dict[str, Any]:
    return {name: spec.parameters[name] for name in names if name in spec.parameters}


def _respond_body(spec: BodySpec, options: ValueMap) -> SolverBody:
    row_options = _row_values(spec, "restitution", "rocking_restitution", "tenon")
    body = _rigid_body(spec)
    if isinstance(body, Block) and ("mu" in spec.parameters or "surface" in spec.parameters):
        body = body.without_ranges("mu")
    return SolverBody(spec.name, body, {**options, **row_options, **_friction(spec, options)})


def _rock_body(spec: BodySpec, options: ValueMap) -> SolverBody:
    file_restitution = None if spec.description is None else table_restitution(spec.description, spec.source)
    row_options = {**({} if file_restitution is None else {"restitution": file_restitution}), **_row_values(spec, "restitution")}
    return SolverBody(spec.name, _rigid_body(spec), {**options, **row_options})


def _slide_body(spec: BodySpec, options: ValueMap) -> SolverBody:
    friction = _friction(spec, options)
    if "kappa" in spec.parameters and "mu_kinetic" not in spec.parameters:
        friction["mu_kinetic"] = None
    row_options = _row_values(spec, "kappa", "slope_deg", "slope_length")
    return SolverBody(spec.name, sliding_base(**friction, **row_options), _without_friction(options))  # type: ignore[arg-type]


def _uplift_body(spec: BodySpec, options: ValueMap) -> SolverBody:
    sizes = _row_values(spec, "width", "depth", "height", "mass")
    if spec.description is not None:
        block = block_from_table(spec.description, side=spec.parameters.get("side", "short"))
        sizes = {"width": block.width, "depth": block.depth, "height": block.height, "mass": block.mass}
    try:
        body = spring_block(**sizes, **_row_values(spec, "frequency_vertical", "beta", "damping"))
    except BodyError as error:
        raise BodyError("{source}: {why}", source=spec.source, why=error.message) from error
    return SolverBody(spec.name, body, options)


def _jump_body(spec: BodySpec, options: ValueMap) -> SolverBody:
    if spec.description is None or spec.description.get("kind") != "two-layer":
        raise BodyError("{source}: jump requires a two-layer body; give its file or a bundled one such as chozusha", source=spec.source)
    contact_values = {**contact_from_table(spec.description), **_row_values(spec, "mu", "mu_kinetic")}
    if "mu" not in contact_values:
        contact_values |= {key: options[key] for key in ("mu", "mu_kinetic") if options.get(key) is not None}
    if "mu" not in contact_values:
        raise BodyError("{source}: friction required: give mu (static coefficient)", source=spec.source)
    block = two_layer_from_table(spec.description, spec.parameters.get("side", "short"))
    return SolverBody(spec.name, block, {**_without_friction(options), "contact": Contact(**contact_values), **_row_values(spec, "drop")})


def _stack_body(spec: BodySpec, options: ValueMap) -> SolverBody:
    if spec.description is None or spec.description.get("kind") != "pile":
        raise BodyError("{source}: stack requires a pile of stones; give its file or a bundled one such as lantern", source=spec.source)
    pile = load_pile(str(spec.description["source"]), mu=spec.parameters.get("mu", options.get("mu")))
    return SolverBody(spec.name, pile, _without_friction(options))


def _respond_probability_columns(solver_body: SolverBody, motion: Motion, runs: int, seed: int, options: ValueMap) -> Row:
    result = respond_probability(solver_body.body, motion, runs=runs, seed=seed, **options)
    low, high = result.interval
    return _probability_columns(result.runs, result.overturned, low, high, result.no_answer) | {"probability_moved": result.moved}


def _rock_probability_columns(solver_body: SolverBody, motion: Motion, runs: int, seed: int, options: ValueMap) -> Row:
    result = perturb(solver_body.body, motion, runs, seed=seed, **options)
    return _probability_columns(result.runs, result.probability, *result.probability_interval, result.no_answer)


def _probability_columns(runs: int, overturned: float, low: float, high: float, no_answer: tuple[int, ...]) -> Row:
    """Return an overturning probability as columns, with a warning for samples without a result."""
    row: Row = {"runs": runs, "probability_overturned": overturned, "probability_low": low, "probability_high": high}
    warning = left_out_versions(no_answer, runs)
    return row if warning is None else {**row, LEFT_OUT: warning}


LEFT_OUT = "left_out"
"""Key of the warning on samples without a result; not a column."""

_PROBABILITY_COLUMNS: dict[str, type] = {"runs": int, "probability_overturned": float, "probability_low": float, "probability_high": float}

BATCH_MODELS = {
    model.name: model
    for model in (
        BatchModel(
            "respond",
            (Block, TwoLayerBlock, ScannedBody),
            (*_BLOCK, "mu", "mu_kinetic", "surface", "restitution", "rocking_restitution", "tenon"),
            _respond_body,
            solve_respond,
            RespondOutcome,
            "overturned",
            _respond_probability_columns,
            {**_PROBABILITY_COLUMNS, "probability_moved": float},
        ),
        BatchModel(
            "rock",
            (Block,),
            (*_BLOCK, "restitution"),
            _rock_body,
            solve_rock,
            RockOutcome,
            "overturned",
            _rock_probability_columns,
            _PROBABILITY_COLUMNS,
        ),
        BatchModel(
            "slide",
            (SlidingBase, float, int),
            ("mu", "mu_kinetic", "surface", "kappa", "slope_deg", "slope_length"),
            _slide_body,
            solve_slide,
            SlideOutcome,
            "slips",
        ),
        BatchModel("jump", (TwoLayerBlock,), ("side", "mu", "mu_kinetic", "drop"), _jump_body, solve_jump, JumpOutcome, "outcome"),
        BatchModel(
            "uplift",
            (SpringBlock,),
            ("width", "depth", "height", "mass", "frequency_vertical", "beta", "damping", "side"),
            _uplift_body,
            solve_uplift,
            UpliftOutcome,
            "uplifts",
        ),
        BatchModel("stack", (Pile,), ("mu",), _stack_body, solve_stack, StackOutcome, "overturned_any"),
    )
}
"""Batch solvers by command name."""


def batch_model(name: str) -> BatchModel:
    """Return the batch solver with a name.

    Raises
    ------
    ParameterError
        If there is none of that name.
    """
    if name not in BATCH_MODELS:
        raise ParameterError("unknown batch solver {name!r}; available: {known}", name=str(name)[:100], known=list(BATCH_MODELS))
    return BATCH_MODELS[name]

"""What each solver of a batch needs of a listed body, and what it answers: one table instead of a branch in every place."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from inspect import signature
from typing import Any

from seisblock.bodies.block import Block
from seisblock.bodies.friction import surface
from seisblock.bodies.inset import Inset
from seisblock.bodies.kinds import of_kind
from seisblock.bodies.library import block_of, body_of, friction_of, restitution_of
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.toml import load_pile
from seisblock.bodies.roster import ListedBody
from seisblock.bodies.scan.body import ScannedBody
from seisblock.bodies.sliding_base import SlidingBase, sliding_base
from seisblock.bodies.spring_block import SpringBlock
from seisblock.bodies.spring_choice import spring_block
from seisblock.bodies.two_layer import Contact, TwoLayerBlock, contact, two_layer_block
from seisblock.errors import BodyError, ParameterError
from seisblock.records import Motion
from seisblock.results import Response
from seisblock.solvers.jump.chain import JUMPED
from seisblock.solvers.jump.solve import JumpOutcome, solve_jump
from seisblock.solvers.respond.outcome import RespondOutcome
from seisblock.solvers.respond.solve import solve_respond
from seisblock.solvers.rock.outcome import RockOutcome
from seisblock.solvers.rock.solve import solve_rock
from seisblock.solvers.slide.solve import SlideOutcome, solve_slide
from seisblock.solvers.stack.outcome import StackOutcome
from seisblock.solvers.stack.solve import solve_stack
from seisblock.solvers.uplift.outcome import UpliftOutcome
from seisblock.solvers.uplift.solve import solve_uplift
from seisblock.studies.batch.scalars import scalars_of
from seisblock.studies.rocking.perturb import perturb
from seisblock.studies.runs import left_out_versions
from seisblock.studies.standing.probability import respond_probability

Told = Mapping[str, Any]
Row = dict[str, Any]

_BLOCK = ("width", "height", "depth", "mass", "density", "centroid_height", "centroid_offset", "centroid_inertia", "inset", "side", "kind")
_SIZES = _BLOCK[:-3]


@dataclass(frozen=True)
class Placed:
    """A body as one solver takes it: what it is called, what it is, and the options of its own."""

    name: str
    body: Any
    options: Told


@dataclass(frozen=True)
class BatchModel:
    """One solver of a batch.

    Parameters
    ----------
    name : str
    kinds : tuple of type
        Bodies it takes as they are.
    columns : tuple of str
        What it takes from a row of a table of bodies.
    place : callable
        ``place(listed, options) -> Placed``.
    solve : callable
        ``solve(body, motion, **options) -> Response``.
    outcome : type
        Of its answer; the scalar fields are columns of the table.
    happens : str
        The column that answers the user's question.
    chance : callable or None
        ``chance(placed, motion, runs, seed, options) -> Row``: what perturbed runs say; None where nothing is perturbed.
    chances : mapping of str to type
        The columns that `chance` fills.
    """

    name: str
    kinds: tuple[type, ...]
    columns: tuple[str, ...]
    place: Callable[[ListedBody, Told], Placed]
    solve: Callable[..., Response[Any]]
    outcome: type
    happens: str
    chance: Callable[[Placed, Motion, int, int, Told], Row] | None = None
    chances: Mapping[str, type] | None = None

    @cached_property
    def scalars(self) -> Mapping[str, type]:
        """The scalar fields of the outcome, with their types."""
        return scalars_of(self.outcome)

    def refuse_unknown(self, options: Told) -> None:
        """Refuse options that neither the solver nor its bodies have.

        Raises
        ------
        ParameterError
            Naming them.
        """
        known = (*signature(self.solve).parameters, *(name for name in ("mu", "mu_kinetic") if name in self.columns))
        unknown = [f"`{name}`" for name in options if name not in known]
        if unknown:
            raise ParameterError("{solver} has no option {names}: leave it out", solver=self.name, names=unknown)

    def happened(self, row: Told) -> bool:
        """Return whether what the user asks about happened in a row with an answer."""
        found = row[self.happens]
        return found == JUMPED if isinstance(found, str) else bool(found)

    def unheard(self, listed: ListedBody) -> list[str]:
        """Return what is told of a body that this solver takes no notice of."""
        return [key for key in listed.told if key not in self.columns]


def _rigid(listed: ListedBody) -> Block | ScannedBody:
    """Return the rigid body of a row or a file."""
    told = listed.told
    sizes = {key: told[key] for key in _SIZES if key in told}
    if listed.description is not None:
        if sizes or "kind" in told:
            raise BodyError("{source}: give sizes, with or without `kind`, or `body`, not both", source=listed.source)
        body = body_of(listed.description, side=told.get("side", "short"))
    else:
        missing = [key for key in ("width", "height") if key not in sizes]
        if missing:
            raise BodyError("{source}: {missing} missing: a block needs width and height", source=listed.source, missing=missing)
        try:
            body = of_kind(Block(**sizes, name=listed.name), told.get("kind", "block"))
        except BodyError as error:
            raise BodyError("{source}: {why}", source=listed.source, why=error.said) from error
    inset = told.get("inset")
    return body.worn(inset) if isinstance(inset, Inset) else body


def _friction(listed: ListedBody, options: Told) -> dict[str, float | None]:
    """Return the static and the kinetic friction: of the row, else of its surface, else of its file, else as given for all."""
    told = listed.told
    if "mu" in told or "surface" in told:
        if "mu" in told and "surface" in told:
            raise BodyError("{source}: give mu or a surface, not both", source=listed.source)
        found = surface(told["surface"]) if "surface" in told else None
        mu, kinetic = (told["mu"], None) if found is None else (found.mu, found.mu_kinetic)
    else:
        mu, kinetic = (None, None) if listed.description is None else friction_of(listed.description, listed.source)
        if mu is None:
            mu, kinetic = options.get("mu"), options.get("mu_kinetic")
    if mu is None:
        raise BodyError("{source}: how rough is it under the body? Tell mu, the static friction coefficient", source=listed.source)
    return {"mu": mu, "mu_kinetic": told.get("mu_kinetic", kinetic)}


def _but_friction(options: Told) -> dict[str, Any]:
    """Return the options that are left where friction belongs to the body, or to its contact."""
    return {key: value for key, value in options.items() if key not in ("mu", "mu_kinetic")}


def _own(listed: ListedBody, *names: str) -> dict[str, Any]:
    """Return what a row says under some names."""
    return {name: listed.told[name] for name in names if name in listed.told}


def _standing(listed: ListedBody, options: Told) -> Placed:
    """Place a free-standing block."""
    own = _own(listed, "restitution", "rocking_restitution", "tenon")
    body = _rigid(listed)
    if isinstance(body, Block) and ("mu" in listed.told or "surface" in listed.told):
        body = body.known("mu")
    return Placed(listed.name, body, {**options, **own, **_friction(listed, options)})


def _rocking(listed: ListedBody, options: Told) -> Placed:
    """Place a block that rocks."""
    brought = None if listed.description is None else restitution_of(listed.description, listed.source)
    own = {**({} if brought is None else {"restitution": brought}), **_own(listed, "restitution")}
    return Placed(listed.name, _rigid(listed), {**options, **own})


def _sliding(listed: ListedBody, options: Told) -> Placed:
    """Place an object on a base on which it slides."""
    friction = _friction(listed, options)
    if "kappa" in listed.told and "mu_kinetic" not in listed.told:
        friction["mu_kinetic"] = None
    own = _own(listed, "kappa", "slope_deg", "slope_length")
    return Placed(listed.name, sliding_base(**friction, **own), _but_friction(options))  # type: ignore[arg-type]


def _on_springs(listed: ListedBody, options: Told) -> Placed:
    """Place a block on corner springs."""
    sizes = _own(listed, "width", "depth", "height", "mass")
    if listed.description is not None:
        block = block_of(listed.description, side=listed.told.get("side", "short"))
        sizes = {"width": block.width, "depth": block.depth, "height": block.height, "mass": block.mass}
    try:
        body = spring_block(**sizes, **_own(listed, "frequency_vertical", "beta", "damping"))
    except BodyError as error:
        raise BodyError("{source}: {why}", source=listed.source, why=error.said) from error
    return Placed(listed.name, body, options)


def _jumping(listed: ListedBody, options: Told) -> Placed:
    """Place a two-layer block."""
    if listed.description is None or listed.description.get("kind") != "two-layer":
        raise BodyError("{source}: a jump needs a two-layer body: name its file, or a bundled one such as chozusha", source=listed.source)
    found = {**contact(listed.description), **_own(listed, "mu", "mu_kinetic")}
    if "mu" not in found:
        found |= {key: options[key] for key in ("mu", "mu_kinetic") if options.get(key) is not None}
    if "mu" not in found:
        raise BodyError("{source}: how rough is it under the body? Tell mu, the static friction coefficient", source=listed.source)
    block = two_layer_block(listed.description, listed.told.get("side", "short"))
    return Placed(listed.name, block, {**_but_friction(options), "contact": Contact(**found), **_own(listed, "drop")})


def _stacked(listed: ListedBody, options: Told) -> Placed:
    """Place a pile of stones."""
    if listed.description is None or listed.description.get("kind") != "pile":
        raise BodyError("{source}: a stack needs a pile: name its file, or a bundled one such as lantern", source=listed.source)
    pile = load_pile(str(listed.description["source"]), mu=listed.told.get("mu", options.get("mu")))
    return Placed(listed.name, pile, _but_friction(options))


def _chance_of_standing(placed: Placed, motion: Motion, runs: int, seed: int, options: Told) -> Row:
    """Return what plausible versions of a free-standing object do."""
    found = respond_probability(placed.body, motion, runs=runs, seed=seed, **options)
    low, high = found.interval
    return _chance(found.runs, found.overturned, low, high, found.no_answer) | {"probability_moved": found.moved}


def _chance_of_rocking(placed: Placed, motion: Motion, runs: int, seed: int, options: Told) -> Row:
    """Return what slightly changed versions of a rocking block do."""
    found = perturb(placed.body, motion, runs, seed=seed, **options)
    return _chance(found.runs, found.probability, *found.probability_interval, found.no_answer)


def _chance(runs: int, overturned: float, low: float, high: float, no_answer: tuple[int, ...]) -> Row:
    """Return a share of falls as columns, with a warning where versions have no answer."""
    row: Row = {"runs": runs, "probability_overturned": overturned, "probability_low": low, "probability_high": high}
    warning = left_out_versions(no_answer, runs)
    return row if warning is None else {**row, LEFT_OUT: warning}


LEFT_OUT = "left_out"
"""Key under which what perturbed runs say holds a sentence on those of them that have no answer; it is no column."""

_CHANCES: dict[str, type] = {"runs": int, "probability_overturned": float, "probability_low": float, "probability_high": float}

BATCH_MODELS = {
    model.name: model
    for model in (
        BatchModel(
            "respond",
            (Block, TwoLayerBlock, ScannedBody),
            (*_BLOCK, "mu", "mu_kinetic", "surface", "restitution", "rocking_restitution", "tenon"),
            _standing,
            solve_respond,
            RespondOutcome,
            "overturned",
            _chance_of_standing,
            {**_CHANCES, "probability_moved": float},
        ),
        BatchModel(
            "rock", (Block,), (*_BLOCK, "restitution"), _rocking, solve_rock, RockOutcome, "overturned", _chance_of_rocking, _CHANCES
        ),
        BatchModel(
            "slide",
            (SlidingBase, float, int),
            ("mu", "mu_kinetic", "surface", "kappa", "slope_deg", "slope_length"),
            _sliding,
            solve_slide,
            SlideOutcome,
            "slips",
        ),
        BatchModel("jump", (TwoLayerBlock,), ("side", "mu", "mu_kinetic", "drop"), _jumping, solve_jump, JumpOutcome, "outcome"),
        BatchModel(
            "uplift",
            (SpringBlock,),
            ("width", "depth", "height", "mass", "frequency_vertical", "beta", "damping", "side"),
            _on_springs,
            solve_uplift,
            UpliftOutcome,
            "uplifts",
        ),
        BatchModel("stack", (Pile,), ("mu",), _stacked, solve_stack, StackOutcome, "overturned_any"),
    )
}
"""By the names of the commands."""


def batch_model(name: str) -> BatchModel:
    """Return the solver of a batch by its name.

    Raises
    ------
    ParameterError
        If there is none of that name.
    """
    if name not in BATCH_MODELS:
        raise ParameterError("there is no solver {name!r} for a batch; there are {known}", name=str(name)[:100], known=list(BATCH_MODELS))
    return BATCH_MODELS[name]

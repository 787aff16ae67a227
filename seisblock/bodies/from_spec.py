"""Bodies and friction from the rows of a table, for the solvers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from seisblock.bodies.block import Block
from seisblock.bodies.edge_wear import EdgeWear
from seisblock.bodies.factory import body_from_table, table_friction
from seisblock.bodies.friction import surface
from seisblock.bodies.kinds import of_kind
from seisblock.bodies.scan.body import ScannedBody
from seisblock.bodies.table import BodySpec
from seisblock.core.errors import BodyError

BLOCK_COLUMNS = (
    "width", "height", "depth", "mass", "density", "centroid_height", "centroid_offset", "centroid_inertia", "inset", "side", "kind",
)  # fmt: skip
"""Columns that describe one block."""

SIZE_COLUMNS = BLOCK_COLUMNS[:-3]


def rigid_body_from_spec(spec: BodySpec) -> Block | ScannedBody:
    """Return the block, or the scan, of a row: from its sizes or its file."""
    values = spec.parameters
    sizes = {key: values[key] for key in SIZE_COLUMNS if key in values}
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
    if isinstance(inset, EdgeWear):
        body = body.with_wear(inset)
    if isinstance(body, Block) and ("mu" in values or "surface" in values):
        return body.with_friction_range(values["mu_range"]) if "mu_range" in values else body.without_ranges("mu")
    return body


def friction_from_spec(spec: BodySpec, options: Mapping[str, Any]) -> dict[str, float | None]:
    """Return static and kinetic friction: from the row, its surface, its file, or the common options, in this order."""
    values = spec.parameters
    if "mu" in values or "surface" in values:
        if "mu" in values and "surface" in values:
            raise BodyError("{source}: `mu` and `surface` exclude each other: give only one of them", source=spec.source)
        contact_surface = surface(values["surface"]) if "surface" in values else None
        mu, kinetic = (values["mu"], None) if contact_surface is None else (contact_surface.mu, contact_surface.mu_kinetic)
    else:
        mu, kinetic = (None, None) if spec.description is None else table_friction(spec.description, spec.source)
        if mu is None:
            mu, kinetic = options.get("mu"), options.get("mu_kinetic")
    if mu is None:
        raise BodyError("{source}: friction required: give `mu` (static coefficient)", source=spec.source)
    return {"mu": mu, "mu_kinetic": values.get("mu_kinetic", kinetic)}


def without_friction(options: Mapping[str, Any]) -> dict[str, Any]:
    """Return the options without friction, which belongs to the body or its contact."""
    return {key: value for key, value in options.items() if key not in ("mu", "mu_kinetic")}


def spec_values(spec: BodySpec, *names: str) -> dict[str, Any]:
    """Return the named values of a row that are given."""
    return {name: spec.parameters[name] for name in names if name in spec.parameters}

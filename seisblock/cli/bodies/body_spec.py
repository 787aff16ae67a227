"""Body options converted to a :class:`~seisblock.bodies.table.BodySpec`, as in a table of bodies."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from seisblock.bodies.table import BodySpec
from seisblock.cli.bodies.block import check_side, read_named_block, require_sizes
from seisblock.core.i18n import lazy_gettext

SIZES = ("width", "height", "depth", "mass", "centroid_height", "centroid_offset", "centroid_inertia", "inset", "kind")
"""Options that describe a body by its sizes."""

OWN_OPTIONS = ("mu", "mu_kinetic", "surface", "restitution", "rocking_restitution", "tenon")
"""Body options that only some solvers have; they override the values of the body's file."""


def make_body_spec(params: Mapping[str, Any], solver: str) -> BodySpec:
    """Return the specification of one body given by sizes or by name.

    Parameters
    ----------
    params : mapping
        ``block`` and ``side``, or sizes, SI, and further parameters of the body; None where not given.
    solver : str
        ``slide`` requires neither.

    Raises
    ------
    BodyError
        If both sizes and a named body are given, or a required value is missing.

    Examples
    --------
    >>> make_body_spec({"width": 0.3, "height": 1.2}, "rock").name
    'block 0.3 x 1.2 m'
    """
    from seisblock.core.registry import get_solver

    names = (*SIZES, *(name for name in OWN_OPTIONS if name in get_solver(solver).columns))
    values = {key: params[key] for key in names if params.get(key) is not None}
    if params.get("block"):
        table = read_named_block(params, [key for key in values if key not in ("inset", "kind") and key in SIZES])
        side = {} if params.get("side") is None else {"side": params["side"]}
        return BodySpec(Path(params["block"]).stem, {**values, **side}, table, params["block"])
    if solver == "slide":
        check_side(params, None)
        return BodySpec(lazy_gettext("object"), values, None, lazy_gettext("the object"))
    require_sizes(params, values)
    name = lazy_gettext("block {width:g} x {height:g} m", width=values["width"], height=values["height"])
    return BodySpec(name, values, None, lazy_gettext("the block"))

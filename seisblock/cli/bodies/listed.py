"""The one body that options describe, as a list of bodies would hold it: what each solver of a batch takes of it is its own affair."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from seisblock.bodies.roster import ListedBody
from seisblock.bodies.toml import read_table
from seisblock.cli.bodies.block import refuse_kind, refuse_side
from seisblock.errors import ParameterError
from seisblock.words import said

SIZES = ("width", "height", "depth", "mass", "centroid_height", "centroid_offset", "centroid_inertia", "inset", "kind")
"""Options that describe a body which has no name."""

OWN = ("mu", "mu_kinetic", "surface", "restitution", "rocking_restitution", "tenon")
"""Options of a body that one solver has and another has not; what is asked for goes before what the body's file says."""


def listed_body(asked: Mapping[str, Any], solver: str) -> ListedBody:
    """Return the one body that sizes or a name describe.

    Parameters
    ----------
    asked : mapping
        ``block`` and ``side``, or sizes, SI, and what else is to hold of that body; None where not given.
    solver : str
        ``slide`` needs neither.

    Raises
    ------
    ParameterError
        If sizes and a named body are mixed, or something needed is missing.

    Examples
    --------
    >>> listed_body({"width": 0.3, "height": 1.2}, "rock").name
    'block 0.3 x 1.2 m'
    """
    from seisblock.studies.batch.models import batch_model

    taken = (*SIZES, *(name for name in OWN if name in batch_model(solver).columns))
    told = {key: asked[key] for key in taken if asked.get(key) is not None}
    if asked.get("block"):
        sizes = [key for key in told if key not in ("inset", "kind") and key in SIZES]
        if sizes:
            raise ParameterError("give either --block or sizes ({sizes}), not both", sizes=["--" + key.replace("_", "-") for key in sizes])
        refuse_kind(asked)
        side = {} if asked.get("side") is None else {"side": asked["side"]}
        table = read_table(asked["block"])
        refuse_side(asked, table.get("kind"))
        return ListedBody(Path(asked["block"]).stem, {**told, **side}, table, asked["block"])
    refuse_side(asked, None)
    if solver == "slide":
        return ListedBody(said("object"), told, None, said("the object"))
    missing = [f"--{key}" for key in ("width", "height") if key not in told]
    if missing:
        raise ParameterError(
            "which body? {missing} missing: give --width and --height, or --block NAME|FILE (say gravestone)", missing=missing
        )
    name = said("block {width:g} x {height:g} m", width=told["width"], height=told["height"])
    return ListedBody(name, told, None, said("the block"))

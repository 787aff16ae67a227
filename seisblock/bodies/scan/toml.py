"""A scanned body as TOML: what ``kind = "scan"`` holds, read and written."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from seisblock import checks
from seisblock.bodies.inset import SHARP, parse_inset
from seisblock.bodies.scan.body import EAST, ScannedBody
from seisblock.bodies.scan.scan import Scanned
from seisblock.bodies.toml import length, mass, number, of_kind, read_table, refuse_unknown, shown, source_of, subtable, text
from seisblock.errors import BodyError
from seisblock.limits import check_budget
from seisblock.words import noted

KEYS = ("name", "mass", "height", "centre", "inertia", "base", "inset", "facing", "scan")
OPTIONAL = ("mu", "mu_kinetic", "restitution")
"""What may be said beside, as of a block."""


def scanned_body(table: Mapping[str, Any]) -> ScannedBody:
    """Return the body that a TOML table describes; see :func:`load_scan`.

    Examples
    --------
    >>> from seisblock.bodies.toml import read_table
    >>> scanned_body(read_table("boulder")).name
    'boulder'
    """
    of_kind(table, "scan")
    refuse_unknown(table, {"kind", *KEYS, *OPTIONAL})
    subtable(table, "scan")
    where = source_of(table)
    facing = number(table, "facing")
    inset = table.get("inset", 0.0)
    base = _rows(table, "base", 2)
    check_budget(noted("corners of the base"), len(base), "SEISBLOCK_CORNERS", where=where, error=BodyError)
    return ScannedBody(
        text(table, "name", where),
        mass(table, "mass"),
        length(table, "height"),
        _row(table.get("centre"), table, "centre", 3),  # type: ignore[arg-type]
        _rows(table, "inertia", 3),  # type: ignore[arg-type]
        base,  # type: ignore[arg-type]
        parse_inset(inset if isinstance(inset, str) else checks.finite("{source}: inset", inset, error=BodyError, source=where))
        if inset
        else SHARP,
        EAST if facing is None else facing,
    )


def load_scan(name: str | Path) -> ScannedBody:
    """Return the scanned body of a TOML file, or a bundled one, as ``seisblock body`` writes it.

    Parameters
    ----------
    name : str or Path
        ``kind = "scan"`` with ``mass``, ``height``, ``centre``, ``inertia`` and ``base`` in kg and m, ``inset`` and ``facing``.

    Raises
    ------
    BodyError
        If there is no such body, something is missing or wrong, or it is of another kind.

    Examples
    --------
    >>> body = load_scan("boulder")
    >>> round(body.towards(90.0).slenderness, 2), round(body.worn(0.1).towards(90.0).slenderness, 2)
    (0.26, 0.22)
    """
    return scanned_body(read_table(name))


def told(found: Scanned) -> str:
    """Return the TOML of a scan; every number keeps all of its digits.

    Examples
    --------
    >>> from seisblock.bodies.scan.scan import scan_body
    >>> told(scan_body("boulder.ply")).splitlines()[1]
    'kind = "scan"'
    """
    body = found.body
    lines = [
        "# Written by seisblock body: m, kg, degrees clockwise from north; x, y of the scan, z above the ground.",
        'kind = "scan"',
        f"name = {_quoted(body.name)}",
        f"mass = {body.mass!r}",
        f"height = {body.height!r}",
        f"centre = {list(body.centre)!r}",
        f"inertia = {_nested(body.inertia)}",
        f"facing = {body.facing!r}  # azimuth of +x",
        f'inset = "{body.inset_m!r} m"',
        f"base = {_nested(body.base)}",
        "",
        "[scan]",
        f"source = {_quoted(Path(found.source).name)}",
        f"sha256 = {_quoted(found.sha256)}",
        f"unit = {_quoted(found.unit)}",
        f"up = {_quoted(found.up)}",
        f"volume = {found.volume!r}",
        f"density = {found.density!r}",
        f"tolerance = {found.tolerance!r}",
        f"tilt_deg = {math.degrees(found.tilt)!r}",
        f"triangles = {found.triangles}",
    ]
    return "\n".join(lines) + "\n"


def _quoted(words: str) -> str:
    """Return a text as TOML has it: as JSON does, whose escapes are among TOML's."""
    return json.dumps(words, ensure_ascii=False).replace("\x7f", "\\u007f")


def _nested(rows: Iterable[Iterable[float]]) -> str:
    """Return rows of numbers, one on each line."""
    return "[\n" + "".join(f"    {list(row)!r},\n" for row in rows) + "]"


def _rows(table: Mapping[str, Any], key: str, count: int) -> tuple[tuple[float, ...], ...]:
    """Return a required list of rows of numbers."""
    value = table.get(key)
    if not isinstance(value, list):
        raise BodyError(
            "{source}: {key} must be a list of rows of {count} numbers, found {found}",
            source=source_of(table),
            key=key,
            count=count,
            found=shown(value),
        )
    return tuple(_row(row, table, key, count) for row in value)


def _row(value: Any, table: Mapping[str, Any], key: str, count: int) -> tuple[float, ...]:
    """Return so many numbers."""
    if not isinstance(value, list) or len(value) != count:
        raise BodyError(
            "{source}: expected {count} numbers in {key}, found {found}", source=source_of(table), key=key, count=count, found=shown(value)
        )
    return tuple(checks.finite("{source}: {key}", each, "m", error=BodyError, source=source_of(table), key=key) for each in value)

"""TOML files of scanned bodies (``kind = "scan"``), read and written."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from seisblock.bodies.edge_wear import SHARP_EDGES, parse_edge_wear
from seisblock.bodies.scan.body import EAST, ScannedBody
from seisblock.bodies.scan.scan import Scan
from seisblock.bodies.toml import (
    check_keys,
    check_kind,
    get_length,
    get_mass,
    get_number,
    get_subtable,
    get_text,
    quote_value,
    read_body_toml,
    source_name,
)
from seisblock.core import checks
from seisblock.core.errors import BodyError
from seisblock.core.i18n import N_
from seisblock.core.limits import MAX_BASE_CORNERS, check_limit

KEYS = ("name", "mass", "height", "centre", "inertia", "base", "inset", "facing", "hull", "scan")
OPTIONAL_KEYS = ("mu", "mu_kinetic", "restitution")
"""Optional keys, as of a block."""


def scan_from_table(table: Mapping[str, Any]) -> ScannedBody:
    """Return the body described by a TOML table, see :func:`load_scan`.

    Examples
    --------
    >>> from seisblock.bodies.toml import read_body_toml
    >>> scan_from_table(read_body_toml("boulder")).name
    'boulder'
    """
    check_kind(table, "scan")
    check_keys(table, {"kind", *KEYS, *OPTIONAL_KEYS})
    get_subtable(table, "scan")
    source = source_name(table)
    facing = get_number(table, "facing")
    inset = table.get("inset", 0.0)
    base = _parse_rows(table, "base", 2)
    check_limit(N_("corners of the base"), len(base), MAX_BASE_CORNERS, source=source, error=BodyError)
    hull = _parse_rows(table, "hull", 3) if "hull" in table else ()
    check_limit(N_("vertices of the hull"), len(hull), MAX_BASE_CORNERS, source=source, error=BodyError)
    return ScannedBody(
        get_text(table, "name", source),
        get_mass(table, "mass"),
        get_length(table, "height"),
        _parse_row(table.get("centre"), table, "centre", 3),  # type: ignore[arg-type]
        _parse_rows(table, "inertia", 3),  # type: ignore[arg-type]
        base,  # type: ignore[arg-type]
        parse_edge_wear(inset if isinstance(inset, str) else checks.finite("{source}: inset", inset, error=BodyError, source=source))
        if inset
        else SHARP_EDGES,
        EAST if facing is None else facing,
        hull,  # type: ignore[arg-type]
    )


def load_scan(name: str | Path) -> ScannedBody:
    """Return the scanned body of a TOML file or a bundled one, as written by ``seisblock body``.

    Parameters
    ----------
    name : str or Path
        ``kind = "scan"`` with ``mass``, ``height``, ``centre``, ``inertia`` and ``base`` in kg and m, ``inset``, ``facing`` and, for
        three dimensions, ``hull``.

    Returns
    -------
    ScannedBody

    Raises
    ------
    BodyError
        If there is no such body, an entry is missing or invalid, or the kind is another.

    Examples
    --------
    >>> body = load_scan("boulder")
    >>> round(body.block_toward(90.0).slenderness, 2), round(body.with_wear(0.1).block_toward(90.0).slenderness, 2)
    (0.26, 0.22)
    """
    return scan_from_table(read_body_toml(name))


def scan_to_toml(scan: Scan) -> str:
    """Return the TOML text of a scan, with all digits.

    Examples
    --------
    >>> from seisblock.bodies.scan.scan import scan_body
    >>> scan_to_toml(scan_body("boulder.ply")).splitlines()[1]
    'kind = "scan"'
    """
    body = scan.body
    lines = [
        "# Written by seisblock body: m, kg, degrees clockwise from north; x, y of the scan, z above the ground.",
        'kind = "scan"',
        f"name = {_toml_string(body.name)}",
        f"mass = {body.mass!r}",
        f"height = {body.height!r}",
        f"centre = {list(body.centre)!r}",
        f"inertia = {_toml_rows(body.inertia)}",
        f"facing = {body.facing!r}  # azimuth of +x",
        f'inset = "{body.inset_m!r} m"',
        f"base = {_toml_rows(body.base)}",
        f"hull = {_toml_rows(body.hull)}",
        "",
        "[scan]",
        f"source = {_toml_string(Path(scan.source).name)}",
        f"sha256 = {_toml_string(scan.sha256)}",
        f"unit = {_toml_string(scan.unit)}",
        f"up = {_toml_string(scan.up)}",
        f"volume = {scan.volume!r}",
        f"density = {scan.density!r}",
        f"tolerance = {scan.tolerance!r}",
        f"tilt_deg = {math.degrees(scan.tilt)!r}",
        f"triangles = {scan.triangles}",
    ]
    return "\n".join(lines) + "\n"


def _toml_string(string: str) -> str:
    """Return a text as a TOML string (JSON escapes are valid TOML)."""
    return json.dumps(string, ensure_ascii=False).replace("\x7f", "\\u007f")


def _toml_rows(rows: Iterable[Iterable[float]]) -> str:
    """Return rows of numbers as TOML, one per line."""
    return "[\n" + "".join(f"    {list(row)!r},\n" for row in rows) + "]"


def _parse_rows(table: Mapping[str, Any], key: str, count: int) -> tuple[tuple[float, ...], ...]:
    value = table.get(key)
    if not isinstance(value, list):
        raise BodyError(
            "{source}: {key} must be a list of rows of {count} numbers, found {found}",
            source=source_name(table),
            key=key,
            count=count,
            found=quote_value(value),
        )
    return tuple(_parse_row(row, table, key, count) for row in value)


def _parse_row(value: Any, table: Mapping[str, Any], key: str, count: int) -> tuple[float, ...]:
    if not isinstance(value, list) or len(value) != count:
        raise BodyError(
            "{source}: {key} must have {count} numbers, found {found}",
            source=source_name(table),
            key=key,
            count=count,
            found=quote_value(value),
        )
    return tuple(checks.finite("{source}: {key}", entry, "m", error=BodyError, source=source_name(table), key=key) for entry in value)

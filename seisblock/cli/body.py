"""``seisblock body``: the body of a scan, and how easily it turns in each direction."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from seisblock.bodies.edge_wear import SHARP_EDGES, EdgeWear
from seisblock.cli import shell_completion
from seisblock.cli.command import Command, argument, option
from seisblock.cli.console import info
from seisblock.cli.options import check_callback, gravity_option, output_options
from seisblock.cli.output import Output
from seisblock.cli.progress import progress
from seisblock.cli.types import INSET, LENGTH
from seisblock.cli.write_results import write_results
from seisblock.core import checks
from seisblock.core.errors import OutputError
from seisblock.core.units import LENGTH_UNITS

_positive, _finite = check_callback(checks.positive), check_callback(checks.finite)

UPWARD = ("x", "y", "z", "-x", "-y", "-z")


@click.command(
    cls=Command,
    examples=(
        "seisblock body boulder.ply --inset 10mm --out rock.toml --plot rock.png",
        "seisblock rock --block rock.toml --component EW",
    ),
)
@argument(
    "scan",
    metavar="SCAN",
    section="Body",
    shell_complete=shell_completion.complete_scans,
    help="A closed surface of triangles: an .stl, .ply or .obj file, or the bundled boulder.ply.",
)
@option(
    "--density",
    type=float,
    default=2650.0,
    show_default=True,
    callback=_positive,
    section="Body",
    metavar="KG/M3",
    help="Density, kg/m^3; the motion does not depend on it.",
)
@option(
    "--inset",
    type=INSET,
    metavar="SHARE|M",
    section="Body",
    help="How far in from each side of the base its worn edges lie: a share of the base's least width (0.1, 10%), or m with a unit (1cm). "
    "[default: 0]",
)
@option(
    "--tolerance",
    type=LENGTH,
    section="Body",
    help="How far above the ground a point may lie that carries, m or with a unit. [default: 0.002 of the largest extent]",
)
@option("--unit", type=click.Choice(list(LENGTH_UNITS)), default="m", show_default=True, section="Body", help="Unit of the file's numbers.")
@option(
    "--up",
    type=click.Choice(UPWARD),
    default="z",
    show_default=True,
    section="Body",
    help="The file's axis that points upwards; its x stays x, or y stays y where that is x.",
)
@option(
    "--facing",
    type=float,
    default=90.0,
    show_default=True,
    callback=_finite,
    metavar="DEG",
    section="Body",
    help="Azimuth of the body's +x, degrees clockwise from north; by default x is east, y north.",
)
@option("--name", section="Body", metavar="TEXT", help="What the body is called. [default: as the file]")
@option("--step", type=float, default=10.0, show_default=True, callback=_positive, help="Between azimuths, degrees.")
@gravity_option
@option(
    "--out", type=click.Path(path_type=Path), section="Output", metavar="FILE", help="Write the body: .toml, for --block of other commands."
)
@output_options(histories=False, film=False)
def body(
    output: Output,
    scan: str,
    density: float,
    inset: EdgeWear | None,
    tolerance: float | None,
    unit: str,
    up: str,
    facing: float,
    name: str | None,
    step: float,
    gravity: float,
    out: Path | None,
) -> None:
    """The body of a scan: mass, centre of gravity, inertia, the base that carries it, and alpha and p towards every azimuth.

    The surface must be closed. The body is laid on level ground as it rests nearest to the position of the scan; what carries is the
    convex hull of the points within --tolerance of the ground, and --inset moves each of its sides inwards. The file of --out is a body
    for rock, respond, criteria, batch and fit, which take its arms for the azimuth that they solve.
    """
    from seisblock.bodies.scan.azimuths import scan_azimuths
    from seisblock.bodies.scan.scan import scan_body
    from seisblock.bodies.scan.toml import scan_to_toml
    from seisblock.report.io.atomic import check_target, write_text
    from seisblock.report.json.body import document
    from seisblock.report.text import body as shown

    if out is not None:
        if out.suffix.lower() != ".toml":
            raise OutputError("{path}: a body is written as .toml", path=out)
        check_target(out)
    with progress("reading {names}", names=[Path(scan).name]):
        edge_wear = SHARP_EDGES if inset is None else inset
        scan_result = scan_body(
            scan, density=density, inset=edge_wear, tolerance=tolerance, unit=unit, up=up, facing=facing, body_name=name
        )
    directions = scan_azimuths(scan_result.body, step_deg=step, gravity=gravity)
    if out is not None:
        write_text(out, scan_to_toml(scan_result))
        info("wrote {path}", path=out)
    write_results(
        document(scan_result, directions, step_deg=step, gravity=gravity),
        output,
        tables=lambda: shown.tables(scan_result, directions, gal=output.gal),
        csv=lambda path: shown.write_csv(path, directions),
        figure=lambda: _draw(scan_result),
    )


def _draw(scan_result: Any) -> Any:
    """Return the figure of a scanned body; matplotlib is loaded only for it."""
    from seisblock.report.figures.body import figure

    return figure(scan_result)

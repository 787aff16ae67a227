"""``seisblock body``: rigid-body properties of a 3-D scan, or the file of a body of a kind."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from seisblock.bodies.edge_wear import SHARP_EDGES, EdgeWear
from seisblock.bodies.kinds import KINDS, kind_to_toml
from seisblock.cli import shell_completion
from seisblock.cli.bodies.options import inset_option
from seisblock.cli.build import gravity_option
from seisblock.cli.command import Command, argument, option
from seisblock.cli.console import info, print_result
from seisblock.cli.option_checks import reject_with, reject_without
from seisblock.cli.options import check_callback, output_options
from seisblock.cli.output import OutputOptions
from seisblock.cli.progress import progress
from seisblock.cli.suggest import SuggestingChoice
from seisblock.cli.types import ANGLE, LENGTH, OutputFile
from seisblock.cli.write_results import figure_of, write_results
from seisblock.core import checks
from seisblock.core.errors import OutputError
from seisblock.core.i18n import gettext
from seisblock.core.units import LENGTH_UNITS

_positive, _finite = check_callback(checks.positive), check_callback(checks.finite)

UPWARD = ("x", "y", "z", "-x", "-y", "-z")


@click.command(
    cls=Command,
    examples=(
        "seisblock body boulder.ply --inset 10mm --out rock.toml --plot rock.png",
        "seisblock rock --block rock.toml --component EW",
        "seisblock body --kind gravestone --width 8sun --height 72cm --out stone.toml",
    ),
)
@argument(
    "scan",
    required=False,
    metavar="[SCAN]",
    section="Body",
    shell_complete=shell_completion.complete_bundled("scan"),
    help="Closed triangle mesh: .stl, .ply or .obj file, or the bundled boulder.ply.",
)
@option(
    "--kind",
    type=SuggestingChoice(KINDS),
    section="Body",
    help="Without a scan: print the file of a body of this kind with the prior of its edges; edit it to replace the prior.",
)
@option("--width", type=LENGTH, section="Body", help="--kind: width of the base along the motion, m or with a unit.")
@option("--height", type=LENGTH, section="Body", help="--kind: height, m or with a unit.")
@option(
    "--density",
    type=float,
    default=2650.0,
    show_default=True,
    callback=_positive,
    section="Body",
    metavar="KG/M3",
    help="Density, kg/m^3; without effect on the motion.",
)
@inset_option(
    "Inset of worn edges from each side of the base: share of the smallest width (0.1, 10%), or m with a unit (1cm). [default: 0]"
)
@option(
    "--tolerance",
    type=LENGTH,
    section="Body",
    help="Height above the ground up to which points carry load, m or with a unit. [default: 0.002 of the largest extent]",
)
@option(
    "--unit",
    type=click.Choice(list(LENGTH_UNITS)),
    default="m",
    show_default=True,
    section="Body",
    help="Unit of the coordinates in the file.",
)
@option(
    "--up",
    type=click.Choice(UPWARD),
    default="z",
    show_default=True,
    section="Body",
    help="Axis of the file that points upwards; x stays x (y stays y where x points upwards).",
)
@option(
    "--facing",
    type=ANGLE,
    default=90.0,
    show_default=True,
    callback=_finite,
    metavar="DEG",
    section="Body",
    help="Azimuth of the body's +x, degrees clockwise from north.",
)
@option("--name", "body_name", section="Body", metavar="TEXT", help="Name of the body. [default: file name]")
@option("--step", type=ANGLE, default=10.0, show_default=True, callback=_positive, help="Azimuth step, degrees.")
@gravity_option
@option(
    "--out",
    type=OutputFile(),
    section="Output",
    metavar="FILE",
    help="Write the body (.toml) for the --block of other commands.",
)
@output_options(histories=False, film=False)
def body(
    output: OutputOptions,
    scan: str | None,
    kind: str | None,
    width: float | None,
    height: float | None,
    inset: EdgeWear | None,
    step: float,
    gravity: float,
    out: Path | None,
    **params: Any,
) -> None:
    """Rigid-body properties of a 3-D scan: mass, centre of gravity, inertia, support polygon, and alpha and p for every azimuth.

    The surface must be closed. The body is placed on level ground in the stable pose nearest to the position of the scan. Its support
    polygon is the convex hull of the points within --tolerance of the ground; --inset moves each side of the polygon inwards. The
    file of --out serves rock, respond, criteria, batch and fit as a body, with the arms of the azimuth under analysis.

    Without a scan, --kind, --width and --height give the file of a body of a kind.
    """
    _check_subject(scan, kind, width, height)
    from seisblock.bodies.scan.azimuths import scan_azimuths
    from seisblock.bodies.scan.scan import scan_body
    from seisblock.bodies.scan.toml import scan_to_toml
    from seisblock.output.io.atomic import write_text
    from seisblock.report.json.body import document
    from seisblock.report.text import body as text_output

    if out is not None and out.suffix.lower() != ".toml":
        raise OutputError("{path}: a body file must end in .toml", path=out)
    if kind is not None and width is not None and height is not None:
        text = kind_to_toml(kind, width, height)
        if out is None:
            print_result(text.rstrip())
        else:
            write_text(out, text)
            info("wrote {path}", path=out)
        return
    assert scan is not None
    with progress("reading {names}", names=[Path(scan).name]):
        scan_result = scan_body(scan, inset=SHARP_EDGES if inset is None else inset, **params)
    directions = scan_azimuths(scan_result.body, step_deg=step, gravity=gravity)
    if out is not None:
        write_text(out, scan_to_toml(scan_result))
        info("wrote {path}", path=out)
    write_results(
        document(scan_result, directions, step_deg=step, gravity=gravity),
        output,
        tables=lambda: text_output.tables(scan_result, directions, gal=output.gal),
        csv=lambda: text_output.csv_columns(directions),
        figure=figure_of("body:figure", scan_result),
    )


def _check_subject(scan: str | None, kind: str | None, width: float | None, height: float | None) -> None:
    """Raise an error unless there is either a scan, or a kind with its sizes."""
    if kind is None:
        reject_without("--kind", ["width", "height"])
        if scan is None:
            raise click.UsageError(gettext("give SCAN, or --kind with --width and --height"))
    elif scan is not None:
        raise click.UsageError(gettext("SCAN and --kind exclude each other: give only one of them"))
    elif width is None or height is None:
        raise click.UsageError(gettext("--kind requires --width and --height"))
    else:
        kept = {"scan", "kind", "width", "height", "out", "quiet", "lang"}
        reject_with("--kind", [name for parameter in body.params if (name := parameter.name or "") not in kept])

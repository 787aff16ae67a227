"""``seisblock fragility``: how likely an object falls, slides or rocks, against the intensity of the shaking."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from seisblock.cli import shell_completion
from seisblock.cli.bodies.options import block_options
from seisblock.cli.command import Command, option
from seisblock.cli.options import Source, gravity_option, output_options, suite_record_options
from seisblock.cli.output import Output
from seisblock.cli.types import FLOATS, MU, Count
from seisblock.core.i18n import N_

SOLVERS = ("respond", "rock", "slide", "stack")
METHODS = ("stripes", "ida", "cloud")


@click.command(
    cls=Command,
    examples=(
        "seisblock fragility synthetic_jma.csv elcentro_1940_ns.csv --width 30cm --height 1.2m --solver rock --im pgv",
        "seisblock fragility synthetic_jma.csv elcentro_1940_ns.csv --bodies gravestone --solver rock --im pga,pgv --plot fragility.png",
        "seisblock fragility --suite synthetic:M6.5:R15:20 --suite-out records --block gravestone --solver rock --im pgv",
    ),
)
@suite_record_options
@option(
    "--suite",
    metavar="synthetic:M7:R20:40",
    section="Record",
    help="Instead of RECORD: synthetic records, here 40 of magnitude 7 at 20 km, on rock. [default: these, where no RECORD is given]",
)
@option(
    "--suite-out",
    type=click.Path(path_type=Path, file_okay=False),
    metavar="FOLDER",
    section="Output",
    help="Write the synthetic records to this folder, as --suite-format says.",
)
@option(
    "--suite-format",
    type=click.Choice(["csv", "knet"]),
    default="csv",
    show_default=True,
    section="Output",
    help="CSV in m/s^2 with all their digits, or three files each in the layout of K-NET ASCII (counts of 1e-4 gal).",
)
@block_options
@option(
    "--bodies",
    multiple=True,
    metavar="FILE|NAME",
    shell_complete=shell_completion.complete_bodies(),
    section="Body",
    help="Instead of one body: a table of bodies (.csv: name, width, height in m, mu, ...), a file that describes one, or a bundled body; "
    "may be repeated.",
)
@option(
    "--mu",
    type=MU,
    section="Body",
    metavar="MU",
    help="Static friction coefficient of the body, or of those of --bodies that tell none, 1.",
)
@option("--restitution", type=float, section="Body", metavar="E", help="Restitution, a ratio of velocities, 1. [default: the solver's own]")
@option("--solver", type=click.Choice(SOLVERS), default="respond", show_default=True, help="Which model follows the bodies.")
@option(
    "--limit",
    multiple=True,
    metavar="overturn|rock|slip=5cm|lean=0.5",
    help="What counts: it overturns, leaves its rest, is moved so far (m or with a unit) or falls, leans by a share of its slenderness "
    "(1); may be repeated: then the states share one beta. [default: overturn; slide: slip=1cm]",
)
@option(
    "--im",
    multiple=True,
    metavar="pga|pgv|pgd|sa=T|arias|p*pgv",
    help="Measure of intensity, of the component solved (T in s; p*pgv: p PGV/g); further ones, repeated or after commas, are compared "
    "with the first. [default: pga]",
)
@option("--method", type=click.Choice(METHODS), default="stripes", show_default=True, help="How the curve is found.")
@option(
    "--levels",
    type=FLOATS,
    metavar="X[,X...]|X0:X1:STEP",
    help="Intensities to scale to: gal (pga, sa), kine (pgv), cm (pgd), m/s (arias), 1 (p*pgv). [default: chosen by looking]",
)
@option(
    "--steps",
    type=Count(N_("levels"), "SEISBLOCK_VALUES", minimum=2),
    default=60,
    show_default=True,
    help="How many levels are chosen, evenly in their logarithm.",
)
@option(
    "--perturb",
    type=Count(N_("versions"), "SEISBLOCK_RUNS", minimum=2),
    metavar="N",
    help="N versions of each body (size, edges, restitution, friction): how much of the scatter is its own. [default: as it is alone]",
)
@option("--vertical/--no-vertical", default=None, help="Whether the vertical component acts. [default: as with the solver's own command]")
@option("--confidence", type=float, default=0.95, show_default=True, help="Level of the intervals, 0 to 1.")
@option(
    "--bootstrap",
    type=Count(N_("samples of the records"), "SEISBLOCK_RUNS", minimum=2),
    default=1000,
    show_default=True,
    help="Samples of the records behind the intervals.",
)
@option("--seed", type=int, default=0, show_default=True, help="Seed of versions, samples and synthetic records.")
@option(
    "--compare",
    metavar="MEDIAN,BETA",
    help="A curve to compare with: its median, in the unit of --levels, and beta, 1.",
)
@option(
    "--pelicun",
    type=click.Path(path_type=Path),
    section="Output",
    metavar="FILE.csv",
    help="Write rows for pelicun (fragility.csv of its DLML), and FILE.json beside them that says what they are.",
)
@option(
    "--nrml",
    type=click.Path(path_type=Path),
    section="Output",
    metavar="FILE.xml",
    help="Write a fragility model for OpenQuake, NRML 0.5.",
)
@option(
    "--nrml-shape",
    type=click.Choice(["logncdf", "discrete"]),
    default="logncdf",
    show_default=True,
    section="Output",
    help="--nrml: the lognormal curve, or the shares at the levels, made to rise.",
)
@gravity_option
@output_options(histories=False, film=False)
def fragility(
    source: Source,
    output: Output,
    bodies: tuple[str, ...],
    solver: str,
    limit: tuple[str, ...],
    im: tuple[str, ...],
    levels: tuple[float, ...] | None,
    compare: str | None,
    **params: Any,
) -> None:
    """Tell how likely an object falls, slides or rocks, against the intensity of the shaking: a lognormal curve with its intervals.

    RECORD may be a folder, a pattern, a list (@records.txt) or a bundle: a suite of ten and more. Each component of each record is scaled
    to every level (stripes, ida), or taken as it is (cloud); vertical motion is scaled along. With --component all-azimuths each record
    counts once, in the direction that is worst for the object, and its intensity is the largest of all directions.
    """
    from seisblock.cli.run_fragility import run_study

    measures = tuple(name for text in im or ("pga",) for name in text.split(","))
    states = tuple(name for text in limit for name in text.split(",")) or ("slip=1cm" if solver == "slide" else "overturn",)
    run_study(source, output, bodies=bodies, solver=solver, limits=states, measures=measures, levels=levels, compare=compare, params=params)

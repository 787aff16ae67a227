"""``seisblock fragility``: fragility curves of overturning, sliding or rocking."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from seisblock.cli.bodies.options import block_options, bodies_option
from seisblock.cli.build import gravity_option
from seisblock.cli.command import Command, option
from seisblock.cli.options import Source, output_options, suite_record_options
from seisblock.cli.output import OutputOptions
from seisblock.cli.suggest import SuggestingChoice
from seisblock.cli.types import FLOATS, MU, Count, OutputFile
from seisblock.core.i18n import N_
from seisblock.core.limits import MAX_RUNS, MAX_VALUES
from seisblock.core.registry import solver_names

METHODS = ("stripes", "ida", "cloud")


@click.command(
    cls=Command,
    essential=("--suite", "--bodies", "--width", "--height", "--block", "--mu", "--solver", "--limit", "--im", "--perturb"),
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
    help="Suite of synthetic records instead of RECORD, here 40 records of magnitude 7 at 20 km on rock. [default: these, without RECORD]",
)
@option(
    "--suite-out",
    type=click.Path(path_type=Path, file_okay=False),
    metavar="FOLDER",
    section="Output",
    help="Write the synthetic records to this folder, in the format of --suite-format.",
)
@option(
    "--suite-format",
    type=click.Choice(["csv", "knet"]),
    default="csv",
    show_default=True,
    section="Output",
    help="Format: csv, m/s^2 with all digits, or knet, three files per record in K-NET ASCII (counts of 1e-4 gal).",
)
@block_options
@bodies_option(
    "Bodies instead of one body: table (.csv: name, width, height in m, mu, ...), file that describes one body, or bundled body; "
    "may be repeated.",
    required=False,
)
@option(
    "--mu",
    type=MU,
    section="Body",
    metavar="MU",
    help="Static friction coefficient of the body, or of those of --bodies for which none is given.",
)
@option(
    "--restitution",
    type=float,
    section="Body",
    metavar="E",
    help="Coefficient of restitution, a ratio of velocities. [default: of the solver]",
)
@option("--solver", type=SuggestingChoice(solver_names()), default="respond", show_default=True, help="Model that computes the response.")
@option(
    "--limit",
    multiple=True,
    metavar="overturn|rock|slip=5cm|lean=0.5",
    help="Limit state: overturn, rock (leaves rest), slip=D (displacement of D, m or with a unit, or overturning) or lean=R (tilt of R "
    "times the slenderness). Repeated limits share one beta. [default: overturn; slide: slip=1cm]",
)
@option(
    "--im",
    multiple=True,
    metavar="pga|pgv|pgd|sa:T|rotd50:T|rotd100:T|arias|cav|p*pgv|jma",
    help="Intensity measure of the component under analysis (T in s; p*pgv: p PGV/g, a ratio), or of the whole record (jma: three "
    "components; rotd50:T, rotd100:T: both horizontals); further measures, repeated or separated by commas, are compared with the first. "
    "[default: pga]",
)
@option("--method", type=click.Choice(METHODS), default="stripes", show_default=True, help="Method of analysis.")
@option(
    "--levels",
    type=FLOATS,
    metavar="X[,X...]|X0:X1:STEP",
    help="Intensity levels: gal (pga, sa, rotd50, rotd100), kine (pgv), cm (pgd), m/s (arias, cav), a ratio (p*pgv), intensity (jma). "
    "[default: from a search]",
)
@option(
    "--steps",
    type=Count(N_("levels"), MAX_VALUES, minimum=2),
    default=60,
    show_default=True,
    help="Number of levels, evenly spaced in the logarithm.",
)
@option(
    "--perturb",
    type=Count(N_("samples"), MAX_RUNS, minimum=2),
    metavar="N",
    help="N samples of each body (size, edges, restitution, friction), which separate its share of the dispersion. [default: nominal "
    "body only]",
)
@option("--vertical/--no-vertical", default=None, help="Apply or omit the vertical component. [default: applied where the record has one]")
@option("--confidence", type=float, default=0.95, show_default=True, help="Confidence level of the intervals, 0 to 1.")
@option(
    "--bootstrap",
    type=Count(N_("bootstrap samples"), MAX_RUNS, minimum=2),
    default=1000,
    show_default=True,
    help="Bootstrap samples of the records for the intervals.",
)
@option("--seed", type=int, default=0, show_default=True, help="Seed of body samples, bootstrap and synthetic records.")
@option(
    "--compare",
    metavar="MEDIAN,BETA",
    help="Curve for comparison: median in the unit of --levels, and beta.",
)
@option(
    "--pelicun",
    type=OutputFile(),
    section="Output",
    metavar="FILE.csv",
    help="Write rows for pelicun (fragility.csv of its DLML), and FILE.json with their metadata.",
)
@option(
    "--nrml",
    type=OutputFile(),
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
    help="Content of --nrml: lognormal curve, or shares at the levels, made monotone.",
)
@gravity_option
@output_options(histories=False, film=False)
def fragility(
    source: Source,
    output: OutputOptions,
    bodies: tuple[str, ...],
    solver: str,
    limit: tuple[str, ...],
    im: tuple[str, ...],
    levels: tuple[float, ...] | None,
    compare: str | None,
    **params: Any,
) -> None:
    """Fragility curve: probability of overturning, sliding or rocking against intensity, lognormal, with confidence intervals.

    RECORD may be a folder, a pattern, a list (@records.txt) or an archive; ten or more records are advisable. stripes and ida scale
    each component of each record to every level; cloud takes the records as recorded; vertical motion is scaled by the same factor.
    With --component all-azimuths each record counts once, in its worst azimuth for the object; its intensity is the maximum over all
    azimuths.
    """
    from seisblock.cli.run_fragility import run_study

    measures = tuple(name for text in im or ("pga",) for name in text.split(","))
    states = tuple(name for text in limit for name in text.split(",")) or ("slip=1cm" if solver == "slide" else "overturn",)
    run_study(source, output, bodies=bodies, solver=solver, limits=states, measures=measures, levels=levels, compare=compare, params=params)

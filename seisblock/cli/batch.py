"""``seisblock batch``: one table of many records and many bodies."""

from __future__ import annotations

from typing import Any

import click

from seisblock.cli.bodies.options import bodies_option
from seisblock.cli.build import gravity_option
from seisblock.cli.command import Command, option
from seisblock.cli.options import Source, excel_option, record_options
from seisblock.cli.suggest import SuggestingChoice
from seisblock.cli.types import MU, Count, OutputFile
from seisblock.cli.verbosity import quiet_output
from seisblock.core.i18n import N_
from seisblock.core.limits import MAX_RUNS
from seisblock.core.registry import solver_names


@click.command(
    cls=Command,
    essential=("--bodies", "--solver", "--mu", "--runs", "--out", "--resume"),
    examples=(
        "seisblock batch synthetic_jma.csv elcentro_1940_ns.csv --bodies gravestone --out results.csv",
        "seisblock batch synthetic_knet.knt.tar.gz --bodies gravestone --solver rock --runs 50 --out chances.csv --resume",
    ),
)
@record_options
@bodies_option("Table of bodies (.csv: name, width, height in m, mu, ...), file that describes one body, or bundled body; may be repeated.")
@option("--solver", type=SuggestingChoice(solver_names()), default="respond", show_default=True, help="Model that computes the response.")
@option("--mu", type=MU, section="Body", metavar="MU", help="Static friction coefficient of bodies for which none is given.")
@option("--vertical/--no-vertical", default=None, help="Apply or omit the vertical component. [default: applied where the record has one]")
@option(
    "--runs",
    type=Count(N_("samples"), MAX_RUNS, minimum=0),
    default=0,
    show_default=True,
    help="Perturbed samples for the overturning probability; 0 for none.",
)
@option("--seed", type=int, default=0, show_default=True, help="Seed of the samples.")
@gravity_option
@option(
    "--out",
    type=OutputFile(),
    required=True,
    section="Output",
    metavar="FILE",
    help="Write the table (.csv or .parquet): one row for each record, component and body.",
)
@excel_option
@option("--resume", is_flag=True, section="Output", help="Continue an interrupted table; finished records are kept.")
@option("--force", is_flag=True, section="Output", help="Start again and replace an existing table.")
@option("--workers", type=click.IntRange(1, 1024), metavar="N", help="Number of threads. [default: number of cores]")
@option(
    "--cluster",
    metavar="ADDRESS|local:N",
    help="Dask scheduler tcp://host:8786, or number N of local Dask processes.",
)
@option("--json", "as_json", is_flag=True, section="Output", help="Print a summary of the table as one JSON document on stdout.")
@option("--quiet", is_flag=True, section="Output", help="Print only errors on stderr.")
def batch(source: Source, quiet: bool, **params: Any) -> None:
    """Table of the responses of many bodies to many records: one row for each record, component and body.

    RECORD may be a folder, a pattern, a list (@records.txt) or an archive, each station of which is one record. A record that cannot
    be read or a body that cannot be solved gives a row with the reason. --component all-azimuths sweeps all azimuths in steps of 5
    degrees and writes one row for each record and body: that of its worst azimuth. Finished records are kept in FILE.journal until
    the table is complete; --resume continues from there.
    """
    from seisblock.cli.run_batch import run_batch

    with quiet_output(quiet):
        run_batch(source, **params)

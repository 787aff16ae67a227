"""``seisblock batch``: many records, many bodies, one table."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from seisblock.cli import shell_completion
from seisblock.cli.command import Command, option
from seisblock.cli.options import Source, gravity_option, record_options
from seisblock.cli.suggest import SuggestingChoice
from seisblock.cli.types import MU, Count
from seisblock.cli.verbosity import quiet_output
from seisblock.core.i18n import N_

SOLVERS = ("respond", "rock", "slide", "jump", "uplift", "stack")


@click.command(
    cls=Command,
    examples=(
        "seisblock batch synthetic_jma.csv elcentro_1940_ns.csv --bodies gravestone --out results.csv",
        "seisblock batch synthetic_knet.knt.tar.gz --bodies gravestone --solver rock --runs 50 --out chances.csv --resume",
    ),
)
@record_options
@option(
    "--bodies",
    multiple=True,
    required=True,
    metavar="FILE|NAME",
    shell_complete=shell_completion.complete_bodies(),
    section="Body",
    help="A table of bodies (.csv: name, width, height in m, mu, ...), a file that describes one, or a bundled body; may be repeated.",
)
@option("--solver", type=SuggestingChoice(SOLVERS), default="respond", show_default=True, help="Which model follows them.")
@option("--mu", type=MU, section="Body", metavar="MU", help="Static friction coefficient of bodies that tell none, 1.")
@option("--vertical/--no-vertical", default=None, help="Whether the vertical component acts. [default: as with the solver's own command]")
@option(
    "--runs",
    type=Count(N_("versions"), "SEISBLOCK_RUNS", minimum=0),
    default=0,
    show_default=True,
    help="Perturbed runs behind a probability; 0 for none.",
)
@option("--seed", type=int, default=0, show_default=True, help="Seed of those runs.")
@gravity_option
@option(
    "--out",
    type=click.Path(path_type=Path),
    required=True,
    section="Output",
    metavar="FILE",
    help="Write the table: a row for each record, component and body; .csv or .parquet.",
)
@option("--resume", is_flag=True, section="Output", help="Go on with a table whose writing was interrupted; what is finished is kept.")
@option("--force", is_flag=True, section="Output", help="Begin anew, whatever is there.")
@option("--workers", type=click.IntRange(1, 1024), metavar="N", help="Threads on this machine. [default: as many as there are cores]")
@option(
    "--cluster",
    metavar="ADDRESS|local:N",
    help="Work on a Dask scheduler that is there, tcp://host:8786, or on N processes of this machine.",
)
@option("--json", "as_json", is_flag=True, section="Output", help="One JSON document on stdout: what the table comes to.")
@option("--quiet", is_flag=True, section="Output", help="Nothing on stderr but errors.")
def batch(
    source: Source,
    bodies: tuple[str, ...],
    solver: str,
    out: Path,
    resume: bool,
    force: bool,
    workers: int | None,
    cluster: str | None,
    as_json: bool,
    quiet: bool,
    runs: int,
    seed: int,
    **options: Any,
) -> None:
    """Follow many bodies through many records: one table, a row for each record, component and body.

    RECORD may be a folder, a pattern, a list (@records.txt) or a bundle, each station of which is a record. What cannot be read or
    followed is a row with its reason. --component all-azimuths looks in every direction, in steps of 5 degrees, and has one row for each
    record and body: that of the direction which is worst for it. Finished records are kept in FILE.journal until the table is whole:
    --resume goes on.
    """
    from seisblock.cli.run_batch import BatchRequest, run_batch

    with quiet_output(quiet):
        run_batch(
            source,
            BatchRequest(bodies, solver, runs, seed, options),
            out,
            resume=resume,
            force=force,
            workers=workers,
            cluster=cluster,
            as_json=as_json,
        )

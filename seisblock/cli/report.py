"""``seisblock report``: one page about a record and what it does to some bodies."""

from __future__ import annotations

import shlex
from pathlib import Path

import click

from seisblock.bodies.kinds import KINDS
from seisblock.cli import offered
from seisblock.cli.bodies.options import side_option
from seisblock.cli.command import Command, option
from seisblock.cli.idle import refuse_without
from seisblock.cli.meant import OneOf
from seisblock.cli.options import Source, gravity_option, record_options
from seisblock.cli.quiet import quietly
from seisblock.cli.talk import say, warn
from seisblock.cli.types import LENGTH, MU
from seisblock.errors import InputError
from seisblock.words import language, said

DEFAULT_BODIES = ("gravestone", "chozusha")


@click.command(
    cls=Command,
    examples=("seisblock report -o report.html", "seisblock report record.csv --body 24cmx72cm --mu 0.3 --lang ja -o report.html"),
)
@record_options
@option(
    "--body",
    multiple=True,
    metavar="NAME|FILE|BxH",
    shell_complete=offered.bodies(),
    section="Body",
    help="Bundled body, TOML file, or width and height (24cmx72cm); may be repeated. [default: gravestone and chozusha]",
)
@side_option("Side of a two-layer body along the motion.")
@option(
    "--kind", type=OneOf(KINDS), section="Body", help="Kind of the bodies given by width and height. [default: block, with sharp edges]"
)
@option(
    "--mu", type=MU, section="Body", help="Static friction under the bodies, 1, for sliding. [default: the body's own, else no sliding]"
)
@option("--mu-kinetic", type=MU, section="Body", help="Kinetic friction, 1. [default: as --mu]")
@option(
    "--frequency-vertical",
    type=float,
    metavar="HZ",
    section="Body",
    help="Vertical frequency of the bodies on corner springs, Hz, for uplift. [default: none, no uplift]",
)
@option(
    "--drop",
    type=LENGTH,
    default=0.0,
    section="Body",
    help="Height of a two-layer body's floor above the ground, m or with a unit. [default: 0]",
)
@gravity_option
@option(
    "-o",
    "--output",
    type=click.Path(path_type=Path),
    required=True,
    metavar="FILE",
    section="Output",
    help="The page to write, .html.",
)
@option("--quiet", is_flag=True, section="Output", help="Nothing on stderr but errors, and one line on doubtful records.")
def report(
    source: Source,
    body: tuple[str, ...],
    side: str,
    kind: str | None,
    mu: float | None,
    mu_kinetic: float | None,
    frequency_vertical: float | None,
    drop: float,
    gravity: float,
    output: Path,
    quiet: bool,
) -> None:
    """Write one self-contained page: the record, its measures, and how bodies slide, rock, jump, lift and overturn under it.

    It opens without network, on a phone and on paper. Margins stand beside every verdict.
    """
    from seisblock.bodies.subjects import is_sizes, subject
    from seisblock.cli.inputs import components, load
    from seisblock.cli.progress import progress
    from seisblock.present.figures.fonts import MISSING, drawable
    from seisblock.present.files import refuse_collisions, write_text
    from seisblock.present.pages.report import report as page
    from seisblock.present.suffixes import check_text
    from seisblock.studies.assessment import assess

    refuse_collisions(output)
    check_text(output, "HTML")
    with quietly(quiet):
        names = body or DEFAULT_BODIES
        if not body:
            say("no --body given: {bodies}", bodies=DEFAULT_BODIES)
        subjects = [
            subject(name, side=side, kind=kind or "block", mu=mu, mu_kinetic=mu_kinetic, frequency_vertical=frequency_vertical)
            for name in names
        ]
        if all(each.layers is None for each in subjects):
            refuse_without(said("a two-layer --body"), ("side", "drop"))
        if not any(is_sizes(name) for name in names):
            refuse_without(said("a --body given by width and height"), ("kind",))
        records = load(source)
        if len(records) != 1:
            raise InputError("a report is about one record, found {count}: give one, or run the command for each", count=len(records))
        if drawable() != language():
            say(MISSING)
        with progress("reporting") as advance:
            found = assess(records[0], subjects, components=components(records[0], source), drop=drop, gravity=gravity, progress=advance)
        for message in found.warnings:
            warn(message)
        with progress("drawing"):
            made = page(found, command=shlex.join(["seisblock", *click.get_current_context().obj]))
        write_text(output, made)
        say("wrote {path}", path=output)

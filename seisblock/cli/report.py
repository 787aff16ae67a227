"""``seisblock report``: HTML report of a record and the response of bodies."""

from __future__ import annotations

import shlex
from pathlib import Path

import click

from seisblock.bodies.kinds import KINDS
from seisblock.cli import shell_completion
from seisblock.cli.bodies.options import side_option
from seisblock.cli.build import gravity_option
from seisblock.cli.command import Command, option
from seisblock.cli.console import info, print_result, print_tables, warning
from seisblock.cli.option_checks import reject_without
from seisblock.cli.options import Source, record_options
from seisblock.cli.suggest import SuggestingChoice
from seisblock.cli.types import LENGTH, MU, OutputFile
from seisblock.cli.verbosity import quiet_output
from seisblock.core.errors import InputError
from seisblock.core.i18n import get_locale, gettext, lazy_gettext

DEFAULT_BODIES = ("gravestone", "chozusha")


@click.command(
    cls=Command,
    essential=("--body", "--kind", "--mu", "--drop", "--output", "-o"),
    examples=(
        "seisblock report -o report.html",
        "seisblock report record.csv --body 24cmx72cm --mu 0.3 --lang ja -o report.html",
        "seisblock report record.csv --body gravestone --body bookcase --json",
    ),
)
@record_options
@option(
    "--body",
    multiple=True,
    metavar="NAME|FILE|BxH",
    shell_complete=shell_completion.complete_bodies(),
    section="Body",
    help="Bundled body, TOML file, or width and height (24cmx72cm); may be repeated. [default: gravestone and chozusha]",
)
@side_option("Side of a two-layer body along the motion.")
@option(
    "--kind",
    type=SuggestingChoice(KINDS),
    section="Body",
    help="Kind of the bodies given by width and height. [default: block, with sharp edges]",
)
@option(
    "--mu",
    type=MU,
    section="Body",
    help="Static friction coefficient under the bodies, for sliding. [default: value of the body, else no sliding]",
)
@option("--mu-kinetic", type=MU, section="Body", help="Kinetic friction coefficient. [default: as --mu]")
@option(
    "--frequency-vertical",
    type=float,
    metavar="HZ",
    section="Body",
    help="Vertical natural frequency of the bodies on corner springs, for uplift, Hz. [default: none, no uplift]",
)
@option(
    "--drop",
    type=LENGTH,
    section="Body",
    help="Height of a two-layer body's floor above the ground, m or with a unit. [default: value of the body, else 0]",
)
@gravity_option
@option(
    "-o",
    "--output",
    type=OutputFile("HTML"),
    metavar="FILE",
    section="Output",
    help="HTML page to write. [required without --json]",
)
@option("--json", "as_json", is_flag=True, section="Output", help="Print one JSON document on stdout, SI units.")
@option("--quiet", is_flag=True, section="Output", help="Print only errors and one line of quality warnings on stderr.")
def report(
    source: Source,
    body: tuple[str, ...],
    side: str,
    kind: str | None,
    mu: float | None,
    mu_kinetic: float | None,
    frequency_vertical: float | None,
    drop: float | None,
    gravity: float,
    output: Path | None,
    as_json: bool,
    quiet: bool,
) -> None:
    """Self-contained HTML report: the record, its measures, and sliding, rocking, jump, uplift and overturning of bodies.

    The page works without network, on a phone and in print. Each body has its overturning probability, each result its margin. --json
    prints the assessment of each body, in each direction and as an object under any of them.
    """
    from seisblock.cli.load_records import load_records, selected_components
    from seisblock.cli.progress import progress
    from seisblock.cli.write_results import write_page
    from seisblock.output.figures.fonts import NO_FONT, drawable_locale
    from seisblock.output.json.encode import to_json
    from seisblock.report.html.report import report as page
    from seisblock.report.json.report import document
    from seisblock.report.text.report import tables
    from seisblock.studies.report.models import body_models, is_sizes
    from seisblock.studies.report.responses import collect_responses

    if output is None and not as_json:
        raise click.UsageError(gettext("the page requires -o FILE; without a page, give --json"))
    with quiet_output(quiet):
        names = body or DEFAULT_BODIES
        if not body:
            info("no --body given: using {bodies}", bodies=DEFAULT_BODIES)
        subjects = [
            body_models(name, side=side, kind=kind or "block", mu=mu, mu_kinetic=mu_kinetic, frequency_vertical=frequency_vertical)
            for name in names
        ]
        if all(item.layers is None for item in subjects):
            reject_without(lazy_gettext("a two-layer --body"), ("side", "drop"))
        if not any(is_sizes(name) for name in names):
            reject_without(lazy_gettext("a --body given by width and height"), ("kind",))
        records = load_records(source)
        if len(records) != 1:
            raise InputError("a report requires one record, found {count}: run the command for each record", count=len(records))
        if output is not None and drawable_locale() != get_locale():
            info(NO_FONT)
        with progress("assessing the bodies") as advance:
            data = collect_responses(
                records[0], subjects, components=selected_components(records[0], source), drop=drop, gravity=gravity, progress=advance
            )
        for message in data.warnings:
            warning(message)
        if output is not None:
            write_page(output, lambda: page(data, command=shlex.join(["seisblock", *click.get_current_context().obj])))
        if as_json:
            print_result(to_json(document(data)))
        else:
            print_tables(tables(data))

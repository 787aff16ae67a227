"""``seisblock validate``: numbers printed in the papers compared with the computed ones."""

from __future__ import annotations

from pathlib import Path

import click

from seisblock.cli.command import Command, option
from seisblock.cli.console import print_result, print_tables
from seisblock.cli.types import OutputFile
from seisblock.cli.verbosity import quiet_output

FAILED = 1


@click.command(cls=Command, examples=("seisblock validate", "seisblock validate --paper Sugimoto2017 --html evidence.html"))
@option("--paper", metavar="KEY", multiple=True, help="Key of a paper, or its beginning; may be repeated. [default: all]")
@option("--quick", is_flag=True, help="Skip the slow cases.")
@option("--all", "all_cases", is_flag=True, section="Output", help="List all cases, not only the differences.")
@option("--json", "as_json", is_flag=True, section="Output", help="Print one JSON document on stdout, SI units.")
@option("--html", type=OutputFile("HTML"), section="Output", metavar="FILE", help="Write the gallery as one HTML page.")
@option("--details", is_flag=True, section="Output", help="List the differences from the papers with their causes.")
@option("--quiet", is_flag=True, section="Output", help="Print only errors on stderr.")
@click.pass_context
def validate(
    ctx: click.Context, paper: tuple[str, ...], quick: bool, all_cases: bool, as_json: bool, html: Path | None, details: bool, quiet: bool
) -> None:
    """Numbers printed in the papers compared with the computed ones: counts by paper and by kind of evidence; differences with --details.

    Exit code 1 when a case that should agree does not. A case documented as different also fails when it agrees or differs by another
    amount than documented.
    """
    from seisblock.cli.progress import progress
    from seisblock.cli.write_results import write_page
    from seisblock.report.text import validate as text_output
    from seisblock.validation import cases_of
    from seisblock.validation.case import count_verdicts

    cases = [case for case in cases_of(paper) if case.quick or not quick]
    with quiet_output(quiet):
        results = []
        with progress("validating") as advance:
            for index, case in enumerate(cases):
                advance(index, len(cases))
                results.append(case.run())
        if html is not None:
            from seisblock.report.html.gallery import gallery

            write_page(html, lambda: gallery(results))
    if as_json:
        from seisblock.output.json.encode import to_json
        from seisblock.report.json.validate import document

        print_result(to_json(document(results, quick=quick)))
    else:
        print_tables(text_output.tables(results, all_cases=all_cases), details=details or all_cases)
    if count_verdicts(results)["fails"]:
        ctx.exit(FAILED)

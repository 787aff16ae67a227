"""``seisblock paper``: figures and tables of the papers, on their data or the user's."""

from __future__ import annotations

from typing import Any

import click

from seisblock.cli import shell_completion
from seisblock.cli.command import Command, argument, option
from seisblock.cli.option_checks import RECORD_OPTIONS, reject_without
from seisblock.cli.options import Source, item_record_options, output_options
from seisblock.cli.output import OutputOptions
from seisblock.core.errors import ParameterError


@click.command(
    cls=Command,
    essential=("--body", "--stations", "--component"),
    examples=(
        "seisblock paper",
        "seisblock paper sugimoto2017 table1",
        "seisblock paper fujino1978 fig7 record.csv --plot fig7.png",
        "seisblock paper furukawa2009 fig20 --stations stations.csv --body cemetery.csv",
    ),
)
@argument("paper", required=False, metavar="[PAPER]", help="Citation key of the paper, or its beginning. [default: list of all items]")
@argument("item", required=False, metavar="[ITEM]", help="Figure or table, for example fig7. [default: list of the paper's items]")
@item_record_options
@option(
    "--body",
    metavar="NAME|FILE|SIZES",
    shell_complete=shell_completion.complete_bodies(),
    section="Body",
    help="Body instead of the paper's: two-layer body (sugimoto2017), block or 24cmx72cm (tsutsui; fig8, fig10 of furukawa2009), list of "
    "gravestones (figs. 14 to 20), body on springs (okumura1987).",
)
@option(
    "--stations",
    metavar="FILE",
    section="Body",
    help="CSV of station, pga (gal), pgv (kine) or frequency (Hz), and surveyed rate, for figs. 18 to 20 and table6 of furukawa2009.",
)
@output_options(histories=False, film=False, accelerations=False)
def paper(source: Source, output: OutputOptions, paper: str | None, item: str | None, body: str | None, stations: str | None) -> None:
    """Figures and tables of the papers, computed: on the paper's data or what stands in for it, or on your own record and body.

    Without ITEM, the list of items. The first line says how many statements of the paper on this item hold; those that differ follow
    with their cause.
    """
    from seisblock.cli.write_results import figure_of, write_results
    from seisblock.paper import Inputs, find_item, find_paper, papers
    from seisblock.report.json.paper import document
    from seisblock.report.text import paper as text_output

    if paper is None or item is None:
        reject_without("ITEM", ["body", "stations", *RECORD_OPTIONS])
        listed_papers = papers() if paper is None else (find_paper(paper),)
        listing = document(((listed_paper, entry, None) for listed_paper in listed_papers for entry in listed_paper.items), Inputs())
        write_results(listing, output, tables=lambda: text_output.list_tables(listed_papers))
        return
    chosen_paper = find_paper(paper)
    chosen_item = find_item(chosen_paper, item)
    given_inputs = {"record": bool(source.record), "body": body is not None, "stations": stations is not None}
    for name, is_given in given_inputs.items():
        if is_given and name not in chosen_item.takes:
            raise ParameterError(
                "{paper} {item} takes no {flag}: omit it",
                paper=chosen_paper.key,
                item=chosen_item.name,
                flag=name if name == "record" else f"--{name}",
            )
    if not source.record:
        reject_without("RECORD", RECORD_OPTIONS)
    inputs = Inputs(_records(source), source.component, body, stations)
    from seisblock.cli.progress import progress

    with progress("computing {item}", item=chosen_item.name):
        answer = chosen_item.compute(inputs)
    write_results(
        document([(chosen_paper, chosen_item, answer)], inputs, records=inputs.records),
        output,
        tables=lambda: text_output.tables(chosen_paper, chosen_item, answer, own=any(given_inputs.values())),
        csv=lambda: ([column.key for column in answer.columns], answer.rows),
        figure=figure_of("paper:figure", chosen_paper, chosen_item, answer),
    )


def _records(source: Source) -> tuple[Any, ...]:
    """Return the user's records, prepared."""
    if not source.record:
        return ()
    from seisblock.cli.load_records import load_records

    return tuple(load_records(source))

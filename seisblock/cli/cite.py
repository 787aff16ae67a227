"""``seisblock cite``: references of a command."""

from __future__ import annotations

import click

from seisblock.cli.command import Command, argument, option
from seisblock.cli.console import print_result, print_tables
from seisblock.cli.suggest import SuggestingChoice
from seisblock.references import cited_commands, command_papers


@click.command(cls=Command, examples=("seisblock cite jump", "seisblock cite --bibtex > seisblock.bib"))
@argument("command", required=False, metavar="[COMMAND]", type=SuggestingChoice(cited_commands()), help="Command. [default: all commands]")
@option("--bibtex", is_flag=True, section="Output", help="Print BibTeX entries instead of text.")
@option("--json", "as_json", is_flag=True, section="Output", help="Print one JSON document on stdout.")
def cite(command: str | None, bibtex: bool, as_json: bool) -> None:
    """List of the papers on which the results of a command are based; without COMMAND, of all commands.

    The papers on which a result is based are also in its --json document, under citations.
    """
    from seisblock.references import REFERENCES, SOFTWARE

    keys = command_papers(command) if command else tuple(REFERENCES)
    references = [*(REFERENCES[key] for key in keys), SOFTWARE]
    if as_json:
        from seisblock.output.json.encode import to_json
        from seisblock.report.json.citations import cite_document

        print_result(to_json(cite_document(command, references, keys)))
    elif bibtex:
        print_result("\n\n".join(reference.bibtex() for reference in references))
    else:
        from seisblock.report.text.cite import reference_lines

        print_tables(reference_lines(references))

"""``seisblock cite``: the papers an answer relies on."""

from __future__ import annotations

import click

from seisblock.cli.command import Command, argument, option
from seisblock.cli.meant import OneOf
from seisblock.cli.talk import answer, show
from seisblock.references import CITED


@click.command(cls=Command, examples=("seisblock cite jump", "seisblock cite --bibtex > seisblock.bib"))
@argument("command", required=False, metavar="[COMMAND]", type=OneOf(CITED), help="Whose papers. [default: of all commands]")
@option("--bibtex", is_flag=True, section="Output", help="BibTeX entries instead of lines of text.")
@option("--json", "as_json", is_flag=True, section="Output", help="One JSON document on stdout.")
def cite(command: str | None, bibtex: bool, as_json: bool) -> None:
    """Print the papers that a command's answers rely on; without COMMAND, all there are.

    What one answer relied on also stands in its --json document under citations.
    """
    from seisblock.references import REFERENCES, SOFTWARE

    keys = CITED[command] if command else tuple(REFERENCES)
    chosen = [*(REFERENCES[key] for key in keys), SOFTWARE]
    if as_json:
        from seisblock.present.documents.library import cite_document
        from seisblock.present.documents.write import to_json

        answer(to_json(cite_document(command, chosen, keys)))
    elif bibtex:
        answer("\n\n".join(reference.bibtex() for reference in chosen))
    else:
        from seisblock.present.text.cite import listing

        show(listing(chosen))

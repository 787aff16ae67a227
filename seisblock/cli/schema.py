"""``seisblock schema``: the keys of a command's ``--json`` document, as JSON Schema."""

from __future__ import annotations

import click

from seisblock.cli.command import Command, argument
from seisblock.cli.meant import OneOf
from seisblock.cli.talk import answer
from seisblock.present.documents.catalogue import KINDS, schema_of
from seisblock.present.documents.versions import VERSIONS, schema_name


@click.command(cls=Command, examples=("seisblock schema rock", "seisblock schema"))
@argument("command", required=False, metavar="[COMMAND]", type=OneOf(KINDS), help="Whose document. [default: of all commands]")
def schema(command: str | None) -> None:
    """Print the JSON Schema of a command's --json document; without COMMAND, list the commands that write one.

    Each key says what it means and in which unit. The number at the end of a schema's name grows when a key goes or changes.
    """
    if command is None:
        answer("\n".join(map(schema_name, VERSIONS)))
        return
    import json

    answer(json.dumps(schema_of(command), ensure_ascii=False, indent=2))

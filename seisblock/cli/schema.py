"""``seisblock schema``: JSON Schema of a command's ``--json`` document."""

from __future__ import annotations

import click

from seisblock.cli.command import Command, argument
from seisblock.cli.console import print_result
from seisblock.cli.suggest import SuggestingChoice
from seisblock.report.json.registry import document_commands, document_schemas, json_schema


@click.command(cls=Command, examples=("seisblock schema rock", "seisblock schema"))
@argument(
    "command", required=False, metavar="[COMMAND]", type=SuggestingChoice(document_commands()), help="Command. [default: all commands]"
)
def schema(command: str | None) -> None:
    """JSON Schema of a command's --json document; without COMMAND, the list of commands that write one.

    Each key has a description and a unit. The number at the end of a schema's name increases when a key is removed or changed.
    """
    if command is None:
        print_result("\n".join(document_schemas(name)[0].schema for name in document_commands()))
        return
    import json

    print_result(json.dumps(json_schema(command), ensure_ascii=False, indent=2))

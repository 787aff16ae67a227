"""From an answer to stdout and files, as the output options ask."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any

import click

from seisblock.cli.options import Output
from seisblock.cli.talk import say, warn
from seisblock.errors import OutputError
from seisblock.present.document import Answer, to_json
from seisblock.results import Response


def emit(
    answer: Answer,
    output: Output,
    *,
    tables: Callable[[], Iterable[Any]],
    responses: Sequence[Response[Any]] = (),
    csv: Callable[[Path], None] | None = None,
    figure: Callable[[], Any] | None = None,
    animation: Callable[[Path], None] | None = None,
) -> None:
    """Show an answer and write the files asked for.

    Parameters
    ----------
    answer : Answer
    output : Output
        The output options.
    tables : callable
        Returns what rich prints when no JSON is asked for.
    responses : sequence of Response
        Time histories for ``--csv``.
    csv : callable
        Writes the file of ``--csv`` where time histories are not what it holds.
    figure : callable
        Returns the matplotlib Figure of ``--plot``.
    animation : callable
        Writes the file of ``--animate``.
    """
    for message in answer.warnings:
        warn(message)
    if output.csv is not None:
        from seisblock.present.files import write_histories

        (csv or (lambda path: write_histories(path, responses)))(output.csv)
        say(f"wrote {output.csv}")
    if output.plot is not None:
        if figure is None:
            raise OutputError(f"{answer.command} has no figure: leave --plot out")
        from seisblock.present.canvas import save

        save(figure(), output.plot)
        say(f"wrote {output.plot}")
    if output.animate is not None:
        if animation is None:
            raise OutputError(f"{answer.command} has no animation: leave --animate out")
        animation(output.animate)
        say(f"wrote {output.animate}")
    # stdout comes last: a reader that goes away (| head) takes no file with it
    if output.json:
        click.echo(to_json(answer))
    else:
        from seisblock.present.tables import console

        screen = console()
        for part in tables():
            screen.print(part)


def response_answer(
    command: str, responses: Sequence[Response[Any]], parameters: dict[str, Any], *, extra: dict[str, Any] | None = None
) -> Answer:
    """Return the answer of a solver: one result per response, with its record, warnings and citations."""
    records = list({id(r.motion.record): r.motion.record for r in responses if r.motion.record is not None}.values())
    index = {id(record): i for i, record in enumerate(records)}
    results = []
    for response in responses:
        entry = response.summary()
        if len(records) > 1:
            entry = {"record_index": index[id(response.motion.record)], **entry}
        results.append(entry)
    warnings = list(dict.fromkeys(message for response in responses for message in response.warnings))
    citations = list(dict.fromkeys(key for response in responses for key in response.citations))
    return Answer(command, parameters, results, records, citations, warnings, extra or {})

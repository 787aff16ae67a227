"""What the program says: its answer on stdout, and beside it one line at a time on stderr."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import click

from seisblock.cli.progress import end, hushed
from seisblock.cli.quiet import is_quiet
from seisblock.words import language, plain_text, said, speaking, tell

_warned: set[str] = set()
"""What was warned of in this run: nothing is warned of twice."""


def say(text: str, /, **values: Any) -> None:
    """Say one line on stderr: a template with its values, or a text that was said below."""
    if not is_quiet():
        _write(tell(text, **values), dim=True)


def in_this_language() -> Callable[[str], str]:
    """Return what tells a text in the language that is spoken now, whichever thread asks."""
    spoken = language()

    def told(text: str) -> str:
        with speaking(spoken):
            return tell(text)

    return told


def warn(text: str, /, **values: Any) -> None:
    """Say one line that should not be overlooked, once."""
    message = said(text, **values) if values else text
    if not is_quiet() and message not in _warned:
        _warned.add(message)
        _write(tell("warning: {message}", message=message), fg="yellow")


def insist(text: str, /, **values: Any) -> None:
    """Say one line although the program was asked to keep silent."""
    _write(tell("warning: {message}", message=said(text, **values) if values else text), fg="yellow")


def forget() -> None:
    """Forget what was warned of: another run begins."""
    _warned.clear()


def _write(text: str, **style: Any) -> None:
    """Write one line, where the line of progress does not stand."""
    with hushed():
        click.secho(plain_text(text), err=True, **style)


def answer(text: str) -> None:
    """Write the answer on stdout, as a text."""
    end()
    click.echo(text)


def show(tables: Iterable[Any]) -> None:
    """Write the answer on stdout, as what rich prints."""
    from seisblock.present.text.tables import console

    screen, parts = console(), list(tables)
    end()
    for part in parts:
        screen.print(part)

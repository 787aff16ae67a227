"""What the program says: its answer on stdout, and beside it one line at a time on stderr."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import click

from seisblock.cli.progress import close_line, paused
from seisblock.cli.verbosity import is_quiet
from seisblock.core.i18n import escape_control, get_locale, gettext, lazy_gettext, use_locale

_emitted_warnings: set[str] = set()
"""What was warned of in this run: nothing is warned of twice."""


def info(text: str, /, **values: Any) -> None:
    """Say one line on stderr: a template with its values, or a text that was said below."""
    if not is_quiet():
        _write_line(gettext(text, **values), dim=True)


def bind_locale() -> Callable[[str], str]:
    """Return what tells a text in the language that is spoken now, whichever thread asks."""
    locale = get_locale()

    def translate(text: str) -> str:
        with use_locale(locale):
            return gettext(text)

    return translate


def warning(text: str, /, **values: Any) -> None:
    """Say one line that should not be overlooked, once."""
    message = lazy_gettext(text, **values) if values else text
    if not is_quiet() and message not in _emitted_warnings:
        _emitted_warnings.add(message)
        _write_line(gettext("warning: {message}", message=message), fg="yellow")


def always(text: str, /, **values: Any) -> None:
    """Say one line although the program was asked to keep silent."""
    _write_line(gettext("warning: {message}", message=lazy_gettext(text, **values) if values else text), fg="yellow")


def reset_warnings() -> None:
    """Forget what was warned of: another run begins."""
    _emitted_warnings.clear()


def _write_line(text: str, **style: Any) -> None:
    """Write one line, where the line of progress does not stand."""
    with paused():
        click.secho(escape_control(text), err=True, **style)


def print_result(text: str) -> None:
    """Write the answer on stdout, as a text."""
    close_line()
    click.echo(text)


def print_tables(tables: Iterable[Any]) -> None:
    """Write the answer on stdout, as what rich prints."""
    from seisblock.report.text.tables import console

    screen, parts = console(), list(tables)
    close_line()
    for part in parts:
        screen.print(part)

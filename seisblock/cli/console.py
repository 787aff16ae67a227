"""Console output: results on stdout, messages on stderr."""

from __future__ import annotations

import contextlib
import logging
import re
from collections.abc import Callable, Iterable, Iterator
from typing import Any

import click

from seisblock.cli.progress import close_line, paused, set_task
from seisblock.cli.verbosity import is_quiet
from seisblock.core.i18n import N_, escape_control, get_locale, gettext, lazy_gettext, use_locale

PARAMETER = re.compile(r"`(\w+)`")
"""Parameter name in a message of the library."""

_emitted_warnings: set[str] = set()
"""Warnings already printed in this run; each is printed once."""

_default_records: list[str] = []
"""Lines on the bundled record that stands in for a missing one, until printed."""


def info(text: str, /, **values: Any) -> None:
    """Print an information message on stderr unless ``--quiet``: a template with values, or a message."""
    if not is_quiet():
        _write_line(gettext(text, **values), dim=True)


def bind_locale() -> Callable[[str], str]:
    """Return a function that translates into the current locale from any thread."""
    locale = get_locale()

    def translate(text: str) -> str:
        with use_locale(locale):
            return gettext(text)

    return translate


class KernelMessages(logging.Handler):
    """Handler that prints messages about the compilation of kernels and sets the task of the progress line."""

    def __init__(self) -> None:
        super().__init__()
        self._translate = bind_locale()  # other threads, which compile, too, have no locale context

    def emit(self, record: logging.LogRecord) -> None:
        """Print a message of level INFO or higher; take the task of a lower one."""
        if record.levelno >= logging.INFO:
            info(self._translate(record.msg))
        elif task := getattr(record, "task", ""):
            set_task(self._translate(task))


@contextlib.contextmanager
def kernel_messages() -> Iterator[None]:
    """Show the messages of the logger ``seisblock.jit`` inside the block."""
    logger, handler = logging.getLogger("seisblock.jit"), KernelMessages()
    level = logger.level
    logger.addHandler(handler)
    logger.setLevel(logging.DEBUG)
    try:
        yield
    finally:
        logger.removeHandler(handler)
        logger.setLevel(level)


def with_option_names(text: str, command: click.Command | None) -> str:
    """Return a message with parameter names (`` `dt` ``) replaced by the option names of a command (``--dt``)."""
    names = {parameter.name: parameter.opts[0] for parameter in command.params if isinstance(parameter, click.Option)} if command else {}
    return PARAMETER.sub(lambda match: names.get(match[1], match[1]), text)


def warning(text: str, /, **values: Any) -> None:
    """Print a warning on stderr, once per run."""
    message = lazy_gettext(text, **values) if values else text
    if not is_quiet() and message not in _emitted_warnings:
        _emitted_warnings.add(message)
        context = click.get_current_context(silent=True)
        message = with_option_names(gettext(message), context.command if context else None)
        _write_line(gettext("warning: {message}", message=message), fg="yellow")


def always(text: str, /, **values: Any) -> None:
    """Print a message on stderr even with ``--quiet``."""
    _write_line(gettext("warning: {message}", message=lazy_gettext(text, **values) if values else text), fg="yellow")


def note_default_record(name: str, *, synthetic: bool) -> None:
    """Keep the name of the bundled record that stands in for a missing one: first line of the result."""
    text = N_("Record: {name} (bundled, synthetic); none given.") if synthetic else N_("Record: {name} (bundled); none given.")
    _default_records.append(gettext(text, name=name))


def print_default_record(*, err: bool = False) -> None:
    """Print the line on the bundled record that stands in for a missing one, once; on stderr where stdout holds data."""
    while _default_records:
        line = _default_records.pop()
        if err:
            info(line)
        else:
            click.echo(line)


def reset_warnings() -> None:
    """Clear the messages of an earlier run."""
    _emitted_warnings.clear()
    _default_records.clear()


def _write_line(text: str, **style: Any) -> None:
    """Write one line on stderr while the progress line is hidden."""
    with paused():
        click.secho(escape_control(text), err=True, **style)


def print_result(text: str) -> None:
    """Print the result on stdout as text."""
    print_default_record(err=True)
    close_line()
    click.echo(text)


def print_tables(tables: Iterable[Any], *, details: bool = False) -> None:
    """Print rich tables on stdout: in full with `details`, else shortened and with the option that prints the rest."""
    from seisblock.output.text.tables import console, shortened_answer, whole_answer

    screen, parts = console(), list(whole_answer(tables) if details else shortened_answer(tables))
    close_line()
    print_default_record()
    for part in parts:
        screen.print(part)

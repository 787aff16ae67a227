"""What the program says beside its answer: one line at a time, on stderr."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from typing import Any

import click

from seisblock.words import plain_text, said, tell

_quiet = False
_warned: set[str] = set()
"""What was warned of in this run: nothing is warned of twice."""


@contextlib.contextmanager
def quietly(quiet: bool | None) -> Iterator[None]:
    """Keep silent inside the block when asked to; None changes nothing."""
    global _quiet
    before = _quiet
    _quiet = before if quiet is None else quiet
    try:
        yield
    finally:
        _quiet = before


def is_quiet() -> bool:
    """Whether the program was asked to keep silent."""
    return _quiet


def say(text: str, /, **values: Any) -> None:
    """Say one line on stderr: a template with its values, or a text that was said below."""
    if not _quiet:
        click.secho(plain_text(tell(text, **values)), dim=True, err=True)


def warn(text: str, /, **values: Any) -> None:
    """Say one line that should not be overlooked, once."""
    message = said(text, **values) if values else text
    if not _quiet and message not in _warned:
        _warned.add(message)
        click.secho(plain_text(tell("warning: {message}", message=message)), fg="yellow", err=True)


def insist(text: str, /, **values: Any) -> None:
    """Say one line although the program was asked to keep silent."""
    click.secho(plain_text(tell("warning: {message}", message=said(text, **values) if values else text)), fg="yellow", err=True)


def forget() -> None:
    """Forget what was warned of: another run begins."""
    _warned.clear()

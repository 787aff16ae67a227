"""What the program says beside its answer: one line at a time, on stderr."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator

import click

_quiet = False


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


def say(message: str) -> None:
    """Say one line on stderr."""
    if not _quiet:
        click.secho(message, dim=True, err=True)


def warn(message: str) -> None:
    """Say one line that should not be overlooked."""
    if not _quiet:
        click.secho(f"warning: {message}", fg="yellow", err=True)

"""Which files a command reads and writes: so that no output falls on an input, or on another output.

Files are told apart by what they are (device and inode), not by what they are called: links and ``./`` change nothing. Outside of
:func:`ledger` nothing is kept and nothing is refused.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from contextvars import ContextVar
from dataclasses import dataclass, field
from pathlib import Path

from seisblock.errors import OutputError

Identity = tuple[int, int] | str
"""Device and inode of a file that is there; the resolved path of one that is not."""


@dataclass
class Ledger:
    """The files of one run, each with the name it was given by."""

    read: dict[Identity, str] = field(default_factory=dict)
    written: dict[Identity, str] = field(default_factory=dict)


_open: ContextVar[Ledger | None] = ContextVar("ledger", default=None)


@contextlib.contextmanager
def ledger() -> Iterator[Ledger]:
    """Keep book inside the block; nothing is left behind."""
    token = _open.set(Ledger())
    try:
        book = _open.get()
        assert book is not None
        yield book
    finally:
        _open.reset(token)


def identity(path: Path) -> Identity:
    """Return what tells a file from every other."""
    try:
        found = path.stat()
    except OSError:
        return str(path.resolve())
    return found.st_dev, found.st_ino


def reading(path: Path) -> None:
    """Note that a file is read."""
    book = _open.get()
    if book is not None and path.is_file():
        book.read.setdefault(identity(path), str(path))


def refuse_collision(path: Path) -> None:
    """Refuse an output that is a file read, or another output of this run.

    Raises
    ------
    OutputError
        Naming both.
    """
    book = _open.get()
    if book is None or (path.exists() and not path.is_file()):
        return  # devices and pipes take whatever comes
    who = identity(path)
    if who in book.read:
        raise OutputError(
            "{path} is a file that is read ({use}): it would be lost; give the output another name", path=path, use=book.read[who]
        )
    if who in book.written:
        raise OutputError(
            "{path} is written already by another output ({use}): give each output its own name", path=path, use=book.written[who]
        )


def wrote(path: Path) -> None:
    """Note that a file was written."""
    book = _open.get()
    if book is not None and path.is_file():
        book.written[identity(path)] = str(path)

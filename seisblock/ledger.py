"""Which files a command reads and writes: so that no output falls on an input, or on another output.

Files are told apart by what they are (device and inode), not by what they are called: links and ``./`` change nothing. Outside of
:func:`ledger` nothing is kept and nothing is refused.
"""

from __future__ import annotations

import contextlib
import os
import stat
from collections.abc import Iterator
from contextvars import ContextVar
from dataclasses import dataclass, field
from pathlib import Path
from typing import TextIO

from seisblock.errors import OutputError

Identity = tuple[int, int] | str
"""Device and inode of a file that is there; the resolved path of one that is not."""


@dataclass
class Ledger:
    """The files of one run, each with the name it was given by, and the file that stdout was sent to, where it is one."""

    read: dict[Identity, str] = field(default_factory=dict)
    written: dict[Identity, str] = field(default_factory=dict)
    stdout: Identity | None = None


_open: ContextVar[Ledger | None] = ContextVar("ledger", default=None)


@contextlib.contextmanager
def ledger(stdout: TextIO | None = None) -> Iterator[Ledger]:
    """Keep book inside the block, of the file that answers are printed to, too; nothing is left behind."""
    token = _open.set(Ledger(stdout=_file_of(stdout)))
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
        return os.path.realpath(path)  # `resolve` fails on a link to itself
    return found.st_dev, found.st_ino


def _file_of(stream: TextIO | None) -> Identity | None:
    """Return what tells the file that a stream goes to; None for a terminal, a pipe or a device."""
    if stream is None:
        return None
    try:
        found = os.fstat(stream.fileno())
    except (OSError, ValueError):  # closed, or no file at all
        return None
    return (found.st_dev, found.st_ino) if stat.S_ISREG(found.st_mode) else None


def reading(path: Path) -> None:
    """Note that a file is read.

    Raises
    ------
    OutputError
        If stdout is appended to it.
    """
    book = _open.get()
    if book is not None and path.is_file():
        who = identity(path)
        if who == book.stdout:
            raise OutputError("{path} is a file that is read, and stdout goes to it: send stdout elsewhere", path=path)
        book.read.setdefault(who, str(path))


def refuse_collision(path: Path) -> None:
    """Refuse an output that is a file read, or another output of this run.

    Raises
    ------
    OutputError
        Naming both; also where stdout goes to it, which would be lost behind the new file.
    """
    book = _open.get()
    if book is None or (path.exists() and not path.is_file()):
        return  # devices and pipes take whatever comes
    who = identity(path)
    if who in book.read:
        raise OutputError(
            "{path} is a file that is read ({use}): it would be lost; give the output another name", path=path, use=book.read[who]
        )
    if who == book.stdout:
        raise OutputError("{path} is the file that stdout goes to: give the output another name, or send stdout elsewhere", path=path)
    if who in book.written:
        raise OutputError(
            "{path} is written already by another output ({use}): give each output its own name", path=path, use=book.written[who]
        )


def wrote(path: Path) -> None:
    """Note that a file was written."""
    book = _open.get()
    if book is not None and path.is_file():
        book.written[identity(path)] = str(path)

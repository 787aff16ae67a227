"""Which files a command reads and writes: so that no output falls on an input, or on another output.

Files are told apart by what they are (device and inode), not by what they are called: links and ``./`` change nothing. Outside of
:func:`track_files` nothing is kept and nothing is refused.
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

from seisblock.core.errors import OutputError

FileIdentity = tuple[int, int] | str
"""Device and inode of a file that is there; the resolved path of one that is not."""


@dataclass
class FileTracker:
    """The files of one run, each with the name it was given by, and the file that stdout was sent to, where it is one."""

    read: dict[FileIdentity, str] = field(default_factory=dict)
    written: dict[FileIdentity, str] = field(default_factory=dict)
    stdout: FileIdentity | None = None


_tracker: ContextVar[FileTracker | None] = ContextVar("ledger", default=None)


@contextlib.contextmanager
def track_files(stdout: TextIO | None = None) -> Iterator[FileTracker]:
    """Keep book inside the block, of the file that answers are printed to, too; nothing is left behind."""
    token = _tracker.set(FileTracker(stdout=_stream_identity(stdout)))
    try:
        tracker = _tracker.get()
        assert tracker is not None
        yield tracker
    finally:
        _tracker.reset(token)


def file_identity(path: Path) -> FileIdentity:
    """Return what tells a file from every other."""
    try:
        info = path.stat()
    except OSError:
        return os.path.realpath(path)  # `resolve` fails on a link to itself
    return info.st_dev, info.st_ino


def _stream_identity(stream: TextIO | None) -> FileIdentity | None:
    """Return what tells the file that a stream goes to; None for a terminal, a pipe or a device."""
    if stream is None:
        return None
    try:
        info = os.fstat(stream.fileno())
    except (OSError, ValueError):  # closed, or no file at all
        return None
    return (info.st_dev, info.st_ino) if stat.S_ISREG(info.st_mode) else None


def mark_read(path: Path) -> None:
    """Note that a file is read.

    Raises
    ------
    OutputError
        If stdout is appended to it.
    """
    tracker = _tracker.get()
    if tracker is not None and path.is_file():
        key = file_identity(path)
        if key == tracker.stdout:
            raise OutputError("{path} is a file that is read, and stdout goes to it: send stdout elsewhere", path=path)
        tracker.read.setdefault(key, str(path))


def check_not_input(path: Path) -> None:
    """Refuse an output that is a file read, or another output of this run.

    Raises
    ------
    OutputError
        Naming both; also where stdout goes to it, which would be lost behind the new file.
    """
    tracker = _tracker.get()
    if tracker is None or (path.exists() and not path.is_file()):
        return  # devices and pipes take whatever comes
    key = file_identity(path)
    if key in tracker.read:
        raise OutputError(
            "{path} is a file that is read ({use}): it would be lost; give the output another name", path=path, use=tracker.read[key]
        )
    if key == tracker.stdout:
        raise OutputError("{path} is the file that stdout goes to: give the output another name, or send stdout elsewhere", path=path)
    if key in tracker.written:
        raise OutputError(
            "{path} is written already by another output ({use}): give each output its own name", path=path, use=tracker.written[key]
        )


def mark_written(path: Path) -> None:
    """Note that a file was written."""
    tracker = _tracker.get()
    if tracker is not None and path.is_file():
        tracker.written[file_identity(path)] = str(path)

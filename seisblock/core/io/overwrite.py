"""Protection of input files: outputs that would overwrite a file read or written in the same run are rejected.

Files are identified by device and inode, so that links and relative paths make no difference. Outside :func:`track_files` nothing is
tracked or rejected.
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
"""Device and inode of an existing file, else the resolved path."""


@dataclass
class FileTracker:
    """Names of the files of one run by their identities, and the identity of the file that stdout goes to, if any."""

    stdout: FileIdentity | None
    read: dict[FileIdentity, str] = field(default_factory=dict)
    written: dict[FileIdentity, str] = field(default_factory=dict)


_tracker: ContextVar[FileTracker | None] = ContextVar("file_tracker", default=None)


@contextlib.contextmanager
def track_files(stdout: TextIO) -> Iterator[None]:
    """Track files read and written inside the block, and the file that stdout is redirected to."""
    target = None
    with contextlib.suppress(OSError, ValueError):  # closed, or without a file descriptor
        info = os.fstat(stdout.fileno())
        target = (info.st_dev, info.st_ino) if stat.S_ISREG(info.st_mode) else None
    token = _tracker.set(FileTracker(target))
    try:
        yield
    finally:
        _tracker.reset(token)


def _identity(path: Path) -> FileIdentity:
    try:
        info = path.stat()
    except OSError:
        return os.path.realpath(path)  # Path.resolve raises on a symbolic link to itself
    return info.st_dev, info.st_ino


def mark_read(path: Path) -> None:
    """Register a file that is read; raise OutputError if stdout is redirected to it."""
    if (tracker := _tracker.get()) is not None and path.is_file():
        key = _identity(path)
        if key == tracker.stdout:
            raise OutputError("stdout is redirected to the input file {path}: redirect it to another file", path=path)
        tracker.read.setdefault(key, str(path))


def mark_written(path: Path) -> None:
    """Register a file that was written."""
    if (tracker := _tracker.get()) is not None and path.is_file():
        tracker.written[_identity(path)] = str(path)


def check_not_input(path: Path) -> None:
    """Raise OutputError if an output is a file read or written in this run, or the target of stdout."""
    tracker = _tracker.get()
    if tracker is None or (path.exists() and not path.is_file()):  # devices and pipes cannot be overwritten
        return
    key = _identity(path)
    if key in tracker.read:
        raise OutputError(
            "the output {path} would overwrite the input file {use}: choose another output name", path=path, use=tracker.read[key]
        )
    if key == tracker.stdout:
        raise OutputError(
            "the output {path} is also the target of stdout: choose another output name or redirect stdout to another file", path=path
        )
    if key in tracker.written:
        raise OutputError(
            "the output {path} would overwrite another output ({use}): give each output its own name", path=path, use=tracker.written[key]
        )

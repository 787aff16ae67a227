"""Protection of input files against overwriting.

Files read and written in a run are tracked, and outputs that would overwrite one of them are rejected. Files are identified by device
and inode, so that links and relative paths make no difference. Outside :func:`track_files` nothing is tracked or rejected.
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
    """Files of one run with the names used for them, and the file that stdout is redirected to, if any."""

    read: dict[FileIdentity, str] = field(default_factory=dict)
    written: dict[FileIdentity, str] = field(default_factory=dict)
    stdout: FileIdentity | None = None


_tracker: ContextVar[FileTracker | None] = ContextVar("file_tracker", default=None)


@contextlib.contextmanager
def track_files(stdout: TextIO | None = None) -> Iterator[FileTracker]:
    """Track files read and written inside the block, including the target of stdout."""
    token = _tracker.set(FileTracker(stdout=_stream_identity(stdout)))
    try:
        tracker = _tracker.get()
        assert tracker is not None
        yield tracker
    finally:
        _tracker.reset(token)


def file_identity(path: Path) -> FileIdentity:
    """Return the identity of a file: device and inode, or the resolved path of a file that does not exist."""
    try:
        info = path.stat()
    except OSError:
        # Path.resolve raises on a symbolic link to itself
        return os.path.realpath(path)
    return info.st_dev, info.st_ino


def _stream_identity(stream: TextIO | None) -> FileIdentity | None:
    """Return the identity of the target of a stream; None for a terminal, a pipe or a device."""
    if stream is None:
        return None
    try:
        info = os.fstat(stream.fileno())
    except (OSError, ValueError):
        # closed stream, or a stream without a file descriptor
        return None
    return (info.st_dev, info.st_ino) if stat.S_ISREG(info.st_mode) else None


def mark_read(path: Path) -> None:
    """Register a file that is read.

    Raises
    ------
    OutputError
        If stdout is redirected to the file.
    """
    tracker = _tracker.get()
    if tracker is not None and path.is_file():
        key = file_identity(path)
        if key == tracker.stdout:
            raise OutputError("stdout is redirected to the input file {path}: redirect it to another file", path=path)
        tracker.read.setdefault(key, str(path))


def check_not_input(path: Path) -> None:
    """Raise an error if an output would overwrite an input file or another output of this run.

    Raises
    ------
    OutputError
        If the output is a file read or written in this run, or the target of stdout.
    """
    tracker = _tracker.get()
    if tracker is None or (path.exists() and not path.is_file()):
        # devices and pipes cannot be overwritten
        return
    key = file_identity(path)
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


def mark_written(path: Path) -> None:
    """Register a file that was written."""
    tracker = _tracker.get()
    if tracker is not None and path.is_file():
        tracker.written[file_identity(path)] = str(path)

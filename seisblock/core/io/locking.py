"""File locks, and removal of stale temporary files of killed runs."""

from __future__ import annotations

import contextlib
import os
import time
from collections.abc import Iterator
from pathlib import Path

PREFIX = ".seisblock-"
"""Prefix of the names of temporary files."""

MIN_AGE_S = 60.0
"""Minimum age of a file to be removed, s: a younger one may belong to a run that has not locked it yet."""


@contextlib.contextmanager
def file_lock(path: Path) -> Iterator[bool]:
    """Hold an exclusive ``flock`` inside the block; yield False if another process holds it.

    The lock protects a temporary file from :func:`remove_stale`. The operating system releases it when the process dies. On systems
    or file systems without locks, True is yielded.
    """
    exclusive = True
    with contextlib.ExitStack() as stack:
        # no fcntl on Windows; no locks on some network file systems
        with contextlib.suppress(ImportError, OSError):
            import fcntl

            descriptor = os.open(path, os.O_RDONLY)
            stack.callback(os.close, descriptor)
            try:
                fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                exclusive = False
        yield exclusive


def remove_stale(folder: Path) -> None:
    """Delete temporary files of killed runs in a folder; locked files are kept."""
    with contextlib.suppress(ImportError, OSError):
        import fcntl

        for path in folder.glob(PREFIX + "*"):
            with contextlib.suppress(OSError):
                if not path.is_file() or time.time() - path.stat().st_mtime < MIN_AGE_S:
                    continue
                descriptor = os.open(path, os.O_RDONLY | os.O_NOFOLLOW)
                # flock raises for a file locked by a living run, which is thereby kept
                try:
                    fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
                    path.unlink()
                finally:
                    os.close(descriptor)

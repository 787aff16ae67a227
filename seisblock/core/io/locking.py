"""Hidden files of runs that were killed in the middle of a write: nobody else takes them away."""

from __future__ import annotations

import contextlib
import os
import time
from collections.abc import Iterator
from pathlib import Path

PREFIX = ".seisblock-"
"""How the name of every file begins that is not yet what it will be."""

MIN_AGE_S = 60.0
"""A file younger than this may have been made a moment ago, by a run that has yet to take hold of it."""


@contextlib.contextmanager
def file_lock(path: Path) -> Iterator[bool]:
    """Keep hold of a file inside the block, so that no other run takes it for a leftover; the system lets go when a process dies.

    False where another run has hold of it.
    """
    exclusive = True
    with contextlib.ExitStack() as stack:
        with contextlib.suppress(ImportError, OSError):  # no such locks on this system, or on this disk
            import fcntl

            descriptor = os.open(path, os.O_RDONLY)
            stack.callback(os.close, descriptor)
            try:
                fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                exclusive = False
        yield exclusive


def remove_stale(folder: Path) -> None:
    """Take away what runs that were killed left in a folder; what a living run holds, here or on another machine, stays."""
    with contextlib.suppress(ImportError, OSError):
        import fcntl

        for path in folder.glob(PREFIX + "*"):
            with contextlib.suppress(OSError):
                if not path.is_file() or time.time() - path.stat().st_mtime < MIN_AGE_S:
                    continue
                descriptor = os.open(path, os.O_RDONLY | os.O_NOFOLLOW)
                try:
                    fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
                    path.unlink()
                finally:
                    os.close(descriptor)

"""A file to which a long study adds a line for each part that is finished, so that an interrupted run goes on where it was."""

from __future__ import annotations

import os
from pathlib import Path

from seisblock.core.errors import OutputError, ParameterError, os_error_text
from seisblock.core.i18n import lazy_gettext
from seisblock.core.io.files import read_bytes

MAX_LINE_BYTES = 2**16
"""Bytes of a line that may be kept, many more than any has."""


def read_complete_lines(path: Path, prefix: str) -> list[str]:
    """Return the lines of a file, none where there is no file, without what an interruption left of the last one.

    Parameters
    ----------
    path : Path
    prefix : str
        How every line begins: a last one that is cut and begins otherwise is somebody else's, and is returned like the others.

    Raises
    ------
    ParameterError
        If it cannot be read.

    Examples
    --------
    >>> read_complete_lines(Path("nothing.jsonl"), "{")
    []
    """
    if not path.exists():
        return []
    *complete, tail = read_bytes(path, str(path), ParameterError).decode(errors="replace").split("\n")
    return complete if tail[: len(prefix)] == prefix[: len(tail)] else [*complete, tail]


def append_line(path: Path, line: str) -> None:
    """Add a line, whole or not at all, in the place of what an interruption left of the last one.

    Raises
    ------
    OutputError
        If it cannot be written; the lines before are kept.

    Examples
    --------
    >>> import tempfile
    >>> path = Path(tempfile.mkdtemp()) / "kept.jsonl"
    >>> append_line(path, "{}")
    >>> read_complete_lines(path, "{")
    ['{}']
    """
    try:
        with path.open("a+b", buffering=0) as stream:
            size = stream.seek(0, os.SEEK_END)
            begin = stream.seek(max(size - MAX_LINE_BYTES, 0))
            end = stream.truncate(begin + stream.read(size - begin).rfind(b"\n") + 1)
            buffer = memoryview(f"{line}\n".encode())
            try:
                while buffer:  # a disk takes what it has room for, and then refuses
                    buffer = buffer[stream.write(buffer) :]
            except OSError:
                stream.truncate(end)
                raise
    except OSError as error:
        unchanged_note = lazy_gettext("; what was there is unchanged")
        raise OutputError("cannot write {target}: {reason}{kept}", target=path, reason=os_error_text(error), kept=unchanged_note) from error

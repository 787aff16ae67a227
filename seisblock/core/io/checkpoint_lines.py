"""Line-based checkpoint of a long study: one line per finished part, so that an interrupted run can be resumed."""

from __future__ import annotations

import os
from pathlib import Path

from seisblock.core.errors import OutputError, ParameterError, os_error_text
from seisblock.core.i18n import lazy_gettext
from seisblock.core.io.files import read_bytes

MAX_LINE_BYTES = 2**16
"""Maximum length of a line, bytes."""


def read_complete_lines(path: Path, prefix: str) -> list[str]:
    """Return the complete lines of a file, without an incomplete last line; no lines if the file does not exist.

    Parameters
    ----------
    path : Path
    prefix : str
        Beginning of every line; an incomplete last line that begins otherwise was not written by this program and is returned.

    Raises
    ------
    ParameterError
        If the file cannot be read.

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
    """Append a line atomically, in place of an incomplete last line.

    Raises
    ------
    OutputError
        If the line cannot be written; earlier lines are kept.

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
            # cut off an incomplete last line
            end = stream.truncate(begin + stream.read(size - begin).rfind(b"\n") + 1)
            buffer = memoryview(f"{line}\n".encode())
            try:
                # a full disk accepts part of the data before it raises
                while buffer:
                    buffer = buffer[stream.write(buffer) :]
            except OSError:
                stream.truncate(end)
                raise
    except OSError as error:
        unchanged_note = lazy_gettext("; the existing file is unchanged")
        raise OutputError("cannot write {target}: {reason}{kept}", target=path, reason=os_error_text(error), kept=unchanged_note) from error

"""A file to which a long study adds a line for each part that is finished, so that an interrupted run goes on where it was."""

from __future__ import annotations

import os
from pathlib import Path

from seisblock.contents import contents
from seisblock.errors import OutputError, ParameterError, reason
from seisblock.words import said

LONGEST_LINE = 2**16
"""Bytes of a line that may be kept, many more than any has."""


def kept_lines(path: Path, begins: str) -> list[str]:
    """Return the lines of a file, none where there is no file, without what an interruption left of the last one.

    Parameters
    ----------
    path : Path
    begins : str
        How every line begins: a last one that is cut and begins otherwise is somebody else's, and is returned like the others.

    Raises
    ------
    ParameterError
        If it cannot be read.

    Examples
    --------
    >>> kept_lines(Path("nothing.jsonl"), "{")
    []
    """
    if not path.exists():
        return []
    *whole, rest = contents(path, str(path), ParameterError).decode(errors="replace").split("\n")
    return whole if rest[: len(begins)] == begins[: len(rest)] else [*whole, rest]


def keep_line(path: Path, line: str) -> None:
    """Add a line, whole or not at all, in the place of what an interruption left of the last one.

    Raises
    ------
    OutputError
        If it cannot be written; the lines before are kept.

    Examples
    --------
    >>> import tempfile
    >>> path = Path(tempfile.mkdtemp()) / "kept.jsonl"
    >>> keep_line(path, "{}")
    >>> kept_lines(path, "{")
    ['{}']
    """
    try:
        with path.open("a+b", buffering=0) as stream:
            size = stream.seek(0, os.SEEK_END)
            begin = stream.seek(max(size - LONGEST_LINE, 0))
            end = stream.truncate(begin + stream.read(size - begin).rfind(b"\n") + 1)
            whole = memoryview(f"{line}\n".encode())
            try:
                while whole:  # a disk takes what it has room for, and then refuses
                    whole = whole[stream.write(whole) :]
            except OSError:
                stream.truncate(end)
                raise
    except OSError as error:
        kept = said("; what was there is unchanged")
        raise OutputError("cannot write {target}: {reason}{kept}", target=path, reason=reason(error), kept=kept) from error

"""Size-limited reading of files other than records: bodies, lists, tables, scans."""

from __future__ import annotations

import os
import stat
from pathlib import Path

from seisblock.core.errors import InputError, SeisblockError, os_error_text
from seisblock.core.io.overwrite import mark_read
from seisblock.core.limits import MIB, check_file_size

MAX_NAME_LENGTH = 200
"""Maximum length of a file name in messages."""


def check_no_device(path: Path, name: str, error: type[SeisblockError]) -> os.stat_result:
    """Return the status of a path.

    Raises
    ------
    SeisblockError
        Of that class, if the path is a character or block device, which may have no end.
    """
    info = path.stat()
    if stat.S_ISCHR(info.st_mode) or stat.S_ISBLK(info.st_mode):
        raise error("{name} is a device: give a regular file", name=name)
    return info


def read_bytes(path: Path, name: str, error: type[InputError]) -> bytes:
    """Return the content of a file or pipe and mark it as read.

    Parameters
    ----------
    path : Path
    name : str
        Name in messages.
    error : class
        Exception class.

    Raises
    ------
    InputError
        Of that class, if the path is a directory or a device, cannot be read, or exceeds the size limit.

    Examples
    --------
    >>> from seisblock.core.errors import BodyError
    >>> read_bytes(Path("nothing.toml"), "nothing.toml", BodyError)
    Traceback (most recent call last):
    seisblock.core.errors.BodyError: cannot read nothing.toml: No such file or directory
    """
    name = name[:MAX_NAME_LENGTH]
    pieces: list[bytes] = []
    size = 0
    try:
        check_file_size(check_no_device(path, name, error).st_size, name, error)
        mark_read(path)
        with path.open("rb") as stream:
            while piece := stream.read(MIB):
                pieces.append(piece)
                size += len(piece)
                # the size of a pipe is not known in advance
                check_file_size(size, name, error)
    except SeisblockError:
        # must not be caught below: OutputError is an OSError, too
        raise
    except OSError as failure:
        raise error("cannot read {name}: {reason}", name=name, reason=os_error_text(failure)) from failure
    return b"".join(pieces)

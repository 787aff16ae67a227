"""The bytes of a file that is no record: a body, a list, a table, a scan; as many as may be read, and noted as read."""

from __future__ import annotations

import stat
from pathlib import Path

from seisblock.core.errors import InputError, SeisblockError, os_error_text
from seisblock.core.i18n import N_
from seisblock.core.io.overwrite import mark_read
from seisblock.core.limits import MIB, check_limit

MAX_NAME_LENGTH = 200
"""How much of a name a message shows at most."""


def read_bytes(path: Path, name: str, error: type[InputError]) -> bytes:
    """Return the bytes of a file or of a pipe.

    Parameters
    ----------
    path : Path
    name : str
        What messages call it.
    error : class
        Raised where it cannot be had.

    Raises
    ------
    InputError
        Of that class, if it is a directory or a device, cannot be read, or holds more than may be read.

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
        info = path.stat()
        if stat.S_ISCHR(info.st_mode) or stat.S_ISBLK(info.st_mode):
            raise error("{name} is a device: give a file", name=name)
        _check_size(info.st_size, name, error)
        mark_read(path)
        with path.open("rb") as stream:
            while piece := stream.read(MIB):
                pieces.append(piece)
                size += len(piece)
                _check_size(size, name, error)  # a pipe does not say how much comes
    except SeisblockError:  # some of them are an OSError, too
        raise
    except OSError as failure:
        raise error("cannot read {name}: {reason}", name=name, reason=os_error_text(failure)) from failure
    return b"".join(pieces)


def _check_size(size: int, name: str, error: type[InputError]) -> None:
    """Refuse more bytes than may be read."""
    check_limit(N_("MiB of a file"), -(-size // MIB), "SEISBLOCK_READ_MIB", source=name, error=error)

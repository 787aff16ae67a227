"""The bytes of a file that is no record: a body, a list, a table, a scan; as many as may be read, and noted as read."""

from __future__ import annotations

import stat
from pathlib import Path

from seisblock.errors import InputError, SeisblockError, reason
from seisblock.ledger import reading
from seisblock.limits import MIB, check_budget
from seisblock.words import noted

LONGEST_SHOWN = 200
"""How much of a name a message shows at most."""


def contents(path: Path, name: str, error: type[InputError]) -> bytes:
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
    >>> from seisblock.errors import BodyError
    >>> contents(Path("nothing.toml"), "nothing.toml", BodyError)
    Traceback (most recent call last):
    seisblock.errors.BodyError: cannot read nothing.toml: No such file or directory
    """
    name = name[:LONGEST_SHOWN]
    pieces: list[bytes] = []
    found = 0
    try:
        info = path.stat()
        if stat.S_ISCHR(info.st_mode) or stat.S_ISBLK(info.st_mode):
            raise error("{name} is a device: give a file", name=name)
        _check(info.st_size, name, error)
        reading(path)
        with path.open("rb") as stream:
            while piece := stream.read(MIB):
                pieces.append(piece)
                found += len(piece)
                _check(found, name, error)  # a pipe does not say how much comes
    except SeisblockError:  # some of them are an OSError, too
        raise
    except OSError as failure:
        raise error("cannot read {name}: {reason}", name=name, reason=reason(failure)) from failure
    return b"".join(pieces)


def _check(size: int, name: str, error: type[InputError]) -> None:
    """Refuse more bytes than may be read."""
    check_budget(noted("MiB of a file"), -(-size // MIB), "SEISBLOCK_READ_MIB", where=name, error=error)

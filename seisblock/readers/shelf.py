"""Where members of a bundle wait for the rest of their set: in memory while they are few, else in a temporary file."""

from __future__ import annotations

import tempfile
from collections.abc import Hashable
from contextlib import ExitStack
from dataclasses import dataclass, field
from typing import IO, NamedTuple

from seisblock.errors import RecordError, reason
from seisblock.readers.source import LARGE, Blob


class _Kept(NamedTuple):
    """What was put away: its name, and where its bytes are."""

    name: str
    begin: int
    size: int


@dataclass
class Shelf:
    """Bytes put away under a key; not held in memory beyond some.

    Parameters
    ----------
    in_memory : int
        Bytes from which on a temporary file holds them.

    Examples
    --------
    >>> with Shelf() as shelf:
    ...     waiting = [shelf.put("station", Blob(name, b"1")) for name in ("a.NS", "a.EW")]
    ...     waiting, [blob.name for blob in shelf.take("station")]
    ([1, 2], ['a.NS', 'a.EW'])
    """

    in_memory: int = LARGE
    _sets: dict[Hashable, list[_Kept]] = field(default_factory=dict, init=False)
    _file: IO[bytes] = field(init=False)
    _open: ExitStack = field(default_factory=ExitStack, init=False)

    def __enter__(self) -> Shelf:
        self._file = self._open.enter_context(tempfile.SpooledTemporaryFile(self.in_memory))
        return self

    def __exit__(self, *_: object) -> None:
        self._open.close()

    def put(self, key: Hashable, blob: Blob) -> int:
        """Put a member away, and return how many wait under its key.

        Raises
        ------
        RecordError
            If the temporary file has no room.
        """
        waiting = self._sets.setdefault(key, [])
        try:
            begin = self._file.seek(0, 2)
            self._file.write(blob.data)
        except OSError as error:
            raise RecordError(
                "{name} cannot be put away until the rest of its set is unpacked, in {folder}: {reason}",
                name=blob.name,
                folder=tempfile.gettempdir(),
                reason=reason(error),
            ) from error
        waiting.append(_Kept(blob.name, begin, len(blob.held)))
        return len(waiting)

    def take(self, key: Hashable) -> list[Blob]:
        """Take what waits under a key, in the order in which it was put away."""
        found = [self._bytes(kept) for kept in self._sets.pop(key)]
        if not self._sets:
            self._file.seek(0)
            self._file.truncate()
        return found

    @property
    def keys(self) -> list[Hashable]:
        """The keys under which something waits, the oldest first."""
        return list(self._sets)

    def _bytes(self, kept: _Kept) -> Blob:
        """Return a member with its bytes."""
        self._file.seek(kept.begin)
        return Blob(kept.name, self._file.read(kept.size))

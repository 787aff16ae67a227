"""Spooled buffer that groups archive members by recording: in memory while small, else in a temporary file."""

from __future__ import annotations

import tempfile
from collections.abc import Hashable
from contextlib import ExitStack
from dataclasses import dataclass, field
from typing import IO, NamedTuple

from seisblock.core.errors import RecordError, os_error_text
from seisblock.readers.source import LARGE_FILE_BYTES, RawFile


class _BufferedMember(NamedTuple):
    """Name of a member and position of its bytes in the buffer file."""

    name: str
    begin: int
    size: int


@dataclass
class MemberBuffer:
    """Archive members grouped by key, spooled to a temporary file beyond `in_memory` bytes.

    Examples
    --------
    >>> with MemberBuffer() as buffer:
    ...     counts = [buffer.add("station", RawFile(name, b"1")) for name in ("a.NS", "a.EW")]
    ...     counts, [blob.name for blob in buffer.pop("station")]
    ([1, 2], ['a.NS', 'a.EW'])
    """

    in_memory: int = LARGE_FILE_BYTES
    _sets: dict[Hashable, list[_BufferedMember]] = field(default_factory=dict, init=False)
    _file: IO[bytes] = field(init=False)
    _open: ExitStack = field(default_factory=ExitStack, init=False)

    def __enter__(self) -> MemberBuffer:
        self._file = self._open.enter_context(tempfile.SpooledTemporaryFile(self.in_memory))
        return self

    def __exit__(self, *_: object) -> None:
        self._open.close()

    def add(self, key: Hashable, blob: RawFile) -> int:
        """Store a member and return the number of members under its key; raise RecordError if the file cannot be written."""
        members = self._sets.setdefault(key, [])
        try:
            begin = self._file.seek(0, 2)
            self._file.write(blob.data)
        except OSError as error:
            message = "{name}: cannot write a temporary file in {folder}: {reason}"
            raise RecordError(message, name=blob.name, folder=tempfile.gettempdir(), reason=os_error_text(error)) from error
        members.append(_BufferedMember(blob.name, begin, len(blob.content)))
        return len(members)

    def pop(self, key: Hashable) -> list[RawFile]:
        """Remove and return the members under a key, in the order added."""
        members = [self._read_member(member) for member in self._sets.pop(key)]
        # reuse the space when nothing is buffered
        if not self._sets:
            self._file.seek(0)
            self._file.truncate()
        return members

    @property
    def keys(self) -> list[Hashable]:
        """Keys with members, the oldest first."""
        return list(self._sets)

    def _read_member(self, member: _BufferedMember) -> RawFile:
        self._file.seek(member.begin)
        return RawFile(member.name, self._file.read(member.size))

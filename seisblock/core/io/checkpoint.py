"""The rows of a batch while it runs: each record's as soon as they are there, so that an interruption loses none of them."""

from __future__ import annotations

import contextlib
import hashlib
import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from seisblock.core.errors import OutputError, os_error_text
from seisblock.core.io.locking import file_lock

Key = tuple[str, str]
"""Where a record is, and what tells its bytes."""


def checkpoint_path(target: Path) -> Path:
    """Return the file in which the rows of a table are kept until it is whole."""
    return target.with_name(target.name + ".journal")


@contextlib.contextmanager
def lock_checkpoint(path: Path) -> Iterator[None]:
    """Keep other runs from a journal, which is made if need be, inside the block.

    Raises
    ------
    OutputError
        If another run writes it, or it cannot be written.
    """
    with _os_errors(path):
        path.touch()
    with file_lock(path) as exclusive:
        if not exclusive:
            raise OutputError("{path} is written by another run: let it end, or give the table another name", path=path)
        yield


@dataclass(eq=False)
class Checkpoint:
    """Rows on disk, a line for each record; the first line says of what.

    Parameters
    ----------
    path : Path
    places : dict of key to int
        Where the line of each finished record begins.
    damaged : int
        Lines that are not as they were written, which are passed over.
    """

    path: Path
    places: dict[Key, int] = field(default_factory=dict)
    damaged: int = 0

    @classmethod
    def begin(cls, path: Path, purpose: Mapping[str, str]) -> Checkpoint:
        """Begin a new journal; one that is there is overwritten.

        Raises
        ------
        OutputError
            If it cannot be written.
        """
        with _os_errors(path):
            try:
                path.write_bytes(_encode_line(purpose))
            except OSError:
                path.unlink()  # nothing of a batch is in it
                raise
        return cls(path)

    @classmethod
    def resume(cls, path: Path, purpose: Mapping[str, str]) -> Checkpoint:
        """Go on with a journal: a line that an interruption cut is taken away, and one that was damaged counts as not written.

        Raises
        ------
        OutputError
            If it cannot be read, is of something else, or does not say of what.
        """
        journal = cls(path)
        with _os_errors(path), path.open("r+b") as stream:
            header = _decode_line(stream.readline())
            if header is None:
                raise OutputError("{path} is damaged in its first line, which says of what it is: begin anew", path=path)
            if header != dict(purpose):
                raise OutputError(
                    "{path} was begun with other bodies, options or another version: begin anew, or finish it as it was begun", path=path
                )
            end = stream.tell()
            while line := stream.readline():
                entry = _decode_line(line)
                if entry is not None:
                    journal.places[entry["path"], entry["stamp"]] = end
                elif line.endswith(b"\n"):
                    journal.damaged += 1
                else:
                    break
                end = stream.tell()
            stream.truncate(end)
        return journal

    def append(self, key: Key, rows: Sequence[Mapping[str, Any]]) -> None:
        """Write the rows of a finished record down.

        Raises
        ------
        OutputError
            If the disk is full; the rows of the records before are kept.
        """
        line = _encode_line({"path": key[0], "stamp": key[1], "rows": [dict(row) for row in rows]})
        with _os_errors(self.path), self.path.open("ab") as stream:
            offset = stream.tell()
            try:
                stream.write(line)
                stream.flush()
            except OSError:
                stream.truncate(offset)
                raise
        self.places[key] = offset

    def rows(self, key: Key) -> list[dict[str, Any]]:
        """Return the rows of a finished record."""
        with _os_errors(self.path), self.path.open("rb") as stream:
            stream.seek(self.places[key])
            line = _decode_line(stream.readline())
        if line is None:
            raise OutputError("{path} changed while it was read: --resume computes anew what is damaged", path=self.path)
        stored: list[dict[str, Any]] = line["rows"]
        return stored

    def remove(self) -> None:
        """Take the journal away: its table is written."""
        self.path.unlink(missing_ok=True)


def _encode_line(content: Mapping[str, Any]) -> bytes:
    """Return a line that can be told from a damaged one; floats keep all their digits."""
    payload = json.dumps(dict(content), ensure_ascii=False).encode(errors="surrogatepass")  # names of files need not be text
    return _checksum(payload) + b" " + payload + b"\n"


def _decode_line(line: bytes) -> dict[str, Any] | None:
    """Return what a line says, None where it is not as it was written."""
    check, _, payload = line.rstrip(b"\n").partition(b" ")
    if not line.endswith(b"\n") or check != _checksum(payload):
        return None
    content: dict[str, Any] = json.loads(payload)
    return content


def _checksum(payload: bytes) -> bytes:
    """Return what changes with any damage that disks and editors do."""
    return hashlib.blake2b(payload, digest_size=8).hexdigest().encode()


@contextlib.contextmanager
def _os_errors(path: Path) -> Iterator[None]:
    """Say in one sentence what the disk refuses."""
    try:
        yield
    except OSError as error:
        raise OutputError("cannot write {target}: {reason}{kept}", target=path, reason=os_error_text(error), kept="") from error

"""Checkpoint file of a long run: the rows of each finished part (record, sine), one checksummed JSON line per part."""

from __future__ import annotations

import contextlib
import hashlib
import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from seisblock.core.errors import OutputError, SeisblockError, os_error_text
from seisblock.core.io.files import check_no_device
from seisblock.core.io.locking import file_lock

MAX_HEADER_BYTES = 2**16
"""Maximum length of the header line, bytes: a file of another kind need not have lines."""

Key = tuple[str, str]
"""Path of a record and digest of its content, or two other strings that identify a part of the run."""


def checkpoint_path(target: Path) -> Path:
    """Return the path of the checkpoint of an output table."""
    return target.with_name(target.name + ".journal")


@contextlib.contextmanager
def lock_checkpoint(path: Path) -> Iterator[None]:
    """Hold an exclusive lock on a checkpoint inside the block; create the file if necessary.

    Raises
    ------
    OutputError
        If another run holds the lock, or the file cannot be written.
    """
    with _os_errors(path):
        path.touch()
    with file_lock(path) as exclusive:
        if not exclusive:
            raise OutputError("{path} is in use by another run: wait for its end or choose another output name", path=path)
        yield


@dataclass(eq=False)
class Checkpoint:
    """Rows on disk, one line per finished part, after a header line that identifies the run.

    Parameters
    ----------
    path : Path
    places : dict of key to int
        Byte offset of the line of each finished part.
    damaged : int
        Number of lines skipped because of a wrong checksum.
    """

    path: Path
    places: dict[Key, int] = field(default_factory=dict)
    damaged: int = 0

    @classmethod
    def open(cls, path: Path, purpose: Mapping[str, str]) -> Checkpoint:
        """Resume a checkpoint if the file exists, else begin one.

        Raises
        ------
        OutputError
            As of :meth:`begin` and :meth:`resume`.
        """
        return cls.resume(path, purpose) if path.exists() else cls.begin(path, purpose)

    @classmethod
    def begin(cls, path: Path, purpose: Mapping[str, str]) -> Checkpoint:
        """Create a checkpoint, overwriting an existing one.

        Raises
        ------
        OutputError
            If the file cannot be written.
        """
        with _os_errors(path):
            try:
                path.write_bytes(_encode_line(purpose))
            except OSError:
                # the file holds no rows yet
                path.unlink()
                raise
        return cls(path)

    @classmethod
    def resume(cls, path: Path, purpose: Mapping[str, str]) -> Checkpoint:
        """Open an existing checkpoint; remove an incomplete last line and ignore damaged lines.

        Raises
        ------
        OutputError
            If the file cannot be read, or its header is damaged or belongs to another run.
        """
        journal = cls(path)
        check_no_device(path, str(path), OutputError)
        with _os_errors(path), path.open("r+b") as stream:
            header = _decode_line(stream.readline(MAX_HEADER_BYTES))
            if header is None:
                raise OutputError(
                    "{path}: the first line is no header of an interrupted run, or damaged; start a new run or give another file", path=path
                )
            if header != dict(purpose):
                raise OutputError(
                    "{path} belongs to a run with other bodies, options or version: start a new run or repeat the original call",
                    path=path,
                )
            end = stream.tell()
            while line := stream.readline():
                entry = _decode_line(line)
                if entry is not None:
                    journal.places[entry["path"], entry["stamp"]] = end
                # a complete but damaged line is recomputed; an incomplete one is the last and is cut off below
                elif line.endswith(b"\n"):
                    journal.damaged += 1
                else:
                    break
                end = stream.tell()
            stream.truncate(end)
        return journal

    def append(self, key: Key, rows: Sequence[Mapping[str, Any]]) -> None:
        """Append the rows of a finished part.

        Raises
        ------
        OutputError
            If the disk is full; the rows of earlier parts are kept.
        """
        line = _encode_line({"path": key[0], "stamp": key[1], "rows": [dict(row) for row in rows]})
        with _os_errors(self.path), self.path.open("ab", buffering=0) as stream:
            offset = stream.tell()
            try:
                # a full disk accepts part of the data before it raises
                while line:
                    line = line[stream.write(line) :]
            except OSError:
                stream.truncate(offset)
                raise
        self.places[key] = offset

    def rows(self, key: Key) -> list[dict[str, Any]]:
        """Return the rows of a finished part."""
        with _os_errors(self.path), self.path.open("rb") as stream:
            stream.seek(self.places[key])
            line = _decode_line(stream.readline())
        if line is None:
            raise OutputError("{path} changed during reading: resume the run to recompute the damaged rows", path=self.path)
        stored: list[dict[str, Any]] = line["rows"]
        return stored

    def remove(self) -> None:
        """Delete the checkpoint after the table has been written."""
        self.path.unlink(missing_ok=True)


def _encode_line(content: Mapping[str, Any]) -> bytes:
    """Return checksum, JSON and line end; floats keep all digits."""
    # surrogatepass: file names need not be valid UTF-8
    payload = json.dumps(dict(content), ensure_ascii=False).encode(errors="surrogatepass")
    return _checksum(payload) + b" " + payload + b"\n"


def _decode_line(line: bytes) -> dict[str, Any] | None:
    """Return the content of a line, None if the checksum does not match."""
    check, _, payload = line.rstrip(b"\n").partition(b" ")
    if not line.endswith(b"\n") or check != _checksum(payload):
        return None
    content: dict[str, Any] = json.loads(payload)
    return content


def _checksum(payload: bytes) -> bytes:
    return hashlib.blake2b(payload, digest_size=8).hexdigest().encode()


@contextlib.contextmanager
def _os_errors(path: Path) -> Iterator[None]:
    """Convert OSError to OutputError."""
    try:
        yield
    except SeisblockError:
        # OutputError is an OSError, too
        raise
    except OSError as error:
        raise OutputError("cannot write {target}: {reason}{kept}", target=path, reason=os_error_text(error), kept="") from error

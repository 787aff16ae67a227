"""Which bytes a name stands for."""

from __future__ import annotations

import codecs
import hashlib
import io
import os
import re
import stat
import sys
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from seisblock.core.errors import RecordError, RecordFormatError, RecordNotFoundError, os_error_text
from seisblock.core.io.overwrite import mark_read
from seisblock.readers.limits import ReadBudget
from seisblock.samples import find_sample, list_samples

if TYPE_CHECKING:
    from _typeshed import WriteableBuffer

Location: TypeAlias = "str | PathLike[str]"

STDIN = "-"
"""The name that stands for the standard input."""

MAX_QUOTED_LENGTH = 200
"""How much of a text from outside a message shows at most."""


HEAD_BYTES = 2**16
"""Bytes by which an encoding is told."""

_HALF_WIDTH_KANA = re.compile("[｡-ﾟ\uf8f0-\uf8f3]")
_TABLE_KANJI = re.compile("[時刻間秒南北東西上下方向成分速度動]")
"""Letters that bytes of EUC-JP give when they are read as Shift-JIS, and some that the headings of tables hold."""

LARGE_FILE_BYTES = 2**25
"""Bytes beyond which a file, or a text, is taken piece by piece."""


@dataclass(frozen=True)
class FileBytes:
    """The bytes of a large file, read where they are looked at, so that no memory of its size is needed.

    Parameters
    ----------
    path : Path
    name : str
        What messages call it.
    stamp : tuple of int
        Which file it was and when it was written last.
    """

    path: Path
    name: str
    stamp: tuple[int, ...]

    def __len__(self) -> int:
        return self.stamp[0]

    def __getitem__(self, index: slice) -> bytes:
        begin, stop, _ = index.indices(len(self))
        try:
            with self.path.open("rb") as stream:
                stream.seek(begin)
                data = stream.read(max(stop - begin, 0))
                is_unchanged = file_stamp(os.fstat(stream.fileno())) == self.stamp
        except OSError as error:
            raise RecordError("{name}: cannot read the file: {reason}", name=self.name, reason=os_error_text(error)) from error
        if not is_unchanged:
            raise RecordError("{name}: file changed while reading; read it again after it is complete", name=self.name)
        return data


class BytesReader(io.RawIOBase):
    """Bytes, held in memory or in their file, as a stream."""

    def __init__(self, content: bytes | FileBytes) -> None:
        self._content, self._position = content, 0

    def readable(self) -> bool:
        """Return True."""
        return True

    def seekable(self) -> bool:
        """Return True."""
        return True

    def seek(self, offset: int, whence: int = io.SEEK_SET, /) -> int:
        """Go to a place, told from the beginning, from here or from the end; return where that is."""
        self._position = max(offset + {io.SEEK_SET: 0, io.SEEK_CUR: self._position, io.SEEK_END: len(self._content)}[whence], 0)
        return self._position

    def readinto(self, buffer: WriteableBuffer, /) -> int:
        """Fill a buffer as far as there are bytes; return how many."""
        view = memoryview(buffer).cast("B")
        data = self._content[self._position : self._position + len(view)]
        view[: len(data)] = data
        self._position += len(data)
        return len(data)


def file_stamp(info: os.stat_result) -> tuple[int, ...]:
    """Return what tells a file from another, or from what it was before: its size first."""
    return info.st_size, info.st_mtime_ns, info.st_dev, info.st_ino


@dataclass(frozen=True)
class RawFile:
    """The bytes of one file, or of one member of a bundle, and the name they go by in messages."""

    name: str
    content: bytes | FileBytes
    path: Path | None = None

    @property
    def data(self) -> bytes:
        """All of the bytes."""
        return self.content if isinstance(self.content, bytes) else self.content[:]

    def chunks(self) -> Iterator[bytes]:
        """Yield the bytes, many at a time, each with the one that follows it."""
        for begin in range(0, len(self.content), LARGE_FILE_BYTES):
            yield self.content[begin : begin + LARGE_FILE_BYTES + 1]

    @property
    def basename(self) -> str:
        """Last part of the name."""
        return self.name.replace("\\", "/").rsplit("/", 1)[-1]


def open_source(source: Location, budget: ReadBudget) -> RawFile:
    """Return the bytes of a file, of the bundled sample of that name, or of the standard input.

    Parameters
    ----------
    source : path
        ``-`` is the standard input.
    budget : Budget
        What may be read.

    Raises
    ------
    RecordNotFoundError
        If there is neither a file nor a sample of that name.
    RecordError
        If it is a directory or a device, is empty, cannot be read, or exceeds the budget.
    """
    name = str(source)
    if name == STDIN:
        blob = RawFile("standard input", budget.read("standard input", sys.stdin.buffer))
    else:
        path = resolve_path(source)
        blob = RawFile(name, read_bytes(path, name, budget), path)
    if not any(not piece.isspace() for piece in blob.chunks()):
        raise RecordError("{name}: empty file; expected a strong-motion record", name=blob.name)
    return blob


def read_bytes(path: Path, name: str, budget: ReadBudget) -> bytes | FileBytes:
    """Return the bytes of a file, or of a pipe, as far as the budget goes; those of a large file stay there.

    Parameters
    ----------
    path : Path
    name : str
        What messages call it.
    budget : Budget

    Raises
    ------
    RecordError
        If it is a directory or a device, cannot be read, or exceeds the budget.
    """
    try:
        info = path.stat()
        if stat.S_ISDIR(info.st_mode):
            raise RecordError("{name} is a folder: give a record file in it", name=name)
        if stat.S_ISCHR(info.st_mode) or stat.S_ISBLK(info.st_mode):
            raise RecordError("{name} is a device: give a file, or - for the standard input", name=name)
        budget.check_declared_size(name, info.st_size)
        mark_read(path)
        if stat.S_ISREG(info.st_mode) and info.st_size > LARGE_FILE_BYTES:
            budget.bytes_read += info.st_size
            return FileBytes(path, name, file_stamp(info))
        with path.open("rb") as stream:
            return budget.read(name, stream)
    except OSError as error:
        raise RecordError("{name}: cannot read the file: {reason}", name=name, reason=os_error_text(error)) from error


def resolve_path(source: Location) -> Path:
    """Return the path of a file, or of the bundled sample of that name."""
    name = str(source)
    path = Path(name)
    try:
        if path.exists():
            return path
        if name.startswith("~") and path.expanduser().exists():
            return path.expanduser()
    except (OSError, RuntimeError, ValueError) as error:  # too long, no such home, a NUL in it
        raise RecordNotFoundError(
            "invalid file name {name!r}: {reason}", name=name[:MAX_QUOTED_LENGTH], reason=_error_reason(error)
        ) from error
    sample = find_sample(name) if path.name == name else None
    if sample is None:
        sample_names = [s.name for s in list_samples() if s.kind == "record"]
        raise RecordNotFoundError("{name}: no such file or bundled sample (samples: {known})", name=name, known=sample_names)
    return sample


def _error_reason(error: Exception) -> str:
    """Return why a name was refused, without the name."""
    return os_error_text(error) if isinstance(error, OSError) and error.strerror else str(error)[:MAX_QUOTED_LENGTH]


def sha256_digest(blobs: Iterable[RawFile]) -> str:
    """Return the SHA-256 of the bytes, one after the other."""
    total = hashlib.sha256()
    for blob in blobs:
        for piece in blob.chunks():
            total.update(memoryview(piece)[:LARGE_FILE_BYTES])
    return total.hexdigest()


def decode_text(blob: RawFile) -> str:
    """Return the text of a file in UTF-8 (with or without BOM), UTF-16 with BOM, Shift-JIS (cp932) or EUC-JP, lines ending in LF.

    Raises
    ------
    RecordFormatError
        If the bytes are not text.
    """
    data = blob.data
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        encodings = ["utf-16"]
    elif is_binary(data):
        encodings = []
    else:
        encodings = ["utf-8-sig", *japanese_encodings(data)]
    for encoding in encodings:
        try:
            return data.decode(encoding).replace("\r\n", "\n").replace("\r", "\n")
        except UnicodeDecodeError:
            continue
    raise RecordFormatError("{name}: not a text file (UTF-8, Shift-JIS or EUC-JP): expected a record in a text format", name=blob.name)


def japanese_encodings(data: bytes) -> tuple[str, str]:
    """Return the two encodings of Japanese, the likelier first: what EUC-JP means looks like half-width kana in Shift-JIS.

    Examples
    --------
    >>> japanese_encodings("UD方向(gal)".encode("euc_jp"))[0], japanese_encodings("UD方向(gal)".encode("cp932"))[0]
    ('euc_jp', 'cp932')
    """
    head = data[:HEAD_BYTES]
    try:
        as_euc = head.decode("euc_jp", errors="ignore" if len(data) > HEAD_BYTES else "strict")
    except UnicodeDecodeError:
        return "cp932", "euc_jp"
    kana = _HALF_WIDTH_KANA.search(head.decode("cp932", errors="ignore"))
    return ("euc_jp", "cp932") if kana and _TABLE_KANJI.search(as_euc) else ("cp932", "euc_jp")


def is_binary(data: bytes) -> bool:
    """Return whether bytes hold control characters that no text has."""
    head = data[:HEAD_BYTES]
    return any(byte in head for byte in (b"\x00", b"\x01", b"\x02", b"\x03", b"\x04", b"\x05", b"\x06", b"\x7f"))

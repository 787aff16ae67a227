"""Access to the bytes of a source: file, bundled sample or standard input."""

from __future__ import annotations

import codecs
import hashlib
import io
import os
import re
import stat
import sys
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
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
"""Name of the standard input."""

MAX_QUOTED_LENGTH = 200
"""Longest text from a file or an exception quoted in a message, letters."""


HEAD_BYTES = 2**16
"""Bytes examined to determine the encoding."""

_HALF_WIDTH_KANA = re.compile("[｡-ﾟ\uf8f0-\uf8f3]")
_TABLE_KANJI = re.compile("[時刻間秒南北東西上下方向成分速度動时间东竖垂直]")
_ACCENTED = re.compile(rb"(?<=[A-Za-z])[\xc0-\xff](?:[\xc0-\xff](?=[a-z]))?(?![\x80-\xff])")
_NOT_EUROPEAN = re.compile(rb"[\x80-\xaf\xb1\xb3-\xff]")
"""Half-width kana that other bytes give when decoded as Shift-JIS; kanji common in table headings; accented letters within European words,
and bytes that beside them are neither a degree sign nor a superscript."""

LARGE_FILE_BYTES = 2**25
"""Size above which files and texts are processed in chunks."""


@dataclass(frozen=True)
class FileBytes:
    """Bytes of a large file, read on access; `stamp` is its identity and modification time when opened, `name` its name in messages."""

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
                # after reading, so that a change during the read is noticed, too
                is_unchanged = file_stamp(os.fstat(stream.fileno())) == self.stamp
        except OSError as error:
            raise RecordError("{name}: cannot read the file: {reason}", name=self.name, reason=os_error_text(error)) from error
        if not is_unchanged:
            raise RecordError("{name}: file changed while reading; read it again after it is complete", name=self.name)
        return data


class BytesReader(io.RawIOBase):
    """Raw stream over bytes in memory or in a file."""

    def __init__(self, content: bytes | FileBytes) -> None:
        self._content, self._position = content, 0

    def readable(self) -> bool:
        """Return True."""
        return True

    def seekable(self) -> bool:
        """Return True."""
        return True

    def seek(self, offset: int, whence: int = io.SEEK_SET, /) -> int:
        """Set the position and return it."""
        self._position = max(offset + {io.SEEK_SET: 0, io.SEEK_CUR: self._position, io.SEEK_END: len(self._content)}[whence], 0)
        return self._position

    def readinto(self, buffer: WriteableBuffer, /) -> int:
        """Fill a buffer and return the number of bytes."""
        view = memoryview(buffer).cast("B")
        data = self._content[self._position : self._position + len(view)]
        view[: len(data)] = data
        self._position += len(data)
        return len(data)


def file_stamp(info: os.stat_result) -> tuple[int, ...]:
    """Return the identity of a file version: size, modification time, device and inode."""
    return info.st_size, info.st_mtime_ns, info.st_dev, info.st_ino


@dataclass(frozen=True)
class RawFile:
    """Bytes of a file or archive member, with its name for messages."""

    name: str
    content: bytes | FileBytes
    path: Path | None = None

    @property
    def data(self) -> bytes:
        """All bytes."""
        return self.content if isinstance(self.content, bytes) else self.content[:]

    def chunks(self) -> Iterator[bytes]:
        """Yield the bytes in chunks, each with the first byte of the next."""
        for begin in range(0, len(self.content), LARGE_FILE_BYTES):
            yield self.content[begin : begin + LARGE_FILE_BYTES + 1]

    @property
    def basename(self) -> str:
        """Last part of the name."""
        return self.name.replace("\\", "/").rsplit("/", 1)[-1]


def open_source(source: Location, budget: ReadBudget) -> RawFile:
    """Return the bytes of a file, a bundled sample or, for ``-``, the standard input.

    Raises
    ------
    RecordNotFoundError
        If neither a file nor a sample has that name.
    RecordError
        If the source is a directory or a device, is empty, cannot be read, or exceeds a limit.
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
    """Return the bytes of a file or pipe within the limits; large files are read on access.

    Raise RecordError if the path is a directory or a device, cannot be read, or exceeds a limit; `name` is the source in messages.
    """
    try:
        info = path.stat()
        if stat.S_ISDIR(info.st_mode):
            raise RecordError("{name} is a folder: give a record file in it", name=name)
        # devices such as /dev/zero never end
        if stat.S_ISCHR(info.st_mode) or stat.S_ISBLK(info.st_mode):
            raise RecordError("{name} is a device: give a file, or - for the standard input", name=name)
        budget.check_declared_size(name, info.st_size)
        mark_read(path)
        if stat.S_ISREG(info.st_mode) and info.st_size > LARGE_FILE_BYTES:
            # counted once, though the file may be read several times
            budget.bytes_read += info.st_size
            return FileBytes(path, name, file_stamp(info))
        with path.open("rb") as stream:
            return budget.read(name, stream)
    except OSError as error:
        raise RecordError("{name}: cannot read the file: {reason}", name=name, reason=os_error_text(error)) from error


def resolve_path(source: Location) -> Path:
    """Return the path of a file or of a bundled sample."""
    name = str(source)
    path = Path(name)
    try:
        if path.exists():
            return path
        if name.startswith("~") and path.expanduser().exists():
            return path.expanduser()
    except (OSError, RuntimeError, ValueError) as error:  # name too long, unknown home directory, or NUL character
        raise RecordNotFoundError(
            "invalid file name {name!r}: {reason}", name=name[:MAX_QUOTED_LENGTH], reason=_error_reason(error)
        ) from error
    sample = find_sample(name) if path.name == name else None
    if sample is None:
        if re.match(r"[a-z]+:[^/\\]+@", name, re.IGNORECASE):
            raise RecordNotFoundError(
                "{text!r} is not an analytic motion; write, for example, sine:300gal@1.5Hz,10s or pulse:300gal@1.5Hz", text=name
            )
        sample_names = [s.name for s in list_samples() if s.kind == "record"]
        raise RecordNotFoundError("{name}: no such file or bundled sample (samples: {known})", name=name, known=sample_names)
    return sample


def _error_reason(error: Exception) -> str:
    """Return the reason of an error, without the file name."""
    return os_error_text(error) if isinstance(error, OSError) and error.strerror else str(error)[:MAX_QUOTED_LENGTH]


def sha256_digest(blobs: Iterable[RawFile]) -> str:
    """Return the SHA-256 of the concatenated bytes."""
    total = hashlib.sha256()
    for blob in blobs:
        for piece in blob.chunks():
            total.update(memoryview(piece)[:LARGE_FILE_BYTES])
    return total.hexdigest()


def normalize_text(blob: RawFile) -> RawFile:
    """Return a text file without byte order mark, DOS end-of-file characters and CR line ends; other files and large ones unchanged.

    UTF-16 with a byte order mark becomes UTF-8. Formats are recognised from the first bytes, and some are decoded by ObsPy.
    """
    data = blob.content
    if not isinstance(data, bytes):
        return blob
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        data = data[: len(data) // 2 * 2].decode("utf-16", "replace").encode()
    elif is_binary(data):
        return blob
    data = data.removeprefix(codecs.BOM_UTF8)
    if b"\n" not in data[:HEAD_BYTES] and b"\r" in data[:HEAD_BYTES]:
        data = data.replace(b"\r", b"\n")
    if b"\x1a" in data[-HEAD_BYTES:]:
        data = re.sub(rb"(?:\x1a\s*)+\Z", b"", data)
    return blob if data is blob.content else replace(blob, content=data)


def decode_text(blob: RawFile) -> str:
    """Return the text of a file in one of :func:`text_encodings`, or UTF-16 with BOM, with LF line ends.

    Raise RecordFormatError if the bytes are none of these.
    """
    data = blob.data
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        encodings: tuple[str, ...] = ("utf-16",)
    else:
        encodings = () if is_binary(data) else text_encodings(data)
    for encoding in encodings:
        try:
            return data.decode(encoding).replace("\r\n", "\n").replace("\r", "\n")
        except UnicodeDecodeError:
            continue
    raise RecordFormatError("{name}: not a text file (UTF-8, Shift-JIS or EUC-JP): expected a record in a text format", name=blob.name)


def text_encodings(data: bytes) -> tuple[str, ...]:
    """Return the encodings of a text, the most probable first: UTF-8, then those of Japan, of China, or of Europe with Turkey.

    Examples
    --------
    >>> [text_encodings(text.encode(e))[1] for text, e in (("UD方向", "euc_jp"), ("UD方向", "cp932"), ("东西向", "gb18030"))]
    ['euc_jp', 'cp932', 'gb18030']
    >>> text_encodings("Aceleración N-S (gal)".encode("cp1254"))[1]
    'cp1254'
    """
    head = data[:HEAD_BYTES]
    if head.isascii():
        return ("utf-8-sig", "cp932", "euc_jp")
    without_accents = _ACCENTED.sub(b"", head)
    if without_accents != head and not _NOT_EUROPEAN.search(without_accents):
        return ("utf-8-sig", "cp1254")
    texts: dict[str, str] = {}
    for encoding in ("cp932", "euc_jp", "gb18030", "big5"):
        try:
            texts[encoding] = head.decode(encoding, errors="ignore" if len(data) > HEAD_BYTES else "strict")
        except UnicodeDecodeError:
            continue
    # other encodings decoded as Shift-JIS yield half-width kana; require kanji of table headings before preferring them
    if "cp932" in texts and not _HALF_WIDTH_KANA.search(texts["cp932"]):
        return ("utf-8-sig", "cp932", "euc_jp")
    counts = {encoding: len(_TABLE_KANJI.findall(text)) for encoding, text in texts.items()}
    best = max(counts, key=lambda encoding: counts[encoding], default="cp932")
    return tuple(dict.fromkeys(("utf-8-sig", *([best] if counts.get(best) else []), "cp932", "euc_jp")))


def is_binary(data: bytes) -> bool:
    """Return whether bytes contain control characters that do not occur in text."""
    head = data[:HEAD_BYTES]
    return any(byte in head for byte in (b"\x00", b"\x01", b"\x02", b"\x03", b"\x04", b"\x05", b"\x06", b"\x7f"))

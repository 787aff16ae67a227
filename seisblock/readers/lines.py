"""Lines of text files; lines of large files are decoded on access, chunk by chunk."""

from __future__ import annotations

import codecs
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import overload

import numpy as np

from seisblock.core.errors import RecordFormatError
from seisblock.core.i18n import lazy_gettext
from seisblock.core.typing import IntArray
from seisblock.readers import source
from seisblock.readers.source import FileBytes, RawFile, decode_text, is_binary

DOS_EOF = "\x1a"
"""End-of-file character of DOS text files."""

CHUNK_LINES = 2**16
"""Lines decoded at a time."""


@dataclass(frozen=True, eq=False)
class LazyLines(Sequence[str]):
    """Lines of a large text file, decoded on access.

    `offsets` are the byte offsets of every ``CHUNK_LINES``-th line, and of the end of the data; `begin` and `stop` the range of the lines
    in the file; `transforms` functions applied to each line, in this order.
    """

    data: bytes | FileBytes
    encoding: str
    offsets: IntArray
    begin: int
    stop: int
    transforms: tuple[Callable[[str], str], ...] = ()

    def __len__(self) -> int:
        return max(self.stop - self.begin, 0)

    @overload
    def __getitem__(self, index: int) -> str: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[str]: ...
    def __getitem__(self, index: int | slice) -> str | Sequence[str]:
        if isinstance(index, slice):
            begin, stop, _ = index.indices(len(self))
            return replace(self, begin=self.begin + begin, stop=self.begin + stop)
        place = range(self.begin, self.stop)[index]
        return self._transform(self._chunk(place // CHUNK_LINES)[place % CHUNK_LINES])

    def __iter__(self) -> Iterator[str]:
        for piece in self.chunks():
            yield from piece

    def chunks(self) -> Iterator[list[str]]:
        """Yield lists of lines."""
        for number in range(self.begin // CHUNK_LINES, -(-self.stop // CHUNK_LINES)):
            first = number * CHUNK_LINES
            lines = self._chunk(number)[max(self.begin - first, 0) : self.stop - first]
            yield [self._transform(line) for line in lines] if self.transforms else lines

    def _chunk(self, number: int) -> list[str]:
        """Return the lines of one chunk without transforms."""
        # chunk limits fall on line ends, which are single bytes in these encodings
        text = self.data[self.offsets[number] : self.offsets[number + 1]].decode(self.encoding).replace("\r\n", "\n")
        lines = text.split("\n")
        return lines if number + 2 == self.offsets.size else lines[:CHUNK_LINES]

    def _transform(self, line: str) -> str:
        for transform in self.transforms:
            line = transform(line)
        return line


def read_lines(blob: RawFile) -> Sequence[str]:
    """Return the lines of a text file, see :func:`~seisblock.readers.source.decode_text`; raise RecordFormatError if it is not text."""
    data = blob.content
    if len(data) < source.LARGE_FILE_BYTES or not _has_simple_line_ends(blob):
        return decode_text(blob).split("\n")
    offsets, count = _chunk_offsets(blob)
    for encoding in source.text_encodings(data[: source.HEAD_BYTES + 1]):
        lines = LazyLines(data, encoding, offsets, 0, count)
        try:
            # decode all chunks once: an invalid byte may occur anywhere
            for _ in lines.chunks():
                pass
        except UnicodeDecodeError:
            continue
        return lines
    raise RecordFormatError("{name}: not a text file (UTF-8, Shift-JIS or EUC-JP): expected a record in a text format", name=blob.name)


def read_trimmed_lines(blob: RawFile) -> list[str]:
    """Return the lines of a text file without DOS end-of-file characters and blank lines at the end."""
    return decode_text(blob).replace(DOS_EOF, "").rstrip().split("\n")


def line_error(message: str, name: str, line: int, /, **values: object) -> RecordFormatError:
    """Return the error of a line, counted from 1, of the file `name`; the template says what was expected, and what was found."""
    text = lazy_gettext(message, **values)
    return RecordFormatError("{name}, line {line}: {what}; correct the line, or cut the file before it", name=name, line=line, what=text)


def map_lines(lines: Sequence[str], transform: Callable[[str], str]) -> Sequence[str]:
    """Return lines with a function applied to each."""
    return (
        replace(lines, transforms=(*lines.transforms, transform)) if isinstance(lines, LazyLines) else [transform(line) for line in lines]
    )


def iter_chunks(lines: Sequence[str]) -> Iterator[Sequence[str]]:
    """Yield lists of lines."""
    yield from lines.chunks() if isinstance(lines, LazyLines) else (lines,)


def _has_simple_line_ends(blob: RawFile) -> bool:
    """Return whether a text has LF or CR LF line ends in an encoding that keeps these as single bytes."""
    head = blob.content[: source.HEAD_BYTES]
    if head.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)) or is_binary(head):
        return False
    return all(piece.count(b"\r", 0, source.LARGE_FILE_BYTES) == piece.count(b"\r\n") for piece in blob.chunks())


def _chunk_offsets(blob: RawFile) -> tuple[IntArray, int]:
    """Return the byte offsets of every ``CHUNK_LINES``-th line and of the end, and the number of lines."""
    offsets, count = [len(codecs.BOM_UTF8) if blob.content[:3] == codecs.BOM_UTF8 else 0], 0
    for begin, piece in zip(range(0, len(blob.content), source.LARGE_FILE_BYTES), blob.chunks(), strict=True):
        ends = np.flatnonzero(np.frombuffer(piece, dtype=np.uint8)[: source.LARGE_FILE_BYTES] == ord("\n"))
        # line k begins after k line ends
        first = -(count + 1) % CHUNK_LINES
        offsets += (begin + 1 + ends[first::CHUNK_LINES]).tolist()
        count += int(ends.size)
    return np.array([*offsets, len(blob.content)], dtype=np.int64), count + 1

"""The lines of a text: of a small one at once, of a large one piece by piece from its bytes, so that nothing holds it twice."""

from __future__ import annotations

import codecs
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import overload

import numpy as np

from seisblock.errors import RecordFormatError
from seisblock.readers import source
from seisblock.readers.source import Blob, FileBytes, decode, is_binary
from seisblock.typing import IntArray

PIECE = 2**16
"""Lines that are held at a time."""


@dataclass(frozen=True, eq=False)
class Lines(Sequence[str]):
    """Lines of a large text, made when they are looked at.

    Parameters
    ----------
    data : bytes or FileBytes
        Of the whole file.
    encoding : str
    marks : (m,) array of int
        Where every ``PIECE``-th line begins, and where the data end.
    begin, stop : int
        The lines that these are.
    change : tuple of callable
        What is done to each, in this order.
    """

    data: bytes | FileBytes
    encoding: str
    marks: IntArray
    begin: int
    stop: int
    change: tuple[Callable[[str], str], ...] = ()

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
        return self._changed(self._piece(place // PIECE)[place % PIECE])

    def __iter__(self) -> Iterator[str]:
        for piece in self.pieces():
            yield from piece

    def pieces(self) -> Iterator[list[str]]:
        """Yield the lines, many at a time."""
        for number in range(self.begin // PIECE, -(-self.stop // PIECE)):
            first = number * PIECE
            lines = self._piece(number)[max(self.begin - first, 0) : self.stop - first]
            yield [self._changed(line) for line in lines] if self.change else lines

    def _piece(self, number: int) -> list[str]:
        """Return some lines as they stand in the file."""
        text = self.data[self.marks[number] : self.marks[number + 1]].decode(self.encoding).replace("\r\n", "\n")
        lines = text.split("\n")
        return lines if number + 2 == self.marks.size else lines[:PIECE]

    def _changed(self, line: str) -> str:
        """Return a line after all that is done to it."""
        for change in self.change:
            line = change(line)
        return line


def lines_of(blob: Blob) -> Sequence[str]:
    """Return the lines of a text file, see :func:`~seisblock.readers.source.decode`.

    Raises
    ------
    RecordFormatError
        If the bytes are not text.
    """
    data = blob.held
    if len(data) < source.LARGE or not _is_plain(blob):
        return decode(blob).split("\n")
    marks, count = _marks(blob)
    for encoding in ("utf-8", *source.japanese(data[: source.HEAD])):
        found = Lines(data, encoding, marks, 0, count)
        try:
            for _ in found.pieces():
                pass
        except UnicodeDecodeError:
            continue
        return found
    raise RecordFormatError("{name} is not text (neither UTF-8, Shift-JIS nor EUC-JP): expected a record in a text format", name=blob.name)


def mapped(lines: Sequence[str], change: Callable[[str], str]) -> Sequence[str]:
    """Return lines with something done to each."""
    return replace(lines, change=(*lines.change, change)) if isinstance(lines, Lines) else [change(line) for line in lines]


def pieces_of(lines: Sequence[str]) -> Iterator[Sequence[str]]:
    """Yield lines, many at a time."""
    yield from lines.pieces() if isinstance(lines, Lines) else (lines,)


def _is_plain(blob: Blob) -> bool:
    """Return whether bytes are those of a text whose lines end in LF or CR LF, in an encoding that leaves these single bytes."""
    head = blob.held[: source.HEAD]
    if head.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)) or is_binary(head):
        return False
    return all(piece.count(b"\r", 0, source.LARGE) == piece.count(b"\r\n") for piece in blob.pieces())


def _marks(blob: Blob) -> tuple[IntArray, int]:
    """Return where every ``PIECE``-th line begins and where the data end, and how many lines there are."""
    found, count = [len(codecs.BOM_UTF8) if blob.held[:3] == codecs.BOM_UTF8 else 0], 0
    for begin, piece in zip(range(0, len(blob.held), source.LARGE), blob.pieces(), strict=True):
        ends = np.flatnonzero(np.frombuffer(piece, dtype=np.uint8)[: source.LARGE] == ord("\n"))
        # line number k begins after k ends of lines
        first = -(count + 1) % PIECE
        found += (begin + 1 + ends[first::PIECE]).tolist()
        count += int(ends.size)
    return np.array([*found, len(blob.held)], dtype=np.int64), count + 1

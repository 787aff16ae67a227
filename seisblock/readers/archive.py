"""Extraction of members from zip, tar, gzip, bzip2 and xz files, nested archives included, within the read limits."""

from __future__ import annotations

import bz2
import gzip
import io
import lzma
import re
import struct
import tarfile
import zipfile
import zlib
from collections.abc import Callable, Iterator
from typing import IO, Any

from seisblock.core.errors import InputError, RecordFormatError
from seisblock.core.limits import MIB
from seisblock.readers.limits import LimitedReader, Readable, ReadBudget
from seisblock.readers.source import BytesReader, RawFile

_PLOT_PATTERN = re.compile(
    r"\.(?:ps|eps|gif|png|jpe?g|tiff?|pdf|svg|html?)(?:\.gz)?\Z|\.img\.tar\.gz\Z|(?:^|/)(?:\._|__MACOSX/)", re.IGNORECASE
)
# gzip raises OSErrors
_FORMAT_ERRORS = (tarfile.TarError, zipfile.BadZipFile, zlib.error, lzma.LZMAError, struct.error)
_DAMAGE_ERRORS = (*_FORMAT_ERRORS, EOFError, ValueError, OSError)
"""Exceptions raised by the standard library on truncated or damaged archives."""

_DECOMPRESSORS: tuple[tuple[bytes, Callable[[IO[bytes]], Any]], ...] = (
    (rb"\x1f\x8b", lambda stream: gzip.GzipFile(fileobj=stream)),
    (rb"BZh[1-9]1AY&SY", bz2.BZ2File),
    (rb"\xfd7zXZ\x00", lzma.LZMAFile),
)
"""Magic bytes and opener of each compression format."""

_TAR_MAGIC = slice(257, 262)
"""Position of the tar magic ``ustar``."""


def is_archive(data: bytes) -> bool:
    """Return whether bytes begin a zip or tar archive or a gzip, bzip2 or xz file."""
    if is_workbook(data):
        return False
    return data.startswith((b"PK\x03\x04", b"PK\x05\x06")) or data[_TAR_MAGIC] == b"ustar" or _find_decompressor(data[:16]) is not None


def is_workbook(head: bytes) -> bool:
    """Return whether bytes begin an Excel workbook: a zip whose first member is one of a workbook."""
    return head.startswith(b"PK\x03\x04") and head[30:].startswith((b"[Content_Types].xml", b"_rels/", b"docProps/", b"xl/"))


def _find_decompressor(head: bytes) -> Callable[[IO[bytes]], Any] | None:
    return next((opener for magic, opener in _DECOMPRESSORS if re.match(magic, head)), None)


def iter_members(blob: RawFile, budget: ReadBudget, depth: int = 1) -> Iterator[RawFile]:
    """Yield the files in an archive and in nested archives, without plots and sparse members.

    Declared member sizes are checked against the budget before reading; `depth` is 1 for an archive that is not inside another. Raise
    RecordFormatError if the archive is damaged or encrypted, RecordError if it exceeds a limit.
    """
    budget.check_nesting(blob.name, depth)
    members = _iter_archive(blob, budget)
    while True:
        try:
            member = next(members, None)
        # errors of this package (limits, nested archives) keep their message
        except InputError:
            raise
        # of zipfile, for a password or a compression method that it lacks
        except RuntimeError as error:
            raise RecordFormatError(
                "{name}: archive encrypted or compressed by an unknown method; unpack it first", name=blob.name
            ) from error
        except _DAMAGE_ERRORS as error:
            raise RecordFormatError("{name}: archive damaged; download it again", name=blob.name) from error
        if member is None:
            return
        if not member.data:
            continue
        if is_archive(member.data):
            yield from iter_members(member, budget, depth + 1)
        else:
            yield member


def _iter_archive(blob: RawFile, budget: ReadBudget) -> Iterator[RawFile]:
    """Yield the members of one archive, named archive/member, one at a time."""
    stream = io.BufferedReader(BytesReader(blob.content), MIB)
    head = blob.content[: _TAR_MAGIC.stop]
    packer = _find_decompressor(head)
    if head.startswith(b"PK"):
        yield from _iter_zip(blob.name, stream, budget)
    elif packer is not None:
        yield from _iter_compressed(blob.name, packer(stream), budget)
    else:
        yield from _iter_tar(blob.name, stream, budget)


def _iter_zip(name: str, stream: IO[bytes], budget: ReadBudget) -> Iterator[RawFile]:
    with zipfile.ZipFile(stream) as archive:
        for info in archive.infolist():
            budget.count_member(name)
            if not info.is_dir() and not _PLOT_PATTERN.search(info.filename):
                member_name = f"{name}/{info.filename}"
                budget.check_declared_size(member_name, info.file_size)
                with archive.open(info) as member:
                    yield RawFile(member_name, budget.read(member_name, member))


def _iter_compressed(name: str, stream: IO[bytes], budget: ReadBudget) -> Iterator[RawFile]:
    """Yield a decompressed file, or the members of a compressed tar."""
    with stream as decompressor:
        is_tar = decompressor.read(_TAR_MAGIC.stop)[_TAR_MAGIC] == b"ustar"
        # only the head was read to recognise a tar
        decompressor.seek(0)
        if not is_tar:
            yield RawFile(re.sub(r"\.(?:gz|bz2|xz)\Z", "", name, flags=re.IGNORECASE), budget.read(name, decompressor))
            return
        limited_reader = LimitedReader(name, decompressor, budget)
        yield from _iter_tar(name, limited_reader, budget)
        # read to the end, where the checksum of the compressed stream is verified
        while limited_reader.read(MIB):
            pass


def _iter_tar(name: str, stream: Readable, budget: ReadBudget) -> Iterator[RawFile]:
    # stream mode reads the members in order; seeking in compressed data would unpack it again
    with tarfile.open(fileobj=stream, mode="r|", tarinfo=_StrictTarInfo) as archive:  # type: ignore[call-overload]
        for entry in archive:
            budget.count_member(name)
            # the size of a sparse member is unrelated to the bytes in the archive, and records are not sparse
            if not entry.isfile() or entry.issparse() or _PLOT_PATTERN.search(entry.name):
                continue
            member_name = f"{name}/{entry.name.removeprefix('./')}"
            budget.check_declared_size(member_name, entry.size)
            content = archive.extractfile(entry)
            if content is not None:
                yield RawFile(member_name, budget.read(member_name, content))


class _StrictTarInfo(tarfile.TarInfo):
    """Tar member header; an invalid or truncated header raises ReadError instead of ending the archive."""

    @classmethod
    def fromtarfile(cls, archive: tarfile.TarFile) -> _StrictTarInfo:
        """Return the next header."""
        try:
            return super().fromtarfile(archive)  # type: ignore[return-value]
        except (tarfile.InvalidHeaderError, tarfile.TruncatedHeaderError) as error:  # type: ignore[attr-defined]
            raise tarfile.ReadError(str(error)) from None

"""What lies in a .tar, .zip, or what gzip, bzip2 or xz packed: the files in it, however deeply packed, as far as the budget goes."""

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
_DAMAGE_ERRORS = (
    tarfile.TarError,
    zipfile.BadZipFile,
    zlib.error,
    EOFError,
    gzip.BadGzipFile,
    lzma.LZMAError,
    NotImplementedError,
    RuntimeError,
    struct.error,
    ValueError,
    OSError,
)
"""What the packers of the standard library raise on archives that are cut, spoilt or encrypted."""

_DECOMPRESSORS: tuple[tuple[bytes, Callable[[IO[bytes]], Any]], ...] = (
    (rb"\x1f\x8b", lambda stream: gzip.GzipFile(fileobj=stream)),
    (rb"BZh[1-9]1AY&SY", bz2.BZ2File),
    (rb"\xfd7zXZ\x00", lzma.LZMAFile),
)
"""How what was packed begins, and what unpacks it."""

_TAR_MAGIC = slice(257, 262)
"""Where a tar says that it is one."""


def is_archive(data: bytes) -> bool:
    """Return whether bytes are a zip or tar archive, or packed by gzip, bzip2 or xz."""
    return data.startswith((b"PK\x03\x04", b"PK\x05\x06")) or data[_TAR_MAGIC] == b"ustar" or _find_decompressor(data[:16]) is not None


def _find_decompressor(head: bytes) -> Callable[[IO[bytes]], Any] | None:
    """Return what unpacks bytes that begin so."""
    return next((opener for magic, opener in _DECOMPRESSORS if re.match(magic, head)), None)


def list_members(blob: RawFile, budget: ReadBudget) -> list[RawFile]:
    """Return the files in a bundle, see :func:`iter_members`."""
    return list(iter_members(blob, budget))


def iter_members(blob: RawFile, budget: ReadBudget, depth: int = 1) -> Iterator[RawFile]:
    """Yield the files in a bundle, those in bundles within it too, without plots and without sparse members.

    Parameters
    ----------
    blob : Blob
    budget : Budget
        What may be unpacked; sizes that members declare are compared with it before anything is read.
    depth : int
        How many archives this one lies in, itself included.

    Raises
    ------
    RecordFormatError
        If it is damaged or encrypted.
    RecordError
        If it exceeds the budget.
    """
    budget.check_nesting(blob.name, depth)
    members = _iter_archive(blob, budget)
    while True:
        try:
            member = next(members, None)
        except InputError:
            raise
        except _DAMAGE_ERRORS as error:
            raise RecordFormatError(
                "{name}: archive damaged or encrypted ({error}); download it again or unpack it first",
                name=blob.name,
                error=str(error)[:200],
            ) from error
        if member is None:
            return
        if not member.data:
            continue
        if is_archive(member.data):
            yield from iter_members(member, budget, depth + 1)
        else:
            yield member


def _iter_archive(blob: RawFile, budget: ReadBudget) -> Iterator[RawFile]:
    """Yield the members of one archive, named archive/member, none held but the one that is taken."""
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
    """Yield the members of a zip."""
    with zipfile.ZipFile(stream) as archive:
        for info in archive.infolist():
            budget.check_member(name)
            if not info.is_dir() and not _PLOT_PATTERN.search(info.filename):
                member_name = f"{name}/{info.filename}"
                budget.check_declared_size(member_name, info.file_size)
                with archive.open(info) as member:
                    yield RawFile(member_name, budget.read(member_name, member))


def _iter_compressed(name: str, stream: IO[bytes], budget: ReadBudget) -> Iterator[RawFile]:
    """Yield what is packed, and the members of a tar, unpacked as they are taken and to the end, where its checksum stands."""
    with stream as decompressor:
        is_tar = decompressor.read(_TAR_MAGIC.stop)[_TAR_MAGIC] == b"ustar"
        decompressor.seek(0)
        if not is_tar:
            yield RawFile(re.sub(r"\.(?:gz|bz2|xz)\Z", "", name, flags=re.IGNORECASE), budget.read(name, decompressor))
            return
        limited_reader = LimitedReader(name, decompressor, budget)
        yield from _iter_tar(name, limited_reader, budget)
        while limited_reader.read(MIB):
            pass


def _iter_tar(name: str, stream: Readable, budget: ReadBudget) -> Iterator[RawFile]:
    """Yield the members of a tar, from its beginning to its end."""
    with tarfile.open(fileobj=stream, mode="r|", tarinfo=_StrictTarInfo) as archive:  # type: ignore[call-overload]
        for entry in archive:
            budget.check_member(name)
            # a sparse member is mostly holes: no record, and its size is no measure of the archive's
            if not entry.isfile() or entry.issparse() or _PLOT_PATTERN.search(entry.name):
                continue
            member_name = f"{name}/{entry.name.removeprefix('./')}"
            budget.check_declared_size(member_name, entry.size)
            content = archive.extractfile(entry)
            if content is not None:
                yield RawFile(member_name, budget.read(member_name, content))


class _StrictTarInfo(tarfile.TarInfo):
    """The header of a member of a tar: one that is spoilt or cut is damage, and not the end of the archive."""

    @classmethod
    def fromtarfile(cls, archive: tarfile.TarFile) -> _StrictTarInfo:
        """Return the next header."""
        try:
            return super().fromtarfile(archive)  # type: ignore[return-value]
        except (tarfile.InvalidHeaderError, tarfile.TruncatedHeaderError) as error:  # type: ignore[attr-defined]
            raise tarfile.ReadError(str(error)) from None

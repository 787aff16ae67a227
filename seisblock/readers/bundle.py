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

from seisblock.errors import InputError, RecordFormatError
from seisblock.limits import MIB
from seisblock.readers.budget import Budget, Metered, Readable
from seisblock.readers.source import Blob, Held

_PLOT = re.compile(r"\.(?:ps|eps|gif|png|jpe?g|tiff?|pdf|svg|html?)(?:\.gz)?\Z|\.img\.tar\.gz\Z|(?:^|/)(?:\._|__MACOSX/)", re.IGNORECASE)
_DAMAGE = (
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

_PACKERS: tuple[tuple[bytes, Callable[[IO[bytes]], Any]], ...] = (
    (rb"\x1f\x8b", lambda stream: gzip.GzipFile(fileobj=stream)),
    (rb"BZh[1-9]1AY&SY", bz2.BZ2File),
    (rb"\xfd7zXZ\x00", lzma.LZMAFile),
)
"""How what was packed begins, and what unpacks it."""

_TAR_MARK = slice(257, 262)
"""Where a tar says that it is one."""


def is_bundle(data: bytes) -> bool:
    """Return whether bytes are a zip or tar archive, or packed by gzip, bzip2 or xz."""
    return data.startswith((b"PK\x03\x04", b"PK\x05\x06")) or data[_TAR_MARK] == b"ustar" or _packer(data[:16]) is not None


def _packer(head: bytes) -> Callable[[IO[bytes]], Any] | None:
    """Return what unpacks bytes that begin so."""
    return next((opened for mark, opened in _PACKERS if re.match(mark, head)), None)


def members_of(blob: Blob, budget: Budget) -> list[Blob]:
    """Return the files in a bundle, see :func:`walk`."""
    return list(walk(blob, budget))


def walk(blob: Blob, budget: Budget, depth: int = 1) -> Iterator[Blob]:
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
    members = _unpacked(blob, budget)
    while True:
        try:
            member = next(members, None)
        except InputError:
            raise
        except _DAMAGE as error:
            raise RecordFormatError(
                "{name} is a damaged or encrypted archive ({error}): fetch it again or unpack it first",
                name=blob.name,
                error=str(error)[:200],
            ) from error
        if member is None:
            return
        if not member.data:
            continue
        if is_bundle(member.data):
            yield from walk(member, budget, depth + 1)
        else:
            yield member


def _unpacked(blob: Blob, budget: Budget) -> Iterator[Blob]:
    """Yield the members of one archive, named archive/member, none held but the one that is taken."""
    stream = io.BufferedReader(Held(blob.held), MIB)
    head = blob.held[: _TAR_MARK.stop]
    packer = _packer(head)
    if head.startswith(b"PK"):
        yield from _of_zip(blob.name, stream, budget)
    elif packer is not None:
        yield from _of_packed(blob.name, packer(stream), budget)
    else:
        yield from _of_tar(blob.name, stream, budget)


def _of_zip(name: str, stream: IO[bytes], budget: Budget) -> Iterator[Blob]:
    """Yield the members of a zip."""
    with zipfile.ZipFile(stream) as archive:
        for info in archive.infolist():
            budget.spend_member(name)
            if not info.is_dir() and not _PLOT.search(info.filename):
                inner = f"{name}/{info.filename}"
                budget.announce_bytes(inner, info.file_size)
                with archive.open(info) as member:
                    yield Blob(inner, budget.read(inner, member))


def _of_packed(name: str, stream: IO[bytes], budget: Budget) -> Iterator[Blob]:
    """Yield what is packed, and the members of a tar, unpacked as they are taken and to the end, where its checksum stands."""
    with stream as packed:
        is_tar = packed.read(_TAR_MARK.stop)[_TAR_MARK] == b"ustar"
        packed.seek(0)
        if not is_tar:
            yield Blob(re.sub(r"\.(?:gz|bz2|xz)\Z", "", name, flags=re.IGNORECASE), budget.read(name, packed))
            return
        metered = Metered(name, packed, budget)
        yield from _of_tar(name, metered, budget)
        while metered.read(MIB):
            pass


def _of_tar(name: str, stream: Readable, budget: Budget) -> Iterator[Blob]:
    """Yield the members of a tar, from its beginning to its end."""
    with tarfile.open(fileobj=stream, mode="r|", tarinfo=_Header) as archive:  # type: ignore[call-overload]
        for entry in archive:
            budget.spend_member(name)
            # a sparse member is mostly holes: no record, and its size is no measure of the archive's
            if not entry.isfile() or entry.issparse() or _PLOT.search(entry.name):
                continue
            inner = f"{name}/{entry.name.removeprefix('./')}"
            budget.announce_bytes(inner, entry.size)
            content = archive.extractfile(entry)
            if content is not None:
                yield Blob(inner, budget.read(inner, content))


class _Header(tarfile.TarInfo):
    """The header of a member of a tar: one that is spoilt or cut is damage, and not the end of the archive."""

    @classmethod
    def fromtarfile(cls, archive: tarfile.TarFile) -> _Header:
        """Return the next header."""
        try:
            return super().fromtarfile(archive)  # type: ignore[return-value]
        except (tarfile.InvalidHeaderError, tarfile.TruncatedHeaderError) as error:  # type: ignore[attr-defined]
            raise tarfile.ReadError(str(error)) from None

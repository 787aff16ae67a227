"""What lies in a .tar, .tar.gz, .gz or .zip: the files in it, however deeply packed, as far as the budget goes."""

from __future__ import annotations

import gzip
import io
import re
import struct
import tarfile
import zipfile
import zlib
from collections.abc import Iterator

from seisblock.errors import InputError, RecordFormatError
from seisblock.readers.budget import Budget
from seisblock.readers.source import Blob

_PLOT = re.compile(r"\.(?:ps|eps|gif|png|jpe?g|tiff?|pdf|svg|html?)(?:\.gz)?\Z|\.img\.tar\.gz\Z|(?:^|/)(?:\._|__MACOSX/)", re.IGNORECASE)
_DAMAGE = (
    tarfile.TarError,
    zipfile.BadZipFile,
    zlib.error,
    EOFError,
    gzip.BadGzipFile,
    NotImplementedError,
    RuntimeError,
    struct.error,
    ValueError,
    OSError,
)
"""What the packers of the standard library raise on archives that are cut, spoilt or encrypted."""


def is_bundle(data: bytes) -> bool:
    """Return whether bytes are a zip, gzip or tar archive."""
    return data.startswith((b"PK\x03\x04", b"PK\x05\x06", b"\x1f\x8b")) or data[257:262] == b"ustar"


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
    """Yield the members of one archive, named archive/member."""
    data, name = blob.data, blob.name
    if data.startswith(b"PK"):
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            for info in archive.infolist():
                budget.spend_member(name)
                if not info.is_dir() and not _PLOT.search(info.filename):
                    inner = f"{name}/{info.filename}"
                    budget.announce_bytes(inner, info.file_size)
                    with archive.open(info) as stream:
                        yield Blob(inner, budget.read(inner, stream))
        return
    if data.startswith(b"\x1f\x8b"):
        with gzip.GzipFile(fileobj=io.BytesIO(data)) as packed:
            data = budget.read(name, packed)
        if data[257:262] != b"ustar":
            yield Blob(re.sub(r"\.gz\Z", "", name, flags=re.IGNORECASE), data)
            return
    with tarfile.open(fileobj=io.BytesIO(data), mode="r:") as archive:
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

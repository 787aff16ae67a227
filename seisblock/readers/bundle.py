"""What lies in a .tar, .tar.gz, .gz or .zip: the files in it, however deeply packed."""

from __future__ import annotations

import gzip
import io
import re
import tarfile
import zipfile
import zlib
from collections.abc import Iterator

from seisblock.errors import RecordFormatError
from seisblock.readers.source import Blob

MAX_DEPTH = 5
MAX_BYTES = 2**30
_PLOT = re.compile(r"\.(?:ps|eps|gif|png|jpe?g|tiff?|pdf|svg|html?)(?:\.gz)?\Z|\.img\.tar\.gz\Z|(?:^|/)(?:\._|__MACOSX/)", re.IGNORECASE)


def is_bundle(data: bytes) -> bool:
    """Return whether bytes are a zip, gzip or tar archive."""
    return data.startswith((b"PK\x03\x04", b"PK\x05\x06", b"\x1f\x8b")) or data[257:262] == b"ustar"


def members_of(blob: Blob, depth: int = 0) -> list[Blob]:
    """Return the files in a bundle, those in bundles within it too, without plots.

    Raises
    ------
    RecordFormatError
        If it is damaged, encrypted, packed too deeply or unpacks to more than 1 GiB.
    """
    if depth >= MAX_DEPTH:
        raise RecordFormatError(f"{blob.name} is packed more than {MAX_DEPTH} times over: unpack it first")
    found: list[Blob] = []
    total = 0
    try:
        for member in _unpacked(blob):
            total += len(member.data)
            if total > MAX_BYTES:
                raise RecordFormatError(f"{blob.name} unpacks to more than {MAX_BYTES >> 20} MiB: unpack it first")
            if _PLOT.search(member.name) or not member.data:
                continue
            found.extend(members_of(member, depth + 1) if is_bundle(member.data) else [member])
    except (tarfile.TarError, zipfile.BadZipFile, zlib.error, EOFError, gzip.BadGzipFile, NotImplementedError, RuntimeError) as error:
        raise RecordFormatError(f"{blob.name} is a damaged or encrypted archive ({error}): fetch it again or unpack it first") from error
    return found


def _unpacked(blob: Blob) -> Iterator[Blob]:
    """Yield the members of one archive, named archive/member."""
    data = blob.data
    name = blob.name
    if data.startswith(b"PK"):
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            for info in archive.infolist():
                if not info.is_dir() and info.file_size <= MAX_BYTES:
                    yield Blob(f"{name}/{info.filename}", archive.read(info))
        return
    if data.startswith(b"\x1f\x8b"):
        with gzip.GzipFile(fileobj=io.BytesIO(data)) as packed:
            data = packed.read(MAX_BYTES + 1)
        if data[257:262] != b"ustar":
            yield Blob(re.sub(r"\.gz\Z", "", name, flags=re.IGNORECASE), data)
            return
    with tarfile.open(fileobj=io.BytesIO(data), mode="r:") as archive:
        for entry in archive:
            stream = archive.extractfile(entry) if entry.isfile() else None
            if stream is not None:
                yield Blob(f"{name}/{entry.name.removeprefix('./')}", stream.read())

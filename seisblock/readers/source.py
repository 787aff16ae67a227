"""Which bytes a name stands for."""

from __future__ import annotations

import codecs
import hashlib
from collections.abc import Iterable
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import TypeAlias

from seisblock.errors import RecordError, RecordFormatError, RecordNotFoundError
from seisblock.ledger import reading
from seisblock.samples import find_sample, list_samples

Location: TypeAlias = "str | PathLike[str]"


@dataclass(frozen=True)
class Blob:
    """The bytes of one file, or of one member of a bundle, and the name they go by in messages."""

    name: str
    data: bytes
    path: Path | None = None

    @property
    def basename(self) -> str:
        """Last part of the name."""
        return self.name.replace("\\", "/").rsplit("/", 1)[-1]


def fetch(source: Location) -> Blob:
    """Return the bytes of a file, or of the bundled sample of that name.

    Raises
    ------
    RecordNotFoundError
        If there is neither a file nor a sample of that name.
    RecordError
        If it is a directory, is empty or cannot be read.
    """
    name = str(source)
    path = locate(source)
    if path.is_dir():
        raise RecordError(f"{name} is a directory: name a record file in it")
    try:
        data = path.read_bytes()
        reading(path)
    except OSError as error:
        raise RecordError(f"{name} cannot be read: {error.strerror or error}") from error
    if not data.strip():
        raise RecordError(f"{name} is empty: expected a strong-motion record")
    return Blob(name, data, path)


def locate(source: Location) -> Path:
    """Return the path of a file, or of the bundled sample of that name."""
    name = str(source)
    path = Path(name)
    try:
        if path.exists():
            return path
        if name.startswith("~") and path.expanduser().exists():
            return path.expanduser()
    except (OSError, RuntimeError, ValueError) as error:  # too long, no such home, a NUL in it
        raise RecordNotFoundError(f"{name!r} is no name of a file: {error}") from error
    sample = find_sample(name) if path.name == name else None
    if sample is None:
        known = ", ".join(s.name for s in list_samples() if s.kind == "record")
        raise RecordNotFoundError(f"{name}: no such file, and no bundled sample of that name (there are {known})")
    return sample


def digest(blobs: Iterable[Blob]) -> str:
    """Return the SHA-256 of the bytes, one after the other."""
    total = hashlib.sha256()
    for blob in blobs:
        total.update(blob.data)
    return total.hexdigest()


def decode(blob: Blob) -> str:
    """Return the text of a file in UTF-8 (with or without BOM), UTF-16 with BOM, or Shift-JIS (cp932), lines ending in LF.

    Raises
    ------
    RecordFormatError
        If the bytes are not text.
    """
    if blob.data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        encodings = ["utf-16"]
    elif is_binary(blob.data):
        encodings = []
    else:
        encodings = ["utf-8-sig", "cp932"]
    for encoding in encodings:
        try:
            return blob.data.decode(encoding).replace("\r\n", "\n").replace("\r", "\n")
        except UnicodeDecodeError:
            continue
    raise RecordFormatError(f"{blob.name} is not text (neither UTF-8 nor Shift-JIS): expected a record in a text format")


def is_binary(data: bytes) -> bool:
    """Return whether bytes hold control characters that no text has."""
    head = data[:65536]
    return any(byte in head for byte in (b"\x00", b"\x01", b"\x02", b"\x03", b"\x04", b"\x05", b"\x06", b"\x7f"))

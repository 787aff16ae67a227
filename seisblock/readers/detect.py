"""What kind of file are these bytes? Content decides, never the name."""

from __future__ import annotations

import io
import tarfile
import zipfile

from seisblock.errors import RecordFormatError
from seisblock.readers.jma_csv import is_jma_csv
from seisblock.readers.plain_csv import looks_like_csv
from seisblock.readers.source import Blob, decode

BUNDLE = "BUNDLE"
OBSPY = "OBSPY"


def format_of(blob: Blob) -> str:
    """Return ``BUNDLE``, a format of ours, or ``OBSPY`` for whatever else there is."""
    head = blob.data[:4096]
    if is_bundle(blob.data):
        return BUNDLE
    if is_jma_csv(head):
        return "JMA-CSV"
    try:
        text = decode(blob)
    except RecordFormatError:
        return OBSPY
    return "CSV" if looks_like_csv(text) else OBSPY


def is_bundle(data: bytes) -> bool:
    """Return whether bytes are a zip, gzip or tar archive."""
    if data.startswith((b"PK\x03\x04", b"PK\x05\x06", b"\x1f\x8b")):
        return zipfile.is_zipfile(io.BytesIO(data)) or data.startswith(b"\x1f\x8b")
    return data[257:262] == b"ustar" and tarfile.is_tarfile(io.BytesIO(data))

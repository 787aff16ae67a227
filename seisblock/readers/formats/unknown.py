"""What is said of a file that no reader takes: how it begins, and where a table in it does."""

from __future__ import annotations

from seisblock.errors import RecordFormatError
from seisblock.readers.formats.table_layout import FARTHEST, SHOWN, preamble
from seisblock.readers.lines import lines_of
from seisblock.readers.source import Blob
from seisblock.words import noted, said

_KNOWN = noted(
    "JMA CSV, K-NET, KiK-net, K-NET CSV, PEER AT2, CSMIP, COSMOS, SMC, ESM, GeoNet, CWA, a plain table, a bundle of those, nor a "
    "waveform format of obspy"
)


def unknown(blob: Blob) -> RecordFormatError:
    """Return the error of a file in no format that is known: of a text it quotes the first line, and tells where a table begins below."""
    try:
        lines = lines_of(blob)[:FARTHEST]
    except RecordFormatError:
        return RecordFormatError("{name} is in no format known here: not {known}", name=blob.name, known=said(_KNOWN))
    first = next((line.strip() for line in lines if line.strip()), "")[:SHOWN]
    return preamble(blob.name, lines) or RecordFormatError(
        "{name} is in no format known here: it begins {first!r}; not {known}", name=blob.name, first=first, known=said(_KNOWN)
    )

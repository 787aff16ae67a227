"""Error for files of unknown format."""

from __future__ import annotations

from seisblock.core.errors import RecordFormatError
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.readers.lines import read_lines
from seisblock.readers.source import RawFile
from seisblock.readers.table.layout import MAX_PREAMBLE_LINES, MAX_QUOTED_LENGTH, preamble_error

_KNOWN_FORMATS = N_(
    "JMA CSV, K-NET, KiK-net, K-NET CSV, PEER AT2, CSMIP, COSMOS, SMC, ESM, GeoNet, CWA, a plain table, an archive of "
    "these, or a waveform format of obspy"
)


def unrecognized_error(blob: RawFile) -> RecordFormatError:
    """Return the error of a file of unknown format; quotes the first line and locates a table below it."""
    try:
        lines = read_lines(blob)[:MAX_PREAMBLE_LINES]
    except RecordFormatError:
        return RecordFormatError("{name}: unknown file format; expected {known}", name=blob.name, known=lazy_gettext(_KNOWN_FORMATS))
    first = next((line.strip() for line in lines if line.strip()), "")[:MAX_QUOTED_LENGTH]
    return preamble_error(blob.name, lines) or RecordFormatError(
        "{name}: unknown file format (begins with {first!r}); expected {known}",
        name=blob.name,
        first=first,
        known=lazy_gettext(_KNOWN_FORMATS),
    )

"""Format detection by content."""

from __future__ import annotations

import codecs

from seisblock.core.errors import RecordFormatError
from seisblock.readers import archive
from seisblock.readers.formats import at2, cosmos, csmip, cwa, esm, geonet, jma_csv, knet, knet_csv, obspy, plain_csv, smc
from seisblock.readers.lines import read_lines
from seisblock.readers.source import RawFile
from seisblock.readers.table import layout

ARCHIVE = "BUNDLE"
OBSPY = "OBSPY"

_DETECTORS = (
    (jma_csv.is_jma_csv, jma_csv.FORMAT),
    (knet.is_knet, knet.FORMAT),
    (knet_csv.is_knet_csv, knet_csv.FORMAT),
    (cwa.is_cwa, cwa.FORMAT),
    (geonet.is_geonet, geonet.FORMAT),
    (cosmos.is_cosmos, cosmos.FORMAT),
    (csmip.is_csmip, csmip.FORMAT),
    (smc.is_smc, smc.FORMAT),
    (esm.is_esm, esm.FORMAT),
    (at2.is_at2, at2.FORMAT),
)
"""Tests of the first bytes for each format, the most specific first."""


def detect_format(blob: RawFile) -> str:
    """Return ``BUNDLE`` for an archive, the name of a format read here, or ``OBSPY`` for anything else."""
    head = blob.content[:4096]
    if archive.is_archive(head):
        return ARCHIVE
    if head.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        # an even number of bytes: UTF-16 code units
        head = head[:4094].decode("utf-16", "replace").encode()
    for is_format, name in _DETECTORS:
        if is_format(head):
            return name
    # GSE files are text: recognised before the test for tables
    if obspy.is_gse(head):
        return OBSPY
    try:
        lines = read_lines(blob)
    except RecordFormatError:
        return OBSPY
    return plain_csv.FORMAT if layout.looks_like_csv(lines) else OBSPY

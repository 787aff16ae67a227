"""Which format some bytes are in: content decides, never the name."""

from __future__ import annotations

import codecs

from seisblock.errors import RecordFormatError
from seisblock.readers import bundle
from seisblock.readers.formats import at2, cosmos, csmip, cwa, esm, generic, geonet, jma_csv, knet, knet_csv, plain_csv, smc, table_layout
from seisblock.readers.lines import lines_of
from seisblock.readers.source import Blob

BUNDLE = "BUNDLE"
OBSPY = "OBSPY"

_CLAIMS = (
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
"""What tells a format by its first bytes, the most particular first."""


def format_of(blob: Blob) -> str:
    """Return ``BUNDLE``, a format of ours, or ``OBSPY`` for whatever else there is."""
    head = blob.held[:4096]
    if bundle.is_bundle(head):
        return BUNDLE
    if head.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        head = head[:4094].decode("utf-16", "replace").encode()
    for claims, name in _CLAIMS:
        if claims(head):
            return name
    if generic.is_gse(head):
        return OBSPY
    try:
        lines = lines_of(blob)
    except RecordFormatError:
        return OBSPY
    return plain_csv.FORMAT if table_layout.looks_like_csv(lines) else OBSPY

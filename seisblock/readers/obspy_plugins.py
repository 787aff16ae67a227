"""ObsPy waveform plug-ins (entry points) for JMA CSV, K-NET CSV, AT2, CSMIP, COSMOS, SMC, ESM, GeoNet and CWA.

Samples of these streams are accelerations in m/s^2 and ``stats.calib`` is 1; ObsPy's own K-NET reader gives counts and a ``calib`` to
m/s^2, so that ``data * calib`` is in m/s^2 for all of them. Further header entries are in ``stats.jmacsv``, ``stats.knetcsv``,
``stats.at2``, ``stats.csmip``, ``stats.cosmos``, ``stats.smc``, ``stats.esm``, ``stats.geonet`` and ``stats.cwa``.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any, BinaryIO

from seisblock.readers.formats.at2 import is_at2 as _claims_at2
from seisblock.readers.formats.at2 import read_at2 as _parse_at2
from seisblock.readers.formats.cosmos import is_cosmos as _claims_cosmos
from seisblock.readers.formats.cosmos import read_cosmos as _parse_cosmos
from seisblock.readers.formats.csmip import is_csmip as _claims_csmip
from seisblock.readers.formats.csmip import read_csmip as _parse_csmip
from seisblock.readers.formats.cwa import is_cwa as _claims_cwa
from seisblock.readers.formats.cwa import read_cwa as _parse_cwa
from seisblock.readers.formats.esm import is_esm as _claims_esm
from seisblock.readers.formats.esm import read_esm as _parse_esm
from seisblock.readers.formats.geonet import is_geonet as _claims_geonet
from seisblock.readers.formats.geonet import read_geonet as _parse_geonet
from seisblock.readers.formats.jma_csv import is_jma_csv as _claims_jma_csv
from seisblock.readers.formats.jma_csv import read_jma_csv as _parse_jma_csv
from seisblock.readers.formats.knet_csv import is_knet_csv as _claims_knet_csv
from seisblock.readers.formats.knet_csv import read_knet_csv as _parse_knet_csv
from seisblock.readers.formats.smc import is_smc as _claims_smc
from seisblock.readers.formats.smc import read_smc as _parse_smc
from seisblock.readers.source import RawFile
from seisblock.records import Record

_HEAD_BYTES = 4096


def is_jma_csv(filename: str | Path | BinaryIO) -> bool:
    """Return whether a file is a JMA CSV: ``SITE CODE`` at its start, followed by the sampling rate."""
    head = _read_head(filename)
    return _claims_jma_csv(head) and b"SAMPLING" in head.upper()


def read_jma_csv(filename: str | Path | BinaryIO, **_: Any) -> Any:
    """Return an obspy Stream, m/s^2, of a JMA CSV file: channels NS, EW, UD, start in UTC.

    Raises
    ------
    RecordFormatError
        If the file is malformed.
    """
    return _to_stream([_parse_jma_csv(_read_raw(filename))], "jmacsv")


def is_knet_csv(filename: str | Path | BinaryIO) -> bool:
    """Return whether a file is a NIED CSV, beginning with ``#K-NET CSV`` or ``#KiK-net CSV``."""
    return _claims_knet_csv(_read_head(filename))


def read_knet_csv(filename: str | Path | BinaryIO, **_: Any) -> Any:
    """Return an obspy Stream, m/s^2, of a NIED CSV; KiK-net channels are NS1 ... UD2. The offset is kept.

    Raises
    ------
    RecordFormatError
        If the file is malformed.
    """
    return _to_stream(_parse_knet_csv(_read_raw(filename)), "knetcsv")


def is_at2(filename: str | Path | BinaryIO) -> bool:
    """Return whether a file is a PEER AT2, with NPTS and DT in its first lines."""
    return _claims_at2(_read_head(filename))


def read_at2(filename: str | Path | BinaryIO, **_: Any) -> Any:
    """Return an obspy Stream, m/s^2, of an AT2 file; start 1970-01-01, since AT2 has no time.

    Raises
    ------
    RecordFormatError
        If the file is malformed.
    """
    return _to_stream([_parse_at2(_read_raw(filename))], "at2")


def is_csmip(filename: str | Path | BinaryIO) -> bool:
    """Return whether a file is a CSMIP file, by the title in the first line."""
    return _claims_csmip(_read_head(filename))


def read_csmip(filename: str | Path | BinaryIO, **_: Any) -> Any:
    """Return an obspy Stream, m/s^2, of the channels in a CSMIP file of volume 1 or 2.

    Raises
    ------
    RecordFormatError
        If the file is malformed or has no evenly sampled acceleration.
    """
    return _to_stream(_parse_csmip(_read_raw(filename)), "csmip")


def is_cosmos(filename: str | Path | BinaryIO) -> bool:
    """Return whether a file is a COSMOS file, by format and number of text lines in the first line."""
    return _claims_cosmos(_read_head(filename))


def read_cosmos(filename: str | Path | BinaryIO, **_: Any) -> Any:
    """Return an obspy Stream, m/s^2, of the channels in a COSMOS file of volume 1 or 2.

    Raises
    ------
    RecordFormatError
        If the file is malformed or has no evenly sampled acceleration.
    """
    return _to_stream(_parse_cosmos(_read_raw(filename)), "cosmos")


def is_smc(filename: str | Path | BinaryIO) -> bool:
    """Return whether a file is an SMC file of the U.S. Geological Survey."""
    return _claims_smc(_read_head(filename))


def read_smc(filename: str | Path | BinaryIO, **_: Any) -> Any:
    """Return an obspy Stream, m/s^2, of the component in a corrected SMC file.

    Raises
    ------
    RecordFormatError
        If the file is malformed or has no evenly sampled acceleration.
    """
    return _to_stream([_parse_smc(_read_raw(filename))], "smc")


def is_esm(filename: str | Path | BinaryIO) -> bool:
    """Return whether a file is an ESM ASCII file, by event name and identifier in the first lines."""
    return _claims_esm(_read_head(filename))


def read_esm(filename: str | Path | BinaryIO, **_: Any) -> Any:
    """Return an obspy Stream, m/s^2, of the component in an ESM ASCII file.

    Raises
    ------
    RecordFormatError
        If the file is malformed or has no evenly sampled acceleration.
    """
    return _to_stream([_parse_esm(_read_raw(filename))], "esm")


def is_geonet(filename: str | Path | BinaryIO) -> bool:
    """Return whether a file is a GeoNet accelerogram, by its first line."""
    return _claims_geonet(_read_head(filename))


def read_geonet(filename: str | Path | BinaryIO, **_: Any) -> Any:
    """Return an obspy Stream, m/s^2, of the components in a GeoNet file of volume 1 or 2.

    Raises
    ------
    RecordFormatError
        If the file is malformed or has no evenly sampled acceleration.
    """
    return _to_stream(_parse_geonet(_read_raw(filename)), "geonet")


def is_cwa(filename: str | Path | BinaryIO) -> bool:
    """Return whether a file is a strong-motion text file of Taiwan's CWA, by its column sequence."""
    return _claims_cwa(_read_head(filename))


def read_cwa(filename: str | Path | BinaryIO, **_: Any) -> Any:
    """Return an obspy Stream, m/s^2, of the components in a strong-motion text file of Taiwan's CWA.

    Raises
    ------
    RecordFormatError
        If the file is malformed.
    """
    return _to_stream([_parse_cwa(_read_raw(filename))], "cwa")


def _read_head(filename: str | Path | BinaryIO) -> bytes:
    """Return the first bytes of a file; the position of a stream is restored."""
    if isinstance(filename, (str, Path)):
        try:
            with Path(filename).open("rb") as file:
                return file.read(_HEAD_BYTES)
        except OSError:
            return b""
    position = filename.tell()
    try:
        return filename.read(_HEAD_BYTES)
    finally:
        filename.seek(position)


def _read_raw(filename: str | Path | BinaryIO) -> RawFile:
    if isinstance(filename, (str, Path)):
        return RawFile(str(filename), Path(filename).read_bytes())
    return RawFile(str(getattr(filename, "name", "stream")), filename.read())


def _to_stream(records: Sequence[Record], key: str) -> Any:
    from obspy import Stream, Trace, UTCDateTime

    traces = []
    for record in records:
        # as in the names of KiK-net files
        sensor = {"borehole": "1", "surface": "2"}.get(str(record.metadata.get("level", "")), "")
        header_fields = {k: UTCDateTime(v) if k == "origin_time" else v for k, v in record.metadata.items() if k != "unit"}
        for component in record.components:
            direction = {} if component.azimuth_deg is None else {"azimuth_deg": component.azimuth_deg}
            header: dict[str, Any] = {"station": record.station, "channel": component.code + sensor, "delta": record.dt}
            header[key] = {**header_fields, **direction, "unit": "m/s2"}
            if record.start is not None:
                header["starttime"] = UTCDateTime(record.start)
            # the samples of a record are read-only, those of a trace are changed in place by obspy
            traces.append(Trace(component.acceleration.copy(), header=header))
    return Stream(traces)

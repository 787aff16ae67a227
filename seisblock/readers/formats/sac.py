"""SAC, binary: one component in the unit given by a StationXML or by the user; read by ObsPy, its header checked against the samples."""

from __future__ import annotations

import struct
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from seisblock.readers._header_check import qc_flag
from seisblock.readers.channels import waveform_file_set
from seisblock.readers.registry import Format, register
from seisblock.readers.source import RawFile
from seisblock.readers.waveforms import WAVEFORM_OPTIONS, WaveformOptions, read_waveform_file
from seisblock.records import QCFlag, Record

_HEADER_BYTES = 632
_VERSION, _VERSIONS = slice(304, 308), (6, 7)
"""Place of the header version ``NVHDR``, and its values."""

UNDEFINED = -12345.0
"""SAC value of undefined header entries."""

_EXTREME_TOLERANCE = 1e-5
"""Tolerance of SAC extremes relative to the largest sample; both are single precision."""

_END_TOLERANCE = 0.1
"""Tolerance of the end time ``E``, sampling intervals."""

_SINGLE_PRECISION = 2e-7
"""Relative tolerance of single-precision times."""


def is_sac(head: bytes) -> bool:
    """Return whether bytes begin a binary SAC file: header version 6 or 7 in either byte order."""
    if len(head) < _HEADER_BYTES:
        return False
    return any(struct.unpack(order + "i", head[_VERSION])[0] in _VERSIONS for order in "<>")


def read_sac(blob: RawFile, **options: Any) -> list[Record]:
    """Return the component in a SAC file; options as for miniSEED.

    Notes
    -----
    Extremes and mean (``DEPMIN``, ``DEPMAX``, ``DEPMEN``) and the end time (``E``) of the header are checked against the samples.
    """
    return read_waveform_file(blob, "SAC", WaveformOptions(**options), _check_header)


def _check_header(_: bytes, traces: Sequence[Any]) -> Sequence[QCFlag]:
    return tuple(flag for trace in traces for flag in (*_flag_extremes(trace), *_flag_end(trace)))


def _flag_extremes(trace: Any) -> Iterator[QCFlag]:
    """Yield flags for extremes and means in the header that differ from the samples."""
    header, row = trace.stats.sac, np.asarray(trace.data, dtype=np.float64)
    extremes = {"depmin": row.min(), "depmax": row.max(), "depmen": row.mean()} if row.size else {}
    slack = _EXTREME_TOLERANCE * max(abs(row.min()), abs(row.max())) if row.size else 0.0
    for key, value in extremes.items():
        header_value = float(header.get(key, UNDEFINED))
        if header_value != UNDEFINED and not abs(header_value - value) <= slack:
            message = "{channel}: header {key} {stated:g} differs from the value of the samples, {value:g}"
            yield qc_flag(message, "header", channel=trace.id, key=key.upper(), stated=header_value, value=float(value))


def _flag_end(trace: Any) -> Iterator[QCFlag]:
    """Yield a flag if the end time in the header is not that of the last sample."""
    header, delta = trace.stats.sac, float(trace.stats.delta)
    begin, end = (float(header.get(key, UNDEFINED)) for key in ("b", "e"))
    if UNDEFINED in (begin, end):
        return
    last = begin + (trace.stats.npts - 1) * delta
    if not abs(end - last) <= _END_TOLERANCE * delta + _SINGLE_PRECISION * max(abs(begin), abs(last)):
        message = "{channel}: header end time E {end:g} s contradicts B, DELTA and NPTS, which give {last:g} s"
        yield qc_flag(message, "clock", channel=trace.id, end=end, last=last)


def _recording_key(head: bytes) -> object:
    """Return network, station, location, and the first two letters of the channel."""
    if not is_sac(head):
        return False
    station, hole, channel, network = head[440:448], head[464:472], head[600:602], head[608:616]
    return tuple(text.rstrip(b" \0") for text in (network, station, hole, channel))


FORMAT = register(
    Format(
        name="SAC",
        title="SAC",
        parse=read_sac,
        matches=is_sac,
        proves=("count",),
        aliases=("OBSPY:SAC",),
        options=WAVEFORM_OPTIONS,
        plugin=False,
        aligned=True,
        file_set=waveform_file_set,
        recording_key=_recording_key,
    )
)

"""MiniSEED: channels of one or several stations, usually counts, whose unit is in a StationXML; read by ObsPy."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from seisblock.readers._header_check import qc_flag
from seisblock.readers.channels import waveform_file_set
from seisblock.readers.registry import Format, register
from seisblock.readers.source import RawFile
from seisblock.readers.waveforms import WAVEFORM_OPTIONS, WaveformOptions, read_waveform_file
from seisblock.records import QCFlag, Record

_RECORD_HEAD = re.compile(rb"\d{6}[DRQMV][ \x00]")


def is_mseed(head: bytes) -> bool:
    """Return whether bytes begin a miniSEED file or a SEED volume: sequence number and quality letter."""
    return _RECORD_HEAD.match(head) is not None and len(head) >= 48


def read_mseed(blob: RawFile, **options: Any) -> list[Record]:
    """Return the channels in a miniSEED file, as single-component records.

    Notes
    -----
    The response of the StationXML `inventory` is removed; without one, `units` is the unit of the samples. Velocities are refused unless
    `differentiate` is set.
    """
    return read_waveform_file(blob, "MSEED", WaveformOptions(**options), _flag_partial_block)


def _flag_partial_block(data: bytes, traces: Sequence[Any]) -> Sequence[QCFlag]:
    """Return a flag if a file ends inside a block, which ObsPy ignores."""
    length = min(int(trace.stats.mseed.record_length) for trace in traces)
    message = "file ends inside a block of {length} bytes: probably truncated"
    return (qc_flag(message, "cut", length=length),) if len(data) % length else ()


def _recording_key(head: bytes) -> object:
    """Return station, location, the first two letters of the channel, and network, from the fixed header of the first block."""
    return is_mseed(head) and (head[8:17], head[18:20])


FORMAT = register(
    Format(
        name="MSEED",
        title="miniSEED",
        parse=read_mseed,
        matches=is_mseed,
        proves=("count", "clock"),
        aliases=("OBSPY:MSEED",),
        options=WAVEFORM_OPTIONS,
        plugin=False,
        aligned=True,
        file_set=waveform_file_set,
        recording_key=_recording_key,
    )
)

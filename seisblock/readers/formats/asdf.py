"""ASDF (HDF5): waveforms, StationXML and QuakeML of an event in one file; requires h5py (extra ``hdf5``)."""

from __future__ import annotations

import io
from dataclasses import replace
from typing import Any

import numpy as np

from seisblock.core.errors import RecordFormatError
from seisblock.readers.registry import Format, register
from seisblock.readers.response import Inventories
from seisblock.readers.source import BytesReader, RawFile
from seisblock.readers.waveforms import WAVEFORM_OPTIONS, WaveformOptions, trace_to_record
from seisblock.records import Record

_MAGIC = b"\x89HDF\r\n\x1a\n"
RAW_TAGS = ("unprocessed", "raw_recording", "raw")
"""Tags of waveforms as recorded, also as the end of a tag (``EVENT_unprocessed``)."""


def is_asdf(head: bytes) -> bool:
    """Return whether bytes begin an HDF5 file."""
    return head.startswith(_MAGIC)


def read_asdf(blob: RawFile, **options: Any) -> list[Record]:
    """Return the channels in an ASDF file, as single-component records.

    Notes
    -----
    Waveforms as recorded are read (tags ``unprocessed``, ``raw_recording``), else those of the only tag; the response is that of the
    StationXML in the file, unless `inventory` is given.

    Raises
    ------
    RecordFormatError
        If h5py is not installed, the file is not ASDF or damaged, has no waveforms, or several tags and none as recorded.
    """
    try:
        import h5py
    except ImportError as error:
        raise RecordFormatError("{name}: ASDF requires h5py: pip install 'seisblock[hdf5]'", name=blob.name) from error
    try:
        with h5py.File(io.BufferedReader(BytesReader(blob.content)), "r") as file:
            if _text(file.attrs.get("file_format", b"")) != "ASDF":
                raise RecordFormatError("{name}: HDF5 file that is not ASDF", name=blob.name)
            stations = {name: group for name, group in file.get("Waveforms", {}).items() if hasattr(group, "items")}
            traces = [trace for group in stations.values() for trace in _read_traces(group)]
            files = tuple(
                RawFile(f"{blob.name}/{name}/StationXML", np.asarray(group["StationXML"]).tobytes())
                for name, group in stations.items()
                if "StationXML" in group
            )
    except (OSError, KeyError, ValueError, RuntimeError, TypeError) as error:
        if isinstance(error, RecordFormatError):
            raise
        message = "{name}: ASDF file truncated or damaged ({why})"
        raise RecordFormatError(message, name=blob.name, why=" ".join(str(error).split())[:120]) from error
    conversion = WaveformOptions(**options)
    if not conversion.inventory.is_requested:
        conversion = replace(conversion, inventory=Inventories(files))
    return [replace(trace_to_record(blob.name, trace, "ASDF", conversion), format=FORMAT.name) for trace in _select_tag(blob.name, traces)]


def _text(value: Any) -> str:
    return value.decode() if isinstance(value, bytes) else str(value)


def _read_traces(group: Any) -> list[Any]:
    """Return the traces of a station; the tag is in ``stats.tag``."""
    from obspy import Trace, UTCDateTime

    traces = []
    for name, dataset in group.items():
        codes, _, _, tag = (*name.split("__"), "", "", "")[:4]
        if codes.count(".") != 3 or "sampling_rate" not in dataset.attrs:
            continue
        network, station, location, channel = codes.split(".")
        header = {
            "network": network,
            "station": station,
            "location": location.replace("-", ""),
            "channel": channel,
            "sampling_rate": float(dataset.attrs["sampling_rate"]),
            "starttime": UTCDateTime(ns=int(dataset.attrs["starttime"])),
            "tag": tag,
        }
        traces.append(Trace(np.asarray(dataset), header))
    return traces


def _select_tag(name: str, traces: list[Any]) -> list[Any]:
    """Return the traces as recorded."""
    if not traces:
        raise RecordFormatError("{name}: no waveforms in this ASDF file", name=name)
    tags = sorted({trace.stats.tag for trace in traces})
    raw_tags = [tag for tag in tags if tag.endswith(RAW_TAGS)]
    if len(tags) > 1 and not raw_tags:
        raise RecordFormatError("{name}: several tags ({tags}), none as recorded; keep one", name=name, tags=tags)
    selected = raw_tags or tags
    return [trace for trace in traces if trace.stats.tag in selected]


FORMAT = register(
    Format(
        name="ASDF",
        title="ASDF",
        parse=read_asdf,
        matches=is_asdf,
        proves=("count",),
        options=WAVEFORM_OPTIONS,
        plugin=False,
        aligned=True,
    )
)
